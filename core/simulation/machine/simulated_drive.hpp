#pragma once

#include "core/onboard/drive.hpp"

namespace pulseline::simulation {

using onboard::Drive;

/// A drive whose machine truly stands somewhere. Nobody on the vehicle may ask it: for the
/// simulated world and the truth log only.
class SimulatedDrive : public Drive {
public:
    /// The same object for as long as the drive lives.
    virtual const geometry::Pose2& true_pose() const = 0;
    /// It was carried off, its wheels in the air, so that odometry knows nothing of it. `by`: where
    /// it is now, seen from where it was.
    virtual void carry(const geometry::Pose2& by) = 0;
    /// What it carries from now on weighs so much; a drive without wheels does not feel it.
    virtual void set_load(double) {}
    /// Too hot, the motors of that wheel of its type are off until it is not any more; a drive
    /// without wheels does not feel it.
    virtual void set_hot(std::size_t, bool) {}
};

}  // namespace pulseline::simulation
