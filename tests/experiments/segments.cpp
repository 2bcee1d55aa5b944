#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "api/plant/plant_file.hpp"
#include "core/kinematics/motion.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/onboard/pose/marker_watch.hpp"
#include "core/onboard/pose/rest_watch.hpp"
#include "core/planning/legs/blind_way.hpp"
#include "core/planning/legs/leg_chain.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "server/agent/camera_sensing.hpp"
#include "server/agent/map_hall.hpp"
#include "tests/experiments/experiments.hpp"
#include "tests/experiments/straight_way.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Pose2;
using kinematics::Segment;

// In a way that is just sure without turns. Much as Li's lay: where every fourth one is looked for
// it still certainly sees the next if it turns once between them, and nowhere by every sixth.
constexpr double kMarkersBlind = 6.2;
// So that the last one before the station, the boundary marker, is one of every one, two and three
// markers, and not of every four.
constexpr int kMarkers = 18;
constexpr int kDrives = 20;
// Reading codes costs a drive no more of its time than that; Li's stop at each.
constexpr double kSlower = 1.05;
constexpr double kStep_s = 0.05;
constexpr double kStart_m = 3e-4;
constexpr double kStart_rad = 3e-4;

struct Route {
    const char* name;
    std::vector<int> straights;  // markers on each; between them it turns left and right in turn
};

/// To a station as far ahead as to the left.
const std::array<Route, 3> kRoutes{{{"A", {9, 9}}, {"B", {3, 3, 3, 3, 3, 3}}, {"C", {1, 9, 8}}}};

struct Case {
    const char* name;
    int every;  // of the markers; 0: none; -1: those of the chain
    std::array<double, 3> li_mean_mm;
    std::array<double, 3> li_sigma_mm;
    std::array<double, 3> li_s;
};

const std::array<Case, 6> kCases{{
    {"I none", 0, {16.8, 20.3, 18.5}, {11.2, 13.1, 12.4}, {133, 158, 139}},
    {"II every one", 1, {1.5, 2.2, 1.8}, {1.1, 1.5, 1.3}, {173, 188, 179}},
    {"III every two", 2, {1.0, 2.3, 1.7}, {1.6, 2.1, 1.2}, {161, 182, 166}},
    {"IV every three", 3, {1.0, 2.7, 2.5}, {1.6, 1.7, 1.5}, {150, 176, 155}},
    {"V every four", 4, {4.1, 4.7, 3.8}, {2.5, 3.6, 3.0}, {140, 165, 143}},
    {"VI chain", -1, {3.1, 4.4, 3.2}, {2.7, 3.8, 3.4}, {143, 168, 147}},
}};

std::vector<Segment> way_of(const Route& route, const plant::VehicleType& type, double spacing_m) {
    std::vector<Segment> way;
    Pose2 at;
    double turn_rad = kPi / 2;
    for (const int markers : route.straights) {
        if (!way.empty()) {
            Segment turn;
            turn.kind = Segment::Kind::kRotate;
            turn.start = at;
            turn.turn_rad = turn_rad;
            at.heading_rad = wrap(at.heading_rad + turn_rad);
            turn.end = at;
            way.push_back(kinematics::part(type, turn, 0, 1));
            turn_rad = -turn_rad;
        }
        Segment straight;
        straight.start = at;
        straight.length_m = markers * spacing_m;
        at = at * Pose2{straight.length_m, 0, 0};
        straight.end = at;
        way.push_back(kinematics::part(type, straight, 0, 1));
    }
    return way;
}

/// An empty hall with one code on every piece of the way, where the camera has come past the turn.
plant::Plant hall_with(plant::Plant plant, const plant::VehicleType& type,
                       const std::vector<Segment>& way, double spacing_m) {
    plant.markers.clear();
    plant.transmitters.clear();
    plant.reflectors.clear();
    plant.areas.clear();
    plant.halls.front().outline = {{-20, -20}, {120, -20}, {120, 120}, {-20, 120}};
    for (const Segment& segment : way) {
        const int markers = static_cast<int>(std::lround(segment.length_m / spacing_m));
        for (int i = 0; i < markers; ++i) {
            lay_code(plant, type, segment.start * Pose2{(i + 0.5) * spacing_m, 0, 0});
        }
    }
    return plant;
}

struct Arrival {
    double off_mm = 0;  // from the station to where it stands
    double time_s = 0;
};

/// Along `way`, looking for the codes with these payloads.
Arrival drive_along(const simulation::World& world, const plant::VehicleType& type,
                    const std::vector<Segment>& way, const std::set<std::string>& looked_for,
                    std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const Pose2 truth{kStart_m * normal(random), kStart_m * normal(random),
                      kStart_rad * normal(random)};
    simulation::ServoDrive drive(type, truth, seed, 1, 0, world.errors);
    drive.set_believed({});
    const auto& hall = world.plant.halls.front().id;
    agent::CameraSensing cameras(world, hall, drive, false, seed, false);
    onboard::PoseEstimate estimate{Pose2{}, localisation::odometry_noise(world.errors.drive, type)};
    localisation::PoseFix start;
    start.covariance = {{{kStart_m * kStart_m, 0, 0},
                         {0, kStart_m * kStart_m, 0},
                         {0, 0, kStart_rad * kStart_rad}}};
    estimate.take(start);
    onboard::RestWatch rest_watch(drive, estimate);
    onboard::MarkerWatch watch(cameras, drive, estimate);
    auto ahead = agent::edges_over(world.plant, hall, plant::cameras_of(type, false), way);
    for (auto& edge : ahead) {
        std::erase_if(edge.actions.back().markers,
                      [&](const auto& marker) { return !looked_for.contains(marker.payload); });
        drive.append(edge.segment);
    }
    Arrival arrival;
    for (std::size_t done = 0; !drive.idle() || !drive.standing();) {
        const double dt_s = watch.expects_soon() ? onboard::MarkerWatch::kFineStep_s : kStep_s;
        drive.step(dt_s);
        rest_watch.step();
        estimate.drive_to(drive.believed_pose());
        for (; done < drive.segments_done(); ++done) ahead.pop_front();
        watch.step(dt_s, ahead);
        arrival.time_s += dt_s;
        if (drive.stop_cause() || arrival.time_s > 3600) {
            throw std::runtime_error(
                fmt::format("seed {}: its drive did not end ({})", seed,
                            drive.stop_cause() ? drive.stop_cause()->code : "too slow"));
        }
    }
    arrival.off_mm = 1e3 * distance(drive.true_pose().position(), way.back().end.position());
    return arrival;
}

/// One route in a hall of its own.
class Course {
public:
    Course(const plant::Plant& plant, const plant::VehicleType& type, const Route& route,
           double spacing_m)
        : type_(type),
          way_(way_of(route, type, spacing_m)),
          plant_(hall_with(plant, type, way_, spacing_m)) {}

    Result<planning::LegChain> chain(int every) const {
        plant::Plant fewer = plant_;
        const auto payloads = at_every(every);
        std::erase_if(fewer.markers, [&](const plant::Marker& marker) {
            return !payloads.contains(marker.payload);
        });
        const planning::CodeReach reach(type_, false);
        return *planning::leg_chain(fewer, plant_.halls.front().id, reach, nullptr, way_);
    }

    /// Payloads of the codes that a case looks for.
    std::set<std::string> looked_for(const Case& of) const {
        if (of.every >= 0) return at_every(of.every);
        std::set<std::string> payloads;
        const auto found = chain(1);
        if (!found) throw std::runtime_error(found.error().what);
        for (const auto& marker : found->markers) payloads.insert(marker.payload);
        return payloads;
    }

    std::vector<Arrival> drive(const std::set<std::string>& looked_for, std::uint64_t seed,
                               int drives, const localisation::ErrorBudget& errors) const {
        std::vector<Arrival> arrivals;
        for (int i = 0; i < drives; ++i) {
            const auto own = seed + static_cast<std::uint64_t>(i);
            const auto world = simulation::make_world(plant_, own, errors);
            arrivals.push_back(drive_along(world, type_, way_, looked_for, own));
        }
        return arrivals;
    }

private:
    std::set<std::string> at_every(int every) const {
        std::set<std::string> payloads;
        for (int i = every; every > 0 && i <= kMarkers; i += every)
            payloads.insert(plant_.markers[static_cast<std::size_t>(i - 1)].payload);
        return payloads;
    }

    const plant::VehicleType& type_;
    std::vector<Segment> way_;
    plant::Plant plant_;
};

struct Row {
    double mean_mm = 0;
    double sigma_mm = 0;
    double time_s = 0;
};

Row row_of(const std::vector<Arrival>& arrivals) {
    Row row;
    const auto count = static_cast<double>(arrivals.size());
    for (const Arrival& arrival : arrivals) {
        row.mean_mm += arrival.off_mm / count;
        row.time_s += arrival.time_s / count;
    }
    for (const Arrival& arrival : arrivals)
        row.sigma_mm += std::pow(arrival.off_mm - row.mean_mm, 2) / count;
    row.sigma_mm = std::sqrt(row.sigma_mm);
    return row;
}

}  // namespace

bool segments(const Options& options) {
    const int drives = options.runs.value_or(kDrives);
    const auto errors = localisation::ErrorBudget::named(options.errors);
    auto plant =
        api::plant_file::load_plant_file(options.folder + "/../../db/plants/measuring-hall.json");
    if (!plant) throw std::runtime_error(plant.error().what);
    auto& type = plant->vehicle_types.front();
    type.navigation_scanner.reset();  // by codes alone
    const double blind_m = planning::CodeReach(type, false).at_most_m(type.usual_code.size_m);
    const double spacing_m = options.stretch * blind_m / kMarkersBlind;
    fmt::print(
        "\nLi 2022, Table 2: {} measuring vehicles drive {:.0f} m past {} markers, one every "
        "{:.1f} "
        "m, {} errors. How far from the station they stand before anything is measured there, mean "
        "and sigma in mm, and the time of the drive in s; beside it what Li prints\n",
        drives, kMarkers * spacing_m, kMarkers, spacing_m, options.errors);
    fmt::print("{:<16}", "");
    for (const Route& route : kRoutes)
        fmt::print("{:<8}{:>7}{:>6}{:>7}{:>15} |", std::string("route ") + route.name, "mean",
                   "sigma", "time", "Li");
    fmt::print("\n");
    bool good = true;
    std::vector<Course> courses;
    for (const Route& route : kRoutes) courses.emplace_back(*plant, type, route, spacing_m);
    std::vector<std::array<Row, 3>> rows;
    for (const Case& of : kCases) {
        std::array<Row, 3> row;
        fmt::print("{:<16}", of.name);
        for (std::size_t r = 0; r < kRoutes.size(); ++r) {
            const auto looked_for = courses[r].looked_for(of);
            row[r] = row_of(courses[r].drive(looked_for, options.seed, drives, errors));
            fmt::print("{:>2} codes{:>7.2f}{:>6.2f}{:>7.1f}{:>6.1f}{:>5.1f}{:>4.0f} |",
                       looked_for.size(), row[r].mean_mm, row[r].sigma_mm, row[r].time_s,
                       of.li_mean_mm[r], of.li_sigma_mm[r], of.li_s[r]);
            std::fflush(stdout);
        }
        fmt::print("\n");
        rows.push_back(row);
    }
    for (std::size_t r = 0; r < kRoutes.size(); ++r) {
        const Row& none = rows.front()[r];
        const Row& chain = rows.back()[r];
        const bool kept = chain.mean_mm <= kCases.back().li_mean_mm[r] &&
                          chain.sigma_mm <= kCases.back().li_sigma_mm[r] &&
                          none.mean_mm > 2 * chain.mean_mm;
        if (!kept) fmt::print("route {}: NO, the chain is not as good as Li's\n", kRoutes[r].name);
        good &= kept;
        for (std::size_t c = 1; c < kCases.size(); ++c) {
            const Row& row = rows[c][r];
            const double most_mm = kCases[c].li_mean_mm[r] + 2 * kCases[c].li_sigma_mm[r];
            const double most_s = std::min(kCases[c].li_s[r], kSlower * none.time_s);
            if (row.mean_mm <= most_mm && row.time_s <= most_s) continue;
            fmt::print("route {}, case {}: NO, more than {:.1f} mm or {:.1f} s\n", kRoutes[r].name,
                       kCases[c].name, most_mm, most_s);
            good = false;
        }
        int every = 1;
        while (every <= kMarkers && courses[r].chain(every)) ++every;
        fmt::print("route {}: no chain by every {} markers (Li: 5) or fewer: {}\n", kRoutes[r].name,
                   every, every <= kMarkers ? courses[r].chain(every).error().what : "");
        good &= every >= 4 && every <= 6;
    }
    return good;
}

}  // namespace pulseline::experiments
