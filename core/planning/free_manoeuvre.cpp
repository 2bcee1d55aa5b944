#include "core/planning/free_manoeuvre.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "core/kinematics/primitives.hpp"
#include "core/planning/manoeuvre_lattice.hpp"
#include "core/planning/manoeuvre_sampling.hpp"

namespace pulseline::planning {
namespace {

using geometry::Pose2;
using Found = FreeManoeuvre::Found;

// How far the field tells distances beyond the largest clearance: the more, the more of a long way
// through open floor one test can pass.
constexpr double kFieldBeyond_m = 2.5;
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

bool same(const Pose2& a, const Pose2& b) {
    return geometry::distance(a.position(), b.position()) < kArrives &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) < kArrives;
}

/// One request on its way through the stages.
class Planning {
public:
    Planning(const FreeManoeuvreRequest& request, const Steering& steering,
             const ManoeuvreRoom& room)
        : request_(request), task_{steering, room, request.start, request.goal} {}

    Result<FreeManoeuvre> run() {
        const long limit = static_cast<long>(request_.time_limit_s * kTestsPerSecond);
        direct();
        if (best_m_ <= kGoodEnough * least_m_) return answer();
        const LatticeAnswer lattice = lattice_search(task_, limit / 2);
        if (lattice.cut_off && best_.empty()) return none(true);
        consider(lattice.moves, Found::kByLattice);
        for (std::uint64_t k = 0; best_.empty() && task_.room.work() < limit; ++k) {
            const auto planner =
                k % 2 == 0 ? SamplingPlanner::kRrtConnect : SamplingPlanner::kBiEst;
            const long share = std::min(limit / 4, limit - task_.room.work());
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
            if (!task_.room.is_free(request_.start, way)) continue;
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
        if (task_.room.conflict_along(segments)) return {};
        return segments;
    }

    FreeManoeuvre answer() {
        kinematics::set_durations(*request_.type, best_);
        return {kinematics::summed(plant::MotionMode::kFree, std::move(best_)), found_,
                task_.room.work()};
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
    ManoeuvreTask task_;
    std::vector<kinematics::Segment> best_;
    double best_m_ = std::numeric_limits<double>::infinity();
    double least_m_ = 0;
    Found found_ = Found::kDirectly;
};

}  // namespace

FreeFloor::FreeFloor(const plant::Plant& plant, const plant::Hall& of)
    : hall(of.id), obstacles(plant, of), field(plant, of, reach_of(plant)) {}

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
    const ManoeuvreRoom room({floor.obstacles, floor.field},
                             plant::outline_with_load(type, request.loaded), type.clearance_m,
                             request.standing, request.start, request.goal);
    if (const auto by = room.conflict_at(request.start)) {
        return blocked("start_blocked",
                       "where it is now. Move it away by hand, or what stands "
                       "there.",
                       *by);
    }
    if (const auto by = room.conflict_at(request.goal)) {
        return blocked("goal_blocked", "at the goal. Move that away or choose another station.",
                       *by);
    }
    return Planning(request, Steering(type), room).run();
}

}  // namespace pulseline::planning
