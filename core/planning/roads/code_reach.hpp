#pragma once

#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "core/localisation/codes_on_way.hpp"
#include "core/localisation/odometry_noise.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::planning {

/// A turn of a way, and how far along.
struct TurnAt {
    double at_m = 0;
    double turn_rad = 0;
    bool brakes = true;  // TurnBehind
};

/// How far a body drives without a code or light so that it still finds itself at the next, as its
/// machine comes from assembly. Kept once worked out: no const thread safety.
class CodeReach {
public:
    CodeReach(const plant::VehicleType& type, bool loaded);
    const std::vector<plant::Camera>& cameras() const { return cameras_; }
    /// Of iGPS or reflectors.
    bool has_beacons() const { return receiver_m_ > 0 || scanner_.has_value(); }
    const localisation::OdometryNoise& noise() const { return noise_; }
    /// By localisation::blind_way_m, of its best camera.
    double at_most_m(double size_m) const;
    /// A stretch of the way as long as at_most_m counts it: with the turns on it.
    double as_straight_m(double from_m, double to_m, std::span<const TurnAt> turns) const;
    /// Until beacons are seen again: as long as it stays on the floor that traffic keeps beside it.
    double in_the_dark_m() const;
    /// Whether the light of two transmitters falls on it there, or it sees three reflectors, looked
    /// at cell by cell.
    bool is_lit(const plant::Plant& plant, const plant::HallId& hall, geometry::Point2 at) const;
    /// One sigma [m] of the place of the body's middle, both axes together, as it is on an average
    /// of a lane where it begins well known: what the lane by itself leaves unknown. 0 for bodies
    /// without senses, and in plants without anything for them: all lanes are alike then.
    double mean_sigma_m(const plant::Plant& plant, const plant::HallId& hall,
                        const kinematics::Segment& lane) const;

private:
    std::vector<plant::Camera> cameras_;
    double receiver_m_ = 0;  // how high they sit; 0: it has none
    std::optional<plant::NavigationScanner> scanner_;
    localisation::OdometryNoise noise_;
    localisation::KnownPose known_;               // by what it finds itself by
    double arm_m_ = 0;                            // of the camera that lies farthest out
    mutable std::map<double, double> at_most_m_;  // by size
    mutable std::optional<double> in_the_dark_m_;
    mutable std::map<std::tuple<plant::HallId, int, int>, bool> lit_;
};

}  // namespace pulseline::planning
