-- A session that was left alone ends by its idle time across a restart too. Of those from before,
-- nobody knows when they were used last but that it was not before they were made.
ALTER TABLE sessions ADD COLUMN used_ns INTEGER NOT NULL DEFAULT 0;
UPDATE sessions SET used_ns = created_ns;
