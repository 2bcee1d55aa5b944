#include "core/mapping/map_builder.hpp"

#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/poses/CPosePDFGaussian.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMetricMapBuilderRBPF.h>

#include <Eigen/LU>
#include <cmath>

#include "core/mapping/mrpt_frames.hpp"

namespace pulseline::mapping {
namespace {

using geometry::Point2;
using geometry::Pose2;
using mrpt::maps::COccupancyGridMap2D;

constexpr double kCell_m = 0.05;
// MRPT's cells end at multiples of their size, where drawings like to have their walls: such a wall
// would lie in the cells behind it, half a cell off, all round the hall.
constexpr Point2 kMiddle{kCell_m / 2, kCell_m / 2};
constexpr float kEvery_m = 0.1F;
constexpr float kEvery_rad = 0.02F;
constexpr unsigned kWays = 16;
constexpr double kScansCount = 0.01;
constexpr std::uint32_t kSeed = 7;

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options(double within_m) {
    mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options;
    options.verbosity_level = mrpt::system::LVL_ERROR;
    options.insertionLinDistance = options.localizeLinDistance = kEvery_m;
    options.insertionAngDistance = options.localizeAngDistance = kEvery_rad;
    options.PF_options.adaptiveSampleSize = false;
    options.PF_options.sampleSize = kWays;
    options.PF_options.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
    options.PF_options.resamplingMethod = mrpt::bayes::CParticleFilter::prSystematic;
    options.PF_options.powFactor = kScansCount;
    COccupancyGridMap2D::TMapDefinition grid;
    grid.resolution = static_cast<float>(kCell_m);
    grid.min_x = grid.min_y = -1;
    grid.max_x = grid.max_y = 1;
    grid.insertionOpts.maxOccupancyUpdateCertainty = 0.7F;
    grid.insertionOpts.maxDistanceInsertion = static_cast<float>(within_m);
    grid.likelihoodOpts.likelihoodMethod = COccupancyGridMap2D::lmLikelihoodField_Thrun;
    grid.likelihoodOpts.LF_stdHit = 0.05F;
    grid.likelihoodOpts.LF_zHit = 0.8F;
    grid.likelihoodOpts.LF_zRandom = 0.2F;
    grid.likelihoodOpts.LF_maxCorrsDistance = 0.3F;
    grid.likelihoodOpts.LF_decimation = 4;
    options.mapsInitializers.push_back(grid);
    return options;
}

Pose2 in_grid(const Pose2& pose) {
    return {pose.x_m + kMiddle.x_m, pose.y_m + kMiddle.y_m, pose.heading_rad};
}

}  // namespace

struct MapBuilder::Slam {
    mrpt::slam::CMetricMapBuilderRBPF builder;
};

MapBuilder::MapBuilder(const Pose2& start, double within_m)
    : slam_(std::make_unique<Slam>(options(within_m))) {
    mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(kSeed);
    const mrpt::poses::CPosePDFGaussian at(in_mrpt(in_grid(start)));
    slam_->builder.initialize({}, &at);
}

MapBuilder::~MapBuilder() = default;

void MapBuilder::take(const Pose2& moved, const Eigen::Matrix3d& moved_covariance,
                      const std::vector<control::Scan>& scans) {
    auto actions = movement(moved, moved_covariance);
    auto seen = frame_to_draw(scans);
    slam_->builder.processActionObservation(actions, seen);
}

void MapBuilder::stands_at(const Pose2& in_hall, const Eigen::Matrix3d& covariance) {
    const Pose2 pose = in_grid(in_hall);
    const Eigen::Matrix3d information = covariance.inverse();
    for (auto& particle : slam_->builder.mapPDF.m_particles) {
        if (particle.d->robotPath.empty()) continue;  // before the first scan
        auto& at = particle.d->robotPath.back();
        const Eigen::Vector3d off(at.x - pose.x_m, at.y - pose.y_m,
                                  wrap(at.yaw - pose.heading_rad));
        particle.log_w -= off.dot(information * off) / 2;
        at.x = pose.x_m;
        at.y = pose.y_m;
        at.yaw = pose.heading_rad;
    }
}

OccupancyMap MapBuilder::map() const {
    const auto grid =
        slam_->builder.getCurrentlyBuiltMetricMap()->mapByClass<COccupancyGridMap2D>();
    OccupancyMap map;
    map.cell_m = kCell_m;
    map.corner = Point2{grid->getXMin(), grid->getYMin()} - kMiddle;
    map.columns = static_cast<int>(grid->getSizeX());
    map.rows = static_cast<int>(grid->getSizeY());
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            map.free.push_back(
                static_cast<std::uint8_t>(std::lround(255 * grid->getCell(column, row))));
        }
    }
    return map;
}

}  // namespace pulseline::mapping
