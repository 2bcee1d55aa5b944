-- What a type's cameras look for, how noisy its measuring wheels are (0: it has none), and how high it is.
ALTER TABLE vehicle_types ADD COLUMN height_m REAL NOT NULL DEFAULT 1.2;
ALTER TABLE vehicle_types ADD COLUMN usual_code_kind TEXT NOT NULL DEFAULT 'qr';
ALTER TABLE vehicle_types ADD COLUMN usual_code_size_m REAL NOT NULL DEFAULT 0.06;
ALTER TABLE vehicle_types ADD COLUMN slip_sensor_noise_mps REAL NOT NULL DEFAULT 0;
