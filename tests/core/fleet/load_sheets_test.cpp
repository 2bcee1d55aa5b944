#include <gtest/gtest.h>

#include <cmath>

#include "core/fleet/views/order_preview.hpp"
#include "tests/core/fleet/load_world.hpp"

// What people say of loads while the server runs: new ones, those that have been weighed, and those
// that have left for ever.
namespace pulseline::fleet::testing {
namespace {

const plant::LoadId kNew("J-9");
constexpr double kHeavier_kg = 480;

class LoadSheets : public ::testing::Test {
protected:
    LoadSheets() : world(with_load()) {
        for (const char* id : {"V1", "V2"}) weigh(id, 0, 0);
        world.vehicle("V1").lifts_end = false;
        connect();
    }

    void connect() {
        world.connect_all();
        world.announce(
            {"setBracketHeight", "lowerParking", "raiseParking", "stopLifts", "pick", "drop"});
        world.run(1);
    }

    void weigh(const std::string& id, double mass_kg, double height_m) {
        testing::weigh(world.vehicle(id), world.plant, mass_kg, height_m);
    }
    static plant::Load papers(const plant::LoadId& id = kNew) {
        plant::Load load;
        load.id = id;
        load.name = id.str();
        load.mass_kg = kMass_kg;
        return load;
    }
    /// What the plant's file says of J-1.
    plant::Load jig() const { return world.plant.loads.front(); }
    Error refused(const plant::Load& load) {
        const auto put = world.fleet->put_load(load, "ann", world.now);
        world.settle();
        return put ? Error{} : put.error();
    }
    std::string refusal(const plant::Load& load) { return refused(load).reason.code; }
    std::string refusal(const plant::LoadId& id, const LoadPlace& place) {
        const auto placed = world.fleet->place_load(id, place, "op", world.now);
        world.settle();
        return placed ? "" : placed.error().reason.code;
    }
    std::string retired(const plant::LoadId& id) {
        const Status done = world.fleet->retire_load(id, "bob", world.now);
        world.settle();
        return done ? "" : done.error().reason.code;
    }
    double mass_kg(const plant::LoadId& id) const {
        return world.fleet->load(id)->sheet.load.mass_kg;
    }

    World world;
};

TEST_F(LoadSheets, ANewOneIsNowhereIsTakenOverLikeAnyOtherAndOutlivesTheServer) {
    ASSERT_EQ(refusal(papers()), "");
    const auto known = *world.fleet->load(kNew);
    EXPECT_TRUE(known.place.vehicle.empty() && known.place.station.empty());
    EXPECT_EQ(known.sheet.actor, "ann");
    EXPECT_EQ(world.count_events("load.registered"), 1);
    EXPECT_TRUE(world.store.load_moves.empty()) << "it has not moved";

    ASSERT_EQ(refusal(kJig, {}), "");
    ASSERT_EQ(refusal(kNew, {{}, kS1}), "");
    ASSERT_TRUE(
        world.fleet->move_lifts(kV1, {"pick", {{"load", std::string("J-9")}}}, "op", world.now));
    world.settle();
    weigh("V1", kMass_kg, 0.15);
    world.vehicle("V1").end_lifts();
    world.run(1);
    EXPECT_EQ(world.fleet->load(kNew)->place.vehicle, kV1);

    world.crash_server();
    world.run(1);
    EXPECT_EQ(world.fleet->load(kNew)->place.vehicle, kV1);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->carries->name, "J-9");
    EXPECT_EQ(world.fleet->load(kNew)->sheet.actor, "ann");
    world.vehicle("V1").lifts_end = true;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(60);
    EXPECT_EQ(world.store.stops.back().load, kNew);
}

TEST_F(LoadSheets, WhatHasBeenWeighedIsKnownOfThePlantsToo) {
    auto heavier = jig();
    heavier.mass_kg = kHeavier_kg;
    ASSERT_EQ(refusal(heavier), "");
    EXPECT_EQ(mass_kg(kJig), kHeavier_kg);
    EXPECT_EQ(world.fleet->load(kJig)->place.station, kS1) << "it stays where it is";
    EXPECT_EQ(world.count_events("load.changed"), 1);
    ASSERT_EQ(refusal(heavier), "");
    EXPECT_EQ(world.count_events("load.changed"), 1) << "said twice";
    world.crash_server();
    connect();
    EXPECT_EQ(mass_kg(kJig), kHeavier_kg) << "it stands before the plant's file";
    ASSERT_TRUE(world.fleet->move_lifts(kV1, kPick, "op", world.now));
    world.settle();
    weigh("V1", kHeavier_kg, 0.15);
    world.vehicle("V1").end_lifts();
    world.run(1);
    EXPECT_FALSE(world.fleet->vehicle(kV1, world.now)->load.fault) << "the brackets feel that much";
    weigh("V1", kMass_kg, 0.15);
    world.run(1);
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->load.fault->code, "load_differs");
}

TEST_F(LoadSheets, WhatNobodyMayCarryIsNotKnownAndTheFieldIsNamed) {
    const auto expect = [&](plant::Load load, const char* code, const char* field) {
        const Error error = refused(load);
        EXPECT_EQ(error.reason.code, code);
        EXPECT_EQ(error.field, field);
        EXPECT_FALSE(world.fleet->load(load.id)) << code;
    };
    auto load = papers();
    load.mass_kg = 1e6;
    expect(load, "load_too_heavy", "/mass_kg");
    load = papers();
    load.mass_kg = -1;
    expect(load, "negative", "/mass_kg");
    load.mass_kg = std::nan("");
    expect(load, "not_finite", "/mass_kg");
    load = papers();
    load.outline = geometry::rectangle(9, 9);
    expect(load, "load_too_large", "/outline");
    load.outline = {{0, 0}, {1, 1}, {1, 0}, {0, 1}};
    expect(load, "not_simple", "/outline");
    load.outline.assign(65, {0, 0});
    expect(load, "too_many", "/outline");
    load = papers();
    load.vehicle_types = {plant::VehicleTypeId("none")};
    expect(load, "unknown_vehicle_type", "/vehicle_types/0");
    load.vehicle_types.assign(9, plant::VehicleTypeId("small"));
    expect(load, "too_many", "/vehicle_types");
    load = papers();
    load.centre = {0, 1e300};
    expect(load, "load_outside_wheel_base", "/centre");
    load = papers();
    load.name = "J-1";
    expect(load, "load_name_taken", "/name");
    EXPECT_EQ(world.store.load_sheets.size(), 0u) << "nothing half done";
}

TEST_F(LoadSheets, WhoHasItOrIsAboutToHaveItStandsMeanwhile) {
    auto heavier = jig();
    heavier.mass_kg = kHeavier_kg;
    ASSERT_TRUE(world.fleet->move_lifts(kV1, kPick, "op", world.now));
    world.settle();
    EXPECT_EQ(refusal(heavier), "load_in_transfer");
    EXPECT_EQ(refusal(kJig, {}), "load_in_transfer");
    EXPECT_EQ(retired(kJig), "load_in_plant");
    weigh("V1", kMass_kg, 0.15);
    world.vehicle("V1").end_lifts();
    world.run(1);
    auto unfit = jig();
    unfit.vehicle_types = {plant::VehicleTypeId("small")};
    unfit.mass_kg = 1e6;
    EXPECT_EQ(refusal(unfit), "load_too_heavy");
    world.vehicle("V1").lifts_end = true;
    ASSERT_TRUE(world.order("V1", {3}));
    world.run(0.5);
    EXPECT_EQ(refusal(heavier), "vehicle_busy");
    world.run(60);
    EXPECT_EQ(refusal(heavier), "");
    EXPECT_EQ(world.fleet->load(kJig)->place.vehicle, kV1);
}

TEST_F(LoadSheets, WhatHasLeftForEverIsGoneAndItsIdIsNotGivenAgain) {
    EXPECT_EQ(retired(kNew), "unknown_load");
    EXPECT_EQ(retired(kJig), "load_in_plant");
    ASSERT_EQ(refusal(kJig, {}), "");
    ASSERT_EQ(retired(kJig), "");
    EXPECT_EQ(world.count_events("load.retired"), 1);
    for (int life = 0; life < 2; ++life) {
        EXPECT_FALSE(world.fleet->load(kJig)) << "the plant's file still has it";
        EXPECT_TRUE(world.fleet->loads().empty());
        EXPECT_EQ(refusal(jig()), "load_retired");
        EXPECT_EQ(retired(kJig), "unknown_load");
        EXPECT_EQ(refusal(kJig, {{}, kS1}), "unknown_load");
        const auto picked = world.fleet->move_lifts(kV1, kPick, "op", world.now);
        EXPECT_EQ(picked.error().reason.code, "unknown_load");
        world.crash_server();
        connect();
    }
    auto other = papers();
    other.name = jig().name;
    EXPECT_EQ(refusal(other), "") << "its name is free";
}

/// What an open order will take over is not retired under it.
TEST_F(LoadSheets, AnOrderThatWillTakeItOverKeepsIt) {
    ASSERT_EQ(refusal(papers()), "");
    NewOrder order;
    order.vehicle = kV1;
    order.earliest_start = world.now + std::chrono::seconds(30);
    order.steps = {{3, plant::MotionMode::kLinear, {}, {{"pick", {{"load", std::string("J-9")}}}}}};
    ASSERT_TRUE(world.fleet->create(order, world.now));
    world.settle();
    EXPECT_EQ(retired(kNew), "load_in_order");
    const JobOrderId id = world.only_order().id;
    ASSERT_TRUE(world.fleet->cancel_order(id, std::nullopt, "op", world.now));
    world.run(1);
    EXPECT_EQ(retired(kNew), "");
}

TEST(LoadSheetsOfTypes, AnOrderSaysThatItsVehicleMayNotCarryWhatIsKnownOtherwiseSince) {
    plant::Plant plant = with_load();
    plant.vehicle_types.push_back(plant.vehicle_types.front());
    plant.vehicle_types.back().id = plant::VehicleTypeId("other");
    World world(plant);
    world.connect_all();
    world.announce({"setBracketHeight", "stopLifts", "pick", "drop"});
    for (const char* id : {"V1", "V2"}) testing::weigh(world.vehicle(id), world.plant, 0, 0);
    world.run(1);
    NewOrder order;
    order.vehicle = kV1;
    order.earliest_start = world.now + std::chrono::seconds(5);
    order.steps = {{1, plant::MotionMode::kLinear, {}, {kPick}}};
    ASSERT_TRUE(world.fleet->create(order, world.now));
    plant::Load known = plant.loads.front();
    known.vehicle_types = {plant::VehicleTypeId("other")};
    ASSERT_TRUE(world.fleet->put_load(known, "ann", world.now));
    world.run(10);
    EXPECT_EQ(world.only_order().state, JobState::kAllowedToStart);
    EXPECT_EQ(world.only_order().reason.code, "load_not_for_type");
    known.vehicle_types.clear();
    ASSERT_TRUE(world.fleet->put_load(known, "ann", world.now));
    world.run(30);
    EXPECT_EQ(world.only_order().state, JobState::kEnded);
}

/// What an order has behind it may have left for ever: that does not hold it up.
TEST_F(LoadSheets, OnlyWhatAnOrderHasYetToTakeOverCounts) {
    ASSERT_EQ(refusal(papers()), "");
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{1, plant::MotionMode::kLinear, {}, {}},
                   {3, plant::MotionMode::kLinear, {}, {}},
                   {2, plant::MotionMode::kLinear, {}, {}}};
    order.steps[0].after = {{"pick", {{"load", std::string("J-9")}}}};
    order.steps[1].after = {kDrop};
    ASSERT_EQ(refusal(kJig, {}), "");
    ASSERT_EQ(refusal(kNew, {{}, kS1}), "");
    world.vehicle("V1").lifts_end = true;
    world.vehicle("V1").on_action = [&](const std::string& action) {
        weigh("V1", action == "pick" ? kMass_kg : 0, 0.15);
    };
    ASSERT_TRUE(world.fleet->create(order, world.now));
    world.settle();
    for (int i = 0; i < 600 && world.only_order().current_step < 2; ++i) world.run(0.1);
    ASSERT_EQ(world.only_order().current_step, 2);
    const JobOrderId id = world.only_order().id;
    ASSERT_TRUE(world.fleet->pause_order(id, std::nullopt, "op", world.now));
    ASSERT_EQ(refusal(kNew, {}), "");
    EXPECT_EQ(retired(kNew), "");
    ASSERT_TRUE(world.fleet->resume_order(id, std::nullopt, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.only_order().state, JobState::kEnded) << world.only_order().reason.code;
}

TEST_F(LoadSheets, NoMoreThanAPlantCanHave) {
    for (int i = 0; i < 999; ++i) {
        ASSERT_TRUE(world.fleet->put_load(papers(plant::LoadId("X-" + std::to_string(i))), "ann",
                                          world.now));
    }
    EXPECT_EQ(refusal(papers()), "too_many_loads");
    ASSERT_EQ(retired(plant::LoadId("X-5")), "");
    EXPECT_EQ(refusal(papers()), "");
}

/// The previewer works beside the fleet and keeps what it was told.
TEST_F(LoadSheets, OrdersArePreviewedWithThem) {
    ASSERT_EQ(refusal(kJig, {}), "");
    ASSERT_EQ(refusal(papers()), "");
    ASSERT_EQ(refusal(kNew, {kV1, {}}), "");
    weigh("V1", kMass_kg, 0.15);
    world.run(1);
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{2, plant::MotionMode::kLinear, {}, {}}};
    OrderPreviewer previewer;
    const auto task = world.fleet->preview_task(order, world.now);
    ASSERT_EQ(refusal(kNew, {}), "");
    ASSERT_EQ(retired(kNew), "");
    const Preview preview = previewer.preview(task);
    EXPECT_TRUE(preview.accepted);
}

}  // namespace
}  // namespace pulseline::fleet::testing
