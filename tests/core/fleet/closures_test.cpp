#include <gtest/gtest.h>

#include "tests/core/fleet/traffic_halls.hpp"

// Floor that people close and reopen.
namespace pulseline::fleet::testing {
namespace {

using plant::VehicleId;

/// V2 out of the way, behind the east.
plant::Plant two_free_ways() {
    plant::Plant plant = two_ways();
    plant.vehicles[1].home = plant::StationId("s4");
    return plant;
}

TEST(Closures, ClosedLanesAreGoneRoundAndKeptOverARestart) {
    World world(two_free_ways());
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

TEST(Closures, AnOutlineFarBeyondTheHallIsNoMoreThanTheHall) {
    World world(two_free_ways());
    confirm_poses(world);
    NewClosure closure;
    closure.name = "Everything";
    closure.hall = world.plant.halls.front().id;
    closure.outline = {{-1e5, -1e5}, {1e5, -1e5}, {1e5, 1e5}, {-1e5, 1e5}};

    const auto closed = world.fleet->close_floor(closure, "op", world.now);
    world.settle();
    world.crash_server();
    world.run(1);
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(5);

    ASSERT_TRUE(closed);
    EXPECT_EQ(order_of(world, "V1").reason.code, "floor_closed");
}

TEST(Closures, AnOrderWithoutAnyOtherWayWaitsForTheClosureByName) {
    World world(corridor());
    confirm_poses(world);
    const Closure closed = close_lane(world, 20, 24);
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
    EXPECT_TRUE(has("closure_id", closed.id.str()));

    ASSERT_TRUE(world.fleet->reopen_floor(closed.id, "op", world.now));
    world.run(300);

    EXPECT_EQ(order_of(world, "V1").state, JobState::kEnded);
}

TEST(Closures, ThePreviewOffersTheOtherWayUntilItIsClosed) {
    World world(two_free_ways());
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

TEST(Closures, AVehicleWhoseOrderWaitsForFloorIsNotFreeForAnother) {
    World world(corridor());
    confirm_poses(world);
    close_lane(world, 20, 24);
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

TEST(Closures, WrongClosuresAreRefusedWithTheField) {
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
