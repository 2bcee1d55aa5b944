-- Room beside a lane to go round something; 0 on both sides: none.
ALTER TABLE edges ADD COLUMN corridor_left_m REAL NOT NULL DEFAULT 0;
ALTER TABLE edges ADD COLUMN corridor_right_m REAL NOT NULL DEFAULT 0;
