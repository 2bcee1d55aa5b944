#pragma once

#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "core/base/result.hpp"
#include "core/fleet/state/closure.hpp"
#include "core/fleet/state/job_order.hpp"
#include "core/fleet/state/leg_plan.hpp"
#include "core/fleet/state/standing_orders.hpp"
#include "core/fleet/state/views.hpp"

/// Where the fleet core meets the outside: what it reads at start and what every step puts out.
namespace pulseline::fleet {

/// The answer stored with an Idempotency-Key, so that a repeated request gets the same one.
struct IdempotencyRecord {
    std::string client;  // user or token id
    std::string key;
    std::string body_sha256;
    JobOrderId order;
    Time at;
};

/// A piece of the journal, stored with the records its inputs caused. `seq` has no gaps. The inputs
/// are what journal::Recorder wrote, sealed; none: the fleet was built anew from the tables here,
/// and the journal goes on from the snapshot of the same seq.
struct JournalRow {
    std::int64_t seq = 0;
    Time at;                     // of the last input
    std::int64_t event_seq = 0;  // newest event once they are done
    std::int64_t inputs = 0;     // ticks not counted
    std::string bytes;
};

/// The fleet's state once the journal's rows up to a seq are done.
struct SnapshotRow {
    std::int64_t journal_seq = 0;
    std::int64_t format = 0;          // journal::kFormat of the program that wrote it
    std::int64_t plant_revision = 0;  // of the plant it was written with
    std::string bytes;                // of Fleet::snapshot, sealed
};

/// What brings a fleet back to where it was at the last commit.
struct StoredJournal {
    std::optional<SnapshotRow> snapshot;  // newest one; none: only the tables can help
    std::vector<JournalRow> rows;         // behind it
};

/// Rows to write; the batch is one transaction. Orders and vehicles are upserts by id.
struct Records {
    std::vector<JobOrder> orders;
    std::vector<VehicleRecord> vehicles;
    std::vector<LoadRecord> loads;       // upserts by id; the store keeps each move
    std::vector<LoadSheet> load_sheets;  // upserts by id
    std::vector<StopRecord> stops;
    std::vector<Event> events;
    std::vector<IdempotencyRecord> idempotency;
    std::vector<Closure> closures;    // new ones
    std::vector<ClosureId> reopened;  // to forget
    std::vector<Schedule> schedules;  // upserts by id; deleted ones say so
    std::vector<OrderTemplate> templates;
    std::vector<JournalRow> journal;  // added by the owner of the journal, not by the fleet
    bool empty() const;
};

/// All lists of the records. They are bound by place: one that is added does not compile until it
/// stands here, and so is never left out where records are put together.
template <class R>
requires std::same_as<std::remove_const_t<R>, Records>
auto lists_of(R& records) {
    auto& [orders, vehicles, loads, load_sheets, stops, events, idempotency, closures, reopened,
           schedules, templates, journal] = records;
    return std::tie(orders, vehicles, loads, load_sheets, stops, events, idempotency, closures,
                    reopened, schedules, templates, journal);
}

inline bool Records::empty() const {
    return std::apply([](const auto&... lists) { return (lists.empty() && ...); }, lists_of(*this));
}

/// Everything the fleet needs to go on after a restart.
struct StoredFleet {
    std::vector<JobOrder> orders;  // not final ones, and the final ones of the last 7 days
    std::vector<VehicleRecord> vehicles;
    std::vector<LoadRecord> loads;
    std::vector<LoadSheet> load_sheets;          // that people have said, retired ones too
    std::vector<IdempotencyRecord> idempotency;  // of the last 7 days
    std::vector<Closure> closures;               // oldest first
    std::vector<Schedule> schedules;
    std::vector<OrderTemplate> templates;
    std::int64_t last_event_seq = 0;
    std::int64_t last_order_number = 0;
    std::int64_t last_journal_seq = 0;
    /// Newest stored time. The clock starts there or later, unless it was much ahead of the truth:
    /// then it starts earlier, and the fleet brings back the times in here.
    Time last_time;
};

/// Port to the database, implemented by db::FleetStore.
class Store {
public:
    virtual ~Store() = default;
    virtual StoredFleet load() = 0;
    /// One transaction; throws db::Error when nothing was stored.
    virtual void commit(const Records& records) = 0;

    /// The newest snapshot and what follows it. Throws db::Error.
    virtual StoredJournal load_journal() = 0;
    /// A transaction of its own; throws db::Error when nothing was stored. The two newest
    /// snapshots are kept; journal rows before the older one are dropped little by little, by the
    /// commits that follow.
    virtual void put_snapshot(const SnapshotRow& snapshot) = 0;
};

struct StopQuery {
    plant::VehicleId vehicle;  // empty: any
    std::optional<int> station_number;
    JobOrderId order;  // empty: any
    int limit = 50;
    StopRecordId before;  // page on: only records older than this one; empty: from the newest
};

/// Stops that were not measured; what is known of them is an event.
struct UnmeasuredQuery {
    plant::VehicleId vehicle;  // empty: any
    std::optional<int> station_number;
    JobOrderId order;  // empty: any
    int limit = 50;
    std::optional<std::int64_t> before;  // page on: only events of a lower number
};

/// A load has got from one place to another; nothing at either end: outside the plant.
struct LoadMove {
    std::int64_t seq = 0;  // grows with time, among all loads
    LoadPlace from;
    LoadPlace to;
    Time at;
    std::string actor;  // empty: the plant forbade the place it had
};

struct LoadMoveQuery {
    plant::LoadId load;
    int limit = 50;
    std::optional<std::int64_t> before = {};  // page on: only moves of a lower number
};

struct OrderQuery {
    std::vector<JobState> states;  // empty: all
    plant::VehicleId vehicle;
    bool removed = false;  // those taken out by Cancel or Clear instead of the others
    int limit = 50;
    JobOrderId before;
};

/// Absolute deviations of earlier stops, for the expectation shown before a move.
struct StopStatistics {
    int stops = 0;
    double mean_m = 0;  // of hypot(dx, dy)
    double max_m = 0;
    double mean_rad = 0;
    double max_rad = 0;
};

/// Port to what is kept for reading only; runs on its own thread with a read-only connection.
class History {
public:
    virtual ~History() = default;
    virtual std::vector<StopRecord> stops(const StopQuery& query) = 0;  // newest first
    virtual std::optional<StopRecord> stop(StopRecordId id) = 0;
    /// The events stop.not_measured, newest first, as long as events are kept.
    virtual std::vector<Event> unmeasured_stops(const UnmeasuredQuery& query) = 0;
    virtual std::vector<LoadMove> load_moves(const LoadMoveQuery& query) = 0;  // newest first
    /// Whether people have ever said anything of such a load, retired ones too.
    virtual bool has_load_sheet(const plant::LoadId& id) = 0;
    virtual std::vector<JobOrder> orders(const OrderQuery& query) = 0;  // newest first
    virtual std::optional<JobOrder> order(JobOrderId id) = 0;
    virtual std::vector<Event> events_after(std::int64_t seq, int limit) = 0;
    virtual StopStatistics statistics(const std::vector<plant::VehicleId>& vehicles,
                                      plant::MotionMode mode, int newest) = 0;
};

/// A message for a vehicle; sent only after the records of the same step are committed.
struct VehicleMessage {
    plant::VehicleId vehicle;
    std::optional<vda5050::OrderMessage> order;
    std::optional<vda5050::InstantActionsMessage> instant_actions;
};

/// All that a step of the fleet put out. Records first: nothing else leaves the server before they
/// are committed.
struct Outputs {
    Records records;
    std::vector<VehicleMessage> messages;
    std::vector<VehicleView> vehicles;  // changed ones
    std::vector<StationView> stations;  // changed ones
    std::vector<LegPlanQuestion> plans_wanted;
    bool fleet_changed = false;
};

}  // namespace pulseline::fleet
