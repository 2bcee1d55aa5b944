#include "core/control/seen_points.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/base/angle.hpp"

namespace pulseline::control {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// A scanner at the body's origin that looks all round in steps of half a degree; what it sees is
/// `range_m` away between two bearings.
Scan seeing(double from_deg, double to_deg, float range_m) {
    Scan scan;
    scan.first_rad = -kPi;
    scan.step_rad = radians(0.5);
    scan.ranges_m.assign(721, std::numeric_limits<float>::infinity());
    for (int i = 0; i <= 720; ++i) {
        const double deg = -180 + 0.5 * i;
        if (deg >= from_deg && deg <= to_deg) scan.ranges_m[static_cast<std::size_t>(i)] = range_m;
    }
    return scan;
}

TEST(SeenPoints, KeepWhatWasSeenFromElsewhere) {
    SeenPoints seen;
    seen.take(seeing(-5, 5, 2), {10, 5, 0});
    for (const Point2& p : seen.points()) EXPECT_NEAR(distance(p, {10, 5}), 2, 0.08);
    const auto before = seen.points().size();
    EXPECT_GT(before, 5u);
    // From here the same thing hides behind another one.
    seen.take(seeing(160, 180, 1), {14, 5, 0});
    EXPECT_GT(seen.points().size(), before);
}

TEST(SeenPoints, ForgetWhatALaterScanSeesThrough) {
    SeenPoints seen;
    seen.take(seeing(-5, 5, 2), {10, 5, 0});
    seen.take(seeing(-5, 5, 4), {10, 5, 0});
    for (const Point2& p : seen.points()) EXPECT_NEAR(distance(p, {10, 5}), 4, 0.08);
    seen.take(seeing(-5, 5, std::numeric_limits<float>::infinity()), {10, 5, 0});
    EXPECT_TRUE(seen.empty()) << "no return is free floor, too";
}

TEST(SeenPoints, NoiseOfTheScannerForgetsNothing) {
    SeenPoints seen;
    seen.take(seeing(-5, 5, 2), {10, 5, 0});
    const auto before = seen.points().size();
    seen.take(seeing(-5, 5, 2.04F), {10, 5, 0});
    EXPECT_GE(seen.points().size(), before);
}

}  // namespace
}  // namespace pulseline::control
