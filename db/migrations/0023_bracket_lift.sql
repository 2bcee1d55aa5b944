-- How the brackets of a type lift, as JSON; null: stored before types stated it, what is usual.
ALTER TABLE vehicle_types ADD COLUMN bracket_lift TEXT NOT NULL DEFAULT 'null';
