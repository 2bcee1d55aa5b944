#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "api/plant/plant_file.hpp"
#include "core/kinematics/motion.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/onboard/pose/contour_watch.hpp"
#include "core/onboard/pose/light_watch.hpp"
#include "core/onboard/pose/marker_watch.hpp"
#include "core/onboard/pose/reflector_watch.hpp"
#include "core/onboard/pose/rest_watch.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/navigation_scanner.hpp"
#include "core/simulation/world/receivers.hpp"
#include "core/simulation/world/scanners.hpp"
#include "server/agent/camera_sensing.hpp"
#include "server/agent/hall_truth.hpp"
#include "server/agent/map_hall.hpp"
#include "tests/experiments/error_curves.hpp"
#include "tests/experiments/experiments.hpp"
#include "tests/experiments/marker_spacing.hpp"
#include "tests/experiments/straight_way.hpp"

namespace pulseline::experiments {
namespace {

using geometry::Pose2;

constexpr double kLength_m = kWayLength_m;
constexpr double kCheckpoint_m = 10;
constexpr double kStep_s = 0.05;
constexpr int kDrives = 40;
// All that drive by one map share its errors, so that of one map alone 88 to 97 % of what is stated
// with 95 % hold. A map takes as long as ten drives.
constexpr int kDrivesOfAMap = 7;
constexpr int kMostMaps = 8;
constexpr int kSpacedDrives = 3;  // by eq. 5, for each of the others: they are a metre long
constexpr double k95 = 1.96;      // sigmas of a normal distribution
// A drive begins at a measured stop.
constexpr double kStart_m = 3e-4;
constexpr double kStart_rad = 3e-4;
// Of where a drive with codes ends.
constexpr double kEnd_mm = 10;
constexpr double kEndByLight_mm = 1;
constexpr double kEndByContours_mm = 50;
// Of all that is stated with 95 %, what holds.
constexpr double kCovered = 0.95;
constexpr double kCoveredWithin = 0.03;

struct Checkpoint {
    double along_m = 0;
    double across_m = 0;
    double heading_rad = 0;
    double sigma_along_m = 0;
    double sigma_across_m = 0;
    double sigma_heading_rad = 0;
    double off_m() const { return std::hypot(along_m, across_m); }
};

struct Drive {
    std::vector<Checkpoint> checkpoints;  // every kCheckpoint_m of the true way
    int missed = 0;                       // codes that lay below its cameras' way
    int refused = 0;
    double beside_m = 0;  // of its line, at the end
};

Checkpoint checkpoint(const onboard::PoseEstimate& estimate, const Pose2& truth) {
    const Pose2 pose = estimate.pose();
    const auto covariance = estimate.covariance();
    return {pose.x_m - truth.x_m,
            pose.y_m - truth.y_m,
            wrap(pose.heading_rad - truth.heading_rad),
            std::sqrt(covariance(0, 0)),
            std::sqrt(covariance(1, 1)),
            std::sqrt(covariance(2, 2))};
}

/// `map`: of the contours; none: it does not look at them.
Drive drive_along(const simulation::World& world, const plant::Vehicle& vehicle, std::uint64_t seed,
                  const std::shared_ptr<const mapping::MatchedMap>& map) {
    const auto& type = *plant::find_vehicle_type(world.plant, vehicle.type);
    const bool loaded = plant::first_load(world.plant, vehicle.id) != nullptr;
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const Pose2 truth{kStart_m * normal(random), kStart_m * normal(random),
                      kStart_rad * normal(random)};
    simulation::ServoDrive drive(type, truth, seed, 1, agent::first_load_kg(world.plant, vehicle),
                                 world.errors);
    drive.set_believed({});
    agent::CameraSensing cameras(world, world.plant.halls.front().id, drive, false, seed, loaded);
    onboard::PoseEstimate estimate{Pose2{}, localisation::odometry_noise(world.errors.drive, type)};
    localisation::PoseFix start;
    start.covariance = {{{kStart_m * kStart_m, 0, 0},
                         {0, kStart_m * kStart_m, 0},
                         {0, 0, kStart_rad * kStart_rad}}};
    estimate.take(start);
    onboard::RestWatch rest_watch(drive, estimate);
    onboard::MarkerWatch watch(cameras, drive, estimate);
    simulation::SimulatedReceivers receivers(world, world.plant.halls.front().id, type,
                                             drive.true_pose(), seed);
    onboard::LightWatch light(receivers, drive, estimate, watch.trail(), world.errors.receiver);

    std::optional<simulation::SimulatedNavigationScanner> scanner;
    std::optional<onboard::ReflectorWatch> reflectors;
    if (type.navigation_scanner) {
        scanner.emplace(world, world.plant.halls.front().id, type, drive.true_pose(), seed);
        reflectors.emplace(*scanner, drive, estimate, watch.trail(), world.errors.reflector);
    }

    simulation::SimulatedScanners scanners(world, world.plant.halls.front().id, type,
                                           drive.true_pose(), seed);
    std::optional<onboard::ContourWatch> contours;
    if (map) contours.emplace(scanners, drive, estimate, watch.trail(), map, seed);

    auto ahead = agent::edges_over(world.plant, world.plant.halls.front().id,
                                   plant::cameras_of(type, loaded), pieces());
    std::set<std::string> below;
    for (const auto& edge : ahead) {
        drive.append(edge.segment);
        for (const auto& marker : edge.actions.back().markers) below.insert(marker.payload);
    }
    Drive made;
    std::size_t done = 0;
    std::string refused;
    double next_m = kCheckpoint_m;
    for (double left_s = 3 * kLength_m / type.max_speed_mps; !drive.idle();) {
        const bool fine = watch.expects_soon() || light.steers();
        const double dt_s = fine ? onboard::MarkerWatch::kFineStep_s : kStep_s;
        drive.step(dt_s);
        rest_watch.step();
        estimate.drive_to(drive.believed_pose());
        for (; done < drive.segments_done(); ++done) ahead.pop_front();
        watch.step(dt_s, ahead);
        light.step(dt_s, world.plant.transmitters, true);
        if (reflectors) reflectors->step(dt_s, world.plant.reflectors, true);
        if (contours) contours->step(dt_s, true);
        for (const auto& payload : watch.take_taken()) below.erase(payload);
        if (!watch.refused().empty() && watch.refused() != refused) {
            ++made.refused;
            below.erase(watch.refused());
        }
        refused = watch.refused();
        if (drive.true_pose().x_m >= next_m) {
            made.checkpoints.push_back(checkpoint(estimate, drive.true_pose()));
            next_m += kCheckpoint_m;
        }
        left_s -= dt_s;
        if (left_s < 0 || drive.stop_cause()) {
            throw std::runtime_error(fmt::format(
                "{} with seed {}: its drive did not end, at {:.1f} m, {:.3f} m beside ({})",
                vehicle.id.str(), seed, drive.true_pose().x_m, drive.true_pose().y_m,
                drive.stop_cause() ? drive.stop_cause()->code : "too slow"));
        }
    }
    made.missed = static_cast<int>(below.size());
    made.beside_m = std::abs(drive.true_pose().y_m);
    return made;
}

/// As the `number`th vehicle has mapped the way before, by its codes, which lie there no more.
std::shared_ptr<const mapping::MatchedMap> map_of(const plant::Plant& way,
                                                  const plant::Vehicle& vehicle,
                                                  const localisation::ErrorBudget& errors,
                                                  int number) {
    const auto seed = 99 + static_cast<std::uint64_t>(number);
    auto map = agent::map_hall(simulation::make_world(way, seed, errors), vehicle,
                               way.halls.front().id, pieces(), seed, [](double) {});
    if (!map) throw std::runtime_error(map.error().what);
    return mapping::prepare(std::move(*map));
}

std::vector<double> offs_at(const std::vector<Drive>& drives, std::size_t checkpoint) {
    std::vector<double> offs;
    for (const Drive& drive : drives) {
        if (checkpoint < drive.checkpoints.size())
            offs.push_back(drive.checkpoints[checkpoint].off_m());
    }
    return offs;
}

/// Share of all coordinates at all checkpoints that lie inside of what is stated with 95 %.
double covered(const std::vector<Drive>& drives) {
    int inside = 0;
    int all = 0;
    for (const Drive& drive : drives) {
        for (const Checkpoint& c : drive.checkpoints) {
            inside += std::abs(c.along_m) <= k95 * c.sigma_along_m;
            inside += std::abs(c.across_m) <= k95 * c.sigma_across_m;
            inside += std::abs(c.heading_rad) <= k95 * c.sigma_heading_rad;
            all += 3;
        }
    }
    return all == 0 ? 0 : static_cast<double>(inside) / all;
}

std::vector<Method> methods_of(const plant::VehicleType& type) {
    // Its wheels and camera are the omnidirectional mover's, which shows the others.
    if (type.navigation_scanner) return {Method::kReflectors};
    std::vector<Method> methods{Method::kOdometry, Method::kCodes};
    if (!type.receivers.empty()) methods.push_back(Method::kLight);
    if (type.kinematics == plant::Kinematics::kDifferential) methods.push_back(Method::kContours);
    return methods;
}

const char* name_of(Method method) {
    switch (method) {
        case Method::kOdometry:
            return "odometry";
        case Method::kCodes:
            return "codes";
        case Method::kLight:
            return "iGPS";
        case Method::kReflectors:
            return "reflectors";
        case Method::kContours:
            return "contours";
    }
    return "";
}

/// Of 95 % of the drives; odometry has no bound.
double most_at_end_mm(Method method) {
    if (method == Method::kOdometry) return 1e9;
    if (method == Method::kContours) return kEndByContours_mm;
    return method == Method::kLight ? kEndByLight_mm : kEnd_mm;
}

struct Family {
    const plant::Plant& plant;
    const plant::Vehicle& vehicle;
    const plant::VehicleType& type;
    double spacing_m = 0;  // of its codes, as computed
};

Family family_of(const plant::Plant& plant, const char* id) {
    const auto& vehicle = *plant::find_vehicle(plant, plant::VehicleId(id));
    const auto& type = *plant::find_vehicle_type(plant, vehicle.type);
    Family family{plant, vehicle, type};
    for (const auto& camera :
         plant::cameras_of(type, plant::first_load(plant, vehicle.id) != nullptr)) {
        family.spacing_m =
            std::max(family.spacing_m, localisation::blind_way_m(camera, type.usual_code.size_m));
    }
    return family;
}

std::vector<Drive> drives_of(const Family& family, Method method, double every_m, int drives,
                             const Options& options) {
    const auto errors = localisation::ErrorBudget::named(options.errors);
    const auto way = straight_way(family.plant, family.type, method, every_m);
    std::vector<std::shared_ptr<const mapping::MatchedMap>> maps;
    if (method == Method::kContours) {
        const auto mapped = straight_way(family.plant, family.type, method, family.spacing_m);
        for (int i = 0; i < std::min(kMostMaps, 1 + drives / kDrivesOfAMap); ++i) {
            maps.push_back(map_of(mapped, family.vehicle, errors, i));
        }
    }
    std::vector<Drive> made;
    for (int i = 0; i < drives; ++i) {
        const auto seed = options.seed + static_cast<std::uint64_t>(i);
        const auto map = maps.empty() ? nullptr : maps[static_cast<std::size_t>(i) % maps.size()];
        made.push_back(
            drive_along(simulation::make_world(way, seed, errors), family.vehicle, seed, map));
    }
    return made;
}

/// Drives, prints and judges one row. False when a code is missed, a drive ends too far off or what
/// is stated does not hold; of codes that lie too far apart on purpose, when none is missed.
bool print_row(const Family& family, Method method, int drives, const Options& options,
               std::vector<Curve>& curves) {
    const double every_m = method == Method::kCodes ? options.stretch * family.spacing_m : 0;
    const auto made = drives_of(family, method, every_m, drives, options);
    int missed = 0;
    int refused = 0;
    for (const Drive& drive : made) {
        missed += drive.missed;
        refused += drive.refused;
    }
    Curve curve{family.type.id.str() + ", " + name_of(method), {}};
    for (std::size_t c = 0; c < made.front().checkpoints.size(); ++c)
        curve.off_mm.push_back(1e3 * quantile(offs_at(made, c), 0.95));
    const auto at = [&](double way_m) {
        const auto offs = offs_at(made, static_cast<std::size_t>(way_m / kCheckpoint_m) - 1);
        return fmt::format("{:.1f}, {:.1f}", 1e3 * quantile(offs, 0.95), 1e3 * quantile(offs, 1));
    };
    const double end_mm = curve.off_mm.empty() ? 1e9 : curve.off_mm.back();
    const double share = covered(made);
    const bool holds = std::abs(share - kCovered) <= kCoveredWithin && missed == 0 &&
                       end_mm <= most_at_end_mm(method);
    const bool kept = options.stretch > 1 ? missed > 0 : holds;
    fmt::print("{:<22}{:>10}{:>18}{:>18}{:>18}{:>9.1f}%{:>9}{:>9}{}\n", curve.name,
               every_m > 0 ? fmt::format("{:.1f} m", every_m) : std::string("-"), at(50), at(100),
               at(kLength_m - kCheckpoint_m), 100 * share, missed, refused, kept ? "" : "  NO");
    std::fflush(stdout);
    curves.push_back(std::move(curve));
    return kept;
}

}  // namespace

bool navigation(const Options& options) {
    const int drives = options.runs.value_or(kDrives);
    const bool stretched = options.stretch > 1;
    const auto plant =
        api::plant_file::load_plant_file(options.folder + "/../../db/plants/final-assembly.json");
    if (!plant) throw std::runtime_error(plant.error().what);
    bool good = true;
    if (!stretched) {
        const Family platform = family_of(*plant, "TP-01");
        good &= drive_equation_5(platform.type, kSpacedDrives * drives, options.seed);
    }
    fmt::print(
        "\n{} machines a family drive {} m straight ahead, {} errors: how far the pose that they "
        "steer by is off, mm{}\n",
        drives, kLength_m, options.errors,
        stretched ? "; codes too far apart, which some of each family have to miss" : "");
    fmt::print("{:<22}{:>10}{:>18}{:>18}{:>18}{:>10}{:>9}{:>9}\n", "", "code every",
               "50 m: 95 %, max", "100 m", "190 m", "covered", "missed", "refused");
    std::vector<Curve> curves;
    for (const char* id : {"TP-01", "OM-01", "MV-01", "DL-01"}) {
        const Family family = family_of(*plant, id);
        for (const Method method : methods_of(family.type)) {
            if (stretched && method != Method::kCodes) continue;
            good &= print_row(family, method, drives, options, curves);
        }
    }
    if (!stretched) plot(options.plots + "/navigation.svg", curves, kCheckpoint_m);
    return good;
}

}  // namespace pulseline::experiments
