#include <gtest/gtest.h>

#include "tests/core/fleet/fleet_world.hpp"

// Vehicles that meet: the fleet's side of core/traffic, with obedient vehicles.
namespace pulseline::fleet::testing {
namespace {

using plant::VehicleId;

struct Spot {
    const char* name;
    double x_m;
    double y_m;
    int station = 0;  // number; 0: only a node
};

/// A hall of stations and nodes joined by two-way lanes; every station is a resting place. Vehicles
/// stand at the first stations.
plant::Plant plant_of(const std::vector<Spot>& spots,
                      const std::vector<std::pair<const char*, const char*>>& lanes, int vehicles) {
    plant::Plant plant = small_plant();
    plant.halls[0].outline = {{0, 0}, {100, 0}, {100, 80}, {0, 80}};
    plant.stations.clear();
    plant.markers.clear();
    plant.nodes.clear();
    plant.edges.clear();
    plant.vehicles.clear();
    for (const Spot& spot : spots) {
        plant.nodes.push_back({plant::NodeId(spot.name), plant.halls[0].id, {spot.x_m, spot.y_m}});
        if (spot.station == 0) continue;
        plant::Station station;
        station.id = plant::StationId("s" + std::to_string(spot.station));
        station.number = spot.station;
        station.name = spot.name;
        station.hall = plant.halls[0].id;
        station.pose = {spot.x_m, spot.y_m, 0};
        station.node = plant::NodeId(spot.name);
        station.resting_place = true;
        plant.stations.push_back(station);
    }
    for (const auto& [a, b] : lanes) {
        for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
            plant::RoadmapEdge edge;
            edge.from = plant::NodeId(from);
            edge.to = plant::NodeId(to);
            edge.id = plant::EdgeId(std::string(from) + "." + to);
            plant.edges.push_back(edge);
        }
    }
    for (int i = 0; i < vehicles; ++i) {
        plant::Vehicle vehicle;
        vehicle.id = VehicleId("V" + std::to_string(i + 1));
        vehicle.type = plant.vehicle_types[0].id;
        vehicle.manufacturer = "test";
        vehicle.serial_number = vehicle.id.str();
        vehicle.home = plant.stations[static_cast<std::size_t>(i)].id;
        plant.vehicles.push_back(vehicle);
    }
    return plant;
}

/// Two ends of a lane with a bay beside its middle.
plant::Plant corridor() {
    return plant_of(
        {{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40}, {"bay", 40, 52, 3}},
        {{"west", "middle"}, {"middle", "east"}, {"middle", "bay"}}, 2);
}

void confirm_poses(World& world) {
    world.connect_all();
    for (auto& [id, vehicle] : world.vehicles) {
        vehicle.state.position_initialized = true;
    }
    world.run(1);
}

JobOrder order_of(const World& world, const std::string& vehicle) {
    for (const auto& [id, order] : world.store.orders) {
        if (order.assigned_vehicle == VehicleId(vehicle) ||
            order.wanted_vehicle == VehicleId(vehicle)) {
            return order;
        }
    }
    return {};
}

TEST(TrafficScenarios, TwoThatWantEachOthersPlaceMeetHeadOnAndOneUsesTheBay) {
    World world(corridor());
    confirm_poses(world);

    ASSERT_TRUE(world.order("V1", {2}));
    ASSERT_TRUE(world.order("V2", {1}));
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_EQ(order_of(world, "V2").state, JobState::kEnded) << order_of(world, "V2").reason.code;
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped);
}

TEST(TrafficScenarios, WhoWaitsIsInTheWaitForGraphWithWhomItWaitsFor) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    ASSERT_TRUE(world.order("V2", {1}));

    bool seen = false;
    for (int i = 0; i < 600 && !seen; ++i) {
        world.run(0.5);
        for (const auto& wait : world.fleet->traffic(world.now).waits) {
            seen |= wait.vehicle != wait.waits_for && !wait.waits_for.empty() &&
                    wait.reason.code == "floor_held";
        }
    }
    EXPECT_TRUE(seen);
}

TEST(TrafficScenarios, AnIdleVehicleInABayLeavesItForAnother) {
    World world(plant_of({{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40, 3}},
                         {{"west", "middle"}, {"middle", "east"}}, 2));
    confirm_poses(world);
    ASSERT_TRUE(world.order("V2", {3}));
    world.run(200);
    ASSERT_EQ(order_of(world, "V2").state, JobState::kEnded);

    // V2 rests in the middle of the only lane; V1 has to get past it.
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(400);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded);
    EXPECT_EQ(world.fleet->vehicle(VehicleId("V2"), world.now)->at_station, plant::StationId("s2"));
    EXPECT_EQ(world.count_events("vehicle.makes_way"), 1);
}

TEST(TrafficScenarios, OneThatMeasuredItsStopWhileItWasLostMakesWayAfterwards) {
    World world(plant_of(
        {{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40, 3}, {"bay", 40, 52, 4}},
        {{"west", "middle"}, {"middle", "east"}, {"middle", "bay"}}, 2));
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {3}));
    const auto& leg = world.store.vehicles[VehicleId("V1")].leg_data;
    for (int i = 0; i < 1000 && (leg.nodes.empty() || leg.released_nodes < leg.nodes.size()); ++i)
        world.run(0.1);
    ASSERT_EQ(leg.released_nodes, leg.nodes.size());
    world.connected[VehicleId("V1")] = false;
    world.run(15);
    ASSERT_EQ(world.fleet->vehicle(VehicleId("V1"), world.now)->link, Link::kLost);
    world.connected[VehicleId("V1")] = true;
    world.run(1);
    ASSERT_EQ(order_of(world, "V1").state, JobState::kEnded);
    ASSERT_TRUE(world.fleet->resume_fleet({VehicleId("V1")}, "op", world.now));

    ASSERT_TRUE(world.order("V2", {1}));
    world.run(400);

    EXPECT_EQ(order_of(world, "V2").state, JobState::kEnded) << order_of(world, "V2").reason.code;
}

TEST(TrafficScenarios, ALoadedVehicleStaysWhereItStands) {
    plant::Plant plant = plant_of({{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40, 3}},
                                  {{"west", "middle"}, {"middle", "east"}}, 2);
    plant.vehicles[1].load_name = "A-101";
    World world(plant);
    confirm_poses(world);

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(200);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kRunning);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_held");
    EXPECT_EQ(world.count_events("vehicle.makes_way"), 0);
}

TEST(TrafficScenarios, FourThatWantTheNextOnesPlaceGoRoundOverACrossing) {
    World world(plant_of({{"west", 10, 40, 1},
                          {"north", 40, 70, 2},
                          {"east", 70, 40, 3},
                          {"south", 40, 10, 4},
                          {"crossing", 40, 40},
                          {"bay", 60, 60, 5}},
                         {{"west", "crossing"},
                          {"north", "crossing"},
                          {"east", "crossing"},
                          {"south", "crossing"},
                          {"crossing", "bay"}},
                         4));
    confirm_poses(world);

    for (int i = 1; i <= 4; ++i) {
        ASSERT_TRUE(world.order("V" + std::to_string(i), {i % 4 + 1}));
    }
    world.run(1500);

    for (int i = 1; i <= 4; ++i) {
        const auto order = order_of(world, "V" + std::to_string(i));
        EXPECT_EQ(order.state, JobState::kEnded) << i << " " << order.reason.code;
    }
    EXPECT_FALSE(world.fleet->traffic(world.now).stopped);
}

/// Two ways from west to east, the upper one longer.
plant::Plant two_ways() {
    return plant_of({{"west", 10, 40, 1},
                     {"east", 70, 40, 2},
                     {"low", 40, 40, 3},
                     {"a", 10, 60},
                     {"b", 70, 60},
                     {"far", 90, 40, 4}},
                    {{"west", "low"},
                     {"low", "east"},
                     {"west", "a"},
                     {"a", "b"},
                     {"b", "east"},
                     {"east", "far"}},
                    2);
}

TEST(TrafficScenarios, ABrokenDownVehicleOnTheShortWayIsPassedOnTheLongOne) {
    plant::Plant plant = two_ways();
    plant.vehicles[1].home = plant::StationId("s3");
    World world(plant);
    confirm_poses(world);
    world.vehicle("V2").state.errors.push_back({"driveFault", true, "no drive", {}});
    world.run(1);

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
}

TEST(TrafficScenarios, OnTheOnlyRoadABreakdownIsWaitedForWithItsName) {
    plant::Plant plant = plant_of(
        {{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40, 3}, {"far", 90, 40, 4}},
        {{"west", "middle"}, {"middle", "east"}, {"east", "far"}}, 2);
    plant.vehicles[1].home = plant::StationId("s3");
    World world(plant);
    confirm_poses(world);
    world.vehicle("V2").state.errors.push_back({"driveFault", true, "no drive", {}});
    world.run(1);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    ASSERT_EQ(order_of(world, "V1").state, JobState::kRunning);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_held");

    world.vehicle("V2").state.errors.clear();
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << "it made way once it could";
}

TEST(TrafficScenarios, AnIdleVehicleBesideAllPlacesLeavesTheWayOfAnother) {
    plant::Plant plant = plant_of(
        {{"west", 10, 40, 1}, {"east", 70, 40, 2}, {"middle", 40, 40, 3}, {"far", 90, 40, 4}},
        {{"west", "middle"}, {"middle", "east"}, {"east", "far"}}, 2);
    plant.vehicles[1].home = plant::StationId("s3");
    World world(plant);
    world.vehicle("V2").state.pose->x_m += 0.9;
    confirm_poses(world);

    ASSERT_TRUE(world.order("V1", {2}));
    world.run(600);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_GE(world.count_events("vehicle.makes_way"), 1);
}

TEST(TrafficScenarios, ClosedLanesAreGoneRoundAndKeptOverARestart) {
    plant::Plant plant = two_ways();
    plant.vehicles[1].home = plant::StationId("s4");
    World world(plant);
    confirm_poses(world);
    world.run(1);
    NewClosure closure;
    closure.name = "Wet paint";
    closure.edges = {plant::EdgeId("west.low")};
    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    ASSERT_TRUE(closed);
    world.settle();
    world.crash_server();
    ASSERT_EQ(world.fleet->traffic(world.now).closures.size(), 1u);
    world.run(2);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(600);
    ASSERT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    EXPECT_GT(world.vehicle("V1").node_steps, 20) << "by the long way";

    ASSERT_TRUE(world.fleet->reopen_floor(closed->id, "op", world.now));
    world.settle();
    EXPECT_TRUE(world.fleet->traffic(world.now).closures.empty());
    EXPECT_TRUE(world.store.closures.empty());
}

TEST(TrafficScenarios, AnOrderWithoutAnyOtherWayWaitsForTheClosureByName) {
    World world(corridor());
    confirm_poses(world);
    NewClosure closure;
    closure.name = "Door test";
    closure.hall = plant::HallId("h1");
    closure.outline = {{20, 36}, {24, 36}, {24, 44}, {20, 44}};
    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    ASSERT_TRUE(closed);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(5);
    const Reason reason = order_of(world, "V1").reason;
    EXPECT_EQ(reason.code, "floor_closed");
    const auto has = [&](const char* name, const std::string& value) {
        return std::any_of(reason.params.begin(), reason.params.end(), [&](const Param& param) {
            const auto* text = std::get_if<std::string>(&param.value);
            return param.name == name && text && *text == value;
        });
    };
    EXPECT_TRUE(has("closure", "Door test"));
    EXPECT_TRUE(has("closure_id", closed->id.str()));

    ASSERT_TRUE(world.fleet->reopen_floor(closed->id, "op", world.now));
    world.run(300);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded);
}

TEST(TrafficScenarios, ThePreviewOffersTheOtherWayUntilItIsClosed) {
    plant::Plant plant = two_ways();
    plant.vehicles[1].home = plant::StationId("s4");
    World world(plant);
    confirm_poses(world);
    world.run(1);
    NewOrder order;
    order.vehicle = VehicleId("V1");
    order.steps = {{2, plant::MotionMode::kLinear}};

    const auto before = world.fleet->preview(order, world.now);
    NewClosure closure;
    closure.name = "Wet paint";
    closure.edges = {plant::EdgeId("west.low")};
    ASSERT_TRUE(world.fleet->close_floor(closure, "op", world.now));
    const auto after = world.fleet->preview(order, world.now);

    ASSERT_EQ(before.steps.size(), 1u);
    ASSERT_EQ(before.steps[0].alternatives.size(), 1u);
    const auto& other = before.steps[0].alternatives[0];
    EXPECT_GT(other.more_cost, 0);
    ASSERT_EQ(after.steps.size(), 1u);
    EXPECT_TRUE(after.steps[0].alternatives.empty());
    ASSERT_TRUE(after.steps[0].chosen);
    EXPECT_EQ(after.steps[0].options[0].plan->route, other.plan.route) << "by the other way";
}

TEST(TrafficScenarios, AStateThatWasOvertakenChangesNothing) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(1);
    const auto id = VehicleId("V1");
    StateMessage older = world.vehicle("V1").state;
    older.header_id = 7;
    world.run(1);
    StateMessage newer = world.vehicle("V1").state;
    newer.header_id = 8;
    world.fleet->vehicle_state(id, newer, world.now);
    const auto before = world.fleet->vehicle(id, world.now);
    older.order_id.clear();  // from before it had the order

    world.fleet->vehicle_state(id, older, world.now);

    const auto after = world.fleet->vehicle(id, world.now);
    EXPECT_FALSE(after->needs_resume);
    EXPECT_EQ(after->state.header_id, 8);
    EXPECT_EQ(after->pose->x_m, before->pose->x_m);
    EXPECT_EQ(order_of(world, "V1").state, JobState::kRunning);
}

TEST(TrafficScenarios, APauseThatOutlivedItsDriveEndsWithResume) {
    World world;
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2, 3}));
    const auto id = world.only_order().id;
    auto& vehicle = world.vehicle("V1");
    while (vehicle.state.last_node_id != "s2" && world.ticks < 5000) world.run(0.1);
    ASSERT_EQ(world.stored(id).current_step, 0u);
    // It makes its stop while the order to pause is on its way.
    ASSERT_TRUE(world.fleet->pause_order(id, std::nullopt, "op", world.now));
    for (int actions = 0; actions < 3; ++actions) vehicle.step();
    world.fleet->vehicle_state(VehicleId("V1"), vehicle.state, world.now);
    world.run(5);
    ASSERT_EQ(world.stored(id).state, JobState::kInterrupted);
    ASSERT_EQ(world.stored(id).current_step, 1u);
    ASSERT_TRUE(vehicle.state.paused);

    ASSERT_TRUE(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    world.run(600);

    EXPECT_EQ(world.stored(id).state, JobState::kEnded) << world.stored(id).reason.code;
}

TEST(TrafficScenarios, ASilentVehicleGetsNoFloorThatBecomesFree) {
    plant::Plant plant = corridor();
    World world(plant);
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(2);
    NewClosure closure{
        "Door test", plant::HallId("h1"), {{30, 36}, {33, 36}, {33, 44}, {30, 44}}, {}};
    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    ASSERT_TRUE(closed);
    world.run(60);
    const auto& leg = world.store.vehicles.at(VehicleId("V1")).leg_data;
    ASSERT_GT(leg.released_nodes, 1u);
    ASSERT_LT(leg.released_nodes, leg.nodes.size()) << "it waits before the door";
    const std::size_t before = leg.released_nodes;

    world.connected[VehicleId("V1")] = false;
    world.run(4);
    ASSERT_EQ(world.fleet->vehicle(VehicleId("V1"), world.now)->link, Link::kLate);
    ASSERT_TRUE(world.fleet->reopen_floor(closed->id, "op", world.now));
    world.run(20);

    EXPECT_EQ(world.store.vehicles.at(VehicleId("V1")).leg_data.released_nodes, before);
}

TEST(TrafficScenarios, AVehicleWithItsSafetyStopPulledGetsNoFloorThatBecomesFree) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(2);
    const auto closed = world.fleet->close_floor(
        {"Door test", plant::HallId("h1"), {{30, 36}, {33, 36}, {33, 44}, {30, 44}}, {}}, "op",
        world.now);
    ASSERT_TRUE(closed);
    world.run(60);
    const auto& leg = world.store.vehicles.at(VehicleId("V1")).leg_data;
    ASSERT_LT(leg.released_nodes, leg.nodes.size()) << "it waits before the door";
    const std::size_t before = leg.released_nodes;

    world.vehicle("V1").state.e_stop = "MANUAL";
    world.run(2);
    ASSERT_TRUE(world.fleet->reopen_floor(closed->id, "op", world.now));
    world.run(20);

    EXPECT_EQ(world.store.vehicles.at(VehicleId("V1")).leg_data.released_nodes, before);
}

TEST(TrafficScenarios, AVehicleWhoseOrderWaitsForFloorIsNotFreeForAnother) {
    World world(corridor());
    confirm_poses(world);
    ASSERT_TRUE(world.fleet->close_floor(
        {"Door test", plant::HallId("h1"), {{20, 36}, {24, 36}, {24, 44}, {20, 44}}, {}}, "op",
        world.now));
    const auto first = world.order("V1", {3});
    ASSERT_TRUE(first);
    world.vehicle("V2").state.operating_mode = "MANUAL";
    world.run(2);
    ASSERT_EQ(world.stored(first->order.id).reason.code, "floor_closed");

    NewOrder any;
    any.steps = {{1, plant::MotionMode::kAuto}};
    const auto second = world.order(any);
    ASSERT_TRUE(second);
    world.run(5);

    EXPECT_EQ(world.stored(second->order.id).assigned_vehicle, VehicleId());
    EXPECT_EQ(world.stored(first->order.id).assigned_vehicle, VehicleId("V1"));
}

/// V1 in the west and V2 in the middle of a cross.
plant::Plant cross() {
    plant::Plant plant = plant_of(
        {{"west", 10, 40, 1},
         {"east", 70, 40, 2},
         {"middle", 40, 40, 3},
         {"north", 40, 60, 4},
         {"south", 40, 20, 5}},
        {{"west", "middle"}, {"middle", "east"}, {"middle", "north"}, {"middle", "south"}}, 2);
    plant.vehicles[1].home = plant::StationId("s3");
    return plant;
}

/// The place where V2 is going to rest, and the floor there closed.
plant::StationId close_where_it_goes(World& world) {
    const auto id = world.store.vehicles.at(VehicleId("V2")).leg_data.station;
    const auto* station = plant::find_station(world.plant, id);
    if (!station) return {};
    const double x = station->pose.x_m;
    const double y = station->pose.y_m;
    EXPECT_TRUE(
        world.fleet->close_floor({"Wet",
                                  plant::HallId("h1"),
                                  {{x - 3, y - 3}, {x + 3, y - 3}, {x + 3, y + 3}, {x - 3, y + 3}},
                                  {}},
                                 "op", world.now));
    return id;
}

TEST(TrafficScenarios, OneThatMakesWayElsewhereThanPlannedIsKnownToStandThere) {
    World world(cross());
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    for (int i = 0; i < 100 && world.count_events("vehicle.makes_way") == 0; ++i) world.run(0.1);
    const plant::StationId first = close_where_it_goes(world);
    for (int i = 0; i < 400; ++i) {
        world.run(0.5);
        const auto& record = world.store.vehicles.at(VehicleId("V2"));
        if (!record.has_leg) continue;
        const auto& end = record.leg_data.nodes.back().pose;
        for (const auto& station : world.plant.stations) {
            if (geometry::distance(station.pose.position(), end.position()) > 0.25) continue;
            EXPECT_EQ(record.leg_data.station, station.id);
        }
    }

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded) << order_of(world, "V1").reason.code;
    const auto view = world.fleet->vehicle(VehicleId("V2"), world.now);
    EXPECT_FALSE(view->at_station.empty());
    EXPECT_NE(view->at_station, first);
}

TEST(TrafficScenarios, OneThatMakesWayToAPlaceTakenSinceARestartGoesElsewhere) {
    plant::Plant plant = plant_of({{"west", 10, 40, 1},
                                   {"east", 70, 40, 2},
                                   {"middle", 40, 40, 3},
                                   {"north", 40, 58, 4},
                                   {"south", 40, 15, 5},
                                   {"far", 40, 70, 6}},
                                  {{"west", "middle"},
                                   {"middle", "east"},
                                   {"middle", "north"},
                                   {"middle", "south"},
                                   {"north", "far"}},
                                  3);
    plant.vehicles[1].home = plant::StationId("s3");
    plant.vehicles[2].home = plant::StationId("s6");
    for (std::size_t nodes = 1; nodes < 4; ++nodes) {
        World world(plant);
        confirm_poses(world);
        ASSERT_TRUE(world.order("V1", {2}));
        const auto& record = world.store.vehicles[VehicleId("V2")];
        for (int i = 0; i < 200 && (!record.has_leg || record.leg_data.passed_nodes < nodes); ++i)
            world.run(0.1);
        ASSERT_EQ(record.leg_data.station, plant::StationId("s4"));

        world.crash_server();
        world.run(2);
        ASSERT_TRUE(world.fleet->resume_fleet({VehicleId("V3")}, "op", world.now));
        ASSERT_TRUE(world.order("V3", {4}));
        world.run(100);
        ASSERT_EQ(order_of(world, "V3").state, JobState::kEnded)
            << order_of(world, "V3").reason.code;
        ASSERT_TRUE(world.fleet->resume_fleet({VehicleId("V1"), VehicleId("V2")}, "op", world.now));
        world.run(400);

        EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded)
            << nodes << " nodes: " << order_of(world, "V1").reason.code;
    }
}

TEST(TrafficScenarios, WrongClosuresAreRefusedWithTheField) {
    World world(corridor());
    const auto refused = [&](NewClosure wanted) {
        const auto closed = world.fleet->close_floor(wanted, "op", world.now);
        return closed ? std::string() : closed.error().reason.code + " " + closed.error().field;
    };
    EXPECT_EQ(refused({"x", {}, {}, {}}), "nothing_to_close /outline");
    EXPECT_EQ(refused({"x", {}, {}, {plant::EdgeId("no")}}), "unknown_edge /edges/0");
    EXPECT_EQ(refused({"x", plant::HallId("h9"), {{0, 0}, {1, 0}, {0, 1}}, {}}),
              "unknown_hall /hall");
    EXPECT_EQ(refused({"x", plant::HallId("h1"), {{0, 0}, {1, 0}, {2, 0}}, {}}),
              "bad_outline /outline");
}

}  // namespace
}  // namespace pulseline::fleet::testing
