-- A start reads the open orders and those that ended lately, however many ended before.
CREATE INDEX orders_by_end ON orders (ended_ns) WHERE ended_ns > 0;
