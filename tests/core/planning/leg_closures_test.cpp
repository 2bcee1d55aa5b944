#include <gtest/gtest.h>

#include <random>

#include "core/planning/legs/leg_planner.hpp"
#include "tests/core/planning/leg_world.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;

/// Two lanes side by side through the gap: b-c is the shorter one, f-g the other.
LegWorld two_lanes() {
    LegWorld world(24);
    plant::Plant& plant = world.plant();
    const plant::HallId hall("hall");
    plant.nodes.push_back({plant::NodeId("f"), hall, {20, 38}});
    plant.nodes.push_back({plant::NodeId("g"), hall, {84, 38}});
    for (const auto& [a, b] : std::initializer_list<std::pair<std::string, std::string>>{
             {"b", "f"}, {"f", "g"}, {"g", "d"}}) {
        plant.edges.push_back(
            {plant::EdgeId(a + "-" + b), plant::NodeId(a), plant::NodeId(b), 0, {}});
        plant.edges.push_back(
            {plant::EdgeId(b + "-" + a), plant::NodeId(b), plant::NodeId(a), 0, {}});
    }
    return world;
}

ClosedFloor closed(const char* id, std::vector<Polygon> pieces) {
    return {id, id, plant::HallId("hall"), std::move(pieces), 0.1};
}
Polygon on_short_lane() { return {{40, 29}, {44, 29}, {44, 31}, {40, 31}}; }
Polygon on_long_lane() { return {{60, 37}, {64, 37}, {64, 39}, {60, 39}}; }

std::string text(const std::vector<plant::NodeId>& route) {
    std::string all;
    for (const auto& node : route) all += node.str();
    return all;
}

std::vector<std::string> ids(std::initializer_list<const char*> list) {
    return {list.begin(), list.end()};
}

TEST(LegAlternatives, SayWhatAnotherWayTakesMore) {
    LegWorld world = two_lanes();
    const LegPlanner planner(world.plant());
    const auto request = world.request("tug", 1, 2);
    const auto plan = planner.plan_leg(request);
    ASSERT_TRUE(plan) << plan.error().what;
    ASSERT_EQ(text(plan->route), "abcd");

    const auto others = planner.alternatives(request, *plan, 3, {});

    ASSERT_EQ(others.size(), 1u);
    const LegAlternative& other = others.front();
    EXPECT_EQ(text(other.plan.route), "abfgd");
    const double longer_m = 8 + 64 + std::hypot(4, 12) - (60 + 20);
    EXPECT_NEAR(other.plan.length_m - plan->length_m, longer_m, 1e-9);
    EXPECT_EQ(other.plan.turns, plan->turns);
    EXPECT_NEAR(other.more_cost, 10 * longer_m, 1e-9);
    EXPECT_NEAR(other.more_length, 10 * longer_m, 1e-9);
    EXPECT_NEAR(other.more_turns, 0, 1e-9);
    EXPECT_NEAR(other.more_s, other.plan.duration_s - plan->duration_s, 1e-9);
    EXPECT_EQ(other.main_reason, LegAlternative::Reason::kLength);
}

TEST(LegAlternatives, NameTurnsWhereTheyDecide) {
    LegWorld world = two_lanes();
    world.plant().routing.k_diff = 500;
    const LegPlanner planner(world.plant());
    auto request = world.request("tug", 1, 2);
    request.start.heading_rad = kPi / 2;  // b ahead: no turn before it
    world.plant().nodes.push_back({plant::NodeId("h"), plant::HallId("hall"), {50, 36}});
    LegWorld bent = two_lanes();
    bent.plant().routing.k_diff = 500;
    bent.plant().nodes.push_back({plant::NodeId("h"), plant::HallId("hall"), {50, 33}});
    bent.plant().edges.push_back(
        {plant::EdgeId("b-h"), plant::NodeId("b"), plant::NodeId("h"), 0, {}});
    bent.plant().edges.push_back(
        {plant::EdgeId("h-c"), plant::NodeId("h"), plant::NodeId("c"), 0, {}});
    const LegPlanner with_bend(bent.plant());
    const auto plan = with_bend.plan_leg(request);
    ASSERT_TRUE(plan) << plan.error().what;

    bool found = false;
    for (const auto& other : with_bend.alternatives(request, *plan, 3, {})) {
        EXPECT_NEAR(other.more_cost, other.more_length + other.more_turns, 1e-9);
        EXPECT_NEAR(other.plan.cost - plan->cost, other.more_cost, 1e-9);
        if (text(other.plan.route) != "abhcd") continue;
        found = true;
        EXPECT_EQ(other.main_reason, LegAlternative::Reason::kTurns);
        EXPECT_NEAR(other.more_turns, 490.0 * (other.plan.turns - plan->turns), 1e-9);
    }
    EXPECT_TRUE(found);
}

TEST(LegPlanner, GoesRoundWhoStandsOnTheWay) {
    LegWorld world = two_lanes();
    const LegPlanner planner(world.plant());
    const auto request = world.request("tug", 1, 2);
    const StandingBody idle{plant::VehicleId("V9"), {on_short_lane()}};
    const StandingBody other{plant::VehicleId("V8"), {on_long_lane()}};

    const auto round = planner.assess_modes(request, {idle})[0];
    const auto none_free = planner.assess_modes(request, {idle, other})[0];
    const auto nobody = planner.assess_modes(request, {})[0];

    ASSERT_TRUE(round.plan && none_free.plan && nobody.plan);
    EXPECT_EQ(text(round.plan->route), "abfgd");
    EXPECT_GT(round.plan->clearance_m, 0);
    EXPECT_TRUE(planner.alternatives(request, *round.plan, 3, {idle}).empty());
    // They may leave: a way is shown all the same, and who stands on it.
    EXPECT_EQ(none_free.plan->clearance_m, 0);
    EXPECT_EQ(none_free.plan->nearest, "V9");
    EXPECT_TRUE(none_free.plan->closures.empty());
    // The question before leaves nothing behind.
    EXPECT_EQ(text(nobody.plan->route), "abcd");
    EXPECT_EQ(text(planner.plan_leg(request)->route), "abcd");
}

TEST(LegPlanner, TakesTheRoadsWhereWhoStandsThereBarsTheDirectWay) {
    LegWorld world(24);
    plant::Plant& plant = world.plant();
    plant.nodes.push_back({plant::NodeId("x"), plant::HallId("hall"), {8, 30}});
    for (const auto& [from, to] : {std::pair("a", "x"), std::pair("x", "e")}) {
        plant.edges.push_back(
            {plant::EdgeId(std::string(from) + to), plant::NodeId(from), plant::NodeId(to), 0, {}});
    }
    const LegPlanner planner(world.plant());
    const auto request = world.request("platform", 1, 3);
    const auto direct = planner.assess_modes(request, {})[0];
    ASSERT_TRUE(direct.plan);
    ASSERT_TRUE(direct.plan->route.empty());
    const StandingBody idle{plant::VehicleId("V9"),
                            {geometry::transformed({20, 30, 0}, geometry::rectangle(1, 1))}};

    const auto option = planner.assess_modes(request, {idle})[0];

    ASSERT_TRUE(option.plan);
    EXPECT_EQ(text(option.plan->route), "axe");
    EXPECT_GT(option.plan->clearance_m, 0);
}

TEST(LegAlternatives, KeepOffClosedFloor) {
    LegWorld world = two_lanes();
    LegPlanner planner(world.plant());
    planner.set_closures({closed("paint", {on_long_lane()})});
    const auto request = world.request("tug", 1, 2);

    const auto plan = planner.plan_leg(request);

    ASSERT_TRUE(plan);
    EXPECT_TRUE(planner.alternatives(request, *plan, 3, {}).empty());
}

TEST(LegClosures, AreGoneRoundWhereThereIsAnotherWay) {
    LegWorld world = two_lanes();
    LegPlanner planner(world.plant());
    const auto request = world.request("tug", 1, 2);
    const auto before = planner.plan_leg(request);

    planner.set_closures({closed("paint", {on_short_lane()})});
    const auto round = planner.plan_leg(request);
    planner.set_closures({});
    const auto after = planner.plan_leg(request);

    ASSERT_TRUE(before && round && after);
    EXPECT_EQ(text(round->route), "abfgd");
    EXPECT_TRUE(round->closures.empty());
    EXPECT_EQ(after->route, before->route);
    EXPECT_EQ(after->cost, before->cost);
}

TEST(LegClosures, TheOneThatCutsOffIsNamed) {
    LegWorld world = two_lanes();
    LegPlanner planner(world.plant());
    planner.set_closures({closed("elsewhere", {{{5, 50}, {8, 50}, {8, 55}, {5, 55}}}),
                          closed("long", {on_long_lane()}), closed("short", {on_short_lane()})});

    const auto plan = planner.plan_leg(world.request("tug", 1, 2));

    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->closures, ids({"short"}));  // either would do; this one leaves the least cost
    EXPECT_EQ(text(plan->route), "abcd");
}

TEST(LegClosures, OfSeveralThatCutOffNoneIsNamedInVain) {
    LegWorld world = two_lanes();
    LegPlanner planner(world.plant());
    const std::vector<ClosedFloor> all{closed("both", {on_short_lane(), on_long_lane()}),
                                       closed("long", {on_long_lane()}),
                                       closed("short", {on_short_lane()})};
    planner.set_closures(all);
    const auto request = world.request("tug", 1, 2);

    const auto plan = planner.plan_leg(request);

    ASSERT_TRUE(plan);
    ASSERT_EQ(plan->closures.size(), 2u);
    const auto without = [&](const std::vector<std::string>& reopened) {
        std::vector<ClosedFloor> left;
        for (const auto& floor : all) {
            if (std::find(reopened.begin(), reopened.end(), floor.id) == reopened.end()) {
                left.push_back(floor);
            }
        }
        planner.set_closures(left);
        return planner.plan_leg(request)->closures.empty();
    };
    EXPECT_TRUE(without(plan->closures));
    for (const std::string& one : plan->closures) EXPECT_FALSE(without({one})) << one;
}

TEST(LegClosures, ADirectWayOverOneIsTakenOnlyWhenThereIsNoOther) {
    LegWorld world = two_lanes();
    LegPlanner planner(world.plant());
    auto request = world.request("tug", 1, 3);  // straight north, beside the lane a-b-e
    request.start = {26, 10, 0};
    request.mode = plant::MotionMode::kLinear;
    ASSERT_TRUE(planner.plan_leg(request)->route.empty());

    planner.set_closures({closed("paint", {{{22.5, 28}, {24, 28}, {24, 29}, {22.5, 29}}})});
    const auto plan = planner.plan_leg(request);

    ASSERT_TRUE(plan) << plan.error().what;
    EXPECT_FALSE(plan->route.empty());
    EXPECT_TRUE(plan->closures.empty());
}

// Tables follow closures; a planner that never knew others must say the same.
TEST(LegClosures, FollowedOneByOneGiveWhatANewPlannerGives) {
    LegWorld world = two_lanes();
    LegPlanner following(world.plant());
    std::mt19937_64 random(9);
    std::uniform_real_distribution<double> x(10, 90);
    std::uniform_real_distribution<double> y(8, 52);
    std::vector<ClosedFloor> floors;
    for (int i = 0; i < 120; ++i) {
        if (!floors.empty() && random() % 2 == 0) {
            floors.erase(floors.begin() + static_cast<std::ptrdiff_t>(random() % floors.size()));
        } else {
            const double at_x = x(random);
            const double at_y = y(random);
            const std::string id = "c" + std::to_string(i);
            floors.push_back(
                closed(id.c_str(),
                       {{{at_x, at_y}, {at_x + 3, at_y}, {at_x + 3, at_y + 3}, {at_x, at_y + 3}}}));
        }
        following.set_closures(floors);
        LegPlanner fresh(world.plant());
        fresh.set_closures(floors);
        for (const char* type : {"tug", "platform"}) {
            for (const auto& [from, to] : {std::pair(1, 2), {2, 1}, {3, 2}}) {
                const auto a = following.plan_leg(world.request(type, from, to));
                const auto b = fresh.plan_leg(world.request(type, from, to));
                ASSERT_EQ(a.has_value(), b.has_value());
                if (!a) continue;
                ASSERT_EQ(a->cost, b->cost);
                ASSERT_EQ(a->route, b->route);
                ASSERT_EQ(a->closures, b->closures);
            }
        }
    }
}

}  // namespace
}  // namespace pulseline::planning
