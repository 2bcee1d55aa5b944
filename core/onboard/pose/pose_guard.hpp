#pragma once

#include "core/onboard/pose/pose_estimate.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::onboard {

/// What becomes of a drive whose vehicle knows less and less where it is, since no code, beacon or
/// contour has told it: first it drives slowly, which leaves its senses more time; before three
/// sigma of any point of its body reach beyond the floor that is held for it, it stands and looks
/// around; and if nothing tells it then, it asks. Before it begins a way it has more patience:
/// where a person has pointed to, its looks add up as it stands. What a person has measured lets it
/// drive as far as that holds. Thread safety: none. No clock: time passes by step().
class PoseGuard {
public:
    /// What the fleet holds around a body, beside the way that it drives.
    static constexpr double kHeld_m = 0.10;
    static constexpr double kSlowShare = 0.25;  // of its speed
    /// So long it looks around on its way; scanners have seen all that there is to see long before.
    static constexpr double kLook_s = 10;
    /// So long before it begins one.
    static constexpr double kFind_s = 60;

    /// `type`: with what it carries.
    PoseGuard(const plant::VehicleType& type, bool loaded);

    enum class Advice { kDrive, kDriveSlowly, kLookAround, kAsk };
    /// What it has to do: who has no way stays what it is, however little it knows.
    enum class Way { kNone, kToBegin, kUnderWay };
    Advice step(double dt_s, const PoseEstimate& estimate, Way way);
    /// Three sigma of the point of the body that is known worst, and what the drive, which steers
    /// by its own belief, has still to be led there.
    double reach_m(const PoseEstimate& estimate) const;
    /// Whether the drive has to be led so far that this should be done before a way begins: on its
    /// way it would stand and look around, where nobody leads it.
    bool should_be_led(const PoseEstimate& estimate) const;
    /// Whether it knows too little where it is to begin a way, wherever it is led.
    bool is_vague(const PoseEstimate& estimate) const;

    /// By how far the drive has still to be led, at the point of the body where that is most.
    double to_lead_m(const PoseEstimate& estimate) const;

private:
    double unknown_m(const PoseEstimate& estimate) const;

    double radius_m_ = 0;  // of the body, around its origin
    double looked_s_ = 0;
};

/// Of the speed, what is left by this advice.
double speed_share(PoseGuard::Advice advice);

}  // namespace pulseline::onboard
