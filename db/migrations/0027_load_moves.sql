-- Each move of a load, kept for ever: of which assembly stations an aircraft has been at, people ask years later.
CREATE TABLE load_moves (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    load TEXT NOT NULL,
    from_vehicle TEXT NOT NULL,
    from_station TEXT NOT NULL,
    to_vehicle TEXT NOT NULL,
    to_station TEXT NOT NULL,
    at_ns INTEGER NOT NULL,
    actor TEXT NOT NULL
) STRICT;
CREATE INDEX load_moves_by_load ON load_moves (load, id);
