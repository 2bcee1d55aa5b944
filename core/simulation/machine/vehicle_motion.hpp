#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "core/localisation/odometry_noise.hpp"
#include "core/onboard/motion/path_reference.hpp"
#include "core/simulation/machine/simulated_drive.hpp"

namespace pulseline::simulation {

using geometry::Pose2;

/// What separates the true motion of a platform from what its odometry believes: standard
/// deviations of seeded errors. The defaults end a 20 m drive typically 3 to 8 mm and some
/// hundredths of a degree off, as Tang 2020 measured before correcting.
struct MotionErrors {
    double distance_scale = 1.5e-4;   // encoder scale, constant per vehicle
    double turn_scale = 3e-4;         // same for turns
    double steering_bias_rad = 6e-5;  // wheels not quite parallel, constant per vehicle
    double slip_m_per_sqrt_m = 3e-4;  // wheel slip, random walk along and across
    double heading_rad_per_sqrt_m = 9e-5;
    double heading_rad_per_sqrt_rad = 2e-4;
    double settle_m = 1e-3;  // sag of the chassis when it brakes from full speed
    double settle_rad = 1.1e-3;
    // Corrective moves: scale and offset along the move are constant per vehicle and kind of move
    // (ahead, sideways, turn), which can be learned; the rest is new in each move.
    double fine_scale = 0.03;
    double fine_offset_m = 3e-4;
    double fine_offset_rad = 0.01 * kPi / 180;
    double fine_m = 2e-4;  // along and across
    double fine_rad = 0.005 * kPi / 180;
};

/// What its program supposes of a drive that errs so.
localisation::OdometryNoise odometry_noise(const MotionErrors& errors);

/// The statistical drive: a pose that follows the reference with seeded errors, without wheels or
/// motors. It is cheap, so that thousands of hours of large fleets can be simulated.
/// Deterministic: the same seed and steps give the same poses.
class VehicleMotion final : public SimulatedDrive {
public:
    /// Speeds are multiplied by `time_factor`, accelerations by its square.
    VehicleMotion(plant::VehicleType type, const Pose2& true_pose, std::uint64_t seed,
                  double time_factor = 1, const MotionErrors& errors = {});

    void append(const kinematics::Segment& segment, double max_speed_mps = 0) override;
    void correct(std::span<const kinematics::Segment> moves) override;
    void steer(const kinematics::Twist& twist) override { reference_.steer(believed_, twist); }
    void hold() override { reference_.hold(); }
    void release() override { reference_.release(); }
    void slow_to(double share) override { reference_.slow_to(share); }
    void clear() override { reference_.clear(); }
    void step(double dt_s) override;

    bool standing() const override { return reference_.standing(); }
    bool idle() const override { return reference_.standing() && reference_.empty(); }
    std::size_t rests() const override { return rests_; }
    std::size_t segments_done() const override { return reference_.segments_done(); }
    double remaining_m() const override { return reference_.remaining_m(); }
    double braking_m() const override { return reference_.braking_m(); }
    double run_ahead_m() const override { return reference_.run_ahead_m(); }
    double distance_on_segment_m() const override { return reference_.distance_on_segment_m(); }
    const kinematics::Segment* current() const override { return reference_.current(); }

    const Pose2& true_pose() const override { return true_; }
    void carry(const Pose2& by) override { true_ = true_ * by; }
    const Pose2& believed_pose() const override { return believed_; }
    void set_believed(const Pose2& pose) override;
    const plant::VehicleType& type() const override { return type_; }
    double time_factor() const override { return time_factor_; }
    double velocity_mps() const override { return reference_.velocity_mps(); }
    double turn_rate_radps() const override { return reference_.turn_rate_radps(); }
    kinematics::Twist twist() const override { return reference_.twist(); }
    /// Empty: it has none.
    std::vector<kinematics::WheelMotion> wheels() const override { return {}; }
    /// Never: its errors are too small.
    std::optional<Reason> stop_cause() const override { return std::nullopt; }
    void acknowledge() override {}

private:
    /// What a corrective move truly comes to, of the motion believed: ahead, sideways, turned.
    using TrueShare = std::array<double, 3>;
    /// How a vehicle's corrective moves of one kind differ from what is commanded.
    struct FineError {
        double scale = 1;
        double offset = 0;  // along the move
        double share_of(double size) const;
    };

    void take(const onboard::PathReference::Passed& passed);
    void displace(const onboard::PathReference::Passed& passed);
    void settle(double peak_rate);
    double normal(double sigma) { return sigma * unit_normal_(random_); }

    plant::VehicleType type_;
    double time_factor_;
    std::size_t rests_ = 0;
    MotionErrors errors_;
    std::mt19937_64 random_;
    std::normal_distribution<double> unit_normal_;
    double distance_scale_ = 0;
    double turn_scale_ = 0;
    double steering_bias_rad_ = 0;
    std::array<FineError, 3> fine_;      // ahead, sideways, turn
    std::deque<TrueShare> fine_shares_;  // of the corrective moves not yet driven

    Pose2 true_;
    Pose2 believed_;
    onboard::PathReference reference_;
};

}  // namespace pulseline::simulation
