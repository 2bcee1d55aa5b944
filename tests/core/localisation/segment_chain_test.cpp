#include "core/localisation/segment_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/localisation/codes_on_way.hpp"

namespace pulseline::localisation {
namespace {

/// The example of the corrected eq. 5: limit 12 mm, s0 1 mm, C s 0.02, view 140 mm, code 50 mm.
constexpr double kLimit_m = 0.012;
constexpr double kAtCode_m = 0.001;
constexpr double kPerMetre = 0.02;
constexpr double kSeen_m = 0.140 - 0.050;

double linear_m(double from_m, double to_m) { return kPerMetre * (to_m - from_m); }

CodePass pass_at(std::size_t code, double middle_m) {
    CodePass pass;
    pass.code = code;
    pass.from_m = middle_m - kSeen_m / 2;
    pass.to_m = middle_m + kSeen_m / 2;
    pass.sigma_m = kAtCode_m;
    pass.caught_within_m = (kSeen_m / 2 - kAtCode_m) / kPerMetre;
    return pass;
}

ChainTask way(double length_m, const std::vector<double>& codes_at_m) {
    ChainTask task;
    for (const double at_m : codes_at_m) task.passes.push_back(pass_at(task.passes.size(), at_m));
    task.length_m = length_m;
    task.start_sigma_m = kAtCode_m;
    task.limit_m = kLimit_m;
    task.motion_m = linear_m;
    return task;
}

/// Codes as far apart from each other as from start and end, where the vehicle stands on codes.
ChainTask evenly(double spacing_m, int codes) {
    std::vector<double> at_m;
    for (int i = 1; i <= codes; ++i) at_m.push_back(i * spacing_m - kSeen_m / 2);
    return way((codes + 1) * spacing_m - kSeen_m, at_m);
}

std::vector<std::size_t> codes_of(const SegmentChain& chain) {
    std::vector<std::size_t> codes;
    for (const auto& marker : chain.markers) codes.push_back(marker.code);
    return codes;
}

TEST(SegmentChain, TheSpacingOfEquationFiveIsTheLongestThatHolds) {
    const auto right = segment_chain(evenly(0.640, 30));
    ASSERT_TRUE(right);
    EXPECT_NEAR(right->worst_m, kLimit_m, 1e-9);
    EXPECT_EQ(right->markers.size(), 30u) << "none can be left out";
    const auto more = segment_chain(evenly(0.641, 30));
    ASSERT_FALSE(more);
    EXPECT_NEAR(more.error().at_most_m, 0.550, 2e-3) << "of 640 mm are 90 mm in view";
}

TEST(SegmentChain, TheSpacingThatEquationFivePrintsBreaksTheLimit) {
    const double printed_m = 2 * (kLimit_m - kAtCode_m) / kPerMetre + 0.050 - 0.140;
    EXPECT_NEAR(printed_m, 1.010, 1e-9);
    EXPECT_FALSE(segment_chain(evenly(printed_m, 30)));
    auto lenient = evenly(printed_m, 30);
    lenient.limit_m = 1;
    EXPECT_NEAR(kAtCode_m + linear_m(lenient.passes[0].to_m, lenient.passes[1].from_m), 0.0194,
                1e-9)
        << "where 12 mm are allowed";
}

/// Printed the other way round, eq. 6 asks that the mean of the segments' sigma be at least what
/// is allowed: one segment over the whole way would do.
TEST(SegmentChain, EquationSixAsPrintedWouldLeaveAllMarkersOut) {
    const auto task = evenly(0.640, 30);
    const double to_boundary_m = kAtCode_m + linear_m(0, task.passes.back().from_m);
    EXPECT_GE(to_boundary_m / 1, kLimit_m) << "as printed, N = 1 is content";
    EXPECT_GT(to_boundary_m, 30 * kLimit_m) << "and 0.38 m off at the boundary marker";
    const auto chain = segment_chain(task);
    ASSERT_TRUE(chain);
    EXPECT_LE(to_boundary_m / static_cast<double>(chain->markers.size() + 1), kLimit_m + 1e-3);
}

TEST(SegmentChain, AFewOfManyMarkersAreEnough) {
    const auto chain = segment_chain(evenly(0.160, 19));
    ASSERT_TRUE(chain);
    // 59 mm gathered over 2.9 m to the boundary marker, 12 mm allowed: five segments, by eq. 7.
    EXPECT_EQ(chain->markers.size(), 5u);
    EXPECT_EQ(chain->markers.back().code, 18u) << "the boundary marker is the last on the way";
    EXPECT_LE(chain->worst_m, kLimit_m + 1e-9);
    EXPECT_NEAR(chain->arrival_m, kAtCode_m + linear_m(0, 0.160 - kSeen_m), 1e-9);
}

TEST(SegmentChain, OfTwoEquallyGoodTheNearerToTheGoalIsTaken) {
    // Eq. 7 wants two segments of 0.5 m; both codes are 0.05 m off that.
    const auto chain = segment_chain(way(1.1, {0.45 + 0.045, 0.55 + 0.045, 1.0 + 0.045}));
    ASSERT_TRUE(chain);
    EXPECT_EQ(codes_of(*chain), (std::vector<std::size_t>{1, 2}));
}

TEST(SegmentChain, APoorCodeIsLeftOutWhereItLeadsNowhere) {
    auto task = way(1.5, {0.50, 0.55, 1.08});
    task.passes[1].sigma_m = 0.011;  // surveyed badly: 50 mm behind it the limit is reached
    const auto chain = segment_chain(task);
    ASSERT_TRUE(chain);
    EXPECT_EQ(codes_of(*chain), (std::vector<std::size_t>{0, 2}));
    task.passes[1].sigma_m = 0.013;
    EXPECT_TRUE(segment_chain(task)) << "worse than the limit: as if it were not there";
}

TEST(SegmentChain, AShortWayNeedsNoMarker) {
    const auto chain = segment_chain(way(0.5, {}));
    ASSERT_TRUE(chain);
    EXPECT_TRUE(chain->markers.empty());
    EXPECT_NEAR(chain->arrival_m, kAtCode_m + linear_m(0, 0.5), 1e-9);
}

TEST(SegmentChain, SaysWhereAMarkerHelps) {
    const auto chain = segment_chain(way(3, {0.5, 1.0, 2.0, 2.5}));
    ASSERT_FALSE(chain);
    EXPECT_NEAR(chain.error().middle_m(), 1.5, 1e-9);
    EXPECT_NEAR(chain.error().to_m - chain.error().from_m, 1.0 - kSeen_m, 1e-9);
    EXPECT_TRUE(segment_chain(way(3, {0.5, 1.0, 1.5, 2.0, 2.5})));
}

TEST(SegmentChain, TheStationsCodesMustBeCaughtToo) {
    auto task = way(1.0, {0.5});
    EXPECT_TRUE(segment_chain(task));
    task.goal_within_m = 0.4;
    const auto chain = segment_chain(task);
    ASSERT_FALSE(chain);
    EXPECT_NEAR(chain.error().from_m, 0.545, 1e-9);
    EXPECT_NEAR(chain.error().to_m, 1.0, 1e-9);
    EXPECT_NEAR(chain.error().at_most_m, 0.4, 1e-9);
}

/// Random codes of random quality on a random way.
class RandomWays {
public:
    explicit RandomWays(std::uint64_t seed) : random_(seed) {}

    CodePass code(std::size_t code, double length_m) {
        CodePass pass = pass_at(code, uniform(0.05, length_m - 0.05));
        pass.sigma_m = uniform(0.0005, 0.004);
        pass.caught_within_m = uniform(0.3, 2);
        return pass;
    }

    ChainTask task() {
        const double length_m = uniform(1, 6);
        ChainTask task = way(length_m, {});
        const auto codes = static_cast<std::size_t>(uniform(2, 12 * length_m));
        for (std::size_t i = 0; i < codes; ++i) task.passes.push_back(code(i, length_m));
        sort(task);
        task.goal_within_m = uniform(0.3, 2);
        return task;
    }

    static void sort(ChainTask& task) {
        std::sort(task.passes.begin(), task.passes.end(),
                  [](const auto& a, const auto& b) { return a.from_m < b.from_m; });
    }

private:
    double uniform(double from, double to) {
        return std::uniform_real_distribution(from, to)(random_);
    }
    std::mt19937_64 random_;
};

const CodePass& pass_of(const ChainTask& task, std::size_t code) {
    return *std::find_if(task.passes.begin(), task.passes.end(),
                         [&](const auto& pass) { return pass.code == code; });
}

TEST(SegmentChain, NowhereSigmaExceedsTheLimitAndEveryMarkerIsCaught) {
    RandomWays ways(11);
    int chains = 0;
    for (int i = 0; i < 2'000; ++i) {
        const ChainTask task = ways.task();
        const auto chain = segment_chain(task);
        if (!chain) continue;
        ++chains;
        double at_m = 0;
        double sigma_m = task.start_sigma_m;
        for (const auto& marker : chain->markers) {
            const CodePass& pass = pass_of(task, marker.code);
            const double gap_m = std::max(0.0, pass.from_m - at_m);
            EXPECT_LE(gap_m, pass.caught_within_m + 1e-6);
            EXPECT_NEAR(marker.before_m, sigma_m + kPerMetre * gap_m, 1e-9);
            EXPECT_LE(marker.before_m, kLimit_m + 1e-6);
            EXPECT_LE(marker.before_m, chain->worst_m + 1e-12);
            at_m = pass.to_m;
            sigma_m = marker.after_m;
        }
        EXPECT_LE(task.length_m - at_m, task.goal_within_m + 1e-6);
        EXPECT_NEAR(chain->arrival_m, sigma_m + kPerMetre * std::max(0.0, task.length_m - at_m),
                    1e-9);
        EXPECT_LE(chain->arrival_m, kLimit_m + 1e-6);
    }
    EXPECT_GT(chains, 500);
    EXPECT_LT(chains, 1'900) << "some of these ways have no chain";
}

TEST(SegmentChain, MoreMarkersNeverMakeItWorse) {
    RandomWays ways(12);
    int helped = 0;
    for (int i = 0; i < 2'000; ++i) {
        const ChainTask task = ways.task();
        ChainTask more = task;
        more.passes.push_back(ways.code(task.passes.size(), task.length_m));
        RandomWays::sort(more);
        const auto chain = segment_chain(task);
        const auto with_more = segment_chain(more);
        if (!chain) {
            helped += with_more ? 1 : 0;
            continue;
        }
        ASSERT_TRUE(with_more);
        EXPECT_LE(with_more->arrival_m, chain->arrival_m + 1e-8);
    }
    EXPECT_GT(helped, 20);
}

/// Against all subsets of the codes: a chain is found wherever there is one.
TEST(SegmentChain, IsFoundWhereverThereIsOne) {
    RandomWays ways(13);
    int broken = 0;
    for (int i = 0; i < 300; ++i) {
        ChainTask task = ways.task();
        if (task.passes.size() > 10) task.passes.resize(10);
        bool any = false;
        for (unsigned subset = 0; subset < 1u << task.passes.size() && !any; ++subset) {
            double at_m = 0;
            double sigma_m = task.start_sigma_m;
            bool holds = true;
            for (std::size_t c = 0; c < task.passes.size(); ++c) {
                if (!(subset >> c & 1u)) continue;
                const CodePass& pass = task.passes[c];
                const double gap_m = std::max(0.0, pass.from_m - at_m);
                holds &= gap_m <= pass.caught_within_m && sigma_m + kPerMetre * gap_m <= kLimit_m;
                at_m = pass.to_m;
                sigma_m = pass.sigma_m;
            }
            const double rest_m = std::max(0.0, task.length_m - at_m);
            any = holds && rest_m <= task.goal_within_m && sigma_m + kPerMetre * rest_m <= kLimit_m;
        }
        EXPECT_EQ(segment_chain(task).has_value(), any);
        broken += any ? 0 : 1;
    }
    EXPECT_GT(broken, 20);
    EXPECT_LT(broken, 290);
}

/// With machines as they are: what motion adds by the budget of errors instead of a share.
TEST(SegmentChain, MotionAddsAsTheOdometrysNoiseSays) {
    const OdometryNoise noise;
    EXPECT_EQ(motion_sigma_m(5e-4, 0, noise), 0);
    const double ten_m = motion_sigma_m(5e-4, 10, noise);
    EXPECT_GT(ten_m, 5e-4 * 10) << "the heading alone";
    EXPECT_LT(ten_m, 0.015);
    EXPECT_GT(motion_sigma_m(5e-4, 20, noise), 2 * ten_m) << "more than in proportion to the way";
    EXPECT_GT(motion_sigma_m(1e-3, 10, noise), ten_m);
}

TEST(SegmentChain, APoseByACodeIsAsGoodAsSurveyCameraAndArm) {
    plant::Camera camera;
    plant::Marker marker;
    marker.size_m = 0.05;
    const auto below = known_by_code(camera, marker);
    camera.body_from_camera = {5, 0, 0};
    const auto ahead = known_by_code(camera, marker);
    EXPECT_EQ(ahead.heading_rad, below.heading_rad);
    EXPECT_NEAR(ahead.place_m, std::hypot(below.place_m, 5 * below.heading_rad), 1e-12);
    marker.sigma_xy_m = 0.01;
    EXPECT_GT(known_by_code(camera, marker).place_m, 0.01);
}

}  // namespace
}  // namespace pulseline::localisation
