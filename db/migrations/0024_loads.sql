-- What vehicles carry is a thing of its own. Here stands where it is at first, in loads_state where it has got to since.
CREATE TABLE loads (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL,
    kind TEXT NOT NULL,
    model TEXT NOT NULL,
    mass_kg REAL NOT NULL,
    centre_x_m REAL NOT NULL,
    centre_y_m REAL NOT NULL,
    outline TEXT NOT NULL,
    vehicle_types TEXT NOT NULL,
    vehicle TEXT NOT NULL,
    station TEXT NOT NULL,
    names TEXT NOT NULL
) STRICT;

-- Until now a name and a mass of the vehicle; names need not have been unique, the vehicle's id is.
INSERT INTO loads
SELECT ROW_NUMBER() OVER (ORDER BY position) - 1, id || '-load', CASE load_name WHEN '' THEN id || '-load' ELSE load_name END,
       'product', '', load_kg, 0, 0, '[]', json_array(type), id, '', '{}'
FROM vehicles WHERE load_name <> '' OR load_kg > 0;
ALTER TABLE vehicles DROP COLUMN load_name;
ALTER TABLE vehicles DROP COLUMN load_kg;

CREATE TABLE loads_state (
    id TEXT PRIMARY KEY,
    vehicle TEXT NOT NULL,
    station TEXT NOT NULL,
    at_ns INTEGER NOT NULL,
    actor TEXT NOT NULL
) STRICT;

-- Hoist or stands of a station.
ALTER TABLE stations ADD COLUMN has_support INTEGER NOT NULL DEFAULT 0;
ALTER TABLE stations ADD COLUMN support_height_m REAL NOT NULL DEFAULT 0;

-- What stood there.
ALTER TABLE stop_records ADD COLUMN load TEXT NOT NULL DEFAULT '';
