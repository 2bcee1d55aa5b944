-- Who had a vehicle stand, since when, and whether with the whole fleet. Of pauses from before, the events know.
ALTER TABLE vehicles_state ADD COLUMN paused_by TEXT NOT NULL DEFAULT '';
ALTER TABLE vehicles_state ADD COLUMN paused_ns INTEGER NOT NULL DEFAULT 0;
ALTER TABLE vehicles_state ADD COLUMN paused_with_fleet INTEGER NOT NULL DEFAULT 0;
UPDATE vehicles_state SET
    paused_by = COALESCE((SELECT actor FROM events WHERE type = 'vehicle.paused' AND vehicle = vehicles_state.id
                          ORDER BY seq DESC LIMIT 1), ''),
    paused_ns = COALESCE((SELECT at_ns FROM events WHERE type = 'vehicle.paused' AND vehicle = vehicles_state.id
                          ORDER BY seq DESC LIMIT 1), 0)
WHERE paused != 0;
