#include "core/mapping/particle_cloud.hpp"

#include <mrpt/poses/CPose3D.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "core/base/square.hpp"
#include "core/localisation/covariance.hpp"
#include "core/mapping/mrpt_frames.hpp"

namespace pulseline::mapping {
namespace {

using geometry::Pose2;

// Particles, where the place is known well and where it is not.
constexpr unsigned kFewest = 300;
constexpr unsigned kMost = 600;
constexpr double kWellKnown_m = 0.035;
constexpr double kWellKnown_rad = 0.02;
// That carry weight at least: with fewer, mean and covariance are chance, so that such a look
// counts for less than it is worth and the next one begins nearer.
constexpr double kCarry = 28;
constexpr double kLeastPower = 1e-4;
// Where a person has pointed, rays end 2 m beside a wall 25 m away for its 5 deg, and few particles
// see that it is there.
constexpr int kRounds = 3;
constexpr int kRoundsRoughly = 4;
constexpr int kFiner = 4;       // halvings of what a ray counts: a little more leaves too few
constexpr double kWider = 1.5;  // than those that carry weight: they are few
// One sigma at least, should one of them carry all.
constexpr double kLeast_m = 1e-3;
constexpr double kLeast_rad = 1e-4;

/// Of a Gaussian, but for what is the same everywhere.
double log_density(const Eigen::LLT<Eigen::Matrix3d>& covariance, const Eigen::Vector3d& off) {
    return -0.5 * covariance.matrixL().solve(off).squaredNorm();
}

Eigen::Vector3d from_to(const Pose2& from, const Pose2& to) {
    return {to.x_m - from.x_m, to.y_m - from.y_m, wrap(to.heading_rad - from.heading_rad)};
}

double carrying(const std::vector<double>& weights) {
    double squares = 0;
    for (const double weight : weights) squares += square(weight);
    return 1 / squares;
}

}  // namespace

ParticleCloud::ParticleCloud(std::shared_ptr<LikelihoodField> grid, std::uint64_t seed)
    : seed_(seed) {
    cloud_.options.metricMap = std::move(grid);
}

bool ParticleCloud::is_well_known(const Eigen::Matrix3d& covariance) {
    return localisation::worse_axis_m(covariance) < kWellKnown_m &&
           covariance(2, 2) < square(kWellKnown_rad);
}

ParticleCloud::Told ParticleCloud::look(const Around& prior,
                                        const std::vector<control::Scan>& rays) {
    const bool well_known = is_well_known(prior.covariance);
    const int rounds = well_known ? kRounds : kRoundsRoughly;
    Told told;
    Around drawn = prior;
    for (int round = 0; round < rounds && told.power < 1; ++round) {
        spread(drawn, well_known ? kFewest : kMost);
        weigh(rays);
        const auto [weights, power] = tempered(count_as(prior, drawn), well_known ? 0 : kFiner);
        drawn = gaussian_of(weights);
        told = {drawn.about, drawn.covariance, power, carrying(weights)};
        drawn.covariance *= square(kWider);
        drawn.covariance.diagonal() +=
            Eigen::Vector3d(square(kLeast_m), square(kLeast_m), square(kLeast_rad));
    }
    return told;
}

void ParticleCloud::spread(const Around& drawn, unsigned count) {
    std::mt19937_64 random(seed_ * 1000003 + ++drawn_);
    std::normal_distribution<double> normal;
    const Eigen::Matrix3d root = drawn.covariance.llt().matrixL();
    cloud_.resetDeterministic({drawn.about.x_m, drawn.about.y_m, drawn.about.heading_rad}, count);
    for (auto& particle : cloud_.m_particles) {
        const Eigen::Vector3d off =
            root * Eigen::Vector3d(normal(random), normal(random), normal(random));
        particle.d.x += off[0];
        particle.d.y += off[1];
        particle.d.phi = wrap(particle.d.phi + off[2]);
    }
}

/// Their weights are the logarithms of how well they explain what is seen. What MRPT's filter would
/// do besides, moving each by nothing, took nearly as long again.
void ParticleCloud::weigh(const std::vector<control::Scan>& rays) {
    const auto seen = frame_of(rays);
    const mrpt::bayes::CParticleFilter::TParticleFilterOptions usual;
    for (std::size_t i = 0; i < cloud_.m_particles.size(); ++i) {
        auto& particle = cloud_.m_particles[i];
        particle.log_w = cloud_.PF_SLAM_computeObservationLikelihoodForParticle(
            usual, i, seen, mrpt::poses::CPose3D(mrpt::poses::CPose2D(particle.d)));
    }
}

/// By particle, the logarithm of what makes those drawn from `drawn` count as if they had been
/// drawn from `prior`.
std::vector<double> ParticleCloud::count_as(const Around& prior, const Around& drawn) const {
    const Eigen::LLT<Eigen::Matrix3d> wanted(prior.covariance);
    const Eigen::LLT<Eigen::Matrix3d> given(drawn.covariance);
    std::vector<double> counts;
    for (std::size_t i = 0; i < cloud_.m_particles.size(); ++i) {
        counts.push_back(log_density(wanted, from_to(prior.about, at(i))) -
                         log_density(given, from_to(drawn.about, at(i))));
    }
    return counts;
}

std::vector<double> ParticleCloud::weights(const std::vector<double>& counts, double power) const {
    std::vector<double> weights;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        weights.push_back(power * cloud_.m_particles[i].log_w + counts[i]);
    }
    const double best = *std::ranges::max_element(weights);
    double sum = 0;
    for (double& weight : weights) sum += weight = std::exp(weight - best);
    for (double& weight : weights) weight /= sum;
    return weights;
}

/// As much of the rays' worth as leaves enough particles with weight.
ParticleCloud::Weighed ParticleCloud::tempered(const std::vector<double>& counts, int finer) const {
    Weighed found;
    const auto is_left = [&](double power) {
        auto by_it = weights(counts, power);
        if (carrying(by_it) < kCarry && power > kLeastPower) return false;
        found = {std::move(by_it), power};
        return true;
    };
    double too_much = 0;
    for (double power = 1; !is_left(power); power /= 2) too_much = power;
    for (int i = 0; i < finer && too_much > 0; ++i) {
        const double power = (found.power + too_much) / 2;
        if (!is_left(power)) too_much = power;
    }
    return found;
}

Pose2 ParticleCloud::at(std::size_t particle) const {
    const auto& place = cloud_.m_particles[particle].d;
    return {place.x, place.y, place.phi};
}

Around ParticleCloud::gaussian_of(const std::vector<double>& weights) const {
    const Pose2 first = at(0);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < weights.size(); ++i) {
        const Eigen::Vector3d off = from_to(first, at(i));
        mean += weights[i] * off;
        squares += weights[i] * off * off.transpose();
    }
    return {{first.x_m + mean[0], first.y_m + mean[1], wrap(first.heading_rad + mean[2])},
            squares - mean * mean.transpose()};
}

}  // namespace pulseline::mapping
