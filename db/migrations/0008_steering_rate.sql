-- How fast steered wheels turn about their vertical axis: they do before a motion can begin.
ALTER TABLE vehicle_types ADD COLUMN max_steering_rate_radps REAL NOT NULL DEFAULT 0.8;
