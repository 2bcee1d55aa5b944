-- 06:00 is what the clock on the plant's wall shows, summer and winter.
ALTER TABLE job_order_schedules ADD COLUMN time_zone TEXT NOT NULL DEFAULT 'UTC';
