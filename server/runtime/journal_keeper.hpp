#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/fleet/journal/recorder.hpp"

namespace pulseline::server {

/// When the fleet's inputs become a row of the journal, and when a snapshot is due. Thread safety:
/// none, it belongs to the fleet thread.
class JournalKeeper {
public:
    /// A fleet that was built from the tables: `records` get the row that says so, and the
    /// snapshot returned is where the journal goes on.
    fleet::SnapshotRow begin(fleet::Fleet& fleet, const plant::Plant& plant,
                             std::int64_t last_stored_seq, fleet::Records& records, Time now);
    /// The fleet as it was at the last commit. `tables`: see Fleet. Errors: journal_broken {why},
    /// journal_foreign.
    Result<std::unique_ptr<fleet::Fleet>> rebuild(const plant::Plant& plant,
                                                  std::shared_ptr<const fleet::PlantTables> tables,
                                                  const fleet::StoredJournal& stored);

    /// A step's outputs were taken: its inputs become a row when something has to be stored or
    /// sent, else they wait for the next that has, a second at most.
    void add_row(const fleet::Fleet& fleet, fleet::Outputs& out, Time now);
    /// What waits becomes a row now.
    void add_rest(const fleet::Fleet& fleet, fleet::Records& records, Time now);
    bool snapshot_is_due() const;
    /// REQUIRES: nothing waits.
    fleet::SnapshotRow snapshot(const fleet::Fleet& fleet, const plant::Plant& plant);
    void count_tick() { ++ticks_; }
    bool nothing_waits() const { return recorder_.empty(); }

private:
    void follow(fleet::Fleet& fleet, std::int64_t seq);
    void flush(const fleet::Fleet& fleet, fleet::Records& records, Time now);

    fleet::journal::Recorder recorder_;
    std::int64_t seq_ = 0;  // of the newest row
    std::optional<Time> waits_since_;
    std::int64_t inputs_ = 0;  // since the newest snapshot
    std::int64_t ticks_ = 0;
    std::size_t bytes_ = 0;
    std::size_t snapshot_bytes_ = 0;  // of the newest
};

}  // namespace pulseline::server
