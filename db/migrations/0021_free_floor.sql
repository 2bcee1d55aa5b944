-- A station on free floor, to which no lane leads, has an empty node: the column refers to no table any more, which SQLite can only
-- say of a table that is made anew. What refers to the stations finds them again before the transaction ends.
PRAGMA defer_foreign_keys = ON;
CREATE TABLE stations_before AS SELECT * FROM stations;
DROP TABLE stations;
CREATE TABLE stations (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    number INTEGER NOT NULL UNIQUE,
    name TEXT NOT NULL,
    hall TEXT NOT NULL REFERENCES halls (id),
    x_m REAL NOT NULL,
    y_m REAL NOT NULL,
    heading_rad REAL NOT NULL,
    tolerance_shape TEXT NOT NULL CHECK (tolerance_shape IN ('box', 'ellipse')),
    tolerance_dx_m REAL NOT NULL,
    tolerance_dy_m REAL NOT NULL,
    tolerance_dheading_rad REAL NOT NULL,
    markers TEXT NOT NULL,
    node TEXT NOT NULL,
    resting_place INTEGER NOT NULL,
    vehicle_types TEXT NOT NULL,
    charger INTEGER NOT NULL DEFAULT 0,
    names TEXT NOT NULL DEFAULT '{}'
) STRICT;
INSERT INTO stations SELECT position, id, number, name, hall, x_m, y_m, heading_rad, tolerance_shape, tolerance_dx_m, tolerance_dy_m,
    tolerance_dheading_rad, markers, node, resting_place, vehicle_types, charger, names FROM stations_before;
DROP TABLE stations_before;
