#include "core/planning/roads/what_if.hpp"

#include <gtest/gtest.h>

#include "tests/core/planning/leg_world.hpp"

namespace pulseline::planning {
namespace {

WhatIf question(const char* type, int from, int to) {
    WhatIf q;
    q.vehicle_type = plant::VehicleTypeId(type);
    q.from = from;
    q.to = to;
    return q;
}

TEST(WhatIf, NamesTheLaneThatIsTooNarrowForTheBody) {
    LegWorld world(3);

    const auto small = what_if(world.plant(), question("tug", 1, 2));
    const auto large = what_if(world.plant(), question("platform", 1, 2));

    ASSERT_TRUE(small);
    ASSERT_FALSE(small->routes.empty());
    EXPECT_EQ(small->routes[0].legs.size(), 3u);
    EXPECT_EQ(small->routes[0].turns, 2);
    EXPECT_EQ(small->routes[0].cost, (20 + 60 + 20) * 10'000u + 2 * 10'000u);
    ASSERT_TRUE(large);
    EXPECT_TRUE(large->routes.empty());
    ASSERT_EQ(large->blocking.size(), 1u);
    EXPECT_EQ(large->blocking[0].edge, plant::EdgeId("b-c"));
    EXPECT_EQ(large->blocking[0].bar, Bar::kTooNarrow);
}

TEST(WhatIf, OffersOtherLanesNotTheSameBackwards) {
    LegWorld world(12);
    plant::Plant& plant = world.plant();
    const plant::HallId hall("hall");
    plant.nodes.push_back({plant::NodeId("u"), hall, {30, 33}});
    plant.nodes.push_back({plant::NodeId("v"), hall, {70, 33}});
    for (const auto& [a, b] : {std::pair{"b", "u"}, {"u", "v"}, {"v", "c"}}) {
        plant.edges.push_back(
            {plant::EdgeId(std::string(a) + b), plant::NodeId(a), plant::NodeId(b), 0, {}});
    }

    const auto open = what_if(plant, question("tug", 1, 2));
    WhatIf closing = question("tug", 1, 2);
    closing.closed = {plant::EdgeId("b-c")};
    const auto closed = what_if(plant, closing);

    ASSERT_TRUE(open);
    ASSERT_EQ(open->routes.size(), 2u);
    EXPECT_EQ(open->routes[1].legs[1].edge, plant::EdgeId("bu"));
    EXPECT_EQ(open->differences[0].total(),
              std::int64_t{open->routes[1].cost} - open->routes[0].cost);
    EXPECT_EQ(open->differences[0].main_reason(), RouteDifference::Reason::kTurns);
    EXPECT_TRUE(open->shortcut_bars.empty());
    ASSERT_TRUE(closed);
    ASSERT_EQ(closed->routes.size(), 1u);
    EXPECT_EQ(closed->routes[0].legs[1].edge, plant::EdgeId("bu"));
    ASSERT_EQ(closed->shortcut_bars.size(), 1u);
    EXPECT_EQ(closed->shortcut_bars[0].edge, plant::EdgeId("b-c"));
    EXPECT_EQ(closed->shortcut_bars[0].bar, Bar::kClosed);
    EXPECT_EQ(closed->shortcut_cost, open->routes[0].cost);
}

TEST(WhatIf, GoesByWhatIsClosedAtPresentUnlessAskedNotTo) {
    LegWorld world(12);
    WhatIf q = question("tug", 1, 2);
    q.closures = {{"id-1", "Wet paint", plant::HallId("hall"), {geometry::rectangle(4, 4)}, 0.1}};
    for (auto& corner : q.closures[0].pieces[0]) {
        const auto middle = world.plant().nodes[1].position;
        const auto next = world.plant().nodes[2].position;
        corner = {corner.x_m + (middle.x_m + next.x_m) / 2,
                  corner.y_m + (middle.y_m + next.y_m) / 2};
    }

    const auto closed = what_if(world.plant(), q);
    q.present_closures = false;
    const auto open = what_if(world.plant(), q);

    ASSERT_TRUE(closed);
    EXPECT_TRUE(closed->routes.empty());
    ASSERT_EQ(closed->blocking.size(), 1u);
    EXPECT_EQ(closed->blocking[0].edge, plant::EdgeId("b-c"));
    EXPECT_EQ(closed->blocking[0].closures, std::vector<std::size_t>{0});
    ASSERT_TRUE(open);
    EXPECT_EQ(open->routes.size(), 1u);
}

TEST(WhatIf, CanBeWithdrawn) {
    LegWorld world(12);
    const std::atomic<bool> cancel{true};
    WhatIf q = question("tug", 1, 2);
    q.cancel = &cancel;

    const auto answer = what_if(world.plant(), q);

    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().reason.code, "cancelled");
}

TEST(WhatIf, RefusesWhatThePlantDoesNotHave) {
    LegWorld world(12);
    EXPECT_EQ(what_if(world.plant(), question("ship", 1, 2)).error().reason.code,
              "unknown_vehicle_type");
    EXPECT_EQ(what_if(world.plant(), question("tug", 1, 9)).error().field, "/to");
    WhatIf closing = question("tug", 1, 2);
    closing.closed = {plant::EdgeId("nowhere")};
    EXPECT_EQ(what_if(world.plant(), closing).error().field, "/closed_edges/0");
}

}  // namespace
}  // namespace pulseline::planning
