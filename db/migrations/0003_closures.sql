-- Floor that people have closed; a row goes when it is reopened (the events keep its history).
CREATE TABLE closures (
    id TEXT PRIMARY KEY,
    name TEXT NOT NULL,
    hall TEXT NOT NULL,
    outline TEXT NOT NULL, -- JSON [[x_m, y_m], ...], hall frame
    edges TEXT NOT NULL,   -- JSON ["edge", ...]
    created_by TEXT NOT NULL,
    created_ns INTEGER NOT NULL
) STRICT, WITHOUT ROWID;
