-- What people have said of a load while the server ran: new ones, and what is known by now of the plant's. Retired ones stay: nobody else gets their id.
CREATE TABLE load_sheets (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    kind TEXT NOT NULL,
    model TEXT NOT NULL,
    mass_kg REAL NOT NULL,
    centre_x_m REAL NOT NULL,
    centre_y_m REAL NOT NULL,
    outline TEXT NOT NULL,
    vehicle_types TEXT NOT NULL,
    names TEXT NOT NULL,
    at_ns INTEGER NOT NULL,
    actor TEXT NOT NULL,
    retired INTEGER NOT NULL
) STRICT;
