#include "core/fleet/orders/order_loads.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "core/fleet/views/order_preview.hpp"
#include "tests/core/fleet/order_loads_world.hpp"

// Orders whose steps take loads over and set them down.
namespace pulseline::fleet::testing {
namespace {

TEST_F(OrderLoads, ALoadIsTakenOverBroughtAndSetDownByOneOrder) {
    const JobOrder order = ordered(brings());
    world.run(90);

    EXPECT_EQ(world.stored(order.id).state, JobState::kEnded) << world.stored(order.id).reason.code;
    EXPECT_EQ(jig().station, kS3);
    EXPECT_EQ(world.store.stops.back().load, kJig) << "it drove with it";
    ASSERT_EQ(moves().size(), 2u);
    for (const auto& event : moves()) {
        EXPECT_EQ(event.order, order.id);
        EXPECT_FALSE(event.leg.empty());
        EXPECT_EQ(event.vehicle, kV1);
    }
    const auto view = world.fleet->vehicle(kV1, world.now);
    EXPECT_FALSE(view->carries);
    EXPECT_FALSE(view->load.fault);
}

TEST_F(OrderLoads, EachTransferHasALegOfItsOwnAndTheOthersAreDoneAroundIt) {
    NewOrder order = brings();
    order.steps[0].before = {
        {"raiseParking", {}},
        kPick,
        {"setBracketHeight", {{"bracket", std::string("all")}, {"height_m", 0.2}}}};
    order.steps[0].after = {{"lowerParking", {}}, kDrop, {"raiseParking", {}}};
    const auto id = ordered(order).id;
    world.run(90);
    ASSERT_EQ(world.stored(id).state, JobState::kEnded) << world.stored(id).reason.code;
    EXPECT_EQ(v1().actions_done, (std::vector<std::string>{
                                     "raiseParking", "pick", "setBracketHeight", "adjustToMarker",
                                     "measureStop", "lowerParking", "drop", "raiseParking"}));
    EXPECT_EQ(world.count_events("step.action_done"), 6);
}

TEST_F(OrderLoads, DrivesArePlannedWithWhatItCarriesByThen) {
    NewOrder order = brings();
    order.steps[0].mode = plant::MotionMode::kLinear;
    order.steps.push_back({2, plant::MotionMode::kLinear});
    NewOrder empty = order;
    empty.steps[0].before = {};
    empty.steps[0].after = {};
    const auto swept_m2 = [&](const NewOrder& wanted, std::size_t step) {
        const Preview preview = world.fleet->preview(wanted, world.now);
        const auto& options = preview.steps.at(step).options;
        const auto linear =
            std::ranges::find(options, plant::MotionMode::kLinear, &planning::ModeOption::mode);
        return linear->plan ? linear->plan->swept_area_m2 : 0;
    };
    ASSERT_GT(swept_m2(empty, 0), 0);
    EXPECT_GT(swept_m2(order, 0), swept_m2(empty, 0)) << "its load is wider";
    EXPECT_EQ(swept_m2(order, 1), swept_m2(empty, 1)) << "it has set it down by then";
    ordered(brings());
    EXPECT_EQ(swept_m2(empty, 1), swept_m2(order, 1));
}

TEST_F(OrderLoads, WhatCannotBeIsRefusedWithItsField) {
    NewOrder order = brings();
    order.steps = {{2}};
    order.steps[0].after = {kDrop};
    EXPECT_EQ(refused(order, "/steps/0/after/0/type"), "no_support");

    order = brings();
    order.steps[0].before[0].params = {};
    EXPECT_EQ(refused(order, "/steps/0/before/0/parameters/load"), "missing_field");
    order.steps[0].before[0].params = {{"load", std::string("J-9")}};
    EXPECT_EQ(refused(order, "/steps/0/before/0/parameters/load"), "unknown_load");

    order = brings();
    order.steps[0].before.push_back(kPick);
    EXPECT_EQ(refused(order, "/steps/0/before/1/parameters/load"), "vehicle_loaded");
    order = brings();
    order.steps[0].after.push_back(kDrop);
    EXPECT_EQ(refused(order, "/steps/0/after/1/type"), "vehicle_empty");
    order = brings();
    order.steps.push_back({2});
    order.steps[1].before = {kPick};
    order.steps[1].after = {{"drop", {}}};
    EXPECT_EQ(refused(order, "/steps/1/after/0/type"), "no_support");
    EXPECT_TRUE(world.store.orders.empty());
}

TEST(OrderLoadsOf, WhatNoVehicleMayCarryIsRefused) {
    plant::Plant plant = with_load();
    plant.vehicle_types.front().max_load_kg = kMass_kg / 2;
    World world(plant);
    world.connect_all();
    world.announce({"pick", "drop"});
    NewOrder order;
    order.steps = {{3}};
    order.steps[0].before = {kPick};
    EXPECT_EQ(world.order(order).error().reason.code, "load_too_heavy");
}

TEST_F(OrderLoads, WhatIsNotThereInterruptsTheOrderAndAPersonGoesOn) {
    NewOrder order = brings();
    order.steps = {{1}};
    order.steps[0].after = {kPick};
    ASSERT_TRUE(world.fleet->place_load(kJig, {}, "op", world.now));
    world.settle();
    const auto id = ordered(order).id;
    world.run(30);
    EXPECT_EQ(world.stored(id).state, JobState::kInterrupted);
    EXPECT_EQ(world.stored(id).reason.code, "load_elsewhere");
    ASSERT_TRUE(world.fleet->place_load(kJig, {{}, kS1}, "op", world.now));
    ASSERT_TRUE(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    world.run(30);
    EXPECT_EQ(world.stored(id).state, JobState::kEnded) << world.stored(id).reason.code;
    EXPECT_EQ(jig().vehicle, kV1);
}

TEST_F(OrderLoads, WhatItTookOverBeforeItHeardOfTheCancelIsOnIt) {
    v1().stands = true;
    const auto id = ordered(brings()).id;
    world.run(1);
    ASSERT_TRUE(world.fleet->cancel_order(id, std::nullopt, "op", world.now));
    auto& actions = v1().state.action_states;
    const auto pick = std::ranges::find(actions, "pick", &vda5050::ActionState::type);
    ASSERT_NE(pick, actions.end());
    pick->status = vda5050::ActionStatus::kFinished;
    weigh(v1(), world.plant, kMass_kg, 0.15);
    world.run(3);
    EXPECT_EQ(world.stored(id).state, JobState::kAborted);
    EXPECT_EQ(jig().vehicle, kV1);
    EXPECT_FALSE(world.fleet->vehicle(kV1, world.now)->load.fault);
}

/// Two aircraft do not fit below one hoist.
TEST_F(OrderLoads, WithALoadItGoesNowhereWhereAnotherOneHangs) {
    ordered(brings());
    world.run(90);
    ASSERT_EQ(jig().station, kS3);
    ASSERT_TRUE(world.fleet->place_load(kOther, {kV1, {}}, "op", world.now));
    weigh(v1(), world.plant, kMass_kg, 0.15);
    world.run(1);
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    const auto made = world.order("V1", {3});
    ASSERT_TRUE(made);
    world.run(10);
    EXPECT_EQ(world.stored(made->order.id).reason.code, "station_has_load");
    ASSERT_TRUE(world.fleet->place_load(kJig, {}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.stored(made->order.id).state, JobState::kEnded);
}

/// A part of the weight is on the brackets, and nobody drives with that; it is taken over again.
TEST_F(OrderLoads, ATransferThatIsBrokenOffIsBegunAgainWhenAPersonSaysSo) {
    v1().action_fails = "pick";
    const auto id = ordered(brings()).id;
    world.run(5);
    weigh(v1(), world.plant, kMass_kg / 3, 0.1);
    world.run(5);
    EXPECT_EQ(world.stored(id).state, JobState::kInterrupted);
    EXPECT_EQ(world.stored(id).reason.code, "action_failed");
    EXPECT_EQ(jig().station, kS1);
    EXPECT_EQ(v1().node_steps, 0);

    v1().action_fails = "";
    ASSERT_TRUE(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    world.run(90);
    EXPECT_EQ(world.stored(id).state, JobState::kEnded) << world.stored(id).reason.code;
    EXPECT_EQ(jig().station, kS3);
}

TEST_F(OrderLoads, OneThatIsOnItsWayWhenTheServerDiesIsNotLost) {
    v1().stands = true;  // it has heard of it, and works
    ordered(brings());
    world.run(1);
    world.crash_server();
    world.run(1);
    EXPECT_EQ(jig().station, kS1);
    v1().stands = false;
    world.run(2);
    EXPECT_EQ(jig().vehicle, kV1) << "nobody has to say where it is";
    EXPECT_EQ(moves().size(), 1u);
}

TEST_F(OrderLoads, OneThatANewPlantDoesNotKnowIsOnlyNotKnown) {
    v1().stands = true;
    ordered(brings());
    world.run(1);
    std::erase_if(world.plant.loads, [](const auto& load) { return load.id == kJig; });
    world.crash_server();
    world.run(1);
    v1().stands = false;
    world.run(5);
    EXPECT_FALSE(world.fleet->load(kJig));
    EXPECT_TRUE(world.fleet->vehicle(kV1, world.now)->load.fault)
        << "and it does not drive with it";
    EXPECT_TRUE(moves().empty());
}

/// It has lost its leg when nothing of it was left to do but its end.
TEST_F(OrderLoads, OneWhoseLastActionIsDoneEndsWithoutIt) {
    const auto id = ordered(brings()).id;
    world.run(90);
    JobOrder order = world.stored(id);
    ASSERT_EQ(order.steps[0].phase, StepPhase::kAfter);
    order.state = JobState::kRunning;
    order.current_step = 0;
    order.steps[0].state = StepState::kPending;
    order.steps[0].actions_done = order.steps[0].after.size();
    world.store.orders[id] = order;
    world.crash_server();
    world.run(2);
    static_cast<void>(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    static_cast<void>(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(30);
    EXPECT_EQ(world.stored(id).state, JobState::kEnded) << world.stored(id).reason.code;
}

TEST_F(OrderLoads, ASnapshotInTheMiddleComesBackTheSame) {
    v1().stands = true;
    ordered(brings());
    world.run(1);
    static_cast<void>(world.fleet->take_outputs(world.now));
    const std::string bytes = world.fleet->snapshot();
    const auto again = Fleet::from_snapshot(world.plant, bytes);
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ((*again)->snapshot(), bytes);
}

/// The load is wider than the vehicle: above floor that another one holds it waits with its pick.
TEST(OrderLoadsOf, AboveFloorOfAnotherItWaits) {
    World world(with_v2_beside());
    world.connect_all();
    world.announce({"pick", "drop"});
    for (auto& [id, vehicle] : world.vehicles) weigh(vehicle, world.plant, 0, 0.1);
    world.run(1);
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{1}};
    order.steps[0].after = {kPick};
    const auto made = world.order(order);
    ASSERT_TRUE(made) << made.error().what;
    world.run(10);
    EXPECT_EQ(world.stored(made->order.id).state, JobState::kRunning);
    EXPECT_EQ(world.stored(made->order.id).reason.code, "floor_held");
    ASSERT_TRUE(world.fleet->integrate(kV2, Integration::kIgnore, true, "op", world.now));
    world.run(10);
    EXPECT_EQ(world.stored(made->order.id).state, JobState::kEnded)
        << world.stored(made->order.id).reason.code;
    EXPECT_EQ(world.fleet->load(kJig)->place.vehicle, kV1);
}

}  // namespace
}  // namespace pulseline::fleet::testing
