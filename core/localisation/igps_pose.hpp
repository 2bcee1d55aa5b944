#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/localisation/beacon_fix.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/localisation/receiver_fix.hpp"

namespace pulseline::localisation {

/// What one receiver of a vehicle saw of all transmitters.
struct ReceiverLight {
    std::string receiver;
    std::vector<LightAngles> light;
};

/// Pose of a vehicle by iGPS. Left out are receivers, as locate_receiver says or receiver_moved,
/// and transmitters, transmitter_moved.
struct IgpsFix : BeaconFix {
    double floor_m = 0;  // height of the floor below it, by the receivers' own
};

struct ReceiverResult {
    std::string receiver;
    Result<ReceiverFix> fix;  // as locate_receiver
};

std::vector<ReceiverResult> locate_receivers(std::span<const ReceiverLight> light,
                                             std::span<const plant::Transmitter> transmitters);

/// Each receiver's place by its light, then the rigid fit of all of them to their calibrated places
/// (Wang, section 4: "attitude registration"; his eq. 1, 2 and the pose angle beta take two of
/// them). Receivers of unknown name are passed over. Fails with
/// - too_few_receivers {seen}: two at least tell a direction; with what the last one lacked
/// - receivers_disagree {residual_m}: one does not sit where it was calibrated
Result<IgpsFix> fit_receivers(std::vector<ReceiverResult> located,
                              std::span<const plant::Transmitter> transmitters,
                              std::span<const plant::Receiver> receivers,
                              const ReceiverErrors& errors = {});
Result<IgpsFix> locate_by_light(std::span<const ReceiverLight> light,
                                std::span<const plant::Transmitter> transmitters,
                                std::span<const plant::Receiver> receivers,
                                const ReceiverErrors& errors = {});

/// What is to be expected where a vehicle of this type stands in this hall, as drawn. Fails as
/// locate_by_light.
Result<IgpsFix> expected_fix(const plant::Plant& plant, const plant::HallId& hall,
                             const plant::VehicleType& type, const Pose2& pose);

}  // namespace pulseline::localisation
