-- People read which stops were not measured, of a vehicle or a station, newest first, among millions of other events.
CREATE INDEX events_unmeasured ON events (seq) WHERE type = 'stop.not_measured';
