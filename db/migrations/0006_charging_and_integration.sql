-- Where and when vehicles charge, and how far a vehicle takes part.
ALTER TABLE stations ADD COLUMN charger INTEGER NOT NULL DEFAULT 0;
ALTER TABLE vehicle_types ADD COLUMN battery_critical_percent REAL NOT NULL DEFAULT 15;
ALTER TABLE vehicle_types ADD COLUMN battery_low_percent REAL NOT NULL DEFAULT 30;
ALTER TABLE vehicle_types ADD COLUMN battery_enough_percent REAL NOT NULL DEFAULT 60;
ALTER TABLE vehicles_state ADD COLUMN integration TEXT NOT NULL DEFAULT 'utilise'
    CHECK (integration IN ('ignore', 'notice', 'respect', 'utilise'));
