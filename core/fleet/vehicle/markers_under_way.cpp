#include "core/fleet/vehicle/markers_under_way.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/fleet/vehicle/body.hpp"
#include "core/kinematics/motion.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

using geometry::Point2;
using kinematics::Segment;

// Finer than a camera's view is long, so that no code lies between two looks.
constexpr double kLookEvery_m = 0.03;
// More on one edge than anybody lays: the message stays small.
constexpr std::size_t kMostOnEdge = 64;

/// How far from a camera's foot the middle of a code may lie to be seen whole, however it is
/// turned.
double view_radius_m(const plant::Camera& camera, double size_m) {
    const double view_m =
        std::min(camera.width_px, camera.height_px) * camera.height_m / camera.f_px;
    return (view_m - size_m) / 2;
}

/// Way of a camera along the segment, at most: its foot swings about a turning body.
double foot_way_m(const Segment& segment, const plant::Camera& camera) {
    return std::abs(segment.length_m) +
           std::abs(segment.turn_rad) * norm(camera.body_from_camera.position());
}

double farthest_foot_m(const plant::VehicleType& type, bool loaded) {
    double most_m = 0;
    for (const auto& camera : plant::cameras_of(type, loaded)) {
        most_m = std::max(most_m, norm(camera.body_from_camera.position()));
    }
    return most_m;
}

/// The plant's codes of the hall that may lie below a foot anywhere on the way.
std::vector<const plant::Marker*> codes_near(const plant::Plant& plant, const std::string& hall,
                                             const std::vector<vda5050::OrderEdge>& way,
                                             double farthest_foot_m) {
    geometry::Polygon ends;
    double longest_m = 0;  // so far an arc bulges out at most
    for (const auto& edge : way) {
        ends.push_back(edge.segment.start.position());
        ends.push_back(edge.segment.end.position());
        longest_m = std::max(longest_m, std::abs(edge.segment.length_m));
    }
    const geometry::Box box = geometry::bounding_box(ends);
    const double reach_m = farthest_foot_m + longest_m;
    std::vector<const plant::Marker*> near;
    for (const auto& marker : plant.markers) {
        const Point2 at = marker.pose.position();
        if (marker.hall.str() == hall && at.x_m >= box.min.x_m - reach_m &&
            at.x_m <= box.max.x_m + reach_m && at.y_m >= box.min.y_m - reach_m &&
            at.y_m <= box.max.y_m + reach_m) {
            near.push_back(&marker);
        }
    }
    return near;
}

bool announces_it(const LiveVehicle& live) {
    if (!live.factsheet) return false;
    const auto& actions = live.factsheet->actions;
    return std::find(actions.begin(), actions.end(), vda5050::kObserveMarkers) != actions.end();
}

}  // namespace

std::vector<const plant::Marker*> markers_below(const std::vector<const plant::Marker*>& around,
                                                const plant::VehicleType& type, bool loaded,
                                                const Segment& segment) {
    std::vector<const plant::Marker*> seen;
    const auto cameras = plant::cameras_of(type, loaded);
    const double reach_m = farthest_foot_m(type, loaded) + std::abs(segment.length_m);
    for (const plant::Marker* marker : around) {
        const Point2 at = marker->pose.position();
        if (distance(at, segment.start.position()) > reach_m + marker->size_m) continue;
        const bool passed = std::any_of(cameras.begin(), cameras.end(), [&](const auto& camera) {
            const double radius_m = view_radius_m(camera, marker->size_m);
            const int looks =
                1 + static_cast<int>(std::ceil(foot_way_m(segment, camera) / kLookEvery_m));
            for (int i = 0; i <= looks; ++i) {
                const geometry::Pose2 body =
                    kinematics::pose_at(segment, static_cast<double>(i) / looks);
                const Point2 foot = body * camera.body_from_camera.position();
                if (distance(foot, at) <= radius_m) return true;
            }
            return false;
        });
        if (passed) seen.push_back(marker);
    }
    return seen;
}

void observe_markers(const FleetState& fleet, const LiveVehicle& live, const std::string& hall,
                     vda5050::OrderMessage& order) {
    if (order.edges.empty() || !announces_it(live)) return;
    const bool loaded = is_loaded(live);
    const auto around =
        codes_near(fleet.plant, hall, order.edges, farthest_foot_m(*live.type, loaded));
    for (vda5050::OrderEdge& edge : order.edges) {
        auto below = markers_below(around, *live.type, loaded, edge.segment);
        if (below.empty()) continue;
        below.resize(std::min(below.size(), kMostOnEdge));
        vda5050::Action action;
        action.type = vda5050::kObserveMarkers;
        action.id = order.order_id + "-" + edge.edge_id + "-" + vda5050::kObserveMarkers;
        action.blocking = vda5050::BlockingType::kNone;
        for (const plant::Marker* marker : below) {
            action.markers.push_back({marker->payload, plant::to_string(marker->kind),
                                      marker->size_m, marker->pose, marker->sigma_xy_m,
                                      marker->sigma_heading_rad});
        }
        edge.actions.push_back(std::move(action));
    }
}

}  // namespace pulseline::fleet
