-- What laser scanners navigate by.
CREATE TABLE reflectors (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    hall TEXT NOT NULL REFERENCES halls (id),
    x_m REAL NOT NULL,
    y_m REAL NOT NULL,
    sigma_m REAL NOT NULL
) STRICT;
-- The scanner that looks for them, as JSON; null: the type has none.
ALTER TABLE vehicle_types ADD COLUMN navigation_scanner TEXT NOT NULL DEFAULT 'null';
