#pragma once

#include <optional>
#include <vector>

#include "core/control/obstacle_ring.hpp"
#include "core/control/scan.hpp"
#include "core/kinematics/wheels.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::control {

struct FieldOptions {
    double margin_m = 0.1;    // around the swept outline, the scanner's noise included
    double reaction_s = 0.2;  // from the scan to the brakes
    double look_ahead_s = 2;  // driven on beyond the stopping way: the slow field
};

struct FieldAnswer {
    enum class Verdict { kFree, kSlow, kStop };
    Verdict verdict = Verdict::kFree;
    /// So much of the commanded twist has its slow field just free: 1 free, 0 stop.
    double speed_share = 1;
    double speed_mps = 0;  // of the body's centre at that share
    /// The return that the motion meets first, body frame, and its way until then.
    std::optional<geometry::Point2> nearest;
    double way_m = 0;
};

/// Slow and stop fields around a vehicle that follow its commanded twist: the outline swept over
/// the stopping way (reaction and braking), or over more for the slow field, plus the margin. A
/// return inside the margin from which the motion leads away is let go; a vehicle that stands has
/// no field.
///
/// Not a safety function: it runs on an ordinary computer and only spares the real one, the safety
/// scanner in the vehicle, its stops. No allocation after the first scan of a shape.
class ProtectiveFields {
public:
    /// `outline`: vehicle and load, body frame; its convex hull counts. REQUIRES: limits > 0.
    ProtectiveFields(const plant::VehicleType& type, const geometry::Polygon& outline,
                     const FieldOptions& options = {});

    /// `driven`: the twist commanded now, slowed down as the last answer said. The scanner must not
    /// see the vehicle itself: its angles leave out what it would.
    FieldAnswer check(const Scan& scan, const kinematics::Twist& driven);

private:
    void prepare(const Scan& scan);
    geometry::Box swept_box(const kinematics::Twist& twist, double time_s) const;
    std::optional<double> contact_s(geometry::Point2 p, const kinematics::Twist& twist,
                                    double until_s) const;

    double accel_mps2_;
    double turn_accel_radps2_;
    FieldOptions options_;
    geometry::Polygon hull_;
    ObstacleRing outline_;
    double radius_m_ = 0;
    // Directions of the rays in the body frame, kept for the next scan of the same shape.
    geometry::Pose2 body_from_sensor_;
    double first_rad_ = 0;
    double step_rad_ = 0;
    std::vector<geometry::Point2> rays_;
};

}  // namespace pulseline::control
