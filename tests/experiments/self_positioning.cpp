#include <fmt/core.h>

#include <Eigen/Dense>
#include <cmath>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/plant/plant_file.hpp"
#include "core/base/square.hpp"
#include "core/localisation/reflector_pose.hpp"
#include "core/onboard/pose/contour_watch.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/navigation_scanner.hpp"
#include "core/simulation/world/scanners.hpp"
#include "server/agent/camera_sensing.hpp"
#include "server/agent/map_hall.hpp"
#include "tests/experiments/experiments.hpp"
#include "tests/experiments/stop_runs.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Pose2;

constexpr std::size_t kMarkers = 4;
constexpr int kTimes = 20;
// How an AGV comes to stand over a marker before it knows better.
constexpr double kPlaced_m = 0.02;
constexpr double kPlaced_rad = 0.01;
// What one sigma of three coordinates covers jointly: chi-square of three degrees of freedom, 95 %.
constexpr double kNinetyFive = 7.815;

struct Off {
    double dx_m = 0;
    double dy_m = 0;
};

/// Li 2022's own row of Table 1, the last one: of +-3 sigma the two axes and their hypotenuse, mm.
struct Printed {
    double x_mm = 0;
    double y_mm = 0;
    double r_mm = 0;
};
// What is asked of calibrated ones, of r.
// Li's 1.139 and, in the root of squares, what we have and he does not mention: our one camera
// hangs 0.9 m before the middle, and there the 0.5 mrad by which the survey knows a code's
// direction are 3 x 0.45 mm.
constexpr double kMarker_mm = 1.8;
// Not Li's 4.367: that is one vehicle's, and how many turns and reflectors it is the mean of he
// does not tell. The fixes state 7.1 themselves: 6.2 by one turn that sees 7 or 8 reflectors, each
// ray's range known by 8 mm, and 3.6 by the scanner's mounting and the reflectors' survey, which
// differ from machine to machine. A tenth more.
constexpr double kReflectors_mm = 8;
// Li's own.
constexpr double kContours_mm = 52.572;
// Of looks around at one place, which see the same: as often as a vehicle that has come to stand.
constexpr int kLooks = 12;
// A turn in which something that shines puts two reflectors out of place is passed over.
constexpr double kMissed = 0.005;
constexpr Printed kMarkerBased{0.846, 0.762, 1.139};
constexpr Printed kAmcl{38.769, 35.508, 52.572};
constexpr Printed kNav350{2.967, 3.204, 4.367};

class Method {
public:
    Method(const char* name, Printed printed, double asked_mm)
        : name_(name), printed_(printed), asked_mm_(asked_mm) {}

    void take(const Pose2& pose, const Eigen::Matrix3d& covariance, const Pose2& truth) {
        const Eigen::Vector3d off(pose.x_m - truth.x_m, pose.y_m - truth.y_m,
                                  wrap(pose.heading_rad - truth.heading_rad));
        covered_ += off.dot(covariance.ldlt().solve(off)) <= kNinetyFive;
        offs_.push_back({off.x(), off.y()});
    }
    void miss() { ++missed_; }

    /// False when a measurement failed, does not hold what it states or, if `calibrated`, is
    /// worse than is asked.
    bool print(const std::string& errors, bool calibrated) const {
        double x2 = 0;
        double y2 = 0;
        for (const Off& off : offs_) {
            x2 += square(off.dx_m);
            y2 += square(off.dy_m);
        }
        const auto count = static_cast<double>(offs_.size());
        const double x_mm = 3e3 * std::sqrt(x2 / count);
        const double y_mm = 3e3 * std::sqrt(y2 / count);
        const double r_mm = std::hypot(x_mm, y_mm);
        const double share = covered_ / count;
        // Of a machine's constant errors so few machines show no even share.
        const bool good =
            missed_ <= kMissed * count && share >= 0.85 && (!calibrated || r_mm <= asked_mm_);
        fmt::print("{:<22}{:>9.3f}{:>9.3f}{:>9.3f}{:>12.3f}{:>9.3f}{:>9.3f}{:>12.1f}%{:>9}{}\n",
                   name_ + (", " + errors), x_mm, y_mm, r_mm, printed_.x_mm, printed_.y_mm,
                   printed_.r_mm, 100 * share, missed_, good ? "" : "  NO");
        return good;
    }

private:
    const char* name_;
    Printed printed_;
    double asked_mm_;
    std::vector<Off> offs_;
    double covered_ = 0;
    int missed_ = 0;
};

/// By one turn of the scanner, from near where it should stand: more of them are not better, since
/// the same rays fall on the reflectors.
std::optional<localisation::PoseFix> by_reflectors(const simulation::World& world,
                                                   const plant::Station& station,
                                                   const simulation::ServoDrive& drive,
                                                   std::uint64_t seed) {
    const plant::VehicleType& type = drive.type();
    const plant::NavigationScanner& known = *type.navigation_scanner;
    simulation::SimulatedNavigationScanner scanner(world, station.hall, type, drive.true_pose(),
                                                   seed);
    auto turn = scanner.take_turn(1 / known.rate_hz);
    while (!turn) turn = scanner.take_turn(1 / known.rate_hz);
    std::vector<localisation::SeenReflector> seen;
    for (const auto& sight : localisation::reflector_sights(*turn, known, world.errors.reflector)) {
        seen.push_back(localisation::seen_reflector(sight, known));
    }
    const Eigen::Vector3d variance(square(kPlaced_m), square(kPlaced_m), square(kPlaced_rad));
    const auto fix = localisation::locate_by_reflectors(seen, world.plant.reflectors, known,
                                                        {station.pose, variance.asDiagonal()},
                                                        world.errors.reflector);
    if (!fix) return std::nullopt;
    return fix->fix;
}

/// By the walls and things around, in a map of the hall: Li's AMCL.
std::optional<localisation::PoseFix> by_contours(
    const simulation::World& world, const plant::Station& station, simulation::ServoDrive& drive,
    const std::shared_ptr<const mapping::MatchedMap>& map, std::uint64_t seed) {
    simulation::SimulatedScanners scanners(world, station.hall, drive.type(), drive.true_pose(),
                                           seed);
    onboard::PoseEstimate estimate{Pose2{},
                                   localisation::odometry_noise(world.errors.drive, drive.type())};
    drive.set_believed(station.pose);
    estimate.start_at(station.pose);
    const onboard::OdometryTrail trail(drive);
    onboard::ContourWatch contours(scanners, drive, estimate, trail, map, seed);
    for (int i = 0; i < kLooks; ++i) contours.step(onboard::ContourWatch::kStanding_s, true);
    if (!contours.newest()) return std::nullopt;
    localisation::PoseFix fix = contours.newest()->fix;
    fix.pose = estimate.pose();
    set_covariance(fix, estimate.covariance());
    return fix;
}

void take(Method& method, const std::optional<localisation::PoseFix>& fix, const Pose2& truth) {
    if (!fix) return method.miss();
    method.take(fix->pose, localisation::matrix(fix->covariance), truth);
}

struct Methods {
    Method codes{"marker", kMarkerBased, kMarker_mm};
    Method reflectors{"reflectors", kNav350, kReflectors_mm};
    Method contours{"contours (AMCL)", kAmcl, kContours_mm};
};

void measure(const plant::Plant& plant, const plant::Vehicle& vehicle,
             const plant::Station& station, std::uint64_t seed,
             const localisation::ErrorBudget& errors,
             const std::shared_ptr<const mapping::MatchedMap>& map, Methods& methods) {
    const auto world = simulation::make_world(plant, seed, errors);
    const auto& type = *plant::find_vehicle_type(plant, vehicle.type);
    std::mt19937_64 random(simulation::seed_for(seed, "placed at " + station.id.str()));
    std::normal_distribution<double> normal;
    Pose2 truth = station.pose;
    truth.x_m += kPlaced_m / 2 * normal(random);
    truth.y_m += kPlaced_m / 2 * normal(random);
    truth.heading_rad += kPlaced_rad / 2 * normal(random);
    simulation::ServoDrive drive(type, truth, seed, 1, 0, errors);

    agent::CameraSensing cameras(world, station.hall, drive, true, seed);
    const bool measured = cameras.measure(target_at(plant, station, 0.001)).has_value();
    take(methods.codes, measured ? cameras.take_fix() : std::nullopt, truth);
    take(methods.reflectors, by_reflectors(world, station, drive, seed), truth);
    take(methods.contours, by_contours(world, station, drive, map, seed), truth);
}

/// As the vehicle has mapped the hall before, by its codes.
std::shared_ptr<const mapping::MatchedMap> map_of(const plant::Plant& plant,
                                                  const plant::Vehicle& vehicle,
                                                  const localisation::ErrorBudget& errors) {
    constexpr std::uint64_t kMappedBy = 99;
    const plant::Station& home = *plant::find_station(plant, vehicle.home);
    const auto way = agent::way_over_lanes(plant, home.hall, home.pose);
    if (!way) throw std::runtime_error(way.error().what);
    auto map = agent::map_hall(simulation::make_world(plant, kMappedBy, errors), vehicle, home.hall,
                               *way, kMappedBy, [](double) {});
    if (!map) throw std::runtime_error(map.error().what);
    return mapping::prepare(std::move(*map));
}

}  // namespace

bool self_positioning(const Options& options) {
    const auto plant =
        api::plant_file::load_plant_file(options.folder + "/../../db/plants/measuring-hall.json");
    if (!plant) throw std::runtime_error(plant.error().what);
    const int times = options.runs.value_or(kTimes);
    fmt::print(
        "\nLi 2022, Table 1: {} machines at each of {} markers, +-3 sigma of where they believe to "
        "stand, mm; right of it Li's own\n",
        times, kMarkers);
    fmt::print("{:<22}{:>9}{:>9}{:>9}{:>12}{:>9}{:>9}{:>13}{:>9}\n", "", "x", "y", "r", "Li: x",
               "y", "r", "covered", "missed");
    bool good = true;
    // Li's cameras were calibrated with a laser tracker where they hang.
    for (const char* name : {"kind", "nominal"}) {
        const auto errors = localisation::ErrorBudget::named(name);
        const auto map = map_of(*plant, plant->vehicles.front(), errors);
        Methods methods;
        for (std::size_t station = 0; station < kMarkers; ++station) {
            for (int i = 0; i < times; ++i) {
                measure(*plant, plant->vehicles.front(), plant->stations[station],
                        options.seed + static_cast<std::uint64_t>(i), errors, map, methods);
            }
        }
        const bool calibrated = std::string(name) == "kind";
        for (const Method* method : {&methods.codes, &methods.reflectors, &methods.contours}) {
            good &= method->print(name, calibrated);
        }
    }
    return good;
}

}  // namespace pulseline::experiments
