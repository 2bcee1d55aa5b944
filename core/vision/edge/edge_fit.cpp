#include "core/vision/edge/edge_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/vision/edge/edge_profile.hpp"
#include "core/vision/edge/median.hpp"

namespace pulseline::vision {
namespace {

// Profiles are long at first, to catch a rough start, then short and many.
struct Round {
    int reach_px;
    std::size_t profiles;  // about so many, evenly from all sites
    int passes;
};
constexpr std::array<Round, 3> kRounds{{{7, 160, 3}, {4, 160, 3}, {4, 600, 4}}};
constexpr std::size_t kLocateRounds = 2;
constexpr double kReference_px = 10.4;  // clear of a blur of 2.2 px and a smear of 6 px
constexpr std::size_t kFewestEdges = 24;
constexpr double kTukey = 4.685;  // 95 % efficiency for Gaussian residuals
// Neighbouring profiles share pixels, so they are not independent.
constexpr double kCorrelation = 1.5;
// What may be unknown of a mounted camera's tilt and of the ink's spread, one sigma.
constexpr double kTiltPrior_rad = 0.0035;
constexpr double kGrowthPrior_px = 0.5;

constexpr int kUnknowns = 7;  // centre u, v; angle; relative scale; tilt u, v; growth
using Vector = Eigen::Matrix<double, kUnknowns, 1>;
using Matrix = Eigen::Matrix<double, kUnknowns, kUnknowns>;

/// Weighted normal equations. Plain loops: they run for every profile of every pass.
struct NormalEquations {
    std::array<std::array<double, kUnknowns>, kUnknowns> lower{};
    std::array<double, kUnknowns> right{};

    void add(const Vector& row, double value, double weight) {
        for (int i = 0; i < kUnknowns; ++i) {
            const double wi = weight * row.data()[i];
            auto& out = lower[static_cast<std::size_t>(i)];
            for (int j = 0; j <= i; ++j) out[static_cast<std::size_t>(j)] += wi * row.data()[j];
            right[static_cast<std::size_t>(i)] += wi * value;
        }
    }
    Matrix matrix() const {
        Matrix m;
        for (int i = 0; i < kUnknowns; ++i)
            for (int j = 0; j <= i; ++j)
                m(i, j) = m(j, i) = lower[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
        return m;
    }
};

struct State {
    Placement placement;
    double growth_px = 0;
};

struct Step {
    Vector change = Vector::Zero();
    Matrix information = Matrix::Zero();  // in units of 1 / rms^2
    double rms_px = 0;
    int inliers = 0;
};

Vector gradient(const EdgeObservation& o, Pixel centre, double f_px) {
    const Pixel q = o.foot - centre;
    const double foot_n = o.foot.u * o.normal.u + o.foot.v * o.normal.v;
    const double centre_n = centre.u * o.normal.u + centre.v * o.normal.v;
    Vector j;
    j << o.normal.u, o.normal.v, q.u * o.normal.v - q.v * o.normal.u,
        q.u * o.normal.u + q.v * o.normal.v, -(o.foot.u * foot_n - centre.u * centre_n) / f_px,
        -(o.foot.v * foot_n - centre.v * centre_n) / f_px, 1;
    return j;
}

/// Iteratively reweighted least squares on the offsets along the normals.
Step solve(const std::vector<EdgeObservation>& seen, const State& state, double f_px, int passes) {
    std::vector<Vector> rows;
    std::vector<double> offsets;  // what growth so far does not explain
    rows.reserve(seen.size());
    offsets.reserve(seen.size());
    for (const EdgeObservation& o : seen) {
        rows.push_back(gradient(o, state.placement.centre, f_px));
        offsets.push_back(o.offset_px - state.growth_px);
    }
    Vector prior_pull = Vector::Zero();
    prior_pull[4] = -state.placement.keystone.u * f_px;
    prior_pull[5] = -state.placement.keystone.v * f_px;
    prior_pull[6] = -state.growth_px;
    Step step;
    std::vector<double> magnitude(seen.size());
    for (int pass = 0; pass < passes; ++pass) {
        for (std::size_t i = 0; i < seen.size(); ++i)
            magnitude[i] = std::abs(offsets[i] - rows[i].dot(step.change));
        const double scale = std::max(1.4826 * median(magnitude).value_or(0), 1e-3);
        NormalEquations sums;
        double squares = 0;
        double weights = 0;
        step.inliers = 0;
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const double r = offsets[i] - rows[i].dot(step.change);
            const double x = r / (kTukey * scale);
            if (std::abs(x) >= 1) continue;
            const double w = (1 - x * x) * (1 - x * x);
            sums.add(rows[i], offsets[i], w);
            squares += w * r * r;
            weights += w;
            ++step.inliers;
        }
        step.rms_px = weights > 0 ? std::sqrt(squares / weights) : 0;
        step.information = sums.matrix();
        Vector right(sums.right.data());
        const double noise2 = kCorrelation * std::max(step.rms_px * step.rms_px, 1e-6);
        for (const int i : {4, 5, 6}) {
            const double sigma = i == 6 ? kGrowthPrior_px : kTiltPrior_rad;
            step.information(i, i) += noise2 / (sigma * sigma);
            right[i] += noise2 / (sigma * sigma) * prior_pull[i];
        }
        step.change = step.information.ldlt().solve(right);
        if (!step.change.allFinite()) break;  // nothing can be put in order by it
    }
    return step;
}

void apply(State& state, const Step& step, double f_px) {
    Placement& p = state.placement;
    p.centre = p.centre + Pixel{step.change[0], step.change[1]};
    p.angle_rad += step.change[2];
    p.unit_px *= 1 + step.change[3];
    p.keystone = p.keystone + (1 / f_px) * Pixel{step.change[4], step.change[5]};
    state.growth_px += step.change[6];
}

}  // namespace

std::optional<EdgeFit> fit_edges(const cv::Mat& grey, const plant::Camera& camera,
                                 std::span<const EdgeSite> sites, double feature_units,
                                 const Placement& start, FitEffort effort) {
    const double reference_px = std::min(kReference_px, feature_units * start.unit_px / 2);
    const int longest = std::max(2, static_cast<int>(0.7 * reference_px));
    State state{start};
    Step step;
    int tried = 0;
    for (std::size_t i = 0; i < kRounds.size(); ++i) {
        if (effort == FitEffort::kLocate && i == kLocateRounds) break;
        const Round& round = kRounds[i];
        const auto every = static_cast<int>(
            std::max<std::size_t>(1, (sites.size() + round.profiles / 2) / round.profiles));
        const auto edges = observe_edges(grey, camera, sites, state.placement,
                                         {std::min(round.reach_px, longest), reference_px, every});
        if (edges.seen.size() < kFewestEdges) return std::nullopt;
        step = solve(edges.seen, state, camera.f_px, round.passes);
        if (!step.change.allFinite()) return std::nullopt;
        apply(state, step, camera.f_px);
        tried = edges.tried;
    }
    EdgeFit fit;
    fit.placement = state.placement;
    fit.growth_px = state.growth_px;
    fit.covariance = kCorrelation * step.rms_px * step.rms_px *
                     Matrix(step.information.inverse()).topLeftCorner<3, 3>();
    fit.rms_px = step.rms_px;
    fit.inliers = step.inliers;
    fit.profiles = tried;
    fit.inlier_share = static_cast<double>(step.inliers) / std::max(1, tried);
    return fit;
}

}  // namespace pulseline::vision
