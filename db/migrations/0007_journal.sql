-- The inputs of the fleet core since the older of two snapshots of its state: what a failed commit
-- is made good from, and what `pulseline journal verify` replays. Bytes as core/fleet/journal
-- writes them.
CREATE TABLE journal (
    seq INTEGER PRIMARY KEY,
    at_ns INTEGER NOT NULL,     -- of the last input
    event_seq INTEGER NOT NULL, -- newest event once they are done
    inputs INTEGER NOT NULL,    -- ticks not counted
    bytes BLOB NOT NULL
) STRICT;
CREATE TABLE snapshots (
    journal_seq INTEGER PRIMARY KEY, -- rows up to it are in the state
    format INTEGER NOT NULL,
    plant_revision INTEGER NOT NULL,
    bytes BLOB NOT NULL
) STRICT;
