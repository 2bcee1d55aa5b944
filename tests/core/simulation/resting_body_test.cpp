#include "core/simulation/machine/resting_body.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

namespace pulseline::simulation {
namespace {

const std::vector<Support> kTable{
    {{1, 1}, 0, 1e6}, {{1, -1}, 0, 1e6}, {{-1, 1}, 0, 1e6}, {{-1, -1}, 0, 1e6}};

TEST(RestingBody, SharesItsWeightByItsCentre) {
    const auto even = rest_on(kTable, 4000, {});
    ASSERT_TRUE(even);
    for (const double force_n : even->force_n) EXPECT_NEAR(force_n, 1000, 1e-3);
    EXPECT_NEAR(even->plane[0], -1e-3, 1e-9);
    const auto aft = rest_on(kTable, 4000, {-0.5, 0});
    ASSERT_TRUE(aft);
    EXPECT_NEAR(aft->force_n[0], 500, 1e-3);
    EXPECT_NEAR(aft->force_n[2], 1500, 1e-3);
}

TEST(RestingBody, ALowSupportCarriesNothingAndPullsNothing) {
    auto supports = kTable;
    supports[0].height_m = -0.1;
    const auto rest = rest_on(supports, 4000, {-0.1, -0.1});
    ASSERT_TRUE(rest);
    EXPECT_EQ(rest->force_n[0], 0);
    EXPECT_NEAR(rest->force_n[1] + rest->force_n[2] + rest->force_n[3], 4000, 1e-3);
}

TEST(RestingBody, TipsWhenItsCentreIsOutside) {
    EXPECT_FALSE(rest_on(kTable, 4000, {1.2, 0}));
    EXPECT_FALSE(rest_on({kTable[0], kTable[3]}, 4000, {0.3, -0.3}));
    EXPECT_FALSE(rest_on({}, 4000, {}));
    EXPECT_FALSE(rest_on(kTable, 0, {}));
}

/// Laws of statics, whatever the supports: forces push, their sum is the weight, their moments
/// balance, and who does not push is clear of the body.
TEST(RestingBody, IsInBalanceOnAnySupports) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(-1, 1);
    int rests = 0;
    for (int round = 0; round < 2000; ++round) {
        std::vector<Support> supports;
        const int count = 3 + static_cast<int>(random() % 8);
        for (int i = 0; i < count; ++i) {
            supports.push_back({{5 * unit(random), 2 * unit(random)},
                                0.02 * unit(random),
                                std::pow(10, 7 + unit(random))});
        }
        const double weight_n = 2e5 + 1.5e5 * unit(random);
        const geometry::Point2 centre{unit(random), 0.3 * unit(random)};
        const auto rest = rest_on(supports, weight_n, centre);
        if (!rest) continue;
        ++rests;
        double sum_n = 0;
        double along_nm = 0;
        double across_nm = 0;
        for (std::size_t i = 0; i < supports.size(); ++i) {
            const double force_n = rest->force_n[i];
            ASSERT_GE(force_n, 0);
            sum_n += force_n;
            along_nm += force_n * supports[i].place.x_m;
            across_nm += force_n * supports[i].place.y_m;
            const double body_m = rest->plane[0] + rest->plane[1] * supports[i].place.x_m +
                                  rest->plane[2] * supports[i].place.y_m;
            if (force_n == 0) {
                EXPECT_GE(body_m, supports[i].height_m);
            }
        }
        EXPECT_NEAR(sum_n, weight_n, 1e-6 * weight_n);
        EXPECT_NEAR(along_nm, weight_n * centre.x_m, 1e-5 * weight_n);
        EXPECT_NEAR(across_nm, weight_n * centre.y_m, 1e-5 * weight_n);
    }
    EXPECT_GT(rests, 1000);
}

}  // namespace
}  // namespace pulseline::simulation
