#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/geometry/pose2.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

/// Many stops of simulated vehicles, closed loop: each drives from station to station by its
/// wheels, measures by what it sees, and adjusts. Each is a machine of its own, drawn from the
/// error budget (core/localisation/error_budget.hpp). What counts is where it truly stands.
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
    std::string vehicle;
    std::vector<int> stations;   // driven to in turn
    bool igps = false;           // steers and measures by its receivers
    double tolerance_m = 0.025;  // either way, along both axes
    StopDemand demand = {};
    std::string plant = "final-assembly";  // of db/plants
    std::vector<std::string> dark = {};    // transmitters without power
};
/// Tang 2020, Wang and Li 2020.
std::vector<StopFamily> stop_families();

struct Stop {
    int station = 0;
    geometry::Pose2 arrived;   // true pose seen from the station's, before any adjusting
    geometry::Pose2 off;       // and after
    geometry::Pose2 measured;  // last, seen from the station's pose
    double sigma_xy_m = 0;     // stated with it
    double sigma_heading_rad = 0;
    int looks = 0;
    double time_s = 0;    // of adjusting and measuring, in the vehicle's own time
    std::string why_not;  // not empty: it was refused
};

struct StopRuns {
    int vehicles = 20;  // seeds one after the other
    int stops = 10;     // of each
    std::uint64_t seed = 1;
    double time_factor = 10;
    localisation::ErrorBudget errors;
    double spoil_m = 0;  // a measurement that is off by so much without knowing it
};

/// What an order brings to a stop at the station, whose tolerance is `tolerance_m` either way.
vda5050::StopTarget target_at(const plant::Plant& plant, const plant::Station& station,
                              double tolerance_m);

/// `plants`: the folder of the family's plant. Images are rendered and read; all errors come from
/// the seeds. A machine that refuses a stop makes no more.
std::vector<Stop> run_stops(const StopFamily& family, const std::string& plants,
                            const StopRuns& runs);

}  // namespace pulseline::experiments
