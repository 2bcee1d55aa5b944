#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"

/// Many stops of one simulated vehicle, closed loop: it drives from station to station by its
/// wheels (ServoDrive, whose error budget drive_budget.hpp writes down), measures by what it sees,
/// and adjusts. What counts is where it truly stands.
namespace pulseline::experiments {

/// What the true stops of a family are held to; infinite: nothing.
struct StopDemand {
    static constexpr double kAny = std::numeric_limits<double>::infinity();
    const char* words = "";
    double most_axis_mm = kAny;  // of each stop, along either axis of the station
    double most_deg = kAny;
    double mean_mm = kAny;
    double mean_deg = kAny;
};

struct StopFamily {
    std::string name;
    std::string vehicle;         // of the plant final-assembly
    std::vector<int> stations;   // driven to in turn
    bool igps = false;           // four receivers instead of the cameras
    double tolerance_m = 0.025;  // either way, along both axes
    StopDemand demand = {};
};
/// Tang 2020, Wang and Li 2020.
std::vector<StopFamily> stop_families();

struct Stop {
    int station = 0;
    geometry::Pose2 arrived;  // true pose seen from the station's, before any adjusting
    geometry::Pose2 off;      // and after
    int looks = 0;
    double time_s = 0;    // of adjusting and measuring, in the vehicle's own time
    std::string why_not;  // not empty: it was refused
};

/// `plant_file`: final-assembly.json. Images are rendered and read; light, dirt, print and survey
/// errors come from the seed.
std::vector<Stop> run_stops(const StopFamily& family, const std::string& plant_file, int count,
                            std::uint64_t seed, double time_factor);

}  // namespace pulseline::experiments
