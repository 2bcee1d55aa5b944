#include "core/onboard/stop_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/localisation/codes_on_way.hpp"
#include "core/onboard/stop_procedure.hpp"
#include "tests/core/control/demo_vehicles.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard {
namespace {

using namespace simulation;

using pulseline::testing::differential;
using pulseline::testing::mecanum;

constexpr double kStep_s = 0.05;
constexpr double kReach_m = 0.1;

/// One camera at the body's middle; the code of the stop lies below it at the target.
class OneCamera : public StopSensing {
public:
    explicit OneCamera(const SimulatedDrive& motion) : motion_(motion) {}
    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override {
        ++looks;
        const double radius_m =
            localisation::view_radius_m(motion_.type().cameras.front(), target.markers[0].size_m);
        const Pose2& body = motion_.true_pose();
        if (distance(body.position(), target.target.position()) > radius_m) {
            return fail(Errc::kNotFound, "no_marker_in_view", "No code is in view.");
        }
        return vda5050::StopMeasurement{body, 1e-4, 1e-4, "test", {"ST01"}};
    }
    int looks = 0;

private:
    const SimulatedDrive& motion_;
};

plant::VehicleType seeing(plant::VehicleType type) {
    type.cameras = {plant::Camera{}};
    return type;
}

class StopSearch : public ::testing::Test {
protected:
    /// It believes to stand at the target and stands `off` it.
    StopProcedure::Outcome look_for_it(const plant::VehicleType& type, const Pose2& off) {
        vda5050::StopTarget target{"st01", 1, {5, 3, 0.4}, 0.025, 0.025, radians(0.2), {}};
        target.markers.push_back({"ST01", "qr", 0.05, target.target, 1e-4, 5e-4});
        VehicleMotion motion(type, target.target * off, 1);
        motion.set_believed(target.target);
        OneCamera sensing(motion);
        StopProcedure procedure(motion, sensing);
        farthest_m = 0;
        procedure.start(target, true);
        for (int i = 0; i < 20'000; ++i) {
            motion.step(kStep_s);
            const auto outcome = procedure.step(kStep_s);
            // Until it has seen where it is.
            const Pose2 believed = inverse(motion.believed_pose()) * target.target;
            if (distance(motion.believed_pose().position(), motion.true_pose().position()) > 0.02)
                farthest_m = std::max(farthest_m, norm(believed.position()));
            if (!outcome) continue;
            looks = sensing.looks;
            if (outcome->succeeded) {
                procedure.start(target, false);
                std::optional<StopProcedure::Outcome> measured;
                for (int k = 0; k < 100 && !measured; ++k) measured = procedure.step(kStep_s);
                knows_arrival = measured && measured->measurement && measured->measurement->arrived;
            }
            off_m = distance(motion.true_pose().position(), target.target.position());
            believed_off_m = norm(believed.position());
            return *outcome;
        }
        ADD_FAILURE() << "the procedure does not end";
        return {};
    }
    bool knows_arrival = false;
    double farthest_m = 0;  // from the target as it believed while it searched
    double off_m = 0;       // at the end
    double believed_off_m = 0;
    int looks = 0;
};

TEST_F(StopSearch, FindsTheCodesAllRoundWhereTheyShouldBe) {
    for (const auto& type : {seeing(mecanum()), seeing(pulseline::testing::platform())}) {
        for (int i = 0; i < 16; ++i) {
            for (const double away_m : {0.06, 0.09, 0.105}) {
                const double to_rad = i * kPi / 8;
                const auto outcome = look_for_it(
                    type, {away_m * std::cos(to_rad), away_m * std::sin(to_rad), 0.004});
                EXPECT_TRUE(outcome.succeeded) << type.name << " " << away_m << " m to "
                                               << degrees(to_rad) << ": " << outcome.why_not;
                EXPECT_LE(off_m, 0.005);
                EXPECT_LE(farthest_m, kReach_m) << "it holds no floor beyond";
                EXPECT_FALSE(outcome.measurement && outcome.measurement->arrived)
                    << "nobody saw where the drive had ended";
                EXPECT_FALSE(knows_arrival) << "measured where it was adjusted to";
            }
        }
    }
}

TEST_F(StopSearch, EndsWhereItBeganWhenThereIsNothingToFind) {
    const auto outcome = look_for_it(seeing(mecanum()), {0.5, 0, 0});
    EXPECT_FALSE(outcome.succeeded);
    EXPECT_EQ(outcome.why_not.rfind("no_marker_in_view", 0), 0u) << outcome.why_not;
    EXPECT_FALSE(outcome.measurement);
    EXPECT_LE(believed_off_m, 0.003);
    EXPECT_LE(farthest_m, kReach_m);
    EXPECT_EQ(looks, 10) << "where it stood, eight round it, and where it stood";
}

TEST_F(StopSearch, WhoCannotMoveSidewaysLooksAheadAndBehind) {
    for (const double away_m : {0.09, -0.09}) {
        EXPECT_TRUE(look_for_it(seeing(differential()), {away_m, 0.01, 0}).succeeded) << away_m;
        EXPECT_LE(off_m, 0.0045);
    }
    EXPECT_FALSE(look_for_it(seeing(differential()), {0, 0.2, 0}).succeeded);
    EXPECT_EQ(looks, 5) << "where it stood, ahead, there again, behind, there again";
}

TEST_F(StopSearch, WithoutACameraOrACodeThereIsNothingToSearchBy) {
    const auto type = seeing(mecanum());
    vda5050::StopTarget target{"st01", 1, {5, 3, 0.4}, 0.025, 0.025, radians(0.2), {}};
    EXPECT_TRUE(search_places(type, target, kReach_m).empty());
    target.markers.push_back({"ST01", "qr", 0.05, target.target, 1e-4, 5e-4});
    EXPECT_FALSE(search_places(type, target, kReach_m).empty());
    EXPECT_TRUE(search_places(mecanum(), target, kReach_m).empty());
    target.markers[0].size_m = 0.5;
    EXPECT_TRUE(search_places(type, target, kReach_m).empty()) << "larger than the picture";
}

}  // namespace
}  // namespace pulseline::onboard
