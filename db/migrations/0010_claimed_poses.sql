-- In which hall a vehicle was known to stand, and where it says that it stands while that is in doubt.
ALTER TABLE vehicles_state ADD COLUMN hall TEXT NOT NULL DEFAULT '';
ALTER TABLE vehicles_state ADD COLUMN in_doubt INTEGER NOT NULL DEFAULT 0;
ALTER TABLE vehicles_state ADD COLUMN claimed_hall TEXT NOT NULL DEFAULT '';
ALTER TABLE vehicles_state ADD COLUMN claimed_x_m REAL NOT NULL DEFAULT 0;
ALTER TABLE vehicles_state ADD COLUMN claimed_y_m REAL NOT NULL DEFAULT 0;
ALTER TABLE vehicles_state ADD COLUMN claimed_heading_rad REAL NOT NULL DEFAULT 0;
