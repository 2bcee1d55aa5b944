#include "core/mapping/monte_carlo.hpp"

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/random/RandomGenerators.h>
#include <mrpt/slam/CMonteCarloLocalization2D.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/mapping/mrpt_frames.hpp"

namespace pulseline::mapping {
namespace {

using geometry::Point2;
using geometry::Pose2;

// Of one ray's end from what it met: the scanner's noise and half a cell.
constexpr float kRaySigma_m = 0.04F;
constexpr float kWithin_m = 0.3F;  // farther off something else was met
constexpr float kByChance = 0.2F;  // of all rays, on what is not in the map
constexpr int kEveryRay = 12;      // of a scan: neighbours tell the same
// Rays are not independent: they share the errors of the map where they meet one wall.
constexpr double kRaysCount = 0.1;
constexpr unsigned kFewest = 300;
constexpr unsigned kMost = 3000;
constexpr double kBin_m = 0.03;
constexpr double kBin_rad = 0.01;
constexpr int kNear_cells = 2;
// A ray goes through a wall when it ends farther behind it than the pose and the map may be off.
constexpr double kBehind_m = 0.5;

}  // namespace

struct MatchedMap {
    OccupancyMap map;
    mrpt::maps::COccupancyGridMap2D::Ptr grid;

    bool is_occupied(Point2 place) const {
        const Point2 in = place - map.corner;
        const auto column = static_cast<int>(std::floor(in.x_m / map.cell_m));
        const auto row = static_cast<int>(std::floor(in.y_m / map.cell_m));
        return column >= 0 && column < map.columns && row >= 0 && row < map.rows &&
               map.occupied(column, row);
    }

    /// Whether something stands on the way, but for its ends. Two cells in a row: a ray that grazes
    /// a wall only cuts its corners.
    bool has_something_between(Point2 from, Point2 to) const {
        const double way_m = distance(from, to) - kBehind_m;
        const Point2 step = (map.cell_m / distance(from, to)) * (to - from);
        bool before = false;
        for (int i = 1; i * map.cell_m < way_m; ++i) {
            const bool here = is_occupied(from + static_cast<double>(i) * step);
            if (here && before) return true;
            before = here;
        }
        return false;
    }

    bool has_something_near(Point2 place) const {
        const Point2 in = place - map.corner;
        const auto column = static_cast<int>(std::floor(in.x_m / map.cell_m));
        const auto row = static_cast<int>(std::floor(in.y_m / map.cell_m));
        for (int r = std::max(0, row - kNear_cells); r <= std::min(map.rows - 1, row + kNear_cells);
             ++r) {
            for (int c = std::max(0, column - kNear_cells);
                 c <= std::min(map.columns - 1, column + kNear_cells); ++c) {
                if (map.occupied(c, r)) return true;
            }
        }
        return false;
    }
};

std::shared_ptr<const MatchedMap> prepare(OccupancyMap map) {
    auto matched = std::make_shared<MatchedMap>();
    const Point2 far = map.corner + Point2{map.columns * map.cell_m, map.rows * map.cell_m};
    matched->grid = mrpt::maps::COccupancyGridMap2D::Create(
        static_cast<float>(map.corner.x_m), static_cast<float>(far.x_m),
        static_cast<float>(map.corner.y_m), static_cast<float>(far.y_m),
        static_cast<float>(map.cell_m));
    for (int row = 0; row < map.rows; ++row) {
        for (int column = 0; column < map.columns; ++column) {
            const float free = map.occupied(column, row) ? 0.0F : 1.0F;
            const Point2 middle = map.middle_of(column, row);
            matched->grid->setPos(static_cast<float>(middle.x_m), static_cast<float>(middle.y_m),
                                  free);
        }
    }
    auto& likelihood = matched->grid->likelihoodOptions;
    likelihood.likelihoodMethod = mrpt::maps::COccupancyGridMap2D::lmLikelihoodField_Thrun;
    likelihood.LF_stdHit = kRaySigma_m;
    likelihood.LF_zHit = 1 - kByChance;
    likelihood.LF_zRandom = kByChance;
    likelihood.LF_maxCorrsDistance = kWithin_m;
    likelihood.LF_decimation = kEveryRay;
    likelihood.enableLikelihoodCache = true;
    matched->map = std::move(map);
    return matched;
}

struct MonteCarlo::Particles {
    std::shared_ptr<const MatchedMap> map;
    std::uint64_t seed;
    std::uint64_t steps = 0;
    mrpt::slam::CMonteCarloLocalization2D cloud;
    mrpt::bayes::CParticleFilter filter;
};

MonteCarlo::MonteCarlo(std::shared_ptr<const MatchedMap> map, std::uint64_t seed)
    : particles_(std::make_unique<Particles>()) {
    particles_->map = std::move(map);
    particles_->seed = seed;
    auto& filter = particles_->filter.m_options;
    filter.adaptiveSampleSize = true;
    filter.sampleSize = kFewest;
    filter.PF_algorithm = mrpt::bayes::CParticleFilter::pfStandardProposal;
    filter.resamplingMethod = mrpt::bayes::CParticleFilter::prMultinomial;
    filter.powFactor = kRaysCount;
    auto& options = particles_->cloud.options;
    options.metricMap = particles_->map->grid;
    options.KLD_params.KLD_minSampleSize = kFewest;
    options.KLD_params.KLD_maxSampleSize = kMost;
    options.KLD_params.KLD_binSize_XY = kBin_m;
    options.KLD_params.KLD_binSize_PHI = kBin_rad;
}

MonteCarlo::~MonteCarlo() = default;
MonteCarlo::MonteCarlo(MonteCarlo&&) noexcept = default;

void MonteCarlo::begin_at(const Pose2& pose, const Eigen::Matrix3d& covariance) {
    std::mt19937_64 random(particles_->seed ^ ++particles_->steps);
    std::normal_distribution<double> normal;
    const Eigen::Matrix3d root = covariance.llt().matrixL();
    auto& cloud = particles_->cloud;
    cloud.resetDeterministic({pose.x_m, pose.y_m, pose.heading_rad}, kMost);
    for (auto& particle : cloud.m_particles) {
        const Eigen::Vector3d off =
            root * Eigen::Vector3d(normal(random), normal(random), normal(random));
        particle.d.x += off[0];
        particle.d.y += off[1];
        particle.d.phi = wrap(particle.d.phi + off[2]);
    }
}

MonteCarlo::Cloud MonteCarlo::step(const Pose2& moved, const Eigen::Matrix3d& moved_covariance,
                                   const std::vector<control::Scan>& scans) {
    // MRPT has one generator for all of a program: begun anew, each vehicle has its own numbers.
    // A new one, for the old one keeps half of its last pair of numbers.
    mrpt::random::getRandomGenerator() = mrpt::random::CRandomGenerator(
        static_cast<std::uint32_t>(particles_->seed * 1000003 + ++particles_->steps));
    const auto actions = movement(moved, moved_covariance);
    const auto seen = frame_of(scans);
    particles_->filter.executeOn(particles_->cloud, &actions, &seen);

    const auto [covariance, mean] = particles_->cloud.getCovarianceAndMean();
    Cloud cloud{{mean.x(), mean.y(), mean.phi()}, covariance.asEigen()};
    int explained = 0;
    int through = 0;
    for (const control::Scan& scan : scans) {
        const Pose2 sensor = cloud.pose * scan.body_from_sensor;
        for (std::size_t i = 0; i < scan.ranges_m.size(); i += kEveryRay) {
            const double range_m = scan.ranges_m[i];
            if (!std::isfinite(range_m) || range_m <= 0) continue;
            const double angle_rad = scan.first_rad + static_cast<double>(i) * scan.step_rad;
            ++cloud.returns;
            const Point2 end =
                sensor * (range_m * Point2{std::cos(angle_rad), std::sin(angle_rad)});
            explained += particles_->map->has_something_near(end);
            through += particles_->map->has_something_between(sensor.position(), end);
        }
    }
    if (cloud.returns > 0) {
        cloud.explained = static_cast<double>(explained) / cloud.returns;
        cloud.through = static_cast<double>(through) / cloud.returns;
    }
    return cloud;
}

}  // namespace pulseline::mapping
