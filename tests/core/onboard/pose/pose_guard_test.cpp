#include "core/onboard/pose/pose_guard.hpp"

#include <gtest/gtest.h>

#include "tests/core/control/demo_vehicles.hpp"

namespace pulseline::onboard {
namespace {

using Advice = PoseGuard::Advice;

PoseEstimate measured(const localisation::OdometryNoise& noise) {
    PoseEstimate estimate{geometry::Pose2{}, noise};
    localisation::PoseFix fix;
    fix.covariance = {{{1e-6, 0, 0}, {0, 1e-6, 0}, {0, 0, 1e-8}}};
    estimate.take(fix);
    return estimate;
}

/// Way in metres after which each advice is given first.
struct Ways {
    double slow_m = -1;
    double stay_m = -1;
};

Ways ways(const plant::VehicleType& type, bool loaded, PoseEstimate estimate) {
    const PoseGuard guard(type, loaded);
    Ways found;
    for (double at_m = 0; at_m < 2000 && found.stay_m < 0; at_m += 0.1) {
        estimate.drive_to({at_m, 0, 0});
        const Advice advice = guard.advice(estimate);
        if (advice != Advice::kDrive && found.slow_m < 0) found.slow_m = at_m;
        if (advice == Advice::kStay) found.stay_m = at_m;
        if (advice != Advice::kStay && !estimate.driven_since_said_m()) {
            EXPECT_LE(guard.reach_m(estimate), PoseGuard::kHeld_m) << at_m;
        }
    }
    return found;
}

localisation::OdometryNoise noise(const plant::VehicleType& type) {
    return localisation::odometry_noise({}, type);
}

TEST(PoseGuard, FirstItSlowsDownThenItStays) {
    for (const auto& type : {pulseline::testing::mecanum(), pulseline::testing::differential(),
                             pulseline::testing::platform()}) {
        const auto found = ways(type, false, measured(noise(type)));
        EXPECT_GT(found.slow_m, 12) << type.name << ": codes lie 9 m apart";
        EXPECT_GT(found.stay_m, found.slow_m) << type.name;
        EXPECT_LT(found.stay_m, 200) << type.name;
    }
}

TEST(PoseGuard, ALongLoadReachesFarther) {
    auto type = pulseline::testing::platform();
    const auto empty = ways(type, false, measured(noise(type)));
    type.load_footprint = geometry::rectangle(30, 10);
    const auto loaded = ways(type, true, measured(noise(type)));
    EXPECT_LT(loaded.stay_m, empty.stay_m);
}

TEST(PoseGuard, FromWhereAPersonSaidItDrivesSlowlyToTheNextCode) {
    const auto type = pulseline::testing::differential();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({});
    const auto found = ways(type, false, estimate);
    EXPECT_EQ(found.slow_m, 0);
    EXPECT_GT(found.stay_m, 18);
    EXPECT_LT(found.stay_m, 30);
}

TEST(PoseGuard, WhereCodesHaveToldItItDrivesAtOnce) {
    const auto type = pulseline::testing::differential();
    PoseEstimate estimate{geometry::Pose2{}, noise(type)};
    estimate.start_at({}, 0.002, 0.002);
    EXPECT_EQ(PoseGuard(type, false).advice(estimate), Advice::kDrive);
}

}  // namespace
}  // namespace pulseline::onboard
