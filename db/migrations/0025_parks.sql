-- Where vehicles with parking feet stand on them, if an order says nothing else.
ALTER TABLE stations ADD COLUMN parks INTEGER NOT NULL DEFAULT 0;
