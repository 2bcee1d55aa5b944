#pragma once

#include <memory>

#include "core/fleet/state/ports.hpp"
#include "db/database.hpp"
#include "db/journal/journal_store.hpp"

namespace pulseline::db {

/// What the fleet keeps. commit() is the hot path: its statements are prepared once.
/// `database` must outlive it. Thread safety: none, as Database.
class FleetStore : public fleet::Store {
public:
    /// How long events are kept: the newest so many, and of these the ones not older than `age` by
    /// the newest one's time. Older ones go a few with each commit, oldest first, so that those
    /// that are left have no gap.
    struct EventsKept {
        std::int64_t newest = 1'000'000;
        Duration age = std::chrono::hours(400 * 24);
    };

    explicit FleetStore(Database& database);
    ~FleetStore() override;

    fleet::StoredFleet load() override;
    /// Also throws db::Error when an event does not follow the newest stored one without a gap: a
    /// hole in the journal would never be found again.
    void commit(const fleet::Records& records) override;
    fleet::StoredJournal load_journal() override { return journal_.load(); }
    void keep_events(EventsKept kept) { events_kept_ = kept; }
    void put_snapshot(const fleet::SnapshotRow& snapshot) override { journal_.put(snapshot); }

private:
    struct Statements;

    void put(const fleet::JobOrder& order);
    void put_standing(const fleet::Records& records);
    void drop_old_events(const fleet::Event& newest);

    Database& database_;
    std::unique_ptr<Statements> statements_;
    JournalStore journal_;
    EventsKept events_kept_;
    std::int64_t last_seq_ = 0;
    std::int64_t first_seq_ = 0;  // oldest event that is left
};

}  // namespace pulseline::db
