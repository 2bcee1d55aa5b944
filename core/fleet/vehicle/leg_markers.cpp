#include "core/fleet/vehicle/leg_markers.hpp"

#include <algorithm>
#include <vector>

#include "core/fleet/vehicle/body.hpp"
#include "core/planning/legs/blind_way.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {

bool reads_under_way(const LiveVehicle& live) {
    if (!live.factsheet) return false;
    const auto& actions = live.factsheet->actions;
    return std::find(actions.begin(), actions.end(), vda5050::kObserveMarkers) != actions.end();
}

const std::optional<Result<planning::LegChain>>& leg_markers(const FleetState& fleet,
                                                             const LiveVehicle& live) {
    static const std::optional<Result<planning::LegChain>> kNone;
    if (!reads_under_way(live)) return kNone;
    const Leg& leg = live.leg();
    auto& known = live.leg_markers;
    if (!known || known->leg != leg.id) {
        std::vector<kinematics::Segment> segments;
        for (const auto& edge : leg.edges) segments.push_back(edge.segment);
        known = LiveVehicle::LegMarkers{
            leg.id, planning::leg_chain(fleet.plant, plant::HallId(leg.hall),
                                        planning::CodeReach(*live.type, is_loaded(live)),
                                        plant::find_station(fleet.plant, leg.station), segments)};
    }
    return known->chain;
}

}  // namespace pulseline::fleet
