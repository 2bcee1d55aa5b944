#include "db/fleet/fleet_store.hpp"

#include <algorithm>
#include <map>

#include "core/base/crash_point.hpp"
#include "core/fleet/state/order_book.hpp"
#include "db/fleet/fleet_rows.hpp"
#include "db/fleet/order_reader.hpp"
#include "db/fleet/standing_rows.hpp"
#include "db/names.hpp"
#include "db/plant/plant_json.hpp"
#include "db/sql_text.hpp"
#include "db/statement.hpp"

namespace pulseline::db {
namespace {

constexpr std::int64_t kKept_ns = 7LL * 24 * 3600 * 1'000'000'000;

struct KeyRow {
    static constexpr const char* kColumns = "client, key, body_sha256, order_id, at_ns";
    std::string client, key, body_sha256, order_id;
    std::int64_t at_ns = 0;

    auto fields() { return std::tie(client, key, body_sha256, order_id, at_ns); }
};

struct ClosureRow {
    static constexpr const char* kColumns =
        "id, name, hall, outline, edges, created_by, created_ns";
    std::string id, name, hall, outline, edges, created_by;
    std::int64_t created_ns = 0;

    auto fields() { return std::tie(id, name, hall, outline, edges, created_by, created_ns); }
    void set(const fleet::Closure& closure) {
        id = stored_id(closure.id);
        name = closure.name;
        hall = closure.hall.str();
        outline = polygon_to_json(closure.outline);
        edges = names_to_json(closure.edges);
        created_by = closure.created_by;
        created_ns = to_ns(closure.created);
    }
    fleet::Closure get() const {
        fleet::Closure closure;
        read_id(id, closure.id);
        closure.name = name;
        closure.hall = plant::HallId(hall);
        closure.outline = polygon_from_json(outline);
        closure.edges = edges_from_json(edges);
        closure.created_by = created_by;
        closure.created = time_from_ns(created_ns);
        return closure;
    }
};

constexpr const char* kDropClosure = "DELETE FROM closures WHERE id = :id";
// Before the load's row is: from where it stands there, or, nothing stored yet, from where the
// plant has it at first. Whoever is put where it is has not moved.
constexpr const char* kPutMove =
    "INSERT INTO load_moves (load, to_vehicle, to_station, at_ns, actor, from_vehicle, "
    "from_station) SELECT new.id, new.vehicle, new.station, new.at_ns, new.actor, "
    "COALESCE(known.vehicle, first.vehicle, '') AS left_vehicle, "
    "COALESCE(known.station, first.station, '') AS left_station FROM (SELECT :id AS id, :vehicle "
    "AS vehicle, :station AS station, :at_ns AS at_ns, :actor AS actor) AS new LEFT JOIN "
    "loads_state AS known ON known.id = new.id LEFT JOIN loads AS first ON first.id = new.id WHERE "
    "new.vehicle <> left_vehicle OR new.station <> left_station";
constexpr const char* kDropSteps =
    "DELETE FROM job_order_steps WHERE order_id = :order_id AND position >= :count";
constexpr const char* kDropEvents = "DELETE FROM events WHERE seq <= :upto";
constexpr const char* kTimeOfEvent = "SELECT at_ns FROM events WHERE seq = ";
constexpr std::int64_t kEventsDroppedAtOnce = 64;  // with one commit
constexpr const char* kDropKeys = "DELETE FROM idempotency_keys WHERE at_ns < :before";

// Open orders and those of the last days that the fleet would not forget at once, each part by an
// index of its own.
const std::string kKeptOrders =
    "SELECT id FROM orders WHERE state IN ('NotAllowedToStart', 'AllowedToStart', 'Running', "
    "'Interrupted') UNION SELECT id FROM (SELECT id FROM orders WHERE ended_ns > 0 AND ended_ns >= "
    ":since ORDER BY ended_ns DESC LIMIT " +
    std::to_string(fleet::OrderBook::kMostEnded) + ")";

std::int64_t scalar(soci::session& sql, const std::string& query) {
    std::int64_t value = 0;
    sql << query, soci::into(value);
    return value;
}

/// Newest time of all tables, from the ends of their indexes: what is stored of an order later than
/// its creation and before its end comes with an event.
std::int64_t newest_time(soci::session& sql) {
    // By their numbers, which always grow: a clock that once was ahead left later times behind.
    const std::int64_t told = std::max(
        scalar(sql, "SELECT COALESCE((SELECT at_ns FROM events ORDER BY seq DESC LIMIT 1), 0)"),
        scalar(sql, "SELECT COALESCE((SELECT at_ns FROM journal ORDER BY seq DESC LIMIT 1), 0)"));
    if (told > 0) return told;
    return std::max(
        {scalar(sql,
                "SELECT COALESCE((SELECT MAX(created_ns, started_ns, ended_ns) FROM orders ORDER "
                "BY number DESC LIMIT 1), 0)"),
         scalar(sql, "SELECT COALESCE(MAX(ended_ns), 0) FROM orders WHERE ended_ns > 0"),
         scalar(sql,
                "SELECT COALESCE((SELECT at_ns FROM stop_records ORDER BY id DESC LIMIT 1), 0)"),
         scalar(sql, "SELECT COALESCE(MAX(at_ns), 0) FROM idempotency_keys")});
}

/// Two passes in the same order: a query for the steps of each order would take ten times as long.
std::vector<fleet::JobOrder> load_orders(soci::session& sql, std::int64_t since_ns) {
    std::vector<fleet::JobOrder> orders;
    OrderRow order;
    Statement list(sql,
                   std::string("SELECT ") + OrderRow::kColumns + " FROM orders WHERE id IN (" +
                       kKeptOrders + ") ORDER BY id",
                   std::tie(since_ns), order.fields());
    for (list.start(); list.fetch();) orders.push_back(order.get());

    StepRow step;
    Statement steps(sql,
                    std::string("SELECT ") + StepRow::kColumns +
                        " FROM job_order_steps WHERE order_id IN (" + kKeptOrders +
                        ") ORDER BY order_id, position",
                    std::tie(since_ns), step.fields());
    auto of = orders.begin();
    std::string id;
    for (steps.start(); steps.fetch();) {
        if (step.order_id != id) {
            id = step.order_id;
            while (of != orders.end() && of->id.str() != id) ++of;
            if (of == orders.end()) break;
        }
        of->steps.push_back(step.get());
    }
    for (const auto& one : orders) {
        // The fleet relies on it when it looks up the step of an open order.
        const bool open =
            one.state != fleet::JobState::kEnded && one.state != fleet::JobState::kAborted;
        if (one.current_step < one.steps.size() + (open ? 0 : 1)) continue;
        throw Error(Error::Kind::kBadValue, "The database lacks steps of the order " +
                                                one.id.str() + "; restore a backup.");
    }
    std::ranges::sort(orders, {}, &fleet::JobOrder::number);
    return orders;
}

/// The fleet relies on it when it looks up the step that a vehicle drives for.
void check_legs(const fleet::StoredFleet& stored) {
    std::map<fleet::JobOrderId, std::size_t> steps;
    for (const auto& order : stored.orders) steps[order.id] = order.steps.size();
    for (const auto& vehicle : stored.vehicles) {
        const auto order = steps.find(vehicle.leg_data.order);
        if (!vehicle.has_leg || order == steps.end()) continue;
        if (static_cast<std::size_t>(vehicle.leg_data.step) < order->second) continue;
        throw Error(Error::Kind::kBadValue, "The database names a step that the order " +
                                                order->first.str() +
                                                " does not have; restore a backup.");
    }
}

}  // namespace

struct FleetStore::Statements {
    explicit Statements(soci::session& sql)
        : put_order(sql, upsert_into("orders", OrderRow::kColumns, "id"), order.fields()),
          put_step(sql, upsert_into("job_order_steps", StepRow::kColumns, "order_id, position"),
                   step.fields()),
          drop_steps(sql, kDropSteps, std::tie(order.id, step_count)),
          put_stop(sql, insert_into("stop_records", StopRow::kColumns), stop.fields()),
          put_event(sql, insert_into("events", EventRow::kColumns), event.fields()),
          drop_events(sql, kDropEvents, std::tie(events_upto)),
          put_vehicle(sql, upsert_into("vehicles_state", VehicleRow::kColumns, "id"),
                      vehicle.fields()),
          put_move(sql, kPutMove, load.fields()),
          put_load(sql, upsert_into("loads_state", LoadPlaceRow::kColumns, "id"), load.fields()),
          put_load_sheet(sql, upsert_into("load_sheets", LoadSheetRow::kColumns, "id"),
                         load_sheet.fields()),
          put_key(sql, upsert_into("idempotency_keys", KeyRow::kColumns, "client, key"),
                  key.fields()),
          drop_keys(sql, kDropKeys, std::tie(keys_before)),
          put_closure(sql, upsert_into("closures", ClosureRow::kColumns, "id"), closure.fields()),
          drop_closure(sql, kDropClosure, std::tie(closure.id)),
          put_schedule(sql, upsert_into("job_order_schedules", ScheduleRow::kColumns, "id"),
                       schedule.fields()),
          drop_schedule(sql, "DELETE FROM job_order_schedules WHERE id = :id",
                        std::tie(schedule.id)),
          put_template(sql, upsert_into("job_order_templates", TemplateRow::kColumns, "name"),
                       order_template.fields()),
          drop_template(sql, "DELETE FROM job_order_templates WHERE name = :name",
                        std::tie(order_template.name)) {}

    OrderRow order;
    StepRow step;
    StopRow stop;
    EventRow event;
    VehicleRow vehicle;
    LoadPlaceRow load;
    LoadSheetRow load_sheet;
    KeyRow key;
    ClosureRow closure;
    ScheduleRow schedule;
    TemplateRow order_template;
    std::int64_t step_count = 0;
    std::int64_t keys_before = 0;
    std::int64_t events_upto = 0;
    Statement put_order, put_step, drop_steps, put_stop, put_event, drop_events, put_vehicle,
        put_move, put_load, put_load_sheet, put_key, drop_keys, put_closure, drop_closure,
        put_schedule, drop_schedule, put_template, drop_template;
};

FleetStore::FleetStore(Database& database)
    : database_(database),
      statements_(
          reading(database.path(), [&] { return std::make_unique<Statements>(database.sql()); })),
      journal_(database),
      last_seq_(reading(
          database.path(),
          [&] { return scalar(database.sql(), "SELECT COALESCE(MAX(seq), 0) FROM events"); })),
      first_seq_(reading(database.path(), [&] {
          return scalar(database.sql(), "SELECT COALESCE(MIN(seq), 1) FROM events");
      })) {}

FleetStore::~FleetStore() = default;

void FleetStore::put(const fleet::JobOrder& order) {
    Statements& s = *statements_;
    s.order.set(order);
    s.put_order.run();
    crash_point(CrashPoint::kCommitAfterOrder);
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        s.step.set(s.order.id, i, order.steps[i]);
        s.put_step.run();
    }
    s.step_count = static_cast<std::int64_t>(order.steps.size());
    s.drop_steps.run();
    crash_point(CrashPoint::kCommitAfterSteps);
}

void FleetStore::put_standing(const fleet::Records& records) {
    Statements& s = *statements_;
    for (const auto& schedule : records.schedules) {
        s.schedule.set(schedule);
        (schedule.deleted ? s.drop_schedule : s.put_schedule).run();
    }
    for (const auto& one : records.templates) {
        s.order_template.set(one);
        (one.deleted ? s.drop_template : s.put_template).run();
    }
}

void FleetStore::drop_old_events(const fleet::Event& newest) {
    Statements& s = *statements_;
    const std::int64_t upto =
        std::min(first_seq_ + kEventsDroppedAtOnce, newest.seq) - 1;  // the newest stays
    if (upto < first_seq_) return;
    const bool many = newest.seq - upto >= events_kept_.newest;
    // One look at the last of them tells of them all.
    const bool old = !many && scalar(database_.sql(), kTimeOfEvent + std::to_string(upto)) <
                                  to_ns(newest.at - events_kept_.age);
    if (!many && !old) return;
    s.events_upto = upto;
    s.drop_events.run();
    first_seq_ = upto + 1;
}

void FleetStore::commit(const fleet::Records& records) {
    if (records.empty()) return;
    Statements& s = *statements_;
    std::int64_t seq = last_seq_;
    const std::int64_t first = first_seq_;
    const auto work = [&] {
        for (const auto& order : records.orders) put(order);
        for (const auto& vehicle : records.vehicles) {
            s.vehicle.set(vehicle);
            s.put_vehicle.run();
            crash_point(CrashPoint::kCommitAfterVehicle);
        }
        for (const auto& sheet : records.load_sheets) {
            s.load_sheet.set(sheet);
            s.put_load_sheet.run();
            crash_point(CrashPoint::kCommitAfterLoad);
        }
        for (const auto& load : records.loads) {
            s.load.set(load);
            s.put_move.run();
            s.put_load.run();
            crash_point(CrashPoint::kCommitAfterLoad);
        }
        for (const auto& stop : records.stops) {
            s.stop.set(stop);
            s.put_stop.run();
            crash_point(CrashPoint::kCommitAfterStop);
        }
        for (const auto& event : records.events) {
            if (event.seq != seq + 1) {
                throw Error(Error::Kind::kBadValue,
                            "Nothing was stored: event " + std::to_string(event.seq) +
                                " does not follow event " + std::to_string(seq) + ".");
            }
            seq = event.seq;
            s.event.set(event);
            s.put_event.run();
            crash_point(CrashPoint::kCommitAfterEvent);
        }
        for (const auto& key : records.idempotency) {
            s.key.client = key.client;
            s.key.key = key.key;
            s.key.body_sha256 = key.body_sha256;
            s.key.order_id = stored_id(key.order);
            s.key.at_ns = to_ns(key.at);
            s.put_key.run();
            crash_point(CrashPoint::kCommitAfterKey);
            s.keys_before = s.key.at_ns - kKept_ns;
            s.drop_keys.run();
        }
        for (const auto& closure : records.closures) {
            s.closure.set(closure);
            s.put_closure.run();
        }
        for (const auto& id : records.reopened) {
            s.closure.id = stored_id(id);
            s.drop_closure.run();
        }
        put_standing(records);
        journal_.put(records.journal);
        if (!records.events.empty()) drop_old_events(records.events.back());
    };
    try {
        database_.transaction(work);
    } catch (...) {
        first_seq_ = first;
        throw;
    }
    journal_.committed();
    last_seq_ = seq;
}

fleet::StoredFleet FleetStore::load() {
    return reading(database_.path(), [&] {
        soci::session& sql = database_.sql();
        fleet::StoredFleet stored;
        stored.last_event_seq = count(scalar(sql, "SELECT COALESCE(MAX(seq), 0) FROM events"));
        stored.last_journal_seq = count(journal_.last_seq());
        stored.last_order_number =
            count(scalar(sql, "SELECT COALESCE(MAX(number), 0) FROM orders"));
        const std::int64_t newest_ns = newest_time(sql);
        stored.last_time = time_from_ns(newest_ns);
        std::int64_t since_ns = newest_ns - kKept_ns;

        stored.orders = load_orders(sql, since_ns);
        crash_point(CrashPoint::kStartInLoad);
        VehicleRow vehicle;
        Statement vehicles(
            sql, std::string("SELECT ") + VehicleRow::kColumns + " FROM vehicles_state ORDER BY id",
            std::tuple<>(), vehicle.fields());
        for (vehicles.start(); vehicles.fetch();) stored.vehicles.push_back(vehicle.get());
        check_legs(stored);

        LoadPlaceRow load;
        Statement loads(
            sql, std::string("SELECT ") + LoadPlaceRow::kColumns + " FROM loads_state ORDER BY id",
            std::tuple<>(), load.fields());
        for (loads.start(); loads.fetch();) stored.loads.push_back(load.get());

        LoadSheetRow sheet;
        Statement sheets(
            sql, std::string("SELECT ") + LoadSheetRow::kColumns + " FROM load_sheets ORDER BY id",
            std::tuple<>(), sheet.fields());
        for (sheets.start(); sheets.fetch();) stored.load_sheets.push_back(sheet.get());

        KeyRow key;
        Statement keys(sql,
                       std::string("SELECT ") + KeyRow::kColumns +
                           " FROM idempotency_keys WHERE at_ns >= :since ORDER BY at_ns",
                       std::tie(since_ns), key.fields());
        for (keys.start(); keys.fetch();) {
            fleet::IdempotencyRecord record{
                key.client, key.key, key.body_sha256, {}, time_from_ns(key.at_ns)};
            read_id(key.order_id, record.order);
            stored.idempotency.push_back(std::move(record));
        }

        ClosureRow closure;
        Statement closures(
            sql, std::string("SELECT ") + ClosureRow::kColumns + " FROM closures ORDER BY id",
            std::tuple<>(), closure.fields());
        for (closures.start(); closures.fetch();) stored.closures.push_back(closure.get());
        ScheduleRow schedule;
        Statement schedules(
            sql, std::string("SELECT ") + ScheduleRow::kColumns + " FROM job_order_schedules",
            std::tuple<>(), schedule.fields());
        for (schedules.start(); schedules.fetch();) stored.schedules.push_back(schedule.get());

        TemplateRow one;
        Statement templates(
            sql, std::string("SELECT ") + TemplateRow::kColumns + " FROM job_order_templates",
            std::tuple<>(), one.fields());
        for (templates.start(); templates.fetch();) stored.templates.push_back(one.get());
        return stored;
    });
}

}  // namespace pulseline::db
