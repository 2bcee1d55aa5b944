#include "server/agent/map_hall.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "core/kinematics/primitives.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/mapping/map_builder.hpp"
#include "core/onboard/pose/contour_watch.hpp"
#include "core/onboard/pose/marker_watch.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/scanners.hpp"
#include "server/agent/camera_sensing.hpp"
#include "server/agent/hall_truth.hpp"

namespace pulseline::agent {
namespace {

using geometry::Point2;
using geometry::Pose2;
using kinematics::Segment;

constexpr double kStep_s = 0.05;
// Scans farther apart leave gaps behind things, nearer ones tell nothing new.
constexpr double kEvery_m = 0.3;
constexpr double kEvery_rad = 0.1;
// From far away it draws only behind codes, where it knows well how it is turned.
constexpr double kSharp_m = 0.02;

using Lanes = std::map<plant::NodeId, std::set<plant::NodeId>>;

Lanes lanes_of(const plant::Plant& plant, const plant::HallId& hall) {
    Lanes lanes;
    for (const auto& edge : plant.edges) {
        const auto* from = plant::find_node(plant, edge.from);
        const auto* to = plant::find_node(plant, edge.to);
        if (from == nullptr || to == nullptr || from->hall != hall || to->hall != hall) continue;
        lanes[edge.from].insert(edge.to);
        lanes[edge.to].insert(edge.from);
    }
    return lanes;
}

void append_drive(std::vector<Segment>& way, Pose2& at, Point2 target) {
    const Point2 ahead = target - at.position();
    if (norm(ahead) < kinematics::kNothing) return;
    const double heading_rad = std::atan2(ahead.y_m, ahead.x_m);
    kinematics::append_turn(way, at, kinematics::shortest_turn_rad(at.heading_rad, heading_rad));
    at.heading_rad = heading_rad;
    kinematics::append_straight(way, at, target);
    at = way.back().end;
}

/// A way over lanes as it grows.
struct LaneWay {
    const plant::Plant& plant;
    const Lanes lanes;
    const plant::VehicleType* turns_as;
    std::set<std::pair<plant::NodeId, plant::NodeId>> driven = {};
    Pose2 at = {};
    std::vector<Segment> way = {};

    void drive_to(const plant::NodeId& node) {
        append_drive(way, at, plant::find_node(plant, node)->position);
        for (const auto& station : plant.stations) {
            if (turns_as == nullptr || station.node != node) continue;
            const auto& types = station.vehicle_types;
            if (!types.empty() && std::ranges::find(types, turns_as->id) == types.end()) continue;
            kinematics::append_turn(
                way, at, kinematics::shortest_turn_rad(at.heading_rad, station.pose.heading_rad));
            at.heading_rad = station.pose.heading_rad;
        }
    }

    /// Depth first: each lane once there and once back, or across where it closes a ring.
    void drive_lanes_of(const plant::NodeId& node) {
        for (const plant::NodeId& next : lanes.at(node)) {
            if (!driven.insert(std::minmax(node, next)).second) continue;
            drive_to(next);
            drive_lanes_of(next);
            drive_to(node);
        }
    }
};

}  // namespace

Result<std::vector<Segment>> way_over_lanes(const plant::Plant& plant, const plant::HallId& hall,
                                            const Pose2& from, const plant::VehicleType* turns_as) {
    const Lanes lanes = lanes_of(plant, hall);
    if (lanes.empty()) {
        return fail(Errc::kInvalid, "no_lanes",
                    "hall " + hall.str() + " has no lanes to drive along; draw them first", {},
                    {{"hall", hall.str()}});
    }
    const auto nearest = std::ranges::min_element(lanes, {}, [&](const auto& lane) {
        return distance(plant::find_node(plant, lane.first)->position, from.position());
    });
    LaneWay over{.plant = plant, .lanes = lanes, .turns_as = turns_as, .at = from};
    over.drive_to(nearest->first);
    over.drive_lanes_of(nearest->first);
    return over.way;
}

std::deque<vda5050::OrderEdge> edges_over(const plant::Plant& plant, const plant::HallId& hall,
                                          std::span<const plant::Camera> cameras,
                                          std::span<const Segment> way) {
    std::deque<vda5050::OrderEdge> edges;
    for (const Segment& segment : way) {
        vda5050::OrderEdge edge;
        edge.segment = segment;
        edge.actions.emplace_back();
        for (const auto& marker : plant.markers) {
            if (marker.hall != hall || !localisation::is_passed(marker, cameras, segment)) continue;
            edge.actions.back().markers.push_back({marker.payload, plant::to_string(marker.kind),
                                                   marker.size_m, marker.pose, marker.sigma_xy_m,
                                                   marker.sigma_heading_rad});
        }
        edges.push_back(std::move(edge));
    }
    return edges;
}

Result<mapping::OccupancyMap> map_hall(const simulation::World& world,
                                       const plant::Vehicle& vehicle, const plant::HallId& hall,
                                       const std::vector<Segment>& way, std::uint64_t seed,
                                       const std::function<void(double)>& progress,
                                       double within_m) {
    const auto& type = *plant::find_vehicle_type(world.plant, vehicle.type);
    const bool loaded = plant::first_load(world.plant, vehicle.id) != nullptr;
    const Pose2 start = way.front().start;
    simulation::ServoDrive drive(type, start, seed, 1, first_load_kg(world.plant, vehicle),
                                 world.errors);
    drive.set_believed(start);
    CameraSensing cameras(world, hall, drive, false, seed, loaded);
    simulation::SimulatedScanners scanners(world, hall, type, drive.true_pose(), seed);
    onboard::PoseEstimate estimate{start, localisation::odometry_noise(world.errors.drive, type)};
    onboard::MarkerWatch watch(cameras, drive, estimate);

    auto ahead = edges_over(world.plant, hall, plant::cameras_of(type, loaded), way);
    for (const Segment& segment : way) drive.append(segment);
    mapping::MapBuilder builder(start, within_m);
    std::vector<control::Scan> scans;
    Pose2 taken;  // by the trail
    bool corrected = false;
    bool first = true;
    std::size_t done = 0;
    while (!drive.idle()) {
        const double dt_s = watch.expects_soon() ? onboard::MarkerWatch::kFineStep_s : kStep_s;
        drive.step(dt_s);
        if (const auto cause = drive.stop_cause()) {
            return fail(Errc::kConflict, "mapping_stopped",
                        fmt::format("the vehicle stopped on segment {} of {}: {}", done, way.size(),
                                    cause->code),
                        {}, {{"cause", cause->code}});
        }
        estimate.drive_to(drive.believed_pose());
        for (; done < drive.segments_done(); ++done) {
            ahead.pop_front();
            progress(static_cast<double>(done) / static_cast<double>(way.size()));
        }
        watch.step(dt_s, ahead);
        corrected |= !watch.take_taken().empty();
        const Pose2 driven = inverse(taken) * watch.trail().driven();
        if (!first && norm(driven.position()) < kEvery_m &&
            std::abs(driven.heading_rad) < kEvery_rad)
            continue;
        const bool is_blurred = estimate.sigma_heading_rad() * within_m > kSharp_m;
        if (within_m > mapping::MapBuilder::kWithin_m && is_blurred && !first) continue;
        scanners.scan(scans);
        const auto covariance = onboard::way_covariance(driven, estimate.noise());
        if (corrected) {  // before it draws
            builder.take(driven, covariance, {});
            builder.stands_at(estimate.pose(), estimate.covariance());
            builder.take({}, Eigen::Matrix3d::Zero(), scans);
        } else {
            builder.take(driven, covariance, scans);
        }
        taken = watch.trail().driven();
        first = corrected = false;
    }
    return builder.map();
}

}  // namespace pulseline::agent
