#include "core/fleet/commands/reachable.hpp"

namespace pulseline::fleet {

tl::unexpected<Error> no_such_vehicle(const plant::VehicleId& id) {
    return fail(Errc::kNotFound, "unknown_vehicle", "There is no vehicle " + id.str() + ".", {},
                {{"vehicle", id.str()}});
}

Status is_heard(const LiveVehicle& live, const std::string& field, const std::string& wanted) {
    const std::string& id = live.record.id.str();
    if (!live.connected) {
        return fail(Errc::kConflict, "vehicle_silent",
                    "Vehicle " + id + " is silent. " + wanted + " when it is heard again.", field,
                    {{"vehicle", id}});
    }
    if (!live.reconciled) {
        return fail(Errc::kConflict, "vehicle_not_reported",
                    "Vehicle " + id + " has connected and not said yet where it stands. " + wanted +
                        " when it has.",
                    field, {{"vehicle", id}});
    }
    return {};
}

}  // namespace pulseline::fleet
