-- What an order may say of its start, vehicle and steps; templates and schedules that make orders.
-- Columns of JSON text hold lists and bodies that only this program reads.
ALTER TABLE orders ADD COLUMN wanted_type TEXT NOT NULL DEFAULT '';
ALTER TABLE orders ADD COLUMN earliest_start_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE orders ADD COLUMN due_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE orders ADD COLUMN dependencies TEXT NOT NULL DEFAULT '[]';
ALTER TABLE orders ADD COLUMN sequence TEXT NOT NULL DEFAULT '';
ALTER TABLE orders ADD COLUMN sequence_vehicle TEXT NOT NULL DEFAULT '';
ALTER TABLE orders ADD COLUMN from_template TEXT NOT NULL DEFAULT '';
ALTER TABLE orders ADD COLUMN from_schedule TEXT NOT NULL DEFAULT '';
ALTER TABLE orders ADD COLUMN stop_requested INTEGER NOT NULL DEFAULT 0;
ALTER TABLE orders ADD COLUMN removed INTEGER NOT NULL DEFAULT 0;

ALTER TABLE job_order_steps ADD COLUMN actions_before TEXT NOT NULL DEFAULT '[]';
ALTER TABLE job_order_steps ADD COLUMN actions_after TEXT NOT NULL DEFAULT '[]';
ALTER TABLE job_order_steps ADD COLUMN phase TEXT NOT NULL DEFAULT 'drive'
    CHECK (phase IN ('before', 'drive', 'after'));
ALTER TABLE job_order_steps ADD COLUMN actions_done INTEGER NOT NULL DEFAULT 0;

CREATE TABLE job_order_schedules (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL UNIQUE,
    every_ns INTEGER NOT NULL,
    daily_at_s TEXT NOT NULL,
    window_ns INTEGER NOT NULL,
    from_ns INTEGER NOT NULL,
    until_ns INTEGER NOT NULL,
    body TEXT NOT NULL,
    paused INTEGER NOT NULL,
    next_ns INTEGER NOT NULL,
    newest_order TEXT NOT NULL,
    made INTEGER NOT NULL,
    skipped INTEGER NOT NULL,
    last_skip_code TEXT NOT NULL,
    last_skip_params TEXT NOT NULL,
    created_by TEXT NOT NULL,
    created_ns INTEGER NOT NULL,
    revision INTEGER NOT NULL
) STRICT, WITHOUT ROWID;

CREATE TABLE job_order_templates (
    name TEXT PRIMARY KEY,
    description TEXT NOT NULL,
    parameters TEXT NOT NULL,
    body TEXT NOT NULL,
    created_by TEXT NOT NULL,
    created_ns INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
