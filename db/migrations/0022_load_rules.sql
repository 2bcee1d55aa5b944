-- What a load has to be like for its vehicle to drive, as JSON; null: stored before types stated it, what is usual.
ALTER TABLE vehicle_types ADD COLUMN load_rules TEXT NOT NULL DEFAULT 'null';
