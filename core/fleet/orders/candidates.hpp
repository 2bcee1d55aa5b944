#pragma once

#include <optional>
#include <vector>

#include "core/fleet/state/fleet_state.hpp"

/// Which vehicles an order may be given to, and from where each would come to it.
namespace pulseline::fleet {

/// By vehicle, type and sequence; not by its actions.
bool is_candidate(const FleetState& fleet, const NewOrder& order, const LiveVehicle& live);
/// The station is for vehicles of its type.
bool may_stop_at(const plant::Station& station, const LiveVehicle& live);
bool is_gone(const FleetState& fleet, const LiveVehicle& live, Time now);

/// Where the vehicle will stand when all that it has to do besides the order `self` is done;
/// nullopt: nobody knows.
std::optional<Pose2> future_pose(const FleetState& fleet, const LiveVehicle& live, JobOrderId self);

struct Candidate {
    const LiveVehicle* live = nullptr;
    std::optional<Pose2> pose;  // from where it would come
};
/// Those that are worth a plan, by name: with a thousand vehicles a plan of each takes seconds.
std::vector<Candidate> nearest_of_each_type(const FleetState& fleet, const NewOrder& order,
                                            const Pose2& goal, JobOrderId self, Time now);

}  // namespace pulseline::fleet
