#include "server/runtime/journal_keeper.hpp"

#include "core/fleet/journal/snapshot.hpp"

namespace pulseline::server {
namespace {

namespace journal = fleet::journal;

constexpr std::int64_t kSnapshotInputs = 10'000;
// An hour of ticks without anything else is replayed in a second or two.
constexpr std::int64_t kSnapshotTicks = 36'000;
// Inputs that nothing has to be stored or sent for are lost with a failed commit; vehicles say
// them again. Until then one row for many spares the disk.
constexpr Duration kLongestWait = std::chrono::seconds(1);
constexpr std::size_t kMostWaiting = 256 * 1024;  // bytes

}  // namespace

fleet::SnapshotRow JournalKeeper::begin(fleet::Fleet& fleet, const plant::Plant& plant,
                                        std::int64_t last_stored_seq, fleet::Records& records,
                                        Time now) {
    follow(fleet, last_stored_seq + 1);
    records.journal.push_back({seq_, now, fleet.last_event_seq(), 0, journal::sealed({})});
    return snapshot(fleet, plant);
}

Result<std::unique_ptr<fleet::Fleet>> JournalKeeper::rebuild(
    const plant::Plant& plant, std::shared_ptr<const fleet::PlantTables> tables,
    const fleet::StoredJournal& stored) {
    const auto& snapshot = stored.snapshot;
    if (!snapshot || snapshot->format != journal::kFormat ||
        snapshot->plant_revision != plant.revision) {
        return fail(Errc::kInvalid, "journal_foreign",
                    "There is no snapshot by this program of this plant.");
    }
    const auto bytes = journal::unsealed(snapshot->bytes);
    if (!bytes) return fail(bytes.error());
    auto fleet = fleet::Fleet::from_snapshot(plant, *bytes, std::move(tables));
    if (!fleet) return fleet;
    std::int64_t seq = snapshot->journal_seq;
    for (const auto& row : stored.rows) {
        if (row.seq != seq + 1) return journal::broken("a row is missing");
        seq = row.seq;
        const auto content = journal::unsealed(row.bytes);
        if (!content) return fail(content.error());
        if (content->empty()) return journal::broken("the fleet was built anew behind it");
        const auto entries = journal::decode(*content);
        if (!entries) return fail(entries.error());
        // What it put out was released when the row was committed.
        for (const auto& entry : *entries) journal::apply(**fleet, entry, [](auto&&, Time) {});
    }
    follow(**fleet, seq);
    return fleet;
}

void JournalKeeper::follow(fleet::Fleet& fleet, std::int64_t seq) {
    recorder_.clear();
    waits_since_.reset();
    seq_ = seq;
    inputs_ = 0;
    ticks_ = 0;
    bytes_ = 0;
    fleet.journal_into(&recorder_);
}

void JournalKeeper::add_row(const fleet::Fleet& fleet, fleet::Outputs& out, Time now) {
    if (recorder_.inputs() > 0 && !waits_since_) waits_since_ = now;
    const bool waited = waits_since_ && now - *waits_since_ >= kLongestWait;
    if (!out.records.empty() || !out.messages.empty() || waited ||
        recorder_.size() >= kMostWaiting) {
        flush(fleet, out.records, now);
    }
}

void JournalKeeper::add_rest(const fleet::Fleet& fleet, fleet::Records& records, Time now) {
    if (!recorder_.empty()) flush(fleet, records, now);
}

void JournalKeeper::flush(const fleet::Fleet& fleet, fleet::Records& records, Time now) {
    const auto inputs = static_cast<std::int64_t>(recorder_.inputs());
    records.journal.push_back(
        {++seq_, now, fleet.last_event_seq(), inputs, journal::sealed(recorder_.take())});
    bytes_ += records.journal.back().bytes.size();
    inputs_ += inputs;
    waits_since_.reset();
}

bool JournalKeeper::snapshot_is_due() const {
    // A week of finished orders weighs more than the journal: then it is not written at every turn.
    return ticks_ >= kSnapshotTicks || (inputs_ >= kSnapshotInputs && bytes_ >= snapshot_bytes_);
}

fleet::SnapshotRow JournalKeeper::snapshot(const fleet::Fleet& fleet, const plant::Plant& plant) {
    fleet::SnapshotRow row{seq_, journal::kFormat, plant.revision, fleet.snapshot()};
    snapshot_bytes_ = row.bytes.size();
    inputs_ = 0;
    ticks_ = 0;
    bytes_ = 0;
    return row;
}

}  // namespace pulseline::server
