#include <utility>

#include "core/fleet/commands/reachable.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/carrying.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/lifts.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/views/vehicle_views.hpp"
#include "core/vda5050/actions.hpp"

// What people ask of brackets and parking feet outside an order.
namespace pulseline::fleet {

Result<VehicleView> Fleet::move_lifts(const plant::VehicleId& id, const StepAction& wanted,
                                      const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::move_lifts>(now, id, wanted, actor);
    LiveVehicle* live = fleet.find(id);
    if (!live) return no_such_vehicle(id);
    if (Status heard = is_heard(*live, {}, "Its brackets and feet can be moved"); !heard) {
        return fail(std::move(heard).error());
    }
    if (Status may = may_move_lifts(fleet, *live, wanted); !may)
        return fail(std::move(may).error());
    vda5050::Action action;
    action.type = wanted.type;
    action.params = wanted.params;
    if (vda5050::is_transfer(wanted.type)) action = transfer_action(fleet, *live, wanted);
    if (wanted.type == vda5050::kPick) {
        const auto* load = load_at(fleet, live->record.at_station);
        if (Status held = hold_floor_with(fleet, *live, load, now); !held) {
            return fail(std::move(held).error());
        }
    }
    action.id = to_string(fleet.ids.next(now));
    live->lift = LiftMove{wanted, action.id, actor, now, LiftMove::State::kUnderWay, {}};
    Params params{{"action", wanted.type}, {"action_id", action.id}};
    params.insert(params.end(), wanted.params.begin(), wanted.params.end());
    add_event(fleet, now, event::kVehicleLifts, {}, {}, id, actor, std::move(params));
    send_action(fleet, *live, std::move(action), now);
    fleet.changed_vehicles.insert(id);
    return view_of(fleet, *live, now);
}

Result<VehicleView> Fleet::stop_lifts(const plant::VehicleId& id, const std::string& actor,
                                      Time now) {
    FleetState& fleet = input<&Fleet::stop_lifts>(now, id, actor);
    LiveVehicle* live = fleet.find(id);
    if (!live) return no_such_vehicle(id);
    if (live->type->brackets.empty() && !live->type->parking) {
        return fail(Errc::kUnreachable, "unknown_lift",
                    "Vehicle " + id.str() + " has neither brackets nor parking feet.", {},
                    {{"vehicle", id.str()}});
    }
    // Without a line they stay where they are by themselves.
    if (Status heard = is_heard(*live, {}, "It holds them by itself meanwhile, and tells");
        !heard) {
        return fail(std::move(heard).error());
    }
    add_event(fleet, now, event::kVehicleLiftsStopped, {}, {}, id, actor);
    if (!is_asked(*live, vda5050::kStopLifts)) {
        vda5050::Action action;
        action.type = vda5050::kStopLifts;
        send_action(fleet, *live, std::move(action), now);
    }
    return view_of(fleet, *live, now);
}

}  // namespace pulseline::fleet
