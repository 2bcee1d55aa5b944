-- What a load has to be like for its vehicle to drive, as JSON; null: stored before types stated it, what is usual.
ALTER TABLE vehicle_types ADD COLUMN load_rules TEXT NOT NULL DEFAULT 'null';
-- Its parking feet, as JSON; null: none; before: stored before they were, the usual ones of a type with brackets.
ALTER TABLE vehicle_types ADD COLUMN parking TEXT NOT NULL DEFAULT 'before';
