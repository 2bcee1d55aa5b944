-- When a running order should end, and how long each of its drives was planned to take.
ALTER TABLE orders ADD COLUMN expected_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE job_order_steps ADD COLUMN planned_s REAL NOT NULL DEFAULT 0;
