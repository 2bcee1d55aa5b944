#include "core/planning/detour/detour_ground.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/geometry/bearing.hpp"
#include "core/planning/detour/seen_things.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Polygon;
using geometry::Pose2;

constexpr double kFarAhead_m = 40;      // of the start: no detour is that long
constexpr double kUnseenDepth_m = 0.5;  // of a thing of which only the front is seen
constexpr double kStep_m = 0.1;         // along the line, looking for what bars it

plant::VehicleType careful(const plant::VehicleType& type) {
    plant::VehicleType result = type;
    result.clearance_m = kDetourClearance_m;
    return result;
}

plant::Plant plant_of(const plant::VehicleType& type, const plant::Hall& hall) {
    plant::Plant plant;
    plant.halls = {hall};
    plant.vehicle_types = {type};
    return plant;
}

/// Widths of the floor between two places along the line.
struct Strip {
    double from_m = 0;
    double to_m = 0;
    double left_m = 0;
    double right_m = 0;
};

/// Where bands overlap the narrower one counts: it is still held when the other has been freed.
std::vector<Strip> strips_of(const std::vector<plant::Corridor>& corridors,
                             const std::vector<double>& starts_m, const std::vector<double>& ends_m,
                             double reach_m) {
    std::vector<double> borders;
    for (std::size_t i = 0; i < corridors.size(); ++i) {
        borders.push_back(starts_m[i] - reach_m);
        borders.push_back(ends_m[i] + reach_m);
    }
    std::sort(borders.begin(), borders.end());
    std::vector<Strip> strips;
    for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
        const double middle_m = (borders[k] + borders[k + 1]) / 2;
        Strip strip{borders[k], borders[k + 1], std::numeric_limits<double>::infinity(),
                    std::numeric_limits<double>::infinity()};
        for (std::size_t i = 0; i < corridors.size(); ++i) {
            if (middle_m < starts_m[i] - reach_m || middle_m > ends_m[i] + reach_m) continue;
            strip.left_m = std::min(strip.left_m, corridors[i].left_m);
            strip.right_m = std::min(strip.right_m, corridors[i].right_m);
        }
        const bool same = !strips.empty() && strips.back().left_m == strip.left_m &&
                          strips.back().right_m == strip.right_m;
        if (same) {
            strips.back().to_m = strip.to_m;
        } else if (strip.to_m > strip.from_m) {
            strips.push_back(strip);
        }
    }
    return strips;
}

/// One more stretch of a side; where it goes on as before it has no corner.
void go_on(Polygon& side, double from_m, double to_m, double y_m) {
    const bool as_before = !side.empty() && side.back().y_m == y_m;
    if (as_before) side.pop_back();
    if (!as_before) side.push_back({from_m, y_m});
    side.push_back({to_m, y_m});
}

}  // namespace

DetourGround::DetourGround(const DetourRequest& request)
    : type_(careful(*request.type)),
      loaded_(request.loaded),
      hall_(make_hall(request)),
      floor_(plant_of(type_, hall_), hall_) {
    take_things(request.seen);
}

/// Sets the frame and everything measured in it on the way.
plant::Hall DetourGround::make_hall(const DetourRequest& request) {
    const auto& stretch = request.stretch;
    assert(!stretch.empty());
    const Point2 origin = stretch.front().start.position();
    hall_from_line_ = {origin.x_m, origin.y_m, bearing_rad(origin, stretch.front().end.position())};
    const Pose2 line_from_hall = inverse(hall_from_line_);
    heading_rad_ = (line_from_hall * stretch.front().start).heading_rad;
    start_ = line_from_hall * request.start;

    body_ = plant::outline_with_load(type_, loaded_);
    double reach_m = 0;
    std::vector<Point2> corners;
    for (const Polygon& piece : body_) {
        for (const Point2& corner : piece) {
            reach_m = std::max(reach_m, norm(corner));
            corners.push_back(on_line(0) * corner);
        }
    }
    on_line_ = geometry::bounding_box(corners);

    std::vector<double> starts_m;
    std::vector<plant::Corridor> corridors;
    for (const DetourEdge& edge : stretch) {
        const double from_m = (line_from_hall * edge.start).x_m;
        if (!ends_m_.empty() && from_m > start_.x_m + kFarAhead_m) break;
        starts_m.push_back(from_m);
        ends_m_.push_back((line_from_hall * edge.end).x_m);
        corridors.push_back(edge.corridor);
        most_left_m_ =
            std::max(most_left_m_, edge.corridor.left_m - kBandMargin_m - on_line_.max.y_m);
        most_right_m_ =
            std::max(most_right_m_, edge.corridor.right_m - kBandMargin_m + on_line_.min.y_m);
    }

    // The vehicle on its line is never too near to the band's border.
    const auto wall_at = [&](double border_m, double body_m) {
        return std::max(border_m - kBandMargin_m, body_m) + kDetourClearance_m;
    };
    const auto strips = strips_of(corridors, starts_m, ends_m_, reach_m);
    Polygon right;
    Polygon left;
    for (std::size_t i = 0; i < strips.size(); ++i) {
        const double right_m = -wall_at(strips[i].right_m, -on_line_.min.y_m);
        const double left_m = wall_at(strips[i].left_m, on_line_.max.y_m);
        const double from_m =
            i > 0 ? strips[i].from_m : starts_m.front() - wall_at(reach_m, -on_line_.min.x_m);
        const double to_m = i + 1 < strips.size()
                                ? strips[i].to_m
                                : ends_m_.back() + wall_at(reach_m, on_line_.max.x_m);
        go_on(right, from_m, to_m, right_m);
        go_on(left, from_m, to_m, left_m);
    }
    plant::Hall hall;
    hall.id = plant::HallId("band");
    hall.outline = std::move(right);
    hall.outline.insert(hall.outline.end(), left.rbegin(), left.rend());
    return hall;
}

void DetourGround::take_things(const std::vector<Point2>& seen) {
    const Pose2 line_from_hall = inverse(hall_from_line_);
    const geometry::Box box = geometry::bounding_box(hall_.outline);
    std::vector<Point2> near;
    for (const Point2& in_hall : seen) {
        const Point2 p = line_from_hall * in_hall;
        if (p.x_m < box.min.x_m || p.x_m > box.max.x_m || p.y_m < box.min.y_m ||
            p.y_m > box.max.y_m) {
            continue;
        }
        near.push_back(p);
    }
    things_ = seen_things(std::move(near));
    std::vector<Polygon> standing;
    for (const Polygon& piece : body_) standing.push_back(geometry::transformed(start_, piece));
    for (StandingBody& thing : things_) {
        Polygon deeper = thing.outline.front();
        for (const Point2& p : thing.outline.front())
            deeper.push_back(p + Point2{kUnseenDepth_m, 0});
        StandingBody whole{thing.vehicle, {geometry::convex_hull(std::move(deeper))}};
        // Where the body is there is nothing else.
        if (distance_to(whole, standing, kDetourClearance_m) < kDetourClearance_m) continue;
        thing = std::move(whole);
    }
}

ManoeuvreRoom DetourGround::room(const Pose2& start, const Pose2& goal) const {
    const auto& own = floor_.bodies[loaded_ && floor_.bodies.size() > 1 ? 1 : 0];
    return {{floor_.obstacles, floor_.field, own.body, own.check}, things_, start, goal};
}

std::optional<double> DetourGround::first_barred_m(double from_m) const {
    const int steps = static_cast<int>(std::ceil((ends_m_.back() - from_m) / kStep_m));
    for (int i = 0; i <= steps; ++i) {
        if (!is_free_on_line(from_m + i * kStep_m)) return from_m + i * kStep_m;
    }
    return std::nullopt;
}

bool DetourGround::is_free_on_line(double x_m) const {
    std::vector<Polygon> pieces;
    for (const Polygon& piece : body_) pieces.push_back(geometry::transformed(on_line(x_m), piece));
    return std::all_of(things_.begin(), things_.end(), [&](const StandingBody& thing) {
        return distance_to(thing, pieces, kDetourClearance_m) >= kDetourClearance_m;
    });
}

}  // namespace pulseline::planning
