-- Wheels that swivel and tell nothing; how a type's axes are controlled, as JSON (null: stored before types stated it, what is
-- usual); and from where on the drives of its wheels are warm, and switch themselves off.
ALTER TABLE vehicle_types ADD COLUMN casters TEXT NOT NULL DEFAULT '[]';
ALTER TABLE vehicle_types ADD COLUMN control TEXT NOT NULL DEFAULT 'null';
ALTER TABLE vehicle_types ADD COLUMN drive_warm_c REAL NOT NULL DEFAULT 65;
ALTER TABLE vehicle_types ADD COLUMN drive_hot_c REAL NOT NULL DEFAULT 90;
