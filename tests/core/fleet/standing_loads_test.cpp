#include "core/fleet/floor/standing_loads.hpp"

#include "core/fleet/views/order_preview.hpp"
#include "tests/core/fleet/order_loads_world.hpp"

// Loads that stand or hang where others are to drive.
namespace pulseline::fleet::testing {
namespace {

/// J-1 hangs at station 2, on the only way between the others.
class LoadOnTheWay : public OrderLoads {
protected:
    LoadOnTheWay() : OrderLoads(with_hoist_on_the_way()) {}
    static plant::Plant with_hoist_on_the_way() {
        plant::Plant plant = with_two_loads();
        plant.stations[1].support = plant::Support{};
        plant.loads.front().station = plant.stations[1].id;
        plant.stations[0].support.reset();
        return plant;
    }
    JobState driven_to(int station) {
        const auto made = world.order("V1", {station});
        EXPECT_TRUE(made);
        world.run(60);
        newest = made->order.id;
        return world.stored(newest).state;
    }
    void put_j2_on_v1() {
        ASSERT_TRUE(world.fleet->place_load(kOther, {kV1, {}}, "op", world.now));
        weigh(v1(), world.plant, kMass_kg, 0.15);
        world.run(1);
    }
    JobOrderId newest;
};

TEST_F(LoadOnTheWay, IsPassedBelowByWhoCarriesNothingAndWaitedForByWhoCarriesSomething) {
    ASSERT_EQ(driven_to(3), JobState::kEnded);
    put_j2_on_v1();
    const int steps = v1().node_steps;
    EXPECT_EQ(driven_to(1), JobState::kRunning);
    EXPECT_EQ(world.stored(newest).reason,
              (Reason{"load_in_the_way", {{"load", "J-1"}, {"station", std::int64_t{2}}}}));
    EXPECT_EQ(v1().node_steps, steps) << "it stays where it is";
    ASSERT_TRUE(world.fleet->place_load(kJig, {}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.stored(newest).state, JobState::kEnded);
}

TEST_F(LoadOnTheWay, IsNotRunIntoByEmptyBrackets) {
    weigh(v1(), world.plant, 0, 0.118);  // where they touch it, but for what tells up from down
    world.run(1);
    NewOrder order;
    order.vehicle = kV1;
    order.steps = {{3}};
    const Preview preview = OrderPreviewer().preview(world.fleet->preview_task(order, world.now));
    EXPECT_TRUE(std::ranges::any_of(preview.checks, [](const Check& check) {
        return check.code == "load" && check.result == Check::Result::kFail;
    })) << "Send says so before";
    EXPECT_EQ(driven_to(3), JobState::kAllowedToStart);
    const Reason reason = world.stored(newest).reason;
    EXPECT_EQ(reason.code, "brackets_raised");
    EXPECT_EQ(world.fleet->vehicle(kV1, world.now)->load.fault->code, "brackets_raised");
    weigh(v1(), world.plant, 0, 0.11);  // as who has just set one down leaves
    world.run(60);
    EXPECT_EQ(world.stored(newest).state, JobState::kEnded);
}

TEST_F(LoadOnTheWay, IsNotRunIntoByOneThatWasOnItsWayWhenItCame) {
    ASSERT_TRUE(world.fleet->place_load(kJig, {}, "op", world.now));
    weigh(v1(), world.plant, 0, 0.3);
    world.run(1);
    const auto made = world.order("V1", {3});
    ASSERT_TRUE(made);
    world.run(1);
    const auto& leg = world.store.vehicles.at(kV1).leg_data;
    const auto released = leg.released_nodes;
    ASSERT_LT(released, leg.nodes.size());
    const auto& third = world.plant.stations[2].id;
    ASSERT_TRUE(world.fleet->place_load(kJig, {{}, third}, "op", world.now));
    world.run(60);
    EXPECT_EQ(world.store.vehicles.at(kV1).leg_data.released_nodes, released);
    EXPECT_EQ(world.stored(made->order.id).state, JobState::kRunning);
}

TEST_F(LoadOnTheWay, IsInItAfterARestartToo) {
    ASSERT_EQ(driven_to(3), JobState::kEnded);
    put_j2_on_v1();
    world.crash_server();
    world.connect_all();
    world.run(1);
    EXPECT_EQ(driven_to(1), JobState::kRunning);
    EXPECT_EQ(world.stored(newest).reason.code, "load_in_the_way");
}

TEST_F(LoadOnTheWay, IsNotSaidToHangWhereSomebodyWithALoadStands) {
    ASSERT_TRUE(world.fleet->place_load(kJig, {}, "op", world.now));
    put_j2_on_v1();
    ASSERT_EQ(driven_to(2), JobState::kEnded);
    const auto placed =
        world.fleet->place_load(kJig, {{}, world.plant.stations[1].id}, "op", world.now);
    ASSERT_FALSE(placed);
    EXPECT_EQ(placed.error().reason.code, "floor_held");
    EXPECT_TRUE(jig().station.empty());
}

}  // namespace
}  // namespace pulseline::fleet::testing
