#include "db/fleet/fleet_store.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "db/fleet/fleet_rows.hpp"
#include "db/fleet/standing_rows.hpp"
#include "tests/db/fleet_samples.hpp"
#include "tests/db/temp_folder.hpp"

namespace pulseline::db {
namespace {

/// Every column of a record as text: what equals here was stored without loss.
template <class Row, class Record>
std::string columns(const Record& record) {
    Row row;
    row.set(record);
    std::string text;
    std::apply(
        [&](const auto&... field) {
            const auto add = [&](const auto& value) {
                if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>) {
                    text += value + "|";
                } else if constexpr (std::is_floating_point_v<std::decay_t<decltype(value)>>) {
                    char buffer[40];
                    std::snprintf(buffer, sizeof buffer, "%a|", value);
                    text += buffer;
                } else {
                    text += std::to_string(value) + "|";
                }
            };
            (add(field), ...);
        },
        row.fields());
    return text;
}

void expect_same(const fleet::JobOrder& a, const fleet::JobOrder& b) {
    EXPECT_EQ(columns<OrderRow>(a), columns<OrderRow>(b));
    ASSERT_EQ(a.steps.size(), b.steps.size());
    for (std::size_t i = 0; i < a.steps.size(); ++i) {
        StepRow x;
        StepRow y;
        x.set("", i, a.steps[i]);
        y.set("", i, b.steps[i]);
        EXPECT_EQ(x.fields(), y.fields());
    }
}

TEST(FleetStore, EmptyDatabaseLoadsEmpty) {
    Database database(":memory:");
    FleetStore store(database);
    const fleet::StoredFleet stored = store.load();

    EXPECT_TRUE(stored.orders.empty());
    EXPECT_EQ(stored.last_event_seq, 0);
    EXPECT_EQ(stored.last_order_number, 0);
    EXPECT_EQ(to_ns(stored.last_time), 0);
}

plant::Load papers(const std::string& id) {
    plant::Load load;
    load.id = plant::LoadId(id);
    load.name = "Aircraft " + id;
    load.kind = plant::LoadKind::kProduct;
    load.model = "Trainer";
    load.mass_kg = 18350.5;
    load.centre = {-0.05, 0.01};
    load.outline = geometry::rectangle(3, 2);
    load.vehicle_types = {plant::VehicleTypeId("transport-platform")};
    load.names = {{"zh", "\u98de\u673a"}};
    return load;
}

TEST(FleetStore, EverythingComesBackFromTheFile) {
    const TempFolder folder;
    Samples samples(1);
    fleet::Records records;
    records.orders = {samples.order(1, 0), samples.order(2, 10)};
    records.vehicles = {samples.vehicle("TP-01")};
    records.loads = {{plant::LoadId("A-101"), plant::VehicleId("TP-01"), {}, samples.at(4), "ann"},
                     {plant::LoadId("A-102"), {}, plant::StationId("st07"), samples.at(5), ""}};
    records.load_sheets = {{papers("A-101"), samples.at(6), "ann", false},
                           {papers("A-090"), samples.at(7), "bob", true}};
    records.stops = {samples.stop(2, 20)};
    records.events = {samples.event(1, 5), samples.event(2, 20)};
    records.idempotency = {{"mes", "key-1", "ab", records.orders[0].id, samples.at(3)}};
    {
        Database database(folder.file("fleet.db"));
        FleetStore(database).commit(records);
    }
    Database database(folder.file("fleet.db"));
    const fleet::StoredFleet stored = FleetStore(database).load();

    ASSERT_EQ(stored.orders.size(), 2u);
    expect_same(stored.orders[0], records.orders[0]);
    expect_same(stored.orders[1], records.orders[1]);
    EXPECT_EQ(stored.orders[0].reason, records.orders[0].reason);
    ASSERT_EQ(stored.vehicles.size(), 1u);
    EXPECT_EQ(columns<VehicleRow>(stored.vehicles[0]), columns<VehicleRow>(records.vehicles[0]));
    EXPECT_EQ(stored.vehicles[0].leg_data.edges[1].segment.centre,
              records.vehicles[0].leg_data.edges[1].segment.centre);
    EXPECT_EQ(stored.vehicles[0].leg_data.nodes[2].actions[0].params,
              records.vehicles[0].leg_data.nodes[2].actions[0].params);
    ASSERT_EQ(stored.loads.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(columns<LoadPlaceRow>(stored.loads[i]), columns<LoadPlaceRow>(records.loads[i]));
    }
    ASSERT_EQ(stored.load_sheets.size(), 2u);
    EXPECT_TRUE(stored.load_sheets[0].retired) << "by id";
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(columns<LoadSheetRow>(stored.load_sheets[i]),
                  columns<LoadSheetRow>(records.load_sheets[1 - i]));
    }
    ASSERT_EQ(stored.idempotency.size(), 1u);
    EXPECT_EQ(stored.idempotency[0].order, records.orders[0].id);
    EXPECT_EQ(stored.last_event_seq, 2);
    EXPECT_EQ(stored.last_order_number, 2);
    EXPECT_EQ(stored.last_time, samples.at(20));
}

TEST(FleetStore, KeepsTheNewestEventsWithoutAGap) {
    Database database(":memory:");
    FleetStore store(database);
    store.keep_events({1000, std::chrono::hours(24 * 400)});
    Samples samples(1);
    for (int seq = 1; seq <= 5000; ++seq) {
        fleet::Records records;
        records.events = {samples.event(seq, seq)};
        store.commit(records);
    }
    std::int64_t count = 0;
    std::int64_t oldest = 0;
    database.sql() << "SELECT COUNT(*), MIN(seq) FROM events", soci::into(count),
        soci::into(oldest);

    EXPECT_GE(count, 1000);
    EXPECT_LE(count, 1064);
    EXPECT_EQ(oldest, 5000 - count + 1);
    EXPECT_EQ(FleetStore(database).load().last_event_seq, 5000);
}

TEST(FleetStore, DropsEventsThatAreTooOldButNeverTheNewest) {
    Database database(":memory:");
    FleetStore store(database);
    store.keep_events({1'000'000, std::chrono::seconds(100)});
    Samples samples(1);
    for (int seq = 1; seq <= 500; ++seq) {
        fleet::Records records;
        records.events = {samples.event(seq, seq < 400 ? 0 : 1'000'000)};
        store.commit(records);
    }
    std::int64_t oldest = 0;
    database.sql() << "SELECT MIN(seq) FROM events", soci::into(oldest);

    EXPECT_GE(oldest, 330);
    EXPECT_LE(oldest, 400);
}

TEST(FleetStore, SchedulesAndTemplatesComeBackAndGo) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(3);
    fleet::Records records;
    records.schedules = {samples.schedule("round", 0), samples.schedule("night", 10)};
    records.templates = {
        {"to station", "why", "[]", "{\"steps\":[]}", "mes", samples.at(1), false}};
    store.commit(records);

    fleet::StoredFleet stored = store.load();
    ASSERT_EQ(stored.schedules.size(), 2u);
    EXPECT_EQ(columns<ScheduleRow>(stored.schedules[0]),
              columns<ScheduleRow>(records.schedules[0]));
    EXPECT_EQ(stored.schedules[0].order, records.schedules[0].order);
    EXPECT_EQ(stored.schedules[0].recurrence, records.schedules[0].recurrence);
    ASSERT_EQ(stored.templates.size(), 1u);
    EXPECT_EQ(columns<TemplateRow>(stored.templates[0]),
              columns<TemplateRow>(records.templates[0]));

    // A deleted one goes before another of its name comes, in one transaction.
    records.schedules[0].deleted = true;
    fleet::Schedule again = samples.schedule("round", 20);
    fleet::Records change;
    change.schedules = {records.schedules[0], again};
    records.templates[0].deleted = true;
    change.templates = {records.templates[0]};
    store.commit(change);
    stored = store.load();
    ASSERT_EQ(stored.schedules.size(), 2u);
    EXPECT_EQ(stored.schedules[1].id, again.id);
    EXPECT_TRUE(stored.templates.empty());
}

// (SQLite keeps -0.0 as 0.0, which is the same number.)
TEST(FleetStore, DoublesComeBackBitForBit) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(2);
    for (const double value :
         {0.1, 0.0, 5e-324, 1.7976931348623157e308, 1.0 / 3, 123456789.123456789}) {
        fleet::VehicleRecord vehicle = samples.vehicle("TP-01");
        vehicle.pose = {value, -value + 0.0, value / 7};
        vehicle.leg_data.duration_s = value;
        fleet::Records records;
        records.vehicles = {vehicle};
        store.commit(records);

        EXPECT_EQ(columns<VehicleRow>(store.load().vehicles.at(0)), columns<VehicleRow>(vehicle));
    }
}

TEST(FleetStore, OrdersAndVehiclesAreReplacedById) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(3);
    fleet::Records records;
    records.orders = {samples.order(1, 0)};
    records.vehicles = {samples.vehicle("TP-01")};
    store.commit(records);
    records.orders[0].steps.pop_back();
    records.orders[0].current_step = 0;
    records.orders[0].state = fleet::JobState::kInterrupted;
    records.vehicles[0].has_leg = false;
    records.vehicles[0].leg = {};
    store.commit(records);
    const fleet::StoredFleet stored = store.load();

    ASSERT_EQ(stored.orders.size(), 1u);
    expect_same(stored.orders[0], records.orders[0]);
    ASSERT_EQ(stored.vehicles.size(), 1u);
    EXPECT_FALSE(stored.vehicles[0].has_leg);
}

/// What loading says of a fleet whose rows were damaged by that statement.
std::string loaded_after(const std::string& damage) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(1);
    fleet::Records records;
    records.orders = {samples.order(1, 0)};
    records.vehicles = {samples.vehicle("TP-01")};
    records.schedules = {samples.schedule("night", 0)};
    records.events = {samples.event(1, 0)};
    store.commit(records);
    database.sql() << "PRAGMA ignore_check_constraints = ON";
    database.sql() << damage;
    try {
        (void)store.load();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Kind::kBadValue);
        return error.what();
    }
    return "loaded";
}

TEST(FleetStore, RefusesALegWhoseCountsDoNotFit) {
    ASSERT_EQ(loaded_after("UPDATE vehicles_state SET x_m = 1"), "loaded");
    for (const char* part :
         {"'$.step', -1", "'$.passed_nodes', 9", "'$.passed_nodes', 0", "'$.released_nodes', 0",
          "'$.released_nodes', 4", "'$.edges', json('[]')", "'$.nodes', json('[]')"}) {
        EXPECT_EQ(loaded_after("UPDATE vehicles_state SET leg_data = json_set(leg_data, " +
                               std::string(part) + ")"),
                  "The database holds a damaged leg; restore a backup.")
            << part;
    }
}

TEST(FleetStore, RefusesWhatIsNoWholeNumberOrNoKind) {
    for (const char* part : {"'$.step', 1e300", "'$.step', 0.5", "'$.step', 3000000000",
                             "'$.released_nodes', -1", "'$.update', 1e19", "'$.attempt', 'x'",
                             "'$.nodes[0].seq', -1e30", "'$.edges[0].seq', 1e30",
                             "'$.edges[0].segment.kind', 4", "'$.nodes[2].actions[0].blocking', -1",
                             "'$.nodes[2].actions[0].stop_target.number', 1e10"}) {
        EXPECT_TRUE(loaded_after("UPDATE vehicles_state SET leg_data = json_set(leg_data, " +
                                 std::string(part) + ")")
                        .ends_with("restore a backup."))
            << part;
    }
    for (const char* damage :
         {"UPDATE orders SET dependencies = json_set(dependencies, '$[0].number', 1e30)",
          "UPDATE job_order_schedules SET body = json_set(body, '$.priority', 1e30)",
          "UPDATE job_order_schedules SET body = json_set(body, '$.steps[0].station', -1e30)",
          "UPDATE job_order_schedules SET daily_at_s = '[1e30]'"}) {
        EXPECT_TRUE(loaded_after(damage).ends_with("restore a backup.")) << damage;
    }
}

TEST(FleetStore, RefusesCountsThatCannotGoOn) {
    for (const char* damage :
         {"UPDATE orders SET revision = 9223372036854775807", "UPDATE orders SET number = -1",
          "UPDATE orders SET number = 9223372036854775807",
          "UPDATE job_order_schedules SET revision = 9223372036854775807",
          "UPDATE job_order_schedules SET made = 9223372036854775807",
          "UPDATE job_order_schedules SET skipped = 9223372036854775807",
          "UPDATE events SET seq = 9223372036854775807"}) {
        EXPECT_NE(loaded_after(damage).find("a count that cannot be"), std::string::npos) << damage;
    }
}

TEST(FleetStore, RefusesAnOrderThatLacksItsStep) {
    for (const char* damage :
         {"DELETE FROM job_order_steps", "DELETE FROM job_order_steps WHERE position = 1",
          "UPDATE orders SET current_step = 2"}) {
        EXPECT_NE(loaded_after(damage).find("lacks steps of the order"), std::string::npos)
            << damage;
    }
    EXPECT_EQ(loaded_after("UPDATE orders SET current_step = 2, state = 'Ended'"), "loaded");
}

TEST(FleetStore, RefusesADriveForAStepThatItsOrderLacks) {
    const auto drives_for = [](int step) {
        return loaded_after(
            "UPDATE vehicles_state SET leg_data = json_set(leg_data, '$.order', (SELECT id FROM "
            "orders), '$.step', " +
            std::to_string(step) + ")");
    };
    EXPECT_EQ(drives_for(1), "loaded");
    EXPECT_NE(drives_for(2).find("names a step that the order"), std::string::npos);
}

TEST(FleetStore, AFailureTellsNothingOfWhatWasToBeStored) {
    Database database(":memory:");
    FleetStore store(database);
    database.sql() << "PRAGMA max_page_count = 1";  // it is as large as it may become
    Samples samples(1);
    fleet::Records records;
    for (int number = 1; number < 200; ++number) records.orders.push_back(samples.order(number, 0));
    try {
        store.commit(records);
        FAIL() << "stored";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), Error::Kind::kFull);
        EXPECT_EQ(std::string(error.what()).find("INSERT"), std::string::npos) << error.what();
    }
}

TEST(FleetStore, FinalOrdersStaySevenDays) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(4);
    constexpr std::int64_t kDay_ms = 24LL * 3600 * 1000;
    fleet::Records records;
    for (int day = 0; day < 10; ++day) {
        fleet::JobOrder order = samples.order(day + 1, day * kDay_ms);
        order.state = day == 0 ? fleet::JobState::kInterrupted : fleet::JobState::kEnded;
        if (day > 0) order.ended = samples.at(day * kDay_ms);
        records.idempotency.push_back(
            {"mes", "key-" + std::to_string(day), "x", order.id, samples.at(day * kDay_ms)});
        records.orders.push_back(order);
    }
    store.commit(records);
    const fleet::StoredFleet stored = store.load();

    std::vector<std::int64_t> numbers;
    for (const auto& order : stored.orders) numbers.push_back(order.number);
    EXPECT_EQ(numbers, (std::vector<std::int64_t>{1, 4, 5, 6, 7, 8, 9, 10}));
    EXPECT_EQ(stored.last_order_number, 10);
    EXPECT_EQ(stored.idempotency.size(), 7u);
}

TEST(FleetStore, EventsMustFollowWithoutAGap) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(5);
    fleet::Records records;
    records.events = {samples.event(1, 0), samples.event(2, 1)};
    store.commit(records);
    fleet::Records gap;
    gap.events = {samples.event(3, 2), samples.event(5, 3)};
    fleet::Records again;
    again.events = {samples.event(2, 2)};
    fleet::Records right;
    right.events = {samples.event(3, 4)};

    EXPECT_THROW(store.commit(gap), Error);
    EXPECT_THROW(store.commit(again), Error);
    EXPECT_EQ(store.load().last_event_seq, 2);
    EXPECT_NO_THROW(store.commit(right));
    EXPECT_EQ(store.load().last_event_seq, 3);
}

TEST(FleetStore, NotANumberIsRefusedAndNothingOfTheBatchStays) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(6);
    const double inf = std::numeric_limits<double>::infinity();
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {nan, inf, -inf}) {
        fleet::Records records;
        records.orders = {samples.order(1, 0)};
        records.stops = {samples.stop(1, 0)};
        records.stops[0].measured.y_m = bad;
        EXPECT_THROW(store.commit(records), Error);

        fleet::Records vehicle;
        vehicle.vehicles = {samples.vehicle("TP-01")};
        vehicle.vehicles[0].leg_data.nodes[1].pose.x_m = bad;
        EXPECT_THROW(store.commit(vehicle), Error);

        fleet::Records event;
        event.events = {samples.event(1, 0)};
        event.events[0].params[0].value = bad;
        EXPECT_THROW(store.commit(event), Error);
    }
    const fleet::StoredFleet stored = store.load();

    EXPECT_TRUE(stored.orders.empty());
    EXPECT_TRUE(stored.vehicles.empty());
    EXPECT_EQ(stored.last_event_seq, 0);
}

TEST(FleetStore, GoesOnAfterAFailedCommit) {
    Database database(":memory:");
    FleetStore store(database);
    Samples samples(7);
    fleet::Records records;
    records.orders = {samples.order(1, 0)};
    store.commit(records);
    fleet::Records clash;
    clash.orders = {samples.order(1, 5)};  // another id, the same number
    fleet::Records next;
    next.orders = {samples.order(2, 6)};

    EXPECT_THROW(store.commit(clash), Error);
    EXPECT_NO_THROW(store.commit(next));
    EXPECT_EQ(store.load().orders.size(), 2u);
}

}  // namespace
}  // namespace pulseline::db
