#pragma once

#include <cstdint>
#include <memory>

#include "core/fleet/state/ports.hpp"
#include "db/database.hpp"

namespace pulseline::db {

/// The journal and the snapshots of the fleet. `database` must outlive it. Thread safety: none.
class JournalStore {
public:
    explicit JournalStore(Database& database);
    ~JournalStore();

    std::int64_t last_seq() const { return last_seq_; }
    fleet::StoredJournal load();
    /// Inside the caller's transaction; drops a few rows that nobody needs, too. Throws db::Error
    /// when a row does not follow the newest one.
    void put(const std::vector<fleet::JournalRow>& rows);
    /// To be called once that transaction is committed.
    void committed();
    /// A transaction of its own.
    void put(const fleet::SnapshotRow& snapshot);

private:
    struct Statements;
    void read_bounds();

    Database& database_;
    std::unique_ptr<Statements> statements_;
    std::int64_t last_seq_ = 0;
    std::int64_t oldest_seq_ = 0;    // not dropped yet
    std::int64_t needless_seq_ = 0;  // up to here nobody needs them
    std::int64_t next_last_seq_ = 0;
    std::int64_t next_oldest_seq_ = 0;
};

}  // namespace pulseline::db
