#include "core/fleet/legs/leg_plan_answerer.hpp"

#include <utility>
#include <vector>

#include "core/fleet/tables/plant_tables.hpp"

namespace pulseline::fleet {
namespace {

/// With the floor that each body holds where it stands: a way that keeps off it is granted.
std::vector<planning::StandingBody> on_held_floor(std::vector<planning::StandingBody> bodies) {
    constexpr std::size_t kAnyHall = 0;  // its tiles lie where those of the others do
    for (auto& body : bodies) {
        std::vector<geometry::Point2> corners;
        for (const auto tile : traffic::tiles_under(kAnyHall, body.outline, kFloorMargin_m)) {
            const auto box = traffic::tile_box(tile);
            corners.insert(
                corners.end(),
                {box.min, {box.max.x_m, box.min.y_m}, box.max, {box.min.x_m, box.max.y_m}});
        }
        body.outline = {geometry::convex_hull(std::move(corners))};
    }
    return bodies;
}

}  // namespace

LegPlanAnswer LegPlanAnswerer::answer(const LegPlanQuestion& question) {
    if (tables_ != question.tables) {
        tables_ = question.tables;
        planner_ = tables_->planner.again();
    }
    planner_->set_closures(question.closures);
    auto plan = planner_->plan_leg(question.request, on_held_floor(question.standing));
    if (!plan) return {{}, plan.error().reason};
    return {std::move(*plan), {}};
}

}  // namespace pulseline::fleet
