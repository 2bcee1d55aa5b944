#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <variant>

#include "core/simulation/machine/servo_drive.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::simulation {
namespace {

using pulseline::testing::differential;
using pulseline::testing::mecanum;
using pulseline::testing::platform;
using simulation::testing::straight;

constexpr double kStep_s = 0.05;

struct Case {
    plant::VehicleType type;
    std::string wheel;
};

std::vector<Case> cases() {
    return {{platform(), "front drive"}, {mecanum(), "FL"}, {differential(), "left"}};
}

/// A vehicle at full speed on a way of 40 m, far from its end.
std::unique_ptr<ServoDrive> driving(const plant::VehicleType& type) {
    auto drive = std::make_unique<ServoDrive>(type, Pose2{}, 3);
    drive->append(straight({}, 40));
    while (drive->velocity_mps() < 0.95 * type.max_speed_mps) drive->step(kStep_s);
    return drive;
}

/// Runs on until it stands; where it should have come to rest at the latest comes back.
double brake(ServoDrive& drive) {
    const double v = drive.velocity_mps();
    const double latest_m = drive.true_pose().x_m + v * v / (2 * drive.type().max_accel_mps2) +
                            v * 0.6;  // noticing takes a moment
    for (int i = 0; i < 600; ++i) drive.step(kStep_s);
    return latest_m;
}

double number(const Reason& reason) { return std::get<double>(reason.params.at(0).value); }

TEST(ServoFaults, ABrokenWheelStopsTheDriveOnItsPathUntilItIsMended) {
    for (const auto& [type, wheel] : cases()) {
        const auto driven = driving(type);
        ServoDrive& drive = *driven;
        ASSERT_TRUE(drive.break_wheel(wheel));
        const double latest_m = brake(drive);
        ASSERT_TRUE(drive.stop_cause());
        EXPECT_EQ(drive.stop_cause()->code, "wheel_fault");
        EXPECT_EQ(std::get<std::string>(drive.stop_cause()->params.at(0).value), wheel);
        EXPECT_TRUE(drive.standing());
        EXPECT_LT(drive.true_pose().x_m, latest_m);
        EXPECT_LT(std::abs(drive.true_pose().y_m), 0.1);
        const Pose2 here = drive.true_pose();
        drive.release();
        drive.acknowledge();
        for (int i = 0; i < 100; ++i) drive.step(kStep_s);
        EXPECT_EQ(drive.true_pose(), here);
        EXPECT_TRUE(drive.stop_cause());
    }
}

TEST(ServoFaults, ABrokenSteeringDriveKeepsAStandingVehicleFromMoving) {
    ServoDrive drive(platform(), {}, 3);
    ASSERT_TRUE(drive.break_wheel("FL"));
    drive.append(straight({}, 5));
    for (int i = 0; i < 100; ++i) drive.step(kStep_s);
    EXPECT_EQ(drive.stop_cause()->code, "wheel_fault");
    EXPECT_EQ(drive.true_pose(), Pose2{});
}

TEST(ServoFaults, ADeadEncoderIsNoticedByWhatDoesNotFollow) {
    for (const auto& [type, wheel] : cases()) {
        const auto driven = driving(type);
        ServoDrive& drive = *driven;
        ASSERT_TRUE(drive.kill_encoder(wheel));
        const double latest_m = brake(drive);
        ASSERT_TRUE(drive.stop_cause()) << type.name;
        EXPECT_EQ(drive.stop_cause()->code, "wheel_fault");
        EXPECT_TRUE(drive.standing());
        EXPECT_LT(drive.true_pose().x_m, latest_m);
        EXPECT_LT(std::abs(drive.true_pose().y_m), 0.2);
    }
}

TEST(ServoFaults, AWheelThatSlipsStopsTheDriveWithItsShareAndItGoesOnWhenAcknowledged) {
    for (const auto& [type, wheel] : cases()) {
        const auto driven = driving(type);
        ServoDrive& drive = *driven;
        ASSERT_TRUE(drive.set_slip(wheel, 0.2));
        const double latest_m = brake(drive);
        ASSERT_TRUE(drive.stop_cause()) << type.name;
        EXPECT_EQ(drive.stop_cause()->code, "slip");
        EXPECT_GT(number(*drive.stop_cause()), 0.07);
        EXPECT_LT(number(*drive.stop_cause()), 0.3);
        EXPECT_TRUE(drive.standing());
        EXPECT_LT(drive.true_pose().x_m, latest_m);

        drive.set_slip(wheel, 0);
        drive.set_believed(drive.true_pose());
        const Pose2 from = drive.true_pose();
        drive.clear();
        drive.acknowledge();
        drive.append(straight(from, 3));
        for (int i = 0; i < 600; ++i) drive.step(kStep_s);
        EXPECT_FALSE(drive.stop_cause());
        EXPECT_LT(distance((from * Pose2{3, 0, 0}).position(), drive.true_pose().position()), 0.01);
    }
}

TEST(ServoFaults, WithoutMeasuringWheelsNobodySeesAllWheelsSlip) {
    plant::VehicleType type = differential();
    type.slip_sensor.reset();
    const auto driven = driving(type);
    ServoDrive& drive = *driven;
    for (const char* wheel : {"left", "right"}) drive.set_slip(wheel, 0.2);
    for (int i = 0; i < 1200; ++i) drive.step(kStep_s);
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_LT(drive.true_pose().x_m, 36);
}

TEST(ServoFaults, TheNoiseOfMeasuringWheelsStopsNobody) {
    for (auto type : {platform(), mecanum(), differential()}) {
        type.slip_sensor = plant::SlipSensor{0.004};  // twice what is usual
        ServoDrive drive(type, {}, 5);
        for (int leg = 0; leg < 20; ++leg) {
            drive.append(straight({1.0 * leg, 0, 0}, 1));
            for (int i = 0; i < 1200 && !drive.idle(); ++i) drive.step(kStep_s);
            ASSERT_FALSE(drive.stop_cause()) << type.name << ", leg " << leg;
        }
    }
}

TEST(ServoFaults, ASlightSlipIsNotNoticedButFound) {
    const auto driven = driving(mecanum());
    ServoDrive& drive = *driven;
    for (const char* wheel : {"FL", "FR", "BL", "BR"}) drive.set_slip(wheel, 0.03);
    for (int i = 0; i < 1200; ++i) drive.step(kStep_s);
    EXPECT_FALSE(drive.stop_cause());
    EXPECT_TRUE(drive.idle());
    EXPECT_NEAR(drive.believed_pose().x_m, 40, 0.01);
    EXPECT_LT(drive.true_pose().x_m, 39.1);
}

TEST(ServoFaults, AVehicleFarFromItsPathDoesNotDrive) {
    ServoDrive drive(mecanum(), {0, 0.3, 0}, 3);
    drive.append(straight({}, 5));
    for (int i = 0; i < 100; ++i) drive.step(kStep_s);
    ASSERT_TRUE(drive.stop_cause());
    EXPECT_EQ(drive.stop_cause()->code, "off_path");
    EXPECT_NEAR(number(*drive.stop_cause()), 0.3, 0.01);
    EXPECT_TRUE(drive.standing());
    EXPECT_EQ(drive.true_pose().x_m, 0);
}

TEST(ServoFaults, OnlyWheelsThatThereAreCanFail) {
    ServoDrive drive(platform(), {}, 3);
    EXPECT_FALSE(drive.break_wheel("fifth"));
    EXPECT_FALSE(drive.set_slip("fifth", 0.2));
    EXPECT_FALSE(drive.kill_encoder("fifth"));
    EXPECT_FALSE(drive.kill_encoder("FL"));  // it has no motor that rolls it
}

}  // namespace
}  // namespace pulseline::simulation
