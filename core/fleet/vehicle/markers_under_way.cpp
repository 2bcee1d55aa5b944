#include "core/fleet/vehicle/markers_under_way.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/leg_markers.hpp"
#include "core/localisation/codes_on_way.hpp"
#include "core/localisation/reading_speed.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

using geometry::Point2;

// More on one edge than anybody lays: the message stays small.
constexpr std::size_t kMostOnEdge = 64;

double farthest_foot_m(const std::vector<plant::Camera>& cameras) {
    double most_m = 0;
    for (const auto& camera : cameras) {
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

/// Which of the edge's codes its way relies on.
void name_chain(const planning::LegChain& chain, vda5050::Action& action) {
    for (const auto& on_edge : action.markers) {
        const auto is_it = [&](const auto& one) { return one.payload == on_edge.payload; };
        if (std::ranges::none_of(chain.markers, is_it)) continue;
        action.segment_markers.push_back(on_edge.payload);
        if (is_it(chain.markers.back())) action.boundary_marker = on_edge.payload;
    }
}

/// No faster over what its way relies on than its cameras surely read it, where it would be. In its
/// own time as its factsheet has it: a simulated one may be made to drive faster than its type.
void limit_speed(const LiveVehicle& live, const std::vector<plant::Camera>& cameras,
                 const std::vector<const plant::Marker*>& below, const vda5050::Action& action,
                 vda5050::OrderEdge& edge) {
    for (const plant::Marker* marker : below) {
        const auto& chain = action.segment_markers;
        if (std::ranges::find(chain, marker->payload) == chain.end()) continue;
        const auto limit_mps =
            localisation::limit_to_read_mps(*live.type, cameras, *marker, edge.segment);
        if (!limit_mps) continue;
        const double own_mps = *limit_mps * std::max(1.0, speed_share(live));
        const bool limited = edge.max_speed_mps > 0;
        edge.max_speed_mps = limited ? std::min(edge.max_speed_mps, own_mps) : own_mps;
    }
}

}  // namespace

void observe_markers(const FleetState& fleet, const LiveVehicle& live, const std::string& hall,
                     vda5050::OrderMessage& order) {
    if (order.edges.empty() || !reads_under_way(live)) return;
    const auto& chain = leg_markers(fleet, live);
    const auto cameras = plant::cameras_of(*live.type, is_loaded(live));
    const auto around = codes_near(fleet.plant, hall, order.edges, farthest_foot_m(cameras));
    for (vda5050::OrderEdge& edge : order.edges) {
        std::vector<const plant::Marker*> below;
        std::ranges::copy_if(around, std::back_inserter(below), [&](const plant::Marker* marker) {
            return localisation::is_passed(*marker, cameras, edge.segment);
        });
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
        if (chain && *chain) {
            name_chain(**chain, action);
            limit_speed(live, cameras, below, action, edge);
        }
        edge.actions.push_back(std::move(action));
    }
}

}  // namespace pulseline::fleet
