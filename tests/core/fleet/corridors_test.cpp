#include <gtest/gtest.h>

#include <algorithm>

#include "tests/core/fleet/traffic_halls.hpp"

// Lanes in whose corridor a vehicle may leave its line: what is told to it, and kept free for it.
namespace pulseline::fleet::testing {
namespace {

constexpr plant::Corridor kRoom{4, 1};

/// A long lane from 1 to 2, and beside it, in its corridor only, station 4, where V2 of station 3
/// can go.
plant::Plant lane_with_a_neighbour(std::optional<plant::Corridor> corridor) {
    plant::Plant plant = plant_of(
        {{"west", 10, 40, 1}, {"north", 40, 60, 3}, {"east", 70, 40, 2}, {"beside", 40, 43, 4}},
        {{"west", "east"}, {"north", "beside"}, {"north", "east"}}, 2);
    for (auto& edge : plant.edges) {
        if (edge.id == plant::EdgeId("west.east")) edge.corridor = corridor;
    }
    return plant;
}

const vda5050::OrderMessage& order_at(const World& world, const std::string& vehicle) {
    return world.vehicles.at(plant::VehicleId(vehicle)).order();
}

void drive_to(World& world, const std::string& vehicle, double x_m) {
    for (int i = 0; i < 2000 && world.vehicle(vehicle).state.pose->x_m < x_m; ++i) world.run(0.1);
    ASSERT_GE(world.vehicle(vehicle).state.pose->x_m, x_m);
}

TEST(Corridors, AreToldWithTheEdgesAndGiveTheNodesBetweenThemRoom) {
    World world(lane_with_a_neighbour(kRoom));
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(1);

    const vda5050::OrderMessage& order = order_at(world, "V1");
    ASSERT_GT(order.edges.size(), 10u);
    for (const auto& edge : order.edges) EXPECT_EQ(edge.corridor, kRoom) << edge.edge_id;
    for (std::size_t i = 1; i + 1 < order.nodes.size(); ++i) {
        EXPECT_EQ(order.nodes[i].allowed_deviation_xy_m, 4) << order.nodes[i].node_id;
    }
    EXPECT_LT(order.nodes.back().allowed_deviation_xy_m, 0.1);
}

TEST(Corridors, AreKeptFreeOfOthersUntilTheVehicleIsThrough) {
    for (const bool with : {true, false}) {
        World world(lane_with_a_neighbour(with ? std::optional(kRoom) : std::nullopt));
        confirm_poses(world);
        ASSERT_TRUE(world.order("V1", {2}));
        drive_to(world, "V1", 35);
        world.vehicle("V1").state.paused = true;

        ASSERT_TRUE(world.order("V2", {4}));
        world.run(120);
        const JobOrder waiting = order_of(world, "V2");
        EXPECT_EQ(waiting.state == JobState::kEnded, !with);
        if (with) {
            EXPECT_EQ(waiting.reason.code, "floor_held");
        }
        world.crash_server();
        world.run(60);
        EXPECT_EQ(order_of(world, "V2").state == JobState::kEnded, !with) << "after a restart";
    }
}

TEST(Corridors, ABarredVehicleIsGivenMoreOfTheLaneWhenItAsks) {
    for (const bool with : {true, false}) {
        World world(lane_with_a_neighbour(with ? std::optional(kRoom) : std::nullopt));
        confirm_poses(world);
        ASSERT_TRUE(world.order("V1", {2}));
        drive_to(world, "V1", 20);
        FakeVehicle& vehicle = world.vehicle("V1");
        vehicle.stands = true;
        vehicle.state.driving = false;
        world.run(5);
        const auto released = [&] {
            return std::ranges::count_if(order_at(world, "V1").nodes,
                                         [](const auto& node) { return node.released; });
        };
        const auto before = released();
        vehicle.state.field_violation = true;
        world.run(5);
        EXPECT_EQ(released(), before) << "it has not asked";
        vehicle.state.new_base_request = true;
        world.run(1);
        const auto soon = released();
        world.run(30);
        if (with) {
            EXPECT_GT(soon, before);
            EXPECT_EQ(released(), static_cast<long>(order_at(world, "V1").nodes.size()));
        } else {
            EXPECT_EQ(released(), before);
        }
    }
}

TEST(Corridors, AVehicleBesideItsLineSaysWhy) {
    World world(lane_with_a_neighbour(kRoom));
    confirm_poses(world);
    ASSERT_TRUE(world.order("V1", {2}));
    drive_to(world, "V1", 20);
    const auto reason = [&] {
        return world.fleet->vehicle(plant::VehicleId("V1"), world.now)->reason;
    };
    EXPECT_FALSE(reason());
    world.vehicle("V1").state.errors = {{"going_round", false, "round an obstacle", {}}};
    world.run(0.5);
    ASSERT_TRUE(reason());
    EXPECT_EQ(reason()->code, "going_round");
    world.vehicle("V1").state.errors.clear();
    world.run(0.5);
    EXPECT_FALSE(reason());
}

TEST(Corridors, ClosedFloorInOneClosesItsLane) {
    World world(lane_with_a_neighbour(kRoom));
    confirm_poses(world);
    NewClosure closure;
    closure.name = "Open shaft";
    closure.hall = world.plant.halls[0].id;
    closure.outline = {{30, 42}, {33, 42}, {33, 43}, {30, 43}};
    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    ASSERT_TRUE(closed);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(5);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_closed");

    ASSERT_TRUE(world.fleet->reopen_floor(closed->id, "op", world.now));
    world.run(300);
    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded);
}

TEST(LaneSpeeds, AreToldWithTheEdges) {
    plant::Plant plant = lane_with_a_neighbour(std::nullopt);
    for (auto& edge : plant.edges) edge.max_speed_mps = 0.25;
    World world(std::move(plant));
    confirm_poses(world);
    ASSERT_TRUE(world.order("V2", {2}, plant::MotionMode::kLinear));
    world.run(1);
    bool limited = false;
    for (const auto& edge : order_at(world, "V2").edges) {
        if (edge.segment.kind == kinematics::Segment::Kind::kRotate) continue;
        EXPECT_EQ(edge.max_speed_mps, 0.25) << edge.edge_id;
        limited = true;
    }
    EXPECT_TRUE(limited);
}

}  // namespace
}  // namespace pulseline::fleet::testing
