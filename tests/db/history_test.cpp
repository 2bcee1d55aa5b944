#include "db/fleet/history.hpp"

#include <gtest/gtest.h>

#include <set>

#include "db/fleet/fleet_rows.hpp"
#include "db/fleet/fleet_store.hpp"
#include "db/plant/plant_store.hpp"
#include "tests/db/fleet_samples.hpp"
#include "tests/db/temp_folder.hpp"

namespace pulseline::db {
namespace {

class HistoryTest : public testing::Test {
protected:
    TempFolder folder_;
    Database database_{folder_.file("fleet.db")};
    FleetStore store_{database_};
    ReadOnly connection_{folder_.file("fleet.db")};
    History history_{connection_};
    Samples samples_{42};

    void put_stop(const fleet::StopRecord& stop) {
        fleet::Records records;
        records.stops = {stop};
        store_.commit(records);
    }
    fleet::JobOrder put_order(std::int64_t number, fleet::JobState state) {
        fleet::Records records;
        records.orders = {samples_.order(number, number)};
        records.orders[0].state = state;
        store_.commit(records);
        return records.orders[0];
    }
};

TEST_F(HistoryTest, StopComesBackWithoutLoss) {
    const fleet::StopRecord stop = samples_.stop(2, 0);
    put_stop(stop);
    const auto found = history_.stop(stop.id);

    ASSERT_TRUE(found);
    StopRow a;
    StopRow b;
    a.set(stop);
    b.set(*found);
    EXPECT_EQ(a.fields(), b.fields());
    EXPECT_EQ(history_.stop(fleet::StopRecordId()), std::nullopt);
}

TEST_F(HistoryTest, StopsAreFilteredNewestFirst) {
    for (int i = 0; i < 6; ++i) {
        fleet::StopRecord stop = samples_.stop(1 + i % 2, i);
        if (i >= 4) stop.vehicle = plant::VehicleId("TP-02");
        put_stop(stop);
    }
    fleet::StopQuery query;
    query.station_number = 2;
    const auto at_two = history_.stops(query);
    query.vehicle = plant::VehicleId("TP-01");
    const auto both = history_.stops(query);
    fleet::StopQuery by_order;
    by_order.order = both.at(0).order;

    ASSERT_EQ(at_two.size(), 3u);
    EXPECT_GT(at_two[0].at, at_two[1].at);
    EXPECT_EQ(both.size(), 2u);
    EXPECT_EQ(history_.stops(by_order).size(), 1u);
}

TEST_F(HistoryTest, PagesStayStableWhileRowsAreAdded) {
    for (int i = 0; i < 25; ++i) put_stop(samples_.stop(1, i));
    std::set<std::string> seen;
    fleet::StopQuery query;
    query.limit = 10;
    for (int page = 0; page < 3; ++page) {
        const auto stops = history_.stops(query);
        for (const auto& stop : stops) EXPECT_TRUE(seen.insert(stop.id.str()).second);
        query.before = stops.back().id;
        put_stop(samples_.stop(1, 100 + page));
    }

    EXPECT_EQ(seen.size(), 25u);
    EXPECT_TRUE(history_.stops(query).empty());
}

TEST_F(HistoryTest, OrdersAreFilteredByStateAndVehicle) {
    put_order(1, fleet::JobState::kEnded);
    const fleet::JobOrder running = put_order(2, fleet::JobState::kRunning);
    put_order(3, fleet::JobState::kAborted);
    fleet::OrderQuery query;
    query.states = {fleet::JobState::kEnded, fleet::JobState::kAborted};
    const auto final = history_.orders(query);
    fleet::OrderQuery nobody;
    nobody.vehicle = plant::VehicleId("TP-09");

    ASSERT_EQ(final.size(), 2u);
    EXPECT_EQ(final[0].number, 3);
    EXPECT_EQ(final[0].steps.size(), 2u);
    EXPECT_TRUE(history_.orders(nobody).empty());
    EXPECT_EQ(history_.order(running.id)->steps[0].leg, running.steps[0].leg);
    EXPECT_EQ(history_.order(fleet::JobOrderId()), std::nullopt);
}

TEST_F(HistoryTest, EventsComeInOrderFromBehindTheGivenOne) {
    fleet::Records records;
    for (int i = 1; i <= 20; ++i) records.events.push_back(samples_.event(i, i));
    store_.commit(records);
    const auto events = history_.events_after(5, 10);

    ASSERT_EQ(events.size(), 10u);
    for (std::size_t i = 0; i < events.size(); ++i) {
        EXPECT_EQ(events[i].seq, 6 + static_cast<std::int64_t>(i));
    }
    EXPECT_EQ(events[0].params, records.events[5].params);
    EXPECT_TRUE(history_.events_after(20, 10).empty());
}

TEST_F(HistoryTest, UnmeasuredStopsAreFilteredNewestFirst) {
    fleet::Records records;
    for (int i = 1; i <= 12; ++i) {
        fleet::Event event = samples_.event(i, i);
        event.type = i % 2 == 0 ? "stop.not_measured" : "stop.measured";
        event.vehicle = plant::VehicleId(i <= 6 ? "TP-01" : "TP-02");
        event.params = {{"station", std::int64_t{i % 4}}, {"why", std::string("dark")}};
        records.events.push_back(event);
    }
    store_.commit(records);
    const auto seqs = [&](const fleet::UnmeasuredQuery& query) {
        std::vector<std::int64_t> found;
        for (const auto& event : history_.unmeasured_stops(query)) found.push_back(event.seq);
        return found;
    };
    fleet::UnmeasuredQuery all;
    fleet::UnmeasuredQuery of_vehicle;
    of_vehicle.vehicle = plant::VehicleId("TP-01");
    fleet::UnmeasuredQuery at_station;
    at_station.station_number = 2;
    fleet::UnmeasuredQuery older;
    older.before = 8;
    older.limit = 2;

    EXPECT_EQ(seqs(all), (std::vector<std::int64_t>{12, 10, 8, 6, 4, 2}));
    EXPECT_EQ(seqs(of_vehicle), (std::vector<std::int64_t>{6, 4, 2}));
    EXPECT_EQ(seqs(at_station), (std::vector<std::int64_t>{10, 6, 2}));
    EXPECT_EQ(seqs(older), (std::vector<std::int64_t>{6, 4}));
    EXPECT_EQ(history_.unmeasured_stops(all)[0].params, records.events[11].params);
}

TEST_F(HistoryTest, StatisticsTakeTheNewestOfTheMode) {
    for (int i = 0; i < 5; ++i) {
        fleet::StopRecord stop = samples_.stop(1, i);
        stop.dx_m = i == 0 ? 100 : 0.003;
        stop.dy_m = i == 0 ? 100 : -0.004;
        stop.dheading_rad = i % 2 == 0 ? -0.002 : 0.001;
        if (i == 4) stop.mode = plant::MotionMode::kLateral;
        put_stop(stop);
    }
    const auto statistics = history_.statistics(
        {plant::VehicleId("TP-01"), plant::VehicleId("TP-02")}, plant::MotionMode::kLinear, 3);

    EXPECT_EQ(statistics.stops, 3);
    EXPECT_NEAR(statistics.mean_m, 0.005, 1e-12);
    EXPECT_NEAR(statistics.max_m, 0.005, 1e-12);
    EXPECT_NEAR(statistics.mean_rad, 0.004 / 3, 1e-12);
    EXPECT_NEAR(statistics.max_rad, 0.002, 1e-12);
    EXPECT_EQ(history_.statistics({}, plant::MotionMode::kLinear, 3).stops, 0);
}

TEST_F(HistoryTest, TextFromOutsideIsNeverSql) {
    put_stop(samples_.stop(1, 0));
    fleet::StopQuery query;
    query.vehicle = plant::VehicleId("x' OR '1'='1");

    EXPECT_TRUE(history_.stops(query).empty());
}

TEST_F(HistoryTest, MovesOfALoadAreKeptWithTheirPlacesBefore) {
    const plant::LoadId load("A-101");
    plant::Plant plant;
    plant.loads.push_back({});
    plant.loads[0].id = load;
    plant.loads[0].station = plant::StationId("st00");
    PlantStore(database_).import(plant);
    const auto put = [&](const char* vehicle, const char* station, int ms) {
        fleet::Records records;
        records.loads = {
            {load, plant::VehicleId(vehicle), plant::StationId(station), samples_.at(ms), "ann"},
            {plant::LoadId("A-102"), plant::VehicleId("TP-02"), {}, samples_.at(ms), "ben"}};
        store_.commit(records);
    };
    put("TP-01", "", 1);
    put("", "st07", 2);
    put("", "st07", 3);
    put("", "", 4);
    const auto moves = history_.load_moves({load});
    fleet::LoadMoveQuery older{load, 1, moves.at(0).seq};

    ASSERT_EQ(moves.size(), 3u) << "who is where it was has not moved";
    EXPECT_EQ(moves[2].from.station, plant::StationId("st00")) << "where the plant has it at first";
    EXPECT_TRUE(moves[2].from.vehicle.empty());
    EXPECT_EQ(moves[2].to.vehicle, plant::VehicleId("TP-01"));
    EXPECT_EQ(moves[1].from.vehicle, plant::VehicleId("TP-01"));
    EXPECT_EQ(moves[1].to.station, plant::StationId("st07"));
    EXPECT_EQ(moves[1].at, samples_.at(2));
    EXPECT_EQ(moves[1].actor, "ann");
    EXPECT_TRUE(moves[0].to.station.empty() && moves[0].to.vehicle.empty());
    ASSERT_EQ(history_.load_moves(older).size(), 1u);
    EXPECT_EQ(history_.load_moves(older)[0].seq, moves[1].seq);
    EXPECT_EQ(history_.load_moves({plant::LoadId("A-102")}).size(), 1u);
    EXPECT_TRUE(history_.load_moves({plant::LoadId("none")}).empty());
}

}  // namespace
}  // namespace pulseline::db
