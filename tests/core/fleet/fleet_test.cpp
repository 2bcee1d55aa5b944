#include "core/fleet/fleet.hpp"

#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::fleet::testing {
namespace {

using plant::MotionMode;
using plant::VehicleId;

const VehicleId kV1("V1");

TEST(Fleet, AnOrderDrivesMeasuresAndEnds) {
    World world;
    world.connect_all();

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(30);

    const JobOrder order = world.only_order();
    EXPECT_EQ(order.state, JobState::kEnded);
    EXPECT_EQ(order.steps[0].state, StepState::kDone);
    ASSERT_EQ(world.store.stops.size(), 1u);
    EXPECT_TRUE(world.store.stops[0].inside);
    EXPECT_EQ(world.store.stops[0].station_number, 2);
    EXPECT_EQ(world.fleet->stations()[1].occupied_by, kV1);
    EXPECT_TRUE(world.fleet->stations()[1].ready);
}

TEST(Fleet, DeviationIsMeasuredMinusTheoreticalInTheHallFrame) {
    World world;
    world.connect_all();
    world.vehicle("V1").stop_error = {0.004, -0.003, 0.001};

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(30);

    const StopRecord& stop = world.store.stops.at(0);
    EXPECT_NEAR(stop.dx_m, 0.004, 1e-12);
    EXPECT_NEAR(stop.dy_m, -0.003, 1e-12);
    EXPECT_NEAR(stop.dheading_rad, 0.001, 1e-12);
}

TEST(Fleet, TheNextLegStartsFromTheMeasuredPose) {
    World world;
    world.connect_all();
    world.vehicle("V1").stop_error = {0.010, 0.008, 0.002};

    ASSERT_TRUE(world.order("V1", {2, 3}));
    while (world.store.stops.empty()) world.run(0.1);
    world.run(0.2);

    const auto& leg = world.store.vehicles.at(kV1).leg_data;
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_NEAR(leg.nodes.front().pose.x_m, 24.010, 1e-9);
    EXPECT_NEAR(leg.nodes.front().pose.y_m, 20.008, 1e-9);
    EXPECT_NE(world.store.stops[0].leg, leg.id) << "one VDA 5050 order per step";
}

TEST(Fleet, SaysWhenARunningOrderShouldEnd) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {2, 3}));
    while (world.count_events("leg.accepted") == 0) world.run(0.1);

    const JobOrder order = world.only_order();

    const auto& leg = world.store.vehicles.at(kV1).leg_data;
    ASSERT_TRUE(order.expected);
    EXPECT_GT(order.steps[1].planned_s, 1);
    EXPECT_NEAR(seconds(*order.expected - world.now), leg.duration_s + order.steps[1].planned_s,
                0.2);
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
    EXPECT_FALSE(world.only_order().expected);
}

TEST(Fleet, EventsAreGapless) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {2, 3, 2}));
    world.run(90);

    ASSERT_FALSE(world.store.events.empty());
    for (std::size_t i = 0; i < world.store.events.size(); ++i) {
        EXPECT_EQ(world.store.events[i].seq, static_cast<std::int64_t>(i + 1));
    }
}

TEST(Fleet, OutsideToleranceIsApproachedThreeTimesThenAPersonIsAsked) {
    World world;
    world.connect_all();
    world.vehicle("V1").stop_error = {0.030, 0, 0};

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);

    EXPECT_EQ(world.store.stops.size(), 3u);
    EXPECT_FALSE(world.fleet->stations()[1].ready) << "ready only inside tolerance";
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "out_of_tolerance");

    world.vehicle("V1").stop_error = {};
    ASSERT_TRUE(world.fleet->resume_order(world.only_order().id, std::nullopt, "op", world.now));
    world.run(20);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

TEST(Fleet, OneTurnedFurtherThanACorrectionReachesGetsALegToItsOwnStation) {
    for (const auto& [off_deg, is_leg] : {std::pair{0.5, false}, {1.2, true}}) {
        World world;
        world.connect_all();
        world.vehicles_move = false;
        world.vehicle("V1").state.pose->heading_rad += radians(off_deg);
        world.run(1);

        ASSERT_TRUE(world.order("V1", {1}));
        world.run(1);

        const auto& record = world.store.vehicles.at(plant::VehicleId("V1"));
        ASSERT_TRUE(record.has_leg);
        EXPECT_EQ(record.leg_data.nodes.size() > 1, is_leg) << off_deg;
    }
}

TEST(Fleet, AStopThatCannotBeMeasuredNamesTheReason) {
    World world;
    world.connect_all();
    world.vehicle("V1").measure_fails = "no_marker_in_view";

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);

    EXPECT_TRUE(world.store.stops.empty());
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);
    EXPECT_EQ(world.only_order().reason.code, "stop_not_measured");
}

TEST(Fleet, UnknownStationAndVehicleAreRefusedWithTheField) {
    World world;
    world.connect_all();

    const auto station = world.order("V1", {99});
    const auto vehicle = world.order("V9", {2});

    ASSERT_FALSE(station);
    EXPECT_EQ(station.error().reason.code, "unknown_station");
    EXPECT_EQ(station.error().field, "/steps/0/station");
    ASSERT_FALSE(vehicle);
    EXPECT_EQ(vehicle.error().reason.code, "unknown_vehicle");
    EXPECT_TRUE(world.store.orders.empty()) << "nothing half stored";
}

TEST(Fleet, ATargetOnTheHeadingLineIsRefusedForFixedAxisRotation) {
    World world;
    world.connect_all();

    const auto refused = world.order("V1", {2}, MotionMode::kFixedAxisRotation);

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, Errc::kUnreachable);
    EXPECT_EQ(refused.error().reason.code, "target_on_heading_line");
    EXPECT_EQ(refused.error().field, "/steps/0/motion_mode");
}

TEST(Fleet, TheSameIdempotencyKeyGivesTheSameOrder) {
    World world;
    world.connect_all();
    NewOrder request;
    request.vehicle = kV1;
    request.steps = {{2, MotionMode::kAuto}};
    request.idempotency_client = "mes";
    request.idempotency_key = "k1";
    request.body_sha256 = "aa";

    const auto first = world.fleet->create(request, world.now);
    world.settle();
    world.crash_server();
    const auto again = world.fleet->create(request, world.now);
    request.body_sha256 = "bb";
    const auto other = world.fleet->create(request, world.now);

    ASSERT_TRUE(first && again);
    EXPECT_TRUE(again->repeated);
    EXPECT_EQ(first->order.id, again->order.id);
    ASSERT_FALSE(other);
    EXPECT_EQ(other.error().reason.code, "idempotency_key_reused");
    EXPECT_EQ(world.store.orders.size(), 1u);
}

TEST(Fleet, AClientsNameIsFreeSevenDaysAfterItsOrderHasEnded) {
    World world;
    world.connect_all();
    NewOrder request;
    request.client_order_id = "WO-7";
    request.steps = {{2, plant::MotionMode::kAuto}};
    ASSERT_TRUE(world.order(request));
    world.run(60);
    ASSERT_EQ(world.only_order().state, JobState::kEnded);
    const auto refusal = [&] {
        const auto again = world.order(request);
        return again ? std::string() : again.error().reason.code;
    };

    world.now = world.only_order().ended + std::chrono::hours(24 * 7) - std::chrono::seconds(5);
    world.run(1);
    EXPECT_EQ(refusal(), "duplicate_client_order_id");

    world.run(10);
    EXPECT_EQ(refusal(), "");
}

TEST(Fleet, CancelIsAskedConfirmedAndThenAborted) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}, MotionMode::kLinear));
    world.run(1.5);
    const auto id = world.only_order().id;

    ASSERT_TRUE(world.fleet->cancel_order(id, std::nullopt, "op", world.now));
    EXPECT_EQ(world.fleet->order(id)->state, JobState::kRunning) << "not before the vehicle stands";
    world.run(3);

    EXPECT_EQ(world.only_order().state, JobState::kAborted);
    EXPECT_FALSE(world.store.vehicles.at(kV1).has_leg);
    EXPECT_FALSE(world.fleet->cancel_order(id, std::nullopt, "op", world.now));
}

TEST(Fleet, DashboardsAreToldWhichStationsAreReserved) {
    World world;
    world.connect_all();
    world.run(1);
    ASSERT_TRUE(world.order("V1", {3}, MotionMode::kLinear));
    world.run(1.5);
    ASSERT_EQ(world.told.at(world.plant.stations[2].id).reserved_by, kV1);

    ASSERT_TRUE(world.fleet->cancel_order(world.only_order().id, std::nullopt, "op", world.now));
    world.run(3);

    EXPECT_EQ(world.told.at(world.plant.stations[2].id).reserved_by, VehicleId{});
    EXPECT_EQ(world.stations_told_wrong(), std::vector<int>{});
}

TEST(Fleet, PauseStopsAndResumeGoesOn) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    const auto id = world.only_order().id;

    ASSERT_TRUE(world.fleet->pause_order(id, std::nullopt, "op", world.now));
    world.run(1);
    const int steps = world.vehicle("V1").node_steps;
    world.run(10);
    EXPECT_EQ(world.vehicle("V1").node_steps, steps);
    EXPECT_EQ(world.only_order().state, JobState::kInterrupted);

    ASSERT_TRUE(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    world.run(40);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

TEST(Fleet, StaleRevisionIsRefused) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    const auto order = world.only_order();

    const auto refused = world.fleet->cancel_order(order.id, order.revision - 1, "op", world.now);

    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().reason.code, "stale_revision");
}

TEST(Fleet, AnUnseenOrderIsSentAgainUntilTheVehicleShowsIt) {
    World world;
    world.connect_all();
    auto& vehicle = world.vehicle("V1");
    vehicle.sees_codes = true;
    const vda5050::StateMessage before = vehicle.state;
    ASSERT_TRUE(world.order("V1", {2}));
    const int first = vehicle.orders_received;

    // The first message is lost: the vehicle goes back to what it knew.
    vehicle.restart();
    vehicle.state = before;
    world.run(1.5);

    EXPECT_GT(vehicle.orders_received, first);
    world.run(30);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

TEST(Fleet, OneVehiclePerPieceOfFloor) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    ASSERT_TRUE(world.order("V2", {2}));

    world.run(2);

    // V2's way and V1's cross: the second waits and says for whom.
    const auto waiting = world.fleet->orders().front();
    EXPECT_EQ(waiting.reason.code, "floor_held");
    EXPECT_EQ(std::get<std::string>(waiting.reason.params.at(0).value), "V1");
}

TEST(Fleet, PausedFleetStandsUntilResumed) {
    World world;
    world.connect_all();
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.5);

    world.fleet->pause_fleet("op", world.now);
    world.settle();
    world.run(0.3);
    const int steps = world.vehicle("V1").node_steps;
    world.run(10);
    EXPECT_EQ(world.vehicle("V1").node_steps, steps);
    EXPECT_TRUE(world.fleet->view(world.now).paused);

    ASSERT_TRUE(world.fleet->resume_fleet({kV1, VehicleId("V2")}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

TEST(Fleet, AnOrderThatDidNotReachAPausedVehicleIsNotSentAgainUntilItIsResumed) {
    World world;
    world.connect_all();
    world.connected[kV1] = false;
    ASSERT_TRUE(world.order("V1", {2}));
    ASSERT_TRUE(world.store.vehicles.at(kV1).has_leg);
    ASSERT_TRUE(world.fleet->pause_vehicle(kV1, "op", world.now));

    world.connected[kV1] = true;
    world.run(5);

    EXPECT_EQ(world.vehicle("V1").orders_received, 0);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST(Fleet, ADryRunStoresNothing) {
    World world;
    world.connect_all();
    NewOrder request;
    request.vehicle = kV1;
    request.steps = {{2, MotionMode::kAuto}};

    const Preview preview = world.fleet->preview(request, world.now);

    EXPECT_TRUE(preview.accepted);
    ASSERT_EQ(preview.steps.size(), 1u);
    EXPECT_EQ(preview.steps[0].options.size(), 3u);
    EXPECT_TRUE(preview.steps[0].chosen.has_value());
    EXPECT_FALSE(preview.checks.empty());
    EXPECT_TRUE(world.store.orders.empty());
}

// Crash the server at every moment of a tour: no acknowledged order is lost or done twice, nothing
// passes its released base before the person's act, and after it the tour ends.

}  // namespace
}  // namespace pulseline::fleet::testing
