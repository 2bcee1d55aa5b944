#pragma once

#include <map>
#include <set>

#include "core/fleet/state/job_order.hpp"

namespace pulseline::fleet {

struct FleetState;
struct LiveVehicle;

/// Which stations look different since dashboards were told last. A station is shown by what the
/// vehicles mean for it (station_view), so only a vehicle that has changed can change it.
class StationNews {
public:
    /// What is now is known to everybody.
    void begin(const FleetState& fleet);
    /// The stations that look different because of these vehicles; from now on they are told.
    std::set<plant::StationId> of(const FleetState& fleet,
                                  const std::set<plant::VehicleId>& changed);

private:
    /// All of a vehicle that station_view reads.
    struct Meaning {
        plant::StationId stands_at;
        plant::StationId goes_to;
        StopRecordId last_stop;
        plant::StationId last_stop_at;
        bool last_stop_inside = false;
        bool has_leg = false;
        friend bool operator==(const Meaning&, const Meaning&) = default;
    };
    static Meaning meaning_of(const LiveVehicle& live);

    std::map<plant::VehicleId, Meaning> told_;
};

}  // namespace pulseline::fleet
