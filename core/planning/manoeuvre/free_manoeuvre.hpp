#pragma once

#include <cstdint>
#include <vector>

#include "core/base/result.hpp"
#include "core/kinematics/motion.hpp"
#include "core/planning/roads/roadmap_index.hpp"
#include "core/planning/room/footprint_check.hpp"
#include "core/planning/room/obstacles.hpp"
#include "core/planning/room/standing_body.hpp"

/// Free manoeuvres (motion mode `free`): from pose to pose where no single motion primitive fits.
namespace pulseline::planning {

/// What free manoeuvres need to know of a hall. Built once per hall: some 20 ms and 3 MB for
/// 120 m x 60 m, and half a millisecond for each vehicle type, so best when the first manoeuvre
/// there is asked for.
/// Thread safety: any number of threads may plan on the same one.
struct FreeFloor {
    FreeFloor(const plant::Plant& plant, const plant::Hall& hall);
    plant::HallId hall;
    Obstacles obstacles;
    FloorField field;
    struct Prepared {
        Body body;
        FootprintCheck check;
    };
    std::vector<Prepared> bodies;  // of the plant's types, with and without load
};

struct FreeManoeuvreRequest {
    const plant::VehicleType* type = nullptr;
    bool loaded = false;
    geometry::Pose2 start;  // measured pose
    geometry::Pose2 goal;
    std::vector<StandingBody> standing;  // vehicles that stay where they are
    /// Counted in tests of the body, kTestsPerSecond a second, and not by a clock: what is found
    /// does not depend on the machine. A slower one takes accordingly longer.
    double time_limit_s = 1.0;
    std::uint64_t seed = 1;
};
constexpr double kTestsPerSecond = 1e6;  // of the reference machine (2.6 GHz), about

struct FreeManoeuvre {
    enum class Found : std::uint8_t { kDirectly, kByLattice, kBySampling };
    kinematics::MotionPlan motion;  // mode kFree, durations set; ends at the goal itself
    Found found = Found::kDirectly;
    long tests = 0;  // of the body, spent on it
};

/// Plans one manoeuvre: arcs of at least the type's turning radius and straights, for types that
/// may also turns on the spot and straights in any direction (see Steering). First the ways of
/// Reeds and Shepp between the two poses, then a lattice search, then OMPL's RRTConnect and BiEST;
/// what is found is shortened, and checked once more by what the search does not use: the swept
/// area (kinematics::sweep) against `Obstacles::violation` and the exact distances to the standing
/// bodies. Not optimal; complete only in the probabilistic sense and within the limit.
/// The same request gives the same answer, bit by bit on one machine, whatever was planned before
/// or is planned at the same time.
/// Errors (Errc::kUnreachable): already_there, start_blocked and goal_blocked {by, at_x_m, at_y_m,
/// clearance_m, limit_m}, no_free_way {enclosed, time_limit_s} (`enclosed`: proven that there is
/// none), clearance_too_large {clearance_m, limit_m}.
/// Thread safety: any number at once.
Result<FreeManoeuvre> plan_free_manoeuvre(const FreeFloor& floor,
                                          const FreeManoeuvreRequest& request);

}  // namespace pulseline::planning
