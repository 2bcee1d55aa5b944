#include "core/fleet/vehicle/loads.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/fleet/journal/snapshot.hpp"
#include "core/fleet/views/order_preview.hpp"
#include "tests/core/fleet/load_world.hpp"

// Aircraft and products: each in one place, taken over and set down by vehicles or said by people.
namespace pulseline::fleet::testing {
namespace {

class Loads : public ::testing::Test {
protected:
    explicit Loads(const plant::Plant& plant = with_load()) : world(plant) {
        world.connect_all();
        world.announce(
            {"setBracketHeight", "lowerParking", "raiseParking", "stopLifts", "pick", "drop"});
        weigh("V1", 0, 0);
        weigh("V2", 0, 0);
        v1().lifts_end = false;
        world.run(1);
    }

    FakeVehicle& v1() { return world.vehicle("V1"); }
    void weigh(const std::string& id, double mass_kg, double height_m) {
        testing::weigh(world.vehicle(id), world.plant, mass_kg, height_m);
    }
    Result<VehicleView> move(const StepAction& wanted, const plant::VehicleId& id = kV1) {
        auto moved = world.fleet->move_lifts(id, wanted, "op", world.now);
        world.settle();
        return moved;
    }
    std::string refusal(const StepAction& wanted, const plant::VehicleId& id = kV1) {
        const auto moved = move(wanted, id);
        return moved ? "" : moved.error().reason.code;
    }
    std::string refusal(const LoadPlace& place) {
        const auto placed = world.fleet->place_load(kJig, place, "op", world.now);
        world.settle();
        return placed ? "" : placed.error().reason.code;
    }
    void take_over() {
        ASSERT_EQ(refusal(kPick), "");
        weigh("V1", kMass_kg, 0.15);
        v1().end_lifts();
        world.run(1);
    }
    VehicleView view(const plant::VehicleId& id = kV1) const {
        return *world.fleet->vehicle(id, world.now);
    }
    static plant::LoadId carried(const VehicleView& view) {
        return view.carries ? view.carries->id : plant::LoadId();
    }
    LoadRecord jig() const { return world.fleet->load(kJig)->place; }

    World world;
};

TEST_F(Loads, AVehicleTakesOneOverWhereItHangsAndTheServerKeepsWhoHasIt) {
    EXPECT_EQ(jig().station, kS1);
    EXPECT_FALSE(view().carries);
    ASSERT_EQ(refusal(kPick), "");
    EXPECT_EQ(jig().station, kS1) << "not before the vehicle says so";
    EXPECT_EQ(refusal(kPick), "lifts_moving");
    weigh("V1", kMass_kg, 0.15);
    v1().end_lifts();
    world.run(1);

    EXPECT_EQ(jig().vehicle, kV1);
    EXPECT_TRUE(jig().station.empty());
    EXPECT_EQ(jig().actor, "op");
    EXPECT_EQ(carried(view()), kJig);
    EXPECT_EQ(world.count_events("load.moved"), 1);
    EXPECT_EQ(refusal(kPick), "vehicle_loaded");

    world.crash_server();
    world.run(1);
    EXPECT_EQ(jig().vehicle, kV1) << "never lost by a restart";
    EXPECT_EQ(carried(view()), kJig);
}

/// The plant was imported anew while it was stopped.
TEST_F(Loads, WhatTheNewPlantForbidsWhereItIsIsWhereThatPlantHasItAtFirst) {
    take_over();
    world.plant.vehicle_types.front().max_load_kg = kMass_kg / 2;
    world.crash_server();
    world.run(1);
    EXPECT_EQ(jig().station, kS1);
    EXPECT_TRUE(jig().vehicle.empty());
    EXPECT_FALSE(view().carries);
    EXPECT_EQ(world.count_events("load.moved"), 2) << "and it is told";
}

TEST_F(Loads, ItDrivesWithItToWhereItSetsItDownAndLeavesItThere) {
    take_over();
    v1().lifts_end = true;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(60);
    ASSERT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
    EXPECT_EQ(world.store.stops.back().load, kJig);

    weigh("V1", kMass_kg, 0.02);
    world.run(1);
    EXPECT_EQ(refusal(kDrop), "brackets_too_low");
    weigh("V1", kMass_kg, 0.15);
    world.run(1);
    v1().lifts_end = false;
    ASSERT_EQ(refusal(kDrop), "");
    weigh("V1", 0, 0.1);
    v1().end_lifts();
    world.run(1);
    EXPECT_EQ(jig().station, plant::StationId("s3"));
    EXPECT_FALSE(view().carries);
    EXPECT_EQ(refusal(kDrop), "vehicle_empty");
    ASSERT_TRUE(world.order("V1", {2}));
    world.run(60);
    EXPECT_EQ(world.store.orders.rbegin()->second.state, JobState::kEnded);
    EXPECT_TRUE(world.store.stops.back().load.empty());
}

TEST_F(Loads, WhatWasBrokenOffIsWhereItWasAndNothingDrivesWithAPartOfIt) {
    ASSERT_EQ(refusal(kPick), "");
    weigh("V1", kMass_kg / 2, 0.13);
    v1().end_lifts("load_unbalanced: bracket front left");
    world.run(1);
    EXPECT_EQ(jig().station, kS1);
    ASSERT_TRUE(view().load.fault);
    EXPECT_EQ(view().load.fault->code, "load_unknown");
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(10);
    EXPECT_NE(world.only_order().state, JobState::kRunning);

    weigh("V1", 0, 0);
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << "given back, it drives";
    EXPECT_TRUE(world.store.stops.back().load.empty());
}

TEST_F(Loads, ACutLineLeavesTheLoadWhereItWas) {
    ASSERT_EQ(refusal(kPick), "");
    world.fleet->vehicle_disconnected(kV1, world.now);
    world.settle();
    EXPECT_EQ(view().lift->why, "link_lost");
    world.connected[kV1] = false;
    world.run(1);
    world.connect_all();
    world.run(1);
    EXPECT_EQ(jig().station, kS1);
    EXPECT_FALSE(view().carries);
}

TEST_F(Loads, AWeightThatIsNotThatOfTheLoadBarsTheDrive) {
    take_over();
    weigh("V1", 0.8 * kMass_kg, 0.15);
    world.run(1);
    ASSERT_TRUE(view().load.fault);
    EXPECT_EQ(view().load.fault->code, "load_differs");
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(10);
    EXPECT_NE(world.only_order().state, JobState::kRunning);
    EXPECT_FALSE(v1().state.driving);
    weigh("V1", kMass_kg, 0.15);
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

// Of a load that nobody has weighed, or just after it was begun, only the vehicle knows.
TEST_F(Loads, WhatTheVehicleSaysIsHalfTakenBarsTheDrive) {
    take_over();
    v1().state.errors.push_back({vda5050::kLoadHalfTaken, false, "", {}});
    world.run(1);
    ASSERT_TRUE(view().load.fault);
    EXPECT_EQ(view().load.fault->code, "load_half_taken");
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(10);
    EXPECT_NE(world.only_order().state, JobState::kRunning);
    EXPECT_EQ(world.only_order().reason.code, "load_half_taken");
    v1().state.errors.clear();
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

// On its feet the whole rises below what still hangs.
TEST_F(Loads, WithAWeightThatNobodyKnowsItsFeetStayWhereTheyAre) {
    const StepAction down{"lowerParking", {}}, up{"raiseParking", {}};
    weigh("V1", 0.4 * kMass_kg, 0.13);
    world.run(1);
    EXPECT_EQ(refusal(down), "load_unknown");
    EXPECT_EQ(refusal(up), "load_unknown");
    weigh("V1", 0, 0);
    take_over();
    weigh("V1", 0.4 * kMass_kg, 0.13);
    world.run(1);
    EXPECT_EQ(refusal(down), "load_differs");
    weigh("V1", kMass_kg, 0.15);
    world.run(1);
    EXPECT_EQ(refusal(down), "");
}

TEST_F(Loads, BelowOneThatHangsItGoesOnItsFeetOnlyWithItsBracketsLow) {
    const double support_m = world.plant.stations.front().support->height_m;
    const double lift_m = world.plant.vehicle_types.front().parking->lift_m;
    weigh("V1", 0, support_m - lift_m / 2);
    world.run(1);
    EXPECT_EQ(refusal({"lowerParking", {}}), "brackets_too_high");
    weigh("V1", 0, support_m - 2 * lift_m);
    world.run(1);
    EXPECT_EQ(refusal({"lowerParking", {}}), "");
}

// A part of the weight is on the support: all brackets together take it back, or give it back.
TEST_F(Loads, WhatIsHalfTransferredMayBeRaisedAndLoweredInStep) {
    take_over();
    const StepAction raise{"setBracketHeight",
                           {{"bracket", std::string("all")}, {"height_m", 0.2}}};
    weigh("V1", 0.4 * kMass_kg, 0.13);
    world.run(1);
    ASSERT_EQ(view().load.fault->code, "load_differs");
    EXPECT_EQ(refusal(raise), "");
}

TEST_F(Loads, NobodyTakesOverWhatIsElsewhereUnknownOrNotForIt) {
    EXPECT_EQ(refusal({"pick", {{"load", std::string("none")}}}), "unknown_load");
    EXPECT_EQ(refusal(kPick, kV2), "no_support_here");
    EXPECT_EQ(refusal(kDrop), "vehicle_empty");
    EXPECT_EQ(refusal(LoadPlace{{}, plant::StationId("s3")}), "");
    EXPECT_EQ(refusal(kPick), "load_elsewhere");
}

class TwoLoads : public Loads {
protected:
    TwoLoads() : Loads(with_two_loads()) {}
    std::string refusal_of_other(const LoadPlace& place) {
        const auto placed = world.fleet->place_load(kOther, place, "op", world.now);
        world.settle();
        return placed ? "" : placed.error().reason.code;
    }
};

TEST_F(TwoLoads, NothingIsSetDownOrSaidToBeWhereAnotherOneIs) {
    EXPECT_EQ(refusal_of_other({{}, kS1}), "support_taken");
    take_over();
    EXPECT_EQ(refusal(kPick), "vehicle_loaded");
    EXPECT_EQ(refusal_of_other({kV1, {}}), "vehicle_loaded");
    EXPECT_EQ(refusal_of_other({{}, kS1}), "floor_held") << "V1 stands there with its load";
    EXPECT_EQ(jig().vehicle, kV1);
    EXPECT_EQ(refusal(kDrop), "");
}

/// It was out of the hall, as far as people said, and comes back where another one hangs by now.
TEST_F(TwoLoads, NothingIsSetDownWhereAnotherOneCameWhileTheVehicleWasOffTheFloor) {
    take_over();
    ASSERT_TRUE(world.fleet->integrate(kV1, Integration::kIgnore, true, "op", world.now));
    EXPECT_EQ(refusal_of_other({{}, kS1}), "");
    ASSERT_TRUE(world.fleet->integrate(kV1, Integration::kUtilise, false, "op", world.now));
    world.run(1);
    ASSERT_TRUE(world.fleet->resume_fleet({kV1}, "op", world.now));
    world.run(1);
    EXPECT_EQ(refusal(kDrop), "support_taken");
    EXPECT_EQ(jig().vehicle, kV1);
    EXPECT_EQ(refusal_of_other({}), "");
    EXPECT_EQ(refusal(kDrop), "");
}

TEST(LoadsOfTypes, WhatReachesBeyondItsUsualLoadIsNotPutOnIt) {
    plant::Plant plant = with_load();
    plant.loads.front().outline = geometry::rectangle(5, 5);
    World world(plant);
    world.connect_all();
    world.run(1);
    const auto placed = world.fleet->place_load(kJig, {kV2, {}}, "op", world.now);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().reason.code, "load_too_large");
    EXPECT_EQ(world.fleet->load(kJig)->place.station, kS1);
}

TEST(LoadsOfTypes, WhatIsNotForTheTypeOrTooLargeIsNotPutOnIt) {
    plant::Plant plant = with_load();
    auto other = plant.vehicle_types.front();
    other.id = plant::VehicleTypeId("other");
    plant.vehicle_types.push_back(other);
    plant.loads.front().vehicle_types = {other.id};
    World world(plant);
    world.connect_all();
    world.announce({"setBracketHeight", "stopLifts", "pick", "drop"});
    for (const char* id : {"V1", "V2"}) testing::weigh(world.vehicle(id), world.plant, 0, 0);
    world.run(1);
    const auto placed = world.fleet->place_load(kJig, {kV2, {}}, "op", world.now);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().reason.code, "load_not_for_type");
    const auto picked = world.fleet->move_lifts(kV1, kPick, "op", world.now);
    ASSERT_FALSE(picked);
    EXPECT_EQ(picked.error().reason.code, "load_not_for_type");
}

TEST_F(Loads, APersonSaysWhereOneIsAndIsToldWhatForbidsIt) {
    EXPECT_EQ(refusal(LoadPlace{{}, plant::StationId("s2")}), "no_support");
    EXPECT_EQ(refusal(LoadPlace{{}, plant::StationId("none")}), "unknown_station");
    EXPECT_EQ(refusal(LoadPlace{plant::VehicleId("none"), {}}), "unknown_vehicle");
    EXPECT_EQ(
        world.fleet->place_load(plant::LoadId("none"), {}, "op", world.now).error().reason.code,
        "unknown_load");
    ASSERT_EQ(refusal(LoadPlace{kV2, {}}), "");
    EXPECT_EQ(carried(view(kV2)), kJig);
    EXPECT_EQ(refusal(LoadPlace{kV2, {}}), "") << "said twice";
    EXPECT_EQ(world.count_events("load.moved"), 1);
    weigh("V2", kMass_kg, 0);
    world.run(1);
    ASSERT_TRUE(world.order("V2", {2}));
    world.run(0.5);
    EXPECT_EQ(refusal(LoadPlace{}), "vehicle_busy");
    world.run(60);
    ASSERT_EQ(refusal(LoadPlace{}), "");
    EXPECT_TRUE(jig().vehicle.empty());
    EXPECT_TRUE(jig().station.empty());
}

/// The load is wider than the vehicle: it is not taken over onto floor that another one holds.
TEST(LoadsAndFloor, OneIsNotTakenOverAboveFloorOfAnother) {
    World world(with_v2_beside());
    world.connect_all();
    world.announce({"setBracketHeight", "stopLifts", "pick", "drop"});
    world.run(1);
    const auto held = world.fleet->move_lifts(kV1, kPick, "op", world.now);
    ASSERT_FALSE(held);
    EXPECT_EQ(held.error().reason.code, "floor_held");
    const auto said = world.fleet->place_load(kJig, {kV1, {}}, "op", world.now);
    ASSERT_FALSE(said);
    EXPECT_EQ(said.error().reason.code, "floor_held");
    EXPECT_FALSE(world.fleet->vehicle(kV1, world.now)->carries);
}

/// Send asks beside the fleet: there, too, is known what it carries, and that its brackets move.
TEST_F(Loads, AnOrderIsPreviewedWithThem) {
    take_over();
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{2, plant::MotionMode::kLinear, {}, {}}};
    const auto beside = [&] {
        OrderPreviewer previewer;
        return previewer.preview(world.fleet->preview_task(order, world.now));
    };
    const auto result_of = [](const Preview& preview, const std::string& code) {
        const auto found = std::ranges::find(preview.checks, code, &Check::code);
        return found == preview.checks.end() ? Check::Result::kNote : found->result;
    };
    const Preview own = world.fleet->preview(order, world.now);
    const Preview other = beside();
    EXPECT_EQ(result_of(own, "load"), Check::Result::kPass);
    EXPECT_EQ(result_of(other, "load"), Check::Result::kPass);
    const auto swept = [](const Preview& preview) {
        return preview.steps.at(0).options.at(0).plan->swept_area_m2;
    };
    EXPECT_EQ(swept(own), swept(other));
    ASSERT_EQ(refusal({"setBracketHeight", {{"bracket", std::string("all")}, {"height_m", 0.2}}}),
              "");
    EXPECT_EQ(result_of(beside(), "mode"),
              result_of(world.fleet->preview(order, world.now), "mode"));
    EXPECT_NE(result_of(beside(), "mode"), Check::Result::kPass) << "its brackets move";
}

TEST_F(Loads, ASnapshotInTheMiddleOfATransferComesBackTheSame) {
    ASSERT_EQ(refusal(kPick), "");
    static_cast<void>(world.fleet->take_outputs(world.now));
    const std::string bytes = world.fleet->snapshot();
    const auto again = Fleet::from_snapshot(world.plant, bytes);
    ASSERT_TRUE(again) << again.error().what;
    EXPECT_EQ((*again)->snapshot(), bytes);
}

}  // namespace
}  // namespace pulseline::fleet::testing
