#include "core/mapping/likelihood_field.hpp"

#include <gtest/gtest.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <cmath>
#include <random>

#include "core/mapping/mrpt_frames.hpp"
#include "tests/core/mapping/mapped_hall.hpp"

namespace pulseline::mapping {
namespace {

template <class Grid>
std::shared_ptr<Grid> grid_of(const OccupancyMap& map) {
    auto grid = std::make_shared<Grid>(0.0F, static_cast<float>(map.columns * map.cell_m), 0.0F,
                                       static_cast<float>(map.rows * map.cell_m),
                                       static_cast<float>(map.cell_m));
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            grid->setCell(column, row, map.occupied(column, row) ? 0.0F : 1.0F);
        }
    }
    auto& likelihood = grid->likelihoodOptions;
    likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
    likelihood.LF_decimation = 1;
    return grid;
}

// By the same rays from the same places, outside of the map, too.
TEST(LikelihoodField, IsMrptsOwn) {
    const OccupancyMap map = testing::mapped();
    const auto mrpts = grid_of<mrpt::maps::COccupancyGridMap2D>(map);
    const auto ours = grid_of<LikelihoodField>(map);
    testing::Scanning scanning(3);
    std::mt19937_64 random(5);
    const auto within = [&](double most) {
        return std::uniform_real_distribution<double>(-most, most)(random);
    };
    double least = 0;
    for (int i = 0; i < 200; ++i) {
        const geometry::Pose2 stands{9 + within(10), within(1), within(kPi)};
        for (const auto& seen : frame_of(scanning.from(stands))) {
            const double far = i % 10 == 0 ? 20 : 0.3;
            const mrpt::poses::CPose3D from(stands.x_m - map.corner.x_m + within(far),
                                            stands.y_m - map.corner.y_m + within(far), 0,
                                            stands.heading_rad + within(0.1), 0, 0);
            const double expected = mrpts->computeObservationLikelihood(*seen, from);
            const auto& scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(*seen);
            const auto rays = static_cast<double>(scan.getScanSize());
            EXPECT_NEAR(ours->computeObservationLikelihood(*seen, from), expected, 2e-3 * rays);
            least = std::min(least, expected);
        }
    }
    EXPECT_LT(least, -100);
}

}  // namespace
}  // namespace pulseline::mapping
