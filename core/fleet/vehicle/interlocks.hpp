#pragma once

#include <optional>

#include "core/fleet/state/fleet_state.hpp"

/// Preconditions of a platform's drive (Tang 2020, workflow of section 2): what has to be true of
/// the machine and its load before it may leave where it stands.
namespace pulseline::fleet {

LoadView load_view(const FleetState& fleet, const LiveVehicle& live);
/// The rule of its type that what its brackets feel breaks, whatever that is.
std::optional<Reason> rule_broken(const LiveVehicle& live);

struct Interlock {
    enum class Kind {
        kFeetDown,  // parking_feet_down {furthest_m}
        kLoad,      // those of plant::load_fault; load_unknown {measured_kg}, load_differs {load,
                    // load_kg, measured_kg} of what its brackets feel and nobody knows of;
                    // load_half_taken {}
        kBracketsRaised,  // brackets_raised {load, station, height_m, most_m}
        kWheelFault,      // wheel_fault {wheel, fault}
        kCodes,           // codes_not_seen {found, cameras}
    };
    Kind kind = Kind::kFeetDown;
    Reason reason;
};
/// The first one that bars the drive. Nothing: it may drive.
std::optional<Interlock> interlock(const FleetState& fleet, const LiveVehicle& live);

}  // namespace pulseline::fleet
