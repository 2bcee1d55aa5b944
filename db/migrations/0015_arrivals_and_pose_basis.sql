-- Where the drive of a stop had ended before small moves mended it, and what was expected of it.
ALTER TABLE stop_records ADD COLUMN has_arrival INTEGER NOT NULL DEFAULT 0;
ALTER TABLE stop_records ADD COLUMN arrival_dx_m REAL NOT NULL DEFAULT 0;
ALTER TABLE stop_records ADD COLUMN arrival_dy_m REAL NOT NULL DEFAULT 0;
ALTER TABLE stop_records ADD COLUMN arrival_dheading_rad REAL NOT NULL DEFAULT 0;
ALTER TABLE stop_records ADD COLUMN arrival_expected_m REAL NOT NULL DEFAULT 0;
ALTER TABLE stop_records ADD COLUMN arrival_expected_rad REAL NOT NULL DEFAULT 0;
-- What a vehicle's pose rests on ('': nobody knows), so that a restart does not forget it.
ALTER TABLE vehicles_state ADD COLUMN basis TEXT NOT NULL DEFAULT '';
ALTER TABLE vehicles_state ADD COLUMN basis_station TEXT NOT NULL DEFAULT '';
ALTER TABLE vehicles_state ADD COLUMN basis_actor TEXT NOT NULL DEFAULT '';
ALTER TABLE vehicles_state ADD COLUMN basis_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE vehicles_state ADD COLUMN basis_driven_m REAL NOT NULL DEFAULT 0;
-- Names of things in other languages than the plant's own, as JSON: {"zh": "..."}.
ALTER TABLE plant ADD COLUMN names TEXT NOT NULL DEFAULT '{}';
ALTER TABLE halls ADD COLUMN names TEXT NOT NULL DEFAULT '{}';
ALTER TABLE stations ADD COLUMN names TEXT NOT NULL DEFAULT '{}';
ALTER TABLE areas ADD COLUMN names TEXT NOT NULL DEFAULT '{}';
ALTER TABLE vehicle_types ADD COLUMN names TEXT NOT NULL DEFAULT '{}';
