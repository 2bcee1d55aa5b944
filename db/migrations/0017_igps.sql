-- Transmitters of iGPS; a sheet of light is the plane (a, b, 1) . x + offset_m = 0 in a transmitter's frame.
CREATE TABLE transmitters (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    hall TEXT NOT NULL REFERENCES halls (id),
    x_m REAL NOT NULL,
    y_m REAL NOT NULL,
    z_m REAL NOT NULL,
    roll_rad REAL NOT NULL,
    pitch_rad REAL NOT NULL,
    heading_rad REAL NOT NULL,
    rate_hz REAL NOT NULL,
    first_a REAL NOT NULL,
    first_b REAL NOT NULL,
    first_offset_m REAL NOT NULL,
    second_a REAL NOT NULL,
    second_b REAL NOT NULL,
    second_offset_m REAL NOT NULL,
    range_m REAL NOT NULL,
    elevation_rad REAL NOT NULL,
    sigma_rad REAL NOT NULL,
    sigma_place_m REAL NOT NULL,
    sigma_turn_rad REAL NOT NULL
) STRICT;
-- Where the receivers sit on a vehicle, as JSON; none: it does not navigate by iGPS.
ALTER TABLE vehicle_types ADD COLUMN receivers TEXT NOT NULL DEFAULT '[]';
