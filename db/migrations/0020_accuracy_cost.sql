-- What a route costs because the place of a vehicle is uncertain on it; 0: nothing, as before.
ALTER TABLE plant ADD COLUMN accuracy_k REAL NOT NULL DEFAULT 0;
