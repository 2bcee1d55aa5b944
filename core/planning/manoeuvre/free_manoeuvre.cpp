#include "core/planning/manoeuvre/free_manoeuvre.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <optional>

#include "core/kinematics/primitives.hpp"
#include "core/planning/manoeuvre/manoeuvre_lattice.hpp"
#include "core/planning/manoeuvre/manoeuvre_sampling.hpp"
#include "core/planning/room/disc_distances.hpp"

namespace pulseline::planning {
namespace {

using geometry::Pose2;
using Found = FreeManoeuvre::Found;

// How far the field tells distances beyond the largest clearance: the more, the more of a long way
// through open floor one test can pass.
constexpr double kFieldBeyond_m = 2.0;
constexpr double kLeastBeyond_m = 0.5;
constexpr double kGoodEnough = 1.05;  // times the least cost there can be: no need to look further
constexpr int kRounds = 200;          // of shortening
constexpr double kArrives = 1e-9;

double reach_of(const plant::Plant& plant) {
    double clearance_m = 0;
    for (const auto& type : plant.vehicle_types) {
        clearance_m = std::max(clearance_m, type.clearance_m);
    }
    return clearance_m + kFieldBeyond_m;
}

tl::unexpected<Error> blocked(const char* reason, const std::string& where,
                              const ManoeuvreRoom::Conflict& by) {
    const std::string what = by.by.what == "wall"  ? "a wall"
                             : by.by.what == "map" ? "an obstacle of the map"
                                                   : by.by.what;
    return fail(Errc::kUnreachable, reason,
                "The vehicle would stand too near to " + what + " " + where, {},
                {{"by", by.by.what},
                 {"at_x_m", by.by.at.x_m},
                 {"at_y_m", by.by.at.y_m},
                 {"clearance_m", by.by.distance_m},
                 {"limit_m", by.limit_m}});
}

FreeFloor::Prepared prepared(Body body, const FloorField& field) {
    FootprintCheck check(body.pieces, body.clearance_m + ManoeuvreRoom::kMargin_m, field);
    return {std::move(body), std::move(check)};
}

bool same(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) < kArrives &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) < kArrives;
}

/// One request on its way through the stages.
class Planning {
public:
    Planning(const FreeManoeuvreRequest& request, const Steering& steering, ManoeuvreRoom& room)
        : request_(request), room_(room), task_{steering, room, request.start, request.goal} {}

    Result<FreeManoeuvre> run() {
        const long limit = static_cast<long>(request_.time_limit_s * kTestsPerSecond);
        direct();
        if (best_m_ <= kGoodEnough * least_m_) return answer();
        room_.map_standing();
        const ManoeuvreTask back{task_.steering, room_, task_.goal, task_.start};
        const DiscDistances to_goal(room_.field(), room_.inner_radius_m(), task_.goal.position());
        const DiscDistances to_start(room_.field(), room_.inner_radius_m(), task_.start.position());
        if (best_.empty() && !std::isfinite(to_goal.from(task_.start.position()))) {
            return none(true);
        }
        // From both ends: leaving a tight place is easier found by ways that end there exactly.
        for (const int fineness : {1, 2}) {
            consider(lattice_search(task_, to_goal, fineness, {limit / 6, best_m_}),
                     Found::kByLattice);
            consider(reversed(lattice_search(back, to_start, fineness, {limit / 6, best_m_})),
                     Found::kByLattice);
            if (!best_.empty()) break;
        }
        for (std::uint64_t k = 0; best_.empty() && room_.work() < limit; ++k) {
            const auto planner =
                k % 2 == 0 ? SamplingPlanner::kRrtConnect : SamplingPlanner::kBiEst;
            const long share = std::min(limit / 4, limit - room_.work());
            consider(sampling_search(task_, planner, request_.seed + k, share), Found::kBySampling);
        }
        return best_.empty() ? none(false) : answer();
    }

private:
    void direct() {
        std::vector<Way> ways;
        task_.steering.ways(request_.start, request_.goal, ways);
        least_m_ = ways.front().cost_m;
        for (const Way& way : ways) {
            if (!room_.is_free(request_.start, way)) continue;
            const Moves moves(way.moves.begin(), way.moves.begin() + way.count);
            consider(moves, Found::kDirectly);
            if (!best_.empty()) return;
        }
    }

    /// Shortens a path and keeps it when it is the best so far and stands the second check.
    void consider(const Moves& moves, Found found) {
        if (moves.empty()) return;
        const bool is_least = cost_m(task_.steering, moves) <= least_m_;
        for (const int rounds : {is_least ? 0 : kRounds, 0}) {
            const Moves shorter =
                rounds > 0 ? shortened(task_, moves, rounds, request_.seed) : moves;
            const double cost = cost_m(task_.steering, shorter);
            if (cost >= best_m_) continue;
            auto segments = checked(shorter);
            if (segments.empty()) continue;
            best_ = std::move(segments);
            best_m_ = cost;
            found_ = found;
            return;
        }
    }

    /// The moves as segments, or none when the second check finds something against them.
    std::vector<kinematics::Segment> checked(const Moves& moves) const {
        Pose2 at = request_.start;
        for (const Move& move : moves) at = moved(at, move);
        if (!same(at, request_.goal)) return {};
        auto segments = segments_of(request_.start, moves, request_.goal);
        if (room_.conflict_along(segments)) return {};
        return segments;
    }

    FreeManoeuvre answer() {
        kinematics::set_durations(*request_.type, best_);
        return {kinematics::summed(plant::MotionMode::kFree, std::move(best_)), found_,
                room_.work()};
    }

    Result<FreeManoeuvre> none(bool enclosed) const {
        return fail(Errc::kUnreachable, "no_free_way",
                    enclosed ? "Walls, obstacles or standing vehicles shut the way to the goal. "
                               "Clear the way or choose another station."
                             : "No free manoeuvre was found in the time allowed. Clear the floor "
                               "about the vehicle or the station, allow more time, or drive in "
                               "two legs over another station.",
                    {}, {{"enclosed", enclosed}, {"time_limit_s", request_.time_limit_s}});
    }

    const FreeManoeuvreRequest& request_;
    ManoeuvreRoom& room_;
    ManoeuvreTask task_;
    std::vector<kinematics::Segment> best_;
    double best_m_ = std::numeric_limits<double>::infinity();
    double least_m_ = 0;
    Found found_ = Found::kDirectly;
};

}  // namespace

FreeFloor::FreeFloor(const plant::Plant& plant, const plant::Hall& of)
    : hall(of.id), obstacles(plant, of), field(plant, of, reach_of(plant)) {
    for (const plant::VehicleType& type : plant.vehicle_types) {
        for (const bool loaded : {false, true}) {
            if (loaded && type.load_footprint.empty()) continue;
            bodies.push_back(prepared(body_of(type, loaded), field));
        }
    }
}

Result<FreeManoeuvre> plan_free_manoeuvre(const FreeFloor& floor,
                                          const FreeManoeuvreRequest& request) {
    assert(request.type);
    const plant::VehicleType& type = *request.type;
    if (kinematics::is_there(request.start, request.goal)) {
        return fail(Errc::kUnreachable, "already_there",
                    "The vehicle already stands at this pose. Choose another station.");
    }
    const double most_m = floor.field.reach_m() - kLeastBeyond_m;
    if (type.clearance_m > most_m) {
        return fail(Errc::kUnreachable, "clearance_too_large",
                    "The vehicle keeps a larger clearance than any type of the plant. State the "
                    "type in the plant, or lower its clearance.",
                    {}, {{"clearance_m", type.clearance_m}, {"limit_m", most_m}});
    }
    // A type that is not the plant's, such as one that a vehicle's own factsheet states, is
    // prepared for this request alone.
    std::optional<FreeFloor::Prepared> fresh;
    const Body body = body_of(type, request.loaded);
    const auto known = std::find_if(floor.bodies.begin(), floor.bodies.end(),
                                    [&](const auto& other) { return other.body == body; });
    if (known == floor.bodies.end()) fresh = prepared(body, floor.field);
    const FreeFloor::Prepared& own = fresh ? *fresh : *known;
    ManoeuvreRoom room({floor.obstacles, floor.field, own.body, own.check}, request.standing,
                       request.start, request.goal);
    if (const auto by = room.conflict_at(request.start)) {
        return blocked("start_blocked",
                       "where it is now. Move it away by hand, or what stands there.", *by);
    }
    if (const auto by = room.conflict_at(request.goal)) {
        return blocked("goal_blocked", "at the goal. Move that away or choose another station.",
                       *by);
    }
    return Planning(request, Steering(type), room).run();
}

}  // namespace pulseline::planning
