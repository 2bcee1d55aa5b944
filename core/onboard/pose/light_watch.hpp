#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/localisation/igps_pose.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/pose/beacon_correction.hpp"
#include "core/onboard/pose/odometry_trail.hpp"
#include "core/onboard/pose/pose_estimate.hpp"
#include "core/onboard/receivers.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Light of iGPS corrects the pose that the vehicle steers by, each time the receivers tell of it,
/// standing and driving (Wang, section 4), as BeaconCorrection says. Thread safety: none. No clock:
/// time passes by step().
class LightWatch {
public:
    /// All must outlive it.
    LightWatch(Receivers& receivers, const Drive& drive, PoseEstimate& estimate,
               const OdometryTrail& trail, const localisation::ReceiverErrors& errors = {});

    /// After each step of the trail. Without a pose (`located`) it only tells what it sees.
    void step(double dt_s, const std::vector<plant::Transmitter>& transmitters, bool located);
    /// It drives by light, and longer steps would blur it: of the vehicle's own time, at most.
    static constexpr double kFineStep_s = 0.02;
    bool steers() const { return newest_.has_value() && !drive_.standing(); }

    /// What the receivers saw last, for the server.
    const std::vector<vda5050::ReceiverReading>& readings() const { return readings_; }
    /// The newest pose by light; nothing: the last light gave none.
    const std::optional<localisation::IgpsFix>& newest() const { return newest_; }
    /// Why not, as localisation::locate_by_light says; nothing: there is one, or no light was ever
    /// expected.
    const std::optional<Error>& why_not() const { return why_not_; }
    /// The mean of all since the vehicle stands; driving, the newest one.
    std::optional<localisation::IgpsFix> mean() const;

private:
    void take(const std::vector<ReceiverPulses>& pulses,
              const std::vector<plant::Transmitter>& transmitters, bool located);
    std::vector<localisation::ReceiverLight> light_of(const std::vector<ReceiverPulses>& pulses);
    geometry::Point2 way_since(const plant::Receiver& receiver, double pulse_s) const;
    void tell(const std::vector<localisation::ReceiverLight>& light,
              const std::vector<localisation::ReceiverResult>& results);

    Receivers& receivers_;
    const Drive& drive_;
    const PoseEstimate& estimate_;
    const OdometryTrail& trail_;
    BeaconCorrection correction_;
    localisation::ReceiverErrors errors_;
    std::vector<vda5050::ReceiverReading> readings_;
    std::optional<localisation::IgpsFix> newest_;
    std::vector<localisation::IgpsFix> since_standing_;
    std::optional<Error> why_not_;
    double seen_ago_s_ = 0;  // when the sheets passed, the last time on average
    double waited_s_ = 0;    // own time, since the receivers were asked
};

}  // namespace pulseline::onboard
