#include "core/fleet/reports/rejected_order.hpp"

#include "core/fleet/legs/ending.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"

namespace pulseline::fleet {
namespace {

const vda5050::VehicleError* rejection_of(const vda5050::StateMessage& state,
                                          const std::string& order_id) {
    for (const auto& error : state.errors) {
        for (const auto& [key, value] : error.references) {
            if (key == "orderId" && value == order_id) return &error;
        }
    }
    return nullptr;
}

}  // namespace

void lose_order(FleetState& fleet, LiveVehicle& live, Time now) {
    require_person(fleet, live, {reasons::kVehicleLostOrder, {}}, now);
    end_leg(fleet, live, LegEnd::kLost, now);
}

void handle_other_order(FleetState& fleet, LiveVehicle& live, Time now) {
    // Without pose it has restarted: an order sent before must not set it in motion.
    if (live.delivery.seen() || (!live.record.pose_known && !live.delivery.lost())) {
        return lose_order(fleet, live, now);
    }
    if (live.delivery.lost()) return end_leg(fleet, live, LegEnd::kLost, now);
    const auto* error = rejection_of(live.state, live.leg().id.str());
    if (!error) return;
    require_person(fleet, live,
                   {reasons::kOrderRejected, {{"type", error->type}, {"text", error->description}}},
                   now);
    end_leg(fleet, live, LegEnd::kRejected, now);
}

}  // namespace pulseline::fleet
