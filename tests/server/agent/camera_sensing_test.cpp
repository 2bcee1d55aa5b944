#include "server/agent/camera_sensing.hpp"

#include <gtest/gtest.h>

#include "core/localisation/codes_on_way.hpp"
#include "core/localisation/reading_speed.hpp"
#include "core/simulation/machine/vehicle_motion.hpp"
#include "core/simulation/world/world.hpp"
#include "tests/server/agent/small_hall.hpp"

namespace pulseline::agent {
namespace {

using testing::small_plant;
using testing::target_of;

TEST(CameraSensing, MeasuresTheTruePoseFromRenderedImages) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20.004, 9.995, 0.001}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, true, 3);
    const auto measured = sensing.measure(target_of(world.plant));
    ASSERT_TRUE(measured) << measured.error().what;
    EXPECT_EQ(measured->method, "dual_camera");
    EXPECT_LT(distance(measured->pose.position(), motion.true_pose().position()), 5e-4);
    EXPECT_NEAR(measured->pose.heading_rad, 0.001, 1e-4);
}

TEST(CameraSensing, PicturesOutliveTheReadingsOfAPlaceTheVehicleLeft) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, true, 3);
    sensing.look();
    sensing.forget();
    EXPECT_TRUE(sensing.readings().empty());
    const auto pictures = sensing.pictures();
    ASSERT_EQ(pictures.size(), 2u);
    EXPECT_EQ(pictures[0].jpeg.substr(0, 2), "\xff\xd8");
}

TEST(CameraSensing, CoveredCodesFailWithTheReason) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, false, 3);
    ASSERT_TRUE(sensing.measure(target_of(world.plant)));
    sensing.cover();
    const auto blind = sensing.measure(target_of(world.plant));
    ASSERT_FALSE(blind);
    EXPECT_EQ(blind.error().reason.code, "no_marker_in_view");
}

/// Drives along the platform's front code at full speed, its name said to be `payload`.
std::vector<onboard::WayReading> passed(bool rendered, const std::string& payload, bool dark,
                                        double expect_y_m = 10) {
    const auto world = simulation::make_world(small_plant(), 1);
    simulation::VehicleMotion motion(world.plant.vehicle_types[0], {18, 10, 0}, 1);
    kinematics::Segment segment;
    segment.start = motion.believed_pose();
    segment.end = {26, 10, 0};
    segment.length_m = 8;
    motion.append(segment);
    CameraSensing sensing(world, plant::HallId("hall"), motion, rendered, 3);
    if (dark) sensing.darken();
    const vda5050::SurveyedMarker marker{payload, "qr", 0.06, {20 + 5.346, expect_y_m, 0},
                                         1e-4,    5e-4};
    std::vector<onboard::WayReading> all;
    for (int i = 0; i < 5000 && !motion.idle(); ++i) {
        motion.step(0.02);
        for (auto& reading :
             sensing.look_below(std::span(&marker, 1), motion.believed_pose(), 0.02)) {
            // Where the code was when the picture was taken.
            const double then_x_m = motion.true_pose().x_m - motion.twist().vx_mps * reading.age_s;
            EXPECT_NEAR(then_x_m + reading.seen.centre.x_m, 25.346, 5e-3);
            EXPECT_NEAR(reading.seen.centre.y_m + motion.true_pose().y_m, 10, 2e-3);
            EXPECT_GT(reading.age_s, 0.01);
            all.push_back(std::move(reading));
        }
    }
    EXPECT_TRUE(motion.idle());
    EXPECT_FALSE(sensing.take_fresh()) << "these are no pictures for people";
    return all;
}

/// Of a code below a vehicle that stands, looked at in steps of `step_s` for ten seconds.
std::size_t read_in_ten_seconds(double step_s) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, false, 3);
    const vda5050::SurveyedMarker marker{"ST01-F", "qr", 0.06, {20 + 5.346, 10, 0}, 1e-4, 5e-4};
    std::size_t read = 0;
    for (int i = 0; i < static_cast<int>(10 / step_s); ++i) {
        read += sensing.look_below(std::span(&marker, 1), motion.believed_pose(), step_s).size();
    }
    return read;
}

TEST(CameraSensing, ExposesSixtyTimesASecondHoweverLongItsStepsAre) {
    // Up to five of them are not read yet when the time is over.
    for (const double step_s : {1.0 / 60, 0.0125, 0.01, 0.005}) {
        EXPECT_NEAR(static_cast<double>(read_in_ten_seconds(step_s)), 597.5, 3) << step_s;
    }
    // No more than one a step.
    EXPECT_NEAR(static_cast<double>(read_in_ten_seconds(0.05)), 199, 1.5);
}

TEST(CameraSensing, ReadsACodeThatItPassesOver) {
    for (const bool rendered : {false, true}) {
        const auto readings = passed(rendered, "ST01-F", false);
        ASSERT_FALSE(readings.empty()) << rendered;
        EXPECT_EQ(readings[0].seen.payload, "ST01-F");
        // Smear and clock make it worse than a code seen standing.
        EXPECT_GT(readings[0].seen.sigma_m, 3e-4);
    }
}

/// Of `kPasses` drives at `speed_mps` over the front code, beside it by half of what it may lie
/// beside and each begun a little farther on than the one before, those on which it was read.
constexpr int kPasses = 12;
constexpr double kFrames_hz = 30;  // slower than the steps
int passes_read(bool rendered, double speed_mps, double exposure_s) {
    const auto world = simulation::make_world(small_plant(), 1);
    auto type = world.plant.vehicle_types[0];
    type.max_speed_mps = speed_mps;
    type.max_accel_mps2 = 10;
    for (auto& camera : type.cameras) {
        camera.exposure_s = exposure_s;
        camera.frame_rate_hz = kFrames_hz;
    }
    const auto& code = world.plant.markers[0];
    const vda5050::SurveyedMarker marker{code.payload, "qr", code.size_m, code.pose, 1e-4, 5e-4};
    const double beside_m = localisation::view_radius_m(type.cameras[0], code.size_m) / 2;
    int read = 0;
    for (int pass = 0; pass < kPasses; ++pass) {
        kinematics::Segment segment;
        segment.start = {18 + 0.017 * pass, code.pose.y_m + beside_m, 0};
        segment.end = segment.start * geometry::Pose2{4, 0, 0};
        segment.length_m = 4;
        simulation::VehicleMotion motion(type, segment.start, 1, 1, simulation::testing::exact());
        motion.append(segment);
        CameraSensing sensing(world, plant::HallId("hall"), motion, rendered, 3);
        bool seen = false;
        for (int i = 0; i < 5000 && !motion.idle() && !seen; ++i) {
            motion.step(0.02);
            // Where it is not near, nothing is expected, and no picture rendered.
            const auto foot = motion.believed_pose() * type.cameras[0].body_from_camera.position();
            const bool near = distance(foot, code.pose.position()) < 0.4;
            const std::span<const vda5050::SurveyedMarker> expected(&marker, near ? 1 : 0);
            for (const auto& one : sensing.look_below(expected, motion.believed_pose(), 0.02)) {
                seen |= one.seen.payload == marker.payload;
            }
        }
        read += seen;
    }
    return read;
}

/// As fast as a camera surely reads it, it does each time; far above, the code lies between two
/// pictures, or is smeared. Cameras differ a little from what is known of them: hence nine tenths.
TEST(CameraSensing, ReadsACodeAtItsHighestSpeedAndMissesItFarAbove) {
    plant::Camera camera;
    camera.frame_rate_hz = kFrames_hz;
    camera.exposure_s = 5e-5;
    const double by_frames_mps = localisation::reading_speed_mps(camera, 0.06);
    camera.exposure_s = 1e-2;
    const double by_smear_mps = localisation::reading_speed_mps(camera, 0.06);
    ASSERT_LT(20 * by_smear_mps, by_frames_mps);
    for (const bool rendered : {false, true}) {
        EXPECT_EQ(passes_read(rendered, by_frames_mps, 5e-5), kPasses) << rendered;
        const int between = passes_read(rendered, 2.5 * by_frames_mps, 5e-5);
        EXPECT_LT(between, kPasses * 3 / 4) << rendered;
        EXPECT_GT(between, 0) << rendered << ": chance, no more";
        EXPECT_EQ(passes_read(rendered, 0.9 * by_smear_mps, 1e-2), kPasses) << rendered;
        EXPECT_EQ(passes_read(rendered, 20 * by_smear_mps, 1e-2), 0) << rendered;
    }
}

TEST(CameraSensing, UnderWayItSeesNothingInTheDarkAndNamesACodeThatLiesInAnothersPlace) {
    EXPECT_TRUE(passed(true, "ST01-F", true).empty());
    EXPECT_TRUE(passed(false, "ST01-F", true).empty());
    for (const bool rendered : {false, true}) {
        const auto readings = passed(rendered, "ST02-F", false);
        ASSERT_FALSE(readings.empty()) << rendered;
        EXPECT_EQ(readings[0].marker.payload, "ST02-F");
        EXPECT_EQ(readings[0].seen.payload, "ST01-F");
    }
    EXPECT_TRUE(passed(false, "ST01-F", false, 10.5).empty()) << "none was exposed there";
}

/// The camera knows of the codes what the order says and nothing of the world.
TEST(CameraSensing, ASurveyOfTheWrongKindOrSizeShows) {
    const auto world = simulation::make_world(small_plant(), 1);
    const simulation::VehicleMotion motion(world.plant.vehicle_types[0], {20, 10, 0}, 1);
    CameraSensing sensing(world, plant::HallId("hall"), motion, true, 3);
    ASSERT_TRUE(sensing.measure(target_of(world.plant)));
    for (const char* kind : {"apriltag", "landmark", "no kind"}) {
        auto target = target_of(world.plant);
        for (auto& marker : target.markers) marker.kind = kind;
        EXPECT_FALSE(sensing.measure(target)) << kind;
    }
    auto target = target_of(world.plant);
    for (auto& marker : target.markers) marker.size_m = 0.05;  // 0.06 m are printed
    EXPECT_FALSE(sensing.measure(target));
}

}  // namespace
}  // namespace pulseline::agent
