#include "core/kinematics/dead_reckoning.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/kinematics/primitives.hpp"

namespace pulseline::kinematics {
namespace {

// Within a piece the body's motion is taken as a straight one.
constexpr double kPiece_m = 1.0;
constexpr double kPiece_rad = radians(10.0);
constexpr double kRollerSlip = 2;  // rollers touch the floor at points that come and go
constexpr double kRollerSideways = 3;
constexpr double kTwoWheelTurnScale = 2;

/// How far sideways the body moves at the beginning of a segment, from 0 to 1.
double sideways_share(const Segment& segment) { return std::abs(twist_along(segment, 0).vy_mps); }

/// Error of the pose so far: how it depends on the vehicle's constants, and what chance added.
class Growth {
public:
    explicit Growth(const DeadReckoningNoise& noise) : noise_(noise) {}

    void drive(const Pose2& from, const Pose2& to, double turn_rad, double sideways) {
        const double times = 1 + (noise_.sideways_times - 1) * sideways;
        const Point2 way = to.position() - from.position();
        const double way_m = norm(way);
        Eigen::Matrix3d carry = Eigen::Matrix3d::Identity();
        carry(0, 2) = -way.y_m;
        carry(1, 2) = way.x_m;
        Eigen::Matrix3d by_constants;  // columns: distance, direction, turn
        by_constants << times * way.x_m, -way.y_m, 0, times * way.y_m, way.x_m, 0, 0, 0, turn_rad;
        constants_ = carry * constants_ + by_constants;
        const double slip_rms_m = times * noise_.slip_m_per_sqrt_m;
        const double slip = slip_rms_m * slip_rms_m * way_m;
        const double heading =
            noise_.heading_rad_per_sqrt_m * noise_.heading_rad_per_sqrt_m * way_m +
            noise_.heading_rad_per_sqrt_rad * noise_.heading_rad_per_sqrt_rad * std::abs(turn_rad);
        chance_ = carry * chance_ * carry.transpose();
        chance_.diagonal() += Eigen::Vector3d(slip, slip, heading);
    }

    ExpectedDeviation deviation() const {
        const Eigen::Vector3d sigma(noise_.distance_scale, noise_.steering_bias_rad,
                                    noise_.turn_scale);
        const Eigen::Matrix3d spread = constants_ * sigma.asDiagonal();
        const Eigen::Matrix3d all = spread * spread.transpose() + chance_;
        return {std::sqrt(all(0, 0) + all(1, 1) + noise_.stop_m * noise_.stop_m),
                std::sqrt(all(2, 2) + noise_.stop_rad * noise_.stop_rad)};
    }

private:
    const DeadReckoningNoise& noise_;
    Eigen::Matrix3d constants_ = Eigen::Matrix3d::Zero();
    Eigen::Matrix3d chance_ = Eigen::Matrix3d::Zero();
};

}  // namespace

DeadReckoningNoise usual_noise(plant::Kinematics kinematics) {
    DeadReckoningNoise noise;
    switch (kinematics) {
        case plant::Kinematics::kSteeredPlatform:
            break;
        case plant::Kinematics::kDifferential:
            noise.turn_scale *= kTwoWheelTurnScale;
            break;
        case plant::Kinematics::kMecanum:
            noise.slip_m_per_sqrt_m *= kRollerSlip;
            noise.sideways_times = kRollerSideways;
            break;
    }
    return noise;
}

ExpectedDeviation expected_deviation(std::span<const Segment> segments,
                                     const DeadReckoningNoise& noise) {
    Growth growth(noise);
    for (const Segment& segment : segments) {
        const double pieces = std::max({1.0, std::ceil(std::abs(segment.length_m) / kPiece_m),
                                        std::ceil(std::abs(segment.turn_rad) / kPiece_rad)});
        Pose2 from = segment.start;
        for (int i = 1; i <= static_cast<int>(pieces); ++i) {
            const Pose2 to = pose_at(segment, i / pieces);
            growth.drive(from, to, segment.turn_rad / pieces, sideways_share(segment));
            from = to;
        }
    }
    return growth.deviation();
}

ExpectedDeviation learned_deviation(const ExpectedDeviation& usual,
                                    std::span<const ArrivalMiss> arrivals) {
    constexpr double kFamily = 2;  // arrivals that it counts like
    constexpr double kAtMost = 10;
    double position = kFamily;
    double heading = kFamily;
    for (const ArrivalMiss& arrival : arrivals) {
        const double m = std::min(kAtMost, arrival.position_m / arrival.usual.position_m);
        const double rad = std::min(kAtMost, arrival.heading_rad / arrival.usual.heading_rad);
        position += m * m;
        heading += rad * rad;
    }
    const double count = kFamily + static_cast<double>(arrivals.size());
    return {usual.position_m * std::sqrt(position / count),
            usual.heading_rad * std::sqrt(heading / count)};
}

}  // namespace pulseline::kinematics
