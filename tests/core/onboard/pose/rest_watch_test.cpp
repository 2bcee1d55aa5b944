#include "core/onboard/pose/rest_watch.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "core/simulation/machine/servo_drive.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using geometry::Pose2;

constexpr double kLength_m = 4;
constexpr int kMachines = 60;
constexpr double kStep_s = 0.1;  // as server/agent steps where no code is near

struct Drives {
    std::size_t rests = 0;
    double nees = 0;  // chi-square of 3
};

/// Ahead and back, twice, from where a stop was measured.
Drives to_and_fro(const plant::VehicleType& type, std::uint64_t seed) {
    simulation::ServoDrive drive(type, Pose2{}, seed);
    PoseEstimate estimate(Pose2{}, localisation::odometry_noise({}, type));
    localisation::PoseFix stop;
    stop.covariance = {{{1e-8, 0, 0}, {0, 1e-8, 0}, {0, 0, 1e-10}}};
    estimate.take(stop);
    RestWatch watch(drive, estimate);
    for (const double from_m : {0.0, kLength_m, 0.0, kLength_m}) {
        drive.append(
            simulation::testing::straight({from_m, 0, 0}, kLength_m, from_m > 0 ? kPi : 0));
    }
    for (double left_s = 600; left_s > 0 && !(drive.idle() && drive.standing());
         left_s -= kStep_s) {
        drive.step(kStep_s);
        watch.step();
        estimate.drive_to(drive.believed_pose());
    }
    const Pose2 off = drive.true_pose();
    const Eigen::Vector3d error{off.x_m - estimate.pose().x_m, off.y_m - estimate.pose().y_m,
                                wrap(off.heading_rad - estimate.pose().heading_rad)};
    return {drive.rests(), error.dot(estimate.covariance().inverse() * error)};
}

/// The brakes fall in between two segments for less than a step of the vehicle's program: one that
/// looks only whether its drive stands counts one rest of four.
TEST(RestWatch, CountsTheRestsBetweenTwoSegments) {
    for (const auto& type : {testing::platform(), testing::mecanum(), testing::differential()}) {
        double nees = 0;
        for (int seed = 1; seed <= kMachines; ++seed) {
            const Drives made = to_and_fro(type, static_cast<std::uint64_t>(seed));
            ASSERT_EQ(made.rests, 4U) << type.name;
            nees += made.nees / kMachines;
        }
        EXPECT_LT(nees, 4) << type.name;
        EXPECT_GT(nees, 1.8) << type.name;
    }
}

}  // namespace
}  // namespace pulseline::onboard
