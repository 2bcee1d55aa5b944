#include "server/cli/journal_verify.hpp"

#include <deque>
#include <limits>

#include "core/fleet/journal/input.hpp"
#include "core/fleet/journal/snapshot.hpp"
#include "core/fleet/state/fields.hpp"
#include "db/fleet/history.hpp"
#include "db/journal/journal_rows.hpp"

namespace pulseline::server::cli {
namespace {

namespace journal = fleet::journal;

constexpr std::int64_t kPage = 500;  // journal rows
constexpr int kEventPage = 1000;

std::string bytes_of(const fleet::Event& event) {
    journal::Writer writer;
    writer.put(event);
    return writer.take();
}

/// Stored events one after the other.
class StoredEvents {
public:
    StoredEvents(db::ReadOnly& database, std::int64_t after) : history_(database), after_(after) {}
    std::optional<fleet::Event> next() {
        if (page_.empty()) {
            for (auto& event : history_.events_after(after_, kEventPage)) {
                after_ = event.seq;
                page_.push_back(std::move(event));
            }
        }
        if (page_.empty()) return std::nullopt;
        fleet::Event event = std::move(page_.front());
        page_.pop_front();
        return event;
    }

private:
    db::History history_;
    std::int64_t after_;
    std::deque<fleet::Event> page_;
};

std::string in_words(const fleet::Event& event) {
    return "event " + std::to_string(event.seq) + " (" + event.type + ")";
}

/// One stretch: from a snapshot to the next one.
class Stretch {
public:
    Stretch(db::ReadOnly& database, const plant::Plant& plant, JournalReport& report)
        : database_(database), plant_(plant), report_(report) {}

    void replay(const fleet::SnapshotRow& from, const fleet::SnapshotRow* to) {
        at_ = from.journal_seq;
        const auto bytes = journal::unsealed(from.bytes);
        if (!bytes) return differ("the snapshot: " + bytes.error().what);
        auto fleet = fleet::Fleet::from_snapshot(plant_, *bytes);
        if (!fleet) return differ("the snapshot: " + fleet.error().what);
        if ((*fleet)->snapshot() != *bytes)
            return differ("the snapshot does not come back as it was");
        fleet_ = std::move(*fleet);
        ++report_.snapshots;
        stored_.emplace(database_, fleet_->last_event_seq());
        const std::int64_t end = to ? to->journal_seq : std::numeric_limits<std::int64_t>::max();
        bool built_anew = false;
        while (!report_.difference && !built_anew && at_ < end) {
            const auto rows = db::load_journal_rows(database_.sql(), at_, kPage);
            if (rows.empty()) break;
            for (const auto& row : rows) {
                if (row.seq > end) break;
                built_anew = !replay(row);
                if (built_anew || report_.difference) break;
            }
        }
        if (report_.difference || built_anew || !to) return;
        if (at_ != end) return differ("the journal ends before the next snapshot");
        const auto next = journal::unsealed(to->bytes);
        if (!next) return differ("the next snapshot: " + next.error().what);
        if (fleet_->snapshot() != *next) differ("the replay gives another state than the snapshot");
    }

private:
    /// False: the fleet was built anew from the tables there, nothing follows from what was before.
    bool replay(const fleet::JournalRow& row) {
        if (row.seq != at_ + 1) {
            differ("row " + std::to_string(at_ + 1) + " is missing");
            return true;
        }
        at_ = row.seq;
        const auto content = journal::unsealed(row.bytes);
        if (!content) {
            differ(content.error().what);
            return true;
        }
        if (content->empty()) return false;
        const auto entries = journal::decode(*content);
        if (!entries) {
            differ(entries.error().what);
            return true;
        }
        ++report_.rows;
        report_.inputs += row.inputs;
        for (const auto& entry : *entries) {
            journal::apply(*fleet_, entry, [&](fleet::Outputs&& out, Time) { compare(out); });
            if (report_.difference) return true;
        }
        if (fleet_->last_event_seq() != row.event_seq) {
            differ("the replay has come to event " + std::to_string(fleet_->last_event_seq()) +
                   ", the server to event " + std::to_string(row.event_seq));
        }
        return true;
    }

    void compare(const fleet::Outputs& out) {
        ++report_.steps;
        for (const auto& event : out.records.events) {
            if (report_.difference) return;
            const auto stored = stored_->next();
            if (!stored) return differ(in_words(event) + " of the replay is not stored");
            if (bytes_of(*stored) != bytes_of(event)) {
                return differ("stored is " + in_words(*stored) + ", the replay gives " +
                              in_words(event) +
                              (stored->type == event.type ? " with other values" : ""));
            }
            ++report_.events;
        }
    }

    void differ(std::string what) {
        if (!report_.difference) report_.difference = JournalDifference{at_, std::move(what)};
    }

    db::ReadOnly& database_;
    const plant::Plant& plant_;
    JournalReport& report_;
    std::unique_ptr<fleet::Fleet> fleet_;
    std::optional<StoredEvents> stored_;
    std::int64_t at_ = 0;
};

/// Why a snapshot cannot be replayed by this program; empty: it can.
std::string foreign(const fleet::SnapshotRow& snapshot, const plant::Plant& plant) {
    const std::string which = "snapshot at journal row " + std::to_string(snapshot.journal_seq);
    if (snapshot.format != journal::kFormat) {
        return which + ": its format is " + std::to_string(snapshot.format) +
               ", this program's is " + std::to_string(journal::kFormat);
    }
    if (snapshot.plant_revision != plant.revision) {
        return which + ": the plant was changed meanwhile, from revision " +
               std::to_string(snapshot.plant_revision) + " to " + std::to_string(plant.revision);
    }
    return {};
}

}  // namespace

JournalReport verify_journal(db::ReadOnly& database, const plant::Plant& plant) {
    JournalReport report;
    // One view of the file, whatever a running server adds and drops meanwhile.
    const soci::transaction view(database.sql());
    const auto snapshots = db::load_snapshots(database.sql());
    for (std::size_t i = 0; i < snapshots.size() && !report.difference; ++i) {
        if (auto why = foreign(snapshots[i], plant); !why.empty()) {
            report.passed_over.push_back(std::move(why));
            continue;
        }
        const bool last = i + 1 == snapshots.size();
        Stretch(database, plant, report).replay(snapshots[i], last ? nullptr : &snapshots[i + 1]);
    }
    return report;
}

}  // namespace pulseline::server::cli
