-- Times are nanoseconds of the core clock (UTC). Ids are UUIDs as text; '' stands for none.
-- Orders, stops and events name plant elements without foreign keys: they outlive a new plant.

CREATE TABLE orders (
    id TEXT PRIMARY KEY,
    number INTEGER NOT NULL UNIQUE,
    client_order_id TEXT NOT NULL,
    wanted_vehicle TEXT NOT NULL,
    assigned_vehicle TEXT NOT NULL,
    priority INTEGER NOT NULL,
    current_step INTEGER NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('NotAllowedToStart', 'AllowedToStart', 'Running',
                                         'Interrupted', 'Ended', 'Aborted')),
    cancel_requested INTEGER NOT NULL,
    pause_requested INTEGER NOT NULL,
    reason_code TEXT NOT NULL,
    reason_params TEXT NOT NULL,
    created_by TEXT NOT NULL,
    created_ns INTEGER NOT NULL,
    started_ns INTEGER NOT NULL,
    ended_ns INTEGER NOT NULL,
    revision INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX orders_by_state ON orders (state, id);
CREATE INDEX orders_by_client_order_id ON orders (client_order_id) WHERE client_order_id <> '';

CREATE TABLE job_order_steps (
    order_id TEXT NOT NULL REFERENCES orders (id) ON DELETE CASCADE,
    position INTEGER NOT NULL,
    station TEXT NOT NULL,
    mode TEXT NOT NULL,
    state TEXT NOT NULL CHECK (state IN ('pending', 'driving', 'measuring', 'done', 'skipped')),
    leg TEXT NOT NULL,
    stop TEXT NOT NULL,
    attempts INTEGER NOT NULL,
    PRIMARY KEY (order_id, position)
) STRICT, WITHOUT ROWID;

CREATE TABLE stop_records (
    id TEXT PRIMARY KEY,
    order_id TEXT NOT NULL,
    leg TEXT NOT NULL,
    step INTEGER NOT NULL,
    vehicle TEXT NOT NULL,
    station TEXT NOT NULL,
    station_number INTEGER NOT NULL,
    mode TEXT NOT NULL,
    theoretical_x_m REAL NOT NULL,
    theoretical_y_m REAL NOT NULL,
    theoretical_heading_rad REAL NOT NULL,
    measured_x_m REAL NOT NULL,
    measured_y_m REAL NOT NULL,
    measured_heading_rad REAL NOT NULL,
    dx_m REAL NOT NULL,
    dy_m REAL NOT NULL,
    dheading_rad REAL NOT NULL,
    along_m REAL NOT NULL,
    left_m REAL NOT NULL,
    sigma_xy_m REAL NOT NULL,
    sigma_heading_rad REAL NOT NULL,
    tolerance_shape TEXT NOT NULL CHECK (tolerance_shape IN ('box', 'ellipse')),
    tolerance_dx_m REAL NOT NULL,
    tolerance_dy_m REAL NOT NULL,
    tolerance_dheading_rad REAL NOT NULL,
    inside INTEGER NOT NULL,
    attempt INTEGER NOT NULL,
    method TEXT NOT NULL,
    markers TEXT NOT NULL,
    load_kg REAL NOT NULL,
    at_ns INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX stop_records_by_vehicle ON stop_records (vehicle, id);
CREATE INDEX stop_records_by_station ON stop_records (station_number, id);
CREATE INDEX stop_records_by_order ON stop_records (order_id, id);

CREATE TABLE events (
    seq INTEGER PRIMARY KEY,
    at_ns INTEGER NOT NULL,
    type TEXT NOT NULL,
    order_id TEXT NOT NULL,
    leg TEXT NOT NULL,
    vehicle TEXT NOT NULL,
    actor TEXT NOT NULL,
    params TEXT NOT NULL
) STRICT;

CREATE TABLE vehicles_state (
    id TEXT PRIMARY KEY,
    pose_known INTEGER NOT NULL,
    x_m REAL NOT NULL,
    y_m REAL NOT NULL,
    heading_rad REAL NOT NULL,
    at_station TEXT NOT NULL,
    leg TEXT NOT NULL,
    has_leg INTEGER NOT NULL,
    leg_data TEXT NOT NULL,
    needs_resume INTEGER NOT NULL,
    needs_resume_code TEXT NOT NULL,
    needs_resume_params TEXT NOT NULL,
    paused INTEGER NOT NULL,
    last_stop TEXT NOT NULL,
    last_stop_station TEXT NOT NULL,
    last_stop_inside INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE idempotency_keys (
    client TEXT NOT NULL,
    key TEXT NOT NULL,
    body_sha256 TEXT NOT NULL,
    order_id TEXT NOT NULL REFERENCES orders (id) ON DELETE CASCADE,
    at_ns INTEGER NOT NULL,
    PRIMARY KEY (client, key)
) STRICT, WITHOUT ROWID;
CREATE INDEX idempotency_keys_by_time ON idempotency_keys (at_ns);
CREATE INDEX idempotency_keys_by_order ON idempotency_keys (order_id);

CREATE TABLE users (
    name TEXT PRIMARY KEY,
    role TEXT NOT NULL CHECK (role IN ('viewer', 'operator', 'engineer', 'admin')),
    password_hash TEXT NOT NULL,
    disabled INTEGER NOT NULL,
    created_ns INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE sessions (
    token_sha256 TEXT PRIMARY KEY,
    csrf_token TEXT NOT NULL,
    user TEXT NOT NULL REFERENCES users (name) ON DELETE CASCADE,
    created_ns INTEGER NOT NULL,
    expires_ns INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
CREATE INDEX sessions_by_user ON sessions (user);

CREATE TABLE tokens (
    id TEXT PRIMARY KEY,
    token_sha256 TEXT NOT NULL UNIQUE,
    note TEXT NOT NULL,
    role TEXT NOT NULL,
    scope TEXT NOT NULL,
    vehicle_manufacturer TEXT NOT NULL,
    vehicle_serial TEXT NOT NULL,
    revoked INTEGER NOT NULL,
    created_ns INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

-- The plant. `position` keeps the order of the plant file; lists inside an element are JSON.
CREATE TABLE plant (
    only_one INTEGER PRIMARY KEY CHECK (only_one = 1),
    id TEXT NOT NULL,
    name TEXT NOT NULL,
    revision INTEGER NOT NULL,
    k_same REAL NOT NULL,
    k_diff REAL NOT NULL,
    reference_step_m REAL NOT NULL,
    turn_threshold_rad REAL NOT NULL
) STRICT;

CREATE TABLE halls (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL,
    outline TEXT NOT NULL,
    occupancy_yaml TEXT NOT NULL,
    grid_width INTEGER NOT NULL,
    grid_height INTEGER NOT NULL,
    grid_resolution_m REAL NOT NULL,
    grid_origin_x_m REAL NOT NULL,
    grid_origin_y_m REAL NOT NULL,
    grid BLOB NOT NULL
) STRICT;

CREATE TABLE nodes (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    hall TEXT NOT NULL REFERENCES halls (id),
    x_m REAL NOT NULL,
    y_m REAL NOT NULL
) STRICT;

CREATE TABLE edges (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    from_node TEXT NOT NULL REFERENCES nodes (id),
    to_node TEXT NOT NULL REFERENCES nodes (id),
    max_speed_mps REAL NOT NULL,
    vehicle_types TEXT NOT NULL
) STRICT;

CREATE TABLE vehicle_types (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    name TEXT NOT NULL,
    kinematics TEXT NOT NULL,
    footprint TEXT NOT NULL,
    load_footprint TEXT NOT NULL,
    max_speed_mps REAL NOT NULL,
    max_accel_mps2 REAL NOT NULL,
    max_turn_rate_radps REAL NOT NULL,
    max_turn_accel_radps2 REAL NOT NULL,
    min_turn_radius_m REAL NOT NULL,
    max_arc_radius_m REAL NOT NULL,
    clearance_m REAL NOT NULL,
    motion_modes TEXT NOT NULL,
    wheels TEXT NOT NULL,
    cameras TEXT NOT NULL,
    brackets TEXT NOT NULL,
    mass_kg REAL NOT NULL,
    max_load_kg REAL NOT NULL
) STRICT;

CREATE TABLE markers (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    kind TEXT NOT NULL,
    payload TEXT NOT NULL UNIQUE,
    size_m REAL NOT NULL,
    hall TEXT NOT NULL REFERENCES halls (id),
    x_m REAL NOT NULL,
    y_m REAL NOT NULL,
    heading_rad REAL NOT NULL,
    sigma_xy_m REAL NOT NULL,
    sigma_heading_rad REAL NOT NULL
) STRICT;

CREATE TABLE areas (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    hall TEXT NOT NULL REFERENCES halls (id),
    outline TEXT NOT NULL
) STRICT;

CREATE TABLE stations (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    number INTEGER NOT NULL UNIQUE,
    name TEXT NOT NULL,
    hall TEXT NOT NULL REFERENCES halls (id),
    x_m REAL NOT NULL,
    y_m REAL NOT NULL,
    heading_rad REAL NOT NULL,
    tolerance_shape TEXT NOT NULL CHECK (tolerance_shape IN ('box', 'ellipse')),
    tolerance_dx_m REAL NOT NULL,
    tolerance_dy_m REAL NOT NULL,
    tolerance_dheading_rad REAL NOT NULL,
    markers TEXT NOT NULL,
    node TEXT NOT NULL REFERENCES nodes (id),
    resting_place INTEGER NOT NULL,
    vehicle_types TEXT NOT NULL
) STRICT;

CREATE TABLE vehicles (
    position INTEGER PRIMARY KEY,
    id TEXT NOT NULL UNIQUE,
    type TEXT NOT NULL REFERENCES vehicle_types (id),
    manufacturer TEXT NOT NULL,
    serial_number TEXT NOT NULL,
    name TEXT NOT NULL,
    home TEXT NOT NULL REFERENCES stations (id),
    load_name TEXT NOT NULL,
    load_kg REAL NOT NULL,
    UNIQUE (manufacturer, serial_number)
) STRICT;
