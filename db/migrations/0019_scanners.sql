-- Laser scanners that see what stands around, as JSON; null: stored before they were, those that are usual.
ALTER TABLE vehicle_types ADD COLUMN scanners TEXT NOT NULL DEFAULT 'null';
