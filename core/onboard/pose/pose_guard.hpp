#pragma once

#include "core/onboard/pose/pose_estimate.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::onboard {

/// What becomes of a drive whose vehicle knows less and less where it is, since no code, beacon or
/// contour has told it: first it drives slowly, which leaves its senses more time, then it stays
/// where it is, before three sigma of any point of its body reach beyond the floor that is held for
/// it. Where a person has said that it stands, the person has looked whether the floor around is
/// free: from there it drives slowly for a while, to find something that tells it better.
class PoseGuard {
public:
    /// What the fleet holds around a body, beside the way that it drives.
    static constexpr double kHeld_m = 0.10;
    static constexpr double kSlowShare = 0.25;  // of its speed

    /// `type`: with what it carries.
    PoseGuard(const plant::VehicleType& type, bool loaded);

    enum class Advice { kDrive, kDriveSlowly, kStay };
    Advice advice(const PoseEstimate& estimate) const;
    /// Three sigma of the point of the body that is known worst.
    double reach_m(const PoseEstimate& estimate) const;

private:
    double radius_m_ = 0;  // of the body, around its origin
};

}  // namespace pulseline::onboard
