#include "core/planning/legs/grid_leg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/kinematics/primitives.hpp"
#include "core/planning/legs/floor_way.hpp"
#include "core/planning/manoeuvre/steering.hpp"

namespace pulseline::planning {
namespace {

using geometry::Point2;
using geometry::Pose2;

// Each half a megabyte to two.
constexpr std::size_t kFloorsKept = 12;
// How far a vehicle goes straight to or from a place where it may not turn.
constexpr double kTightEnd_m = 30.0;
// Places at which a straight may end, besides the corners of the way over cells.
constexpr int kPlaces = 8;
constexpr double kLeastApart_m = 0.5;
// A second look at the corners brings them closer in; a third would gain less than a cell.
constexpr int kLooks = 2;
constexpr double kAnyCost = std::numeric_limits<double>::infinity();

tl::unexpected<Error> no_way(const LegTask& task, const char* blocked_by, const char* why) {
    return fail(Errc::kUnreachable, "no_floor_way",
                std::string("No way over the free floor leads there: ") + why, {},
                {{"from", task.request.from_station.str()},
                 {"to", task.station.id.str()},
                 {"blocked_by", std::string(blocked_by)}});
}

/// The nearest place straight ahead, behind or, for a type that can, beside a pose at which the
/// body may do anything; the pose's own where it may there. nullopt: there is none near.
std::optional<Point2> roomy_place(const LegTask& task, const GridFloor& floor, const Pose2& pose,
                                  bool leaving) {
    if (floor.is_roomy(floor.cell_at(pose.position()))) return pose.position();
    const bool sideways = Steering(*task.request.type).any_direction();
    std::array<bool, 4> looks{true, true, sideways, sideways};
    constexpr std::array<double, 4> kSides{0, kPi, kPi / 2, -kPi / 2};
    for (double way_m = floor.cell_m(); way_m <= kTightEnd_m; way_m += floor.cell_m()) {
        for (std::size_t i = 0; i < kSides.size(); ++i) {
            if (!looks[i]) continue;
            const double along = pose.heading_rad + kSides[i];
            const Point2 at = pose.position() + way_m * Point2{std::cos(along), std::sin(along)};
            const Cell cell = floor.cell_at(at);
            if (!floor.map().inside(cell)) looks[i] = false;
            if (!floor.is_roomy(cell)) continue;
            looks[i] = false;  // what bars the way there bars it to places behind
            const Pose2 there{at.x_m, at.y_m, pose.heading_rad};
            std::vector<kinematics::Segment> way;
            kinematics::append_straight(way, leaving ? pose : there,
                                        leaving ? at : pose.position());
            if (keeps_clear(task, floor, way)) return at;
        }
    }
    return std::nullopt;
}

/// The places in order, with more between them, so that there are some `count` along the whole.
std::vector<Point2> with_places_between(const std::vector<Point2>& line, int count) {
    double length_m = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        length_m += geometry::distance(line[i], line[i + 1]);
    }
    const double apart_m = std::max(kLeastApart_m, length_m / count);
    std::vector<Point2> places;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Point2 way = line[i + 1] - line[i];
        if (norm(way) < kinematics::kNothing) continue;
        const int pieces = std::max(1, static_cast<int>(norm(way) / apart_m));
        for (int k = 0; k < pieces; ++k) {
            places.push_back(line[i] + (static_cast<double>(k) / pieces) * way);
        }
    }
    places.push_back(line.back());
    return places;
}

/// As few as draft_along takes; the ends stay.
void thin_out(std::vector<Point2>& places) {
    while (places.size() > kMostPoints) {
        std::vector<Point2> fewer;
        for (std::size_t i = 0; i + 1 < places.size(); i += 2) fewer.push_back(places[i]);
        fewer.push_back(places.back());
        places = std::move(fewer);
    }
}

void add_times(const LegTask& task, LegDraft& draft) {
    for (const auto& segment : draft.segments) {
        draft.max_speed_mps.push_back(
            task.roads.lines().along(task.request.hall, segment).max_speed_mps);
    }
    kinematics::set_durations(*task.request.type, draft.segments, draft.max_speed_mps);
}

/// The best of the chains along the line, each time with more places between its corners.
std::optional<LegDraft> smoothed(const LegTask& task, const GridFloor& floor,
                                 std::vector<Point2> line) {
    std::optional<LegDraft> best;
    for (int look = 0; look < kLooks; ++look) {
        auto places = with_places_between(line, kPlaces);
        thin_out(places);
        auto draft = draft_along(task, floor, places, best ? best->cost : kAnyCost);
        if (!draft || (best && draft->cost >= best->cost)) break;
        line = corners_of(*draft);
        best = std::move(draft);
        if (line.size() <= 2) break;
    }
    return best;
}

}  // namespace

std::shared_ptr<const GridFloor> GridFloors::find(const Of& of) {
    const std::lock_guard lock(mutex_);
    const auto found = std::ranges::find(known_, of, &Known::of);
    if (found == known_.end()) return nullptr;
    std::rotate(known_.begin(), found, found + 1);
    return known_.front().floor;
}

void GridFloors::keep(Of of, std::shared_ptr<const GridFloor> floor) {
    const std::lock_guard lock(mutex_);
    known_.push_front({std::move(of), std::move(floor)});
    if (known_.size() > kFloorsKept) known_.pop_back();
}

std::shared_ptr<const GridFloor> GridLegs::open_floor(const FreeFloor& hall, const Body& body) {
    GridFloors::Of of{hall.hall, body, {}};
    if (auto known = floors_->find(of)) return known;
    auto floor = std::make_shared<const GridFloor>(hall.field, body);
    floors_->keep(std::move(of), floor);
    return floor;
}

Result<LegDraft> GridLegs::draft(const LegTask& task) {
    const FreeFloor* hall = halls_.floor(task.request.hall);
    if (!hall) {
        return fail(Errc::kNotFound, "unknown_hall",
                    "There is no hall " + task.request.hall.str() + " in the plant.");
    }
    const auto open = open_floor(*hall, task.passage.body);
    GridFloors::Of of{hall->hall, task.passage.body, {}};
    std::vector<ClosedFloor> closed;
    for (const ClosedFloor& one : task.closures) {
        if (one.hall != hall->hall) continue;
        of.closed += key_of(one);
        closed.push_back(one);
    }
    if (closed.empty()) return draft_on(task, *open);
    auto around = floors_->find(of);
    if (!around) {
        around = std::make_shared<const GridFloor>(open->with(std::move(closed)));
        floors_->keep(std::move(of), around);
    }
    auto round = draft_on(task, *around);
    return round ? std::move(round) : draft_on(task, *open);
}

Result<LegDraft> GridLegs::draft_on(const LegTask& task, const GridFloor& floor) {
    const auto cost = hall_cost(task.cost, floor.cell_m());
    if (!cost) return fail(cost.error());
    const Pose2& goal = task.station.pose;
    const auto leave = roomy_place(task, floor, task.request.start, true);
    if (!leave) return no_way(task, "start", "the vehicle cannot leave where it stands.");
    const auto arrive = roomy_place(task, floor, goal, false);
    if (!arrive) return no_way(task, "goal", "the station has too little room around it.");
    const GridRequest request{floor.cell_at(*leave), floor.cell_at(*arrive), std::nullopt, *cost};
    if (!floor.may_join(request.start, request.goal) ||
        search_.run(floor.map(), request, Algorithm::kTurnJump, route_) != SearchEnd::kFound) {
        return no_way(task, "obstacles", "walls, obstacles or closed floor shut it off.");
    }
    std::vector<Point2> line{task.request.start.position(), *leave};
    for (const Cell& corner : route_.corners) line.push_back(floor.centre_of(corner));
    line.push_back(*arrive);
    line.push_back(goal.position());
    auto draft = smoothed(task, floor, std::move(line));
    if (!draft) return no_way(task, "obstacles", "there is too little room to turn.");
    add_times(task, *draft);
    return std::move(*draft);
}

}  // namespace pulseline::planning
