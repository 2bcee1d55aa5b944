#include "core/vision/edge_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/vision/sample.hpp"

namespace pulseline::vision {
namespace {

// Profiles are long at first, to catch the decoder's truncated corners, then short and many.
struct Round {
    int reach_px;
    bool thorough;
};
constexpr std::array<Round, 3> kRounds{{{7, false}, {4, false}, {4, true}}};
constexpr std::array<double, 3> kAlong{-0.25, 0, 0.25};  // places on an edge, in modules
constexpr int kFewestEdges = 80;
constexpr double kTukey = 4.685;  // 95 % efficiency for Gaussian residuals
// Profiles at 0.25 module and the samples in them share pixels, so they are not independent.
constexpr double kCorrelation = 1.5;

/// A printed edge: between module (row, column) and its neighbour to the right or below.
struct Edge {
    double a = 0;  // middle, module coordinates
    double b = 0;
    bool vertical = false;  // the edge runs along b; its normal is +a
    float before = 0;       // grey level at the edge on the side of smaller a (or b), without blur
    float after = 0;
    double slope_change = 0;  // grey levels per px: slope of the light after minus before
};

struct Observation {
    double a = 0;
    double b = 0;
    bool vertical = false;
    double offset_px = 0;  // image edge minus model, along the normal
};

double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

/// Grey levels per module along a and b, of all dark or of all light modules: shading.
struct Shading {
    double along_a = 0;
    double along_b = 0;
};

/// Slopes of a plane through the levels of one kind; the darker or lighter outliers (dirt) trimmed.
Shading shading(const ModuleGrid& modules, bool dark) {
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    double limit = 1e9;
    for (int pass = 0; pass < 3; ++pass) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        std::vector<double> residuals;
        for (int row = -1; row <= kModules; ++row) {
            for (int column = -1; column <= kModules; ++column) {
                if (!modules.valid(row, column) || modules.dark(row, column) != dark) continue;
                const Eigen::Vector3d j{1, static_cast<double>(column), static_cast<double>(row)};
                const double residual = std::abs(modules.level(row, column) - j.dot(plane));
                if (residual > limit) continue;
                residuals.push_back(residual);
                normal += j * j.transpose();
                right += j * static_cast<double>(modules.level(row, column));
            }
        }
        if (residuals.size() < 30) return {};
        if (pass > 0) limit = std::max(1.0, 4 * median_of(residuals));
        plane = normal.ldlt().solve(right);
    }
    return {plane[1], plane[2]};
}

/// Levels are measured half a module from the edge: carried to it along the shading.
std::vector<Edge> printed_edges(const ModuleGrid& modules, double module_px) {
    const double half = (kModules - 1) / 2.0;
    const float least = 0.35F * modules.contrast();
    const std::array<Shading, 2> slopes{shading(modules, false), shading(modules, true)};
    std::vector<Edge> edges;
    const auto add = [&](int row, int column, int row2, int column2) {
        if (!modules.valid(row, column) || !modules.valid(row2, column2)) return;
        const bool dark = modules.dark(row, column);
        if (dark == modules.dark(row2, column2)) return;
        const bool vertical = row == row2;
        const Shading& first = slopes[dark ? 1 : 0];
        const Shading& second = slopes[dark ? 0 : 1];
        const double slope = vertical ? first.along_a : first.along_b;
        const double slope2 = vertical ? second.along_a : second.along_b;
        const auto before = static_cast<float>(modules.level(row, column) + slope / 2);
        const auto after = static_cast<float>(modules.level(row2, column2) - slope2 / 2);
        if (std::abs(after - before) < least) return;
        edges.push_back({(column + column2) / 2.0 - half, (row + row2) / 2.0 - half, vertical,
                         before, after, (slope2 - slope) / module_px});
    };
    for (int row = -1; row <= kModules; ++row) {
        for (int column = -1; column <= kModules; ++column) {
            const bool inner_row = row >= 0 && row < kModules;
            const bool inner_column = column >= 0 && column < kModules;
            if (inner_row && column < kModules) add(row, column, row, column + 1);
            if (inner_column && row < kModules) add(row, column, row + 1, column);
        }
    }
    return edges;
}

/// Where the edge lies on the profile through (a, b), in px from the model; by the area under the
/// profile between the levels of the two modules.
std::optional<double> edge_offset(const cv::Mat& grey, const plant::Camera& camera, Pixel foot,
                                  Pixel normal, const Edge& edge, int reach_px) {
    // Lens distortion bends a profile of 15 px by less than 1e-3 px: straight in the image as well.
    const Pixel begin = distorted(camera, foot - static_cast<double>(reach_px) * normal);
    const Pixel end = distorted(camera, foot + static_cast<double>(reach_px) * normal);
    if (!sampleable(grey, begin) || !sampleable(grey, end)) return std::nullopt;
    const Pixel step = 1.0 / (2 * reach_px) * (end - begin);
    const auto before = static_cast<double>(edge.before);
    double sum = -edge.slope_change * reach_px * reach_px / 2 +
                 0.5 * (static_cast<double>(sample(grey, begin) + sample(grey, end)) - 2 * before);
    for (int i = 1; i < 2 * reach_px; ++i)
        sum += static_cast<double>(sample(grey, begin + static_cast<double>(i) * step)) - before;
    // Fully "after" over the whole profile gives 2 reach; the edge at 0 gives reach.
    return reach_px - sum / static_cast<double>(edge.after - edge.before);
}

std::vector<Observation> observe(const cv::Mat& grey, const plant::Camera& camera,
                                 const std::vector<Edge>& edges, const CodePlacement& placement,
                                 const Round& round) {
    const Pixel along_a{std::cos(placement.angle_rad), std::sin(placement.angle_rad)};
    const Pixel along_b{-along_a.v, along_a.u};
    std::vector<Observation> seen;
    seen.reserve(edges.size() * kAlong.size());
    for (const Edge& edge : edges) {
        for (const double step : kAlong) {
            if (step != 0 && !round.thorough) continue;
            const double a = edge.a + (edge.vertical ? 0 : step);
            const double b = edge.b + (edge.vertical ? step : 0);
            const auto offset =
                edge_offset(grey, camera, placement.at(a, b), edge.vertical ? along_a : along_b,
                            edge, round.reach_px);
            if (offset && std::abs(*offset) < round.reach_px)
                seen.push_back({a, b, edge.vertical, *offset});
        }
    }
    return seen;
}

struct Step {
    Eigen::Vector4d change =
        Eigen::Vector4d::Zero();  // along a px, along b px, angle, relative scale
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    double rms_px = 0;
    double inlier_share = 0;
    int inliers = 0;
};

/// Iteratively reweighted least squares on the offsets along the normals.
Step solve(const std::vector<Observation>& seen, double module_px) {
    Step step;
    std::vector<double> magnitude(seen.size());
    const auto row = [&](const Observation& o) {
        // A point (a, b) moves by angle x (-b, a) and scale x (a, b).
        return o.vertical ? Eigen::Vector4d{1, 0, -o.b * module_px, o.a * module_px}
                          : Eigen::Vector4d{0, 1, o.a * module_px, o.b * module_px};
    };
    for (int pass = 0; pass < 4; ++pass) {
        for (std::size_t i = 0; i < seen.size(); ++i)
            magnitude[i] = std::abs(seen[i].offset_px - row(seen[i]).dot(step.change));
        const double scale = std::max(1.4826 * median_of(magnitude), 1e-3);
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        double squares = 0;
        double weights = 0;
        step.inliers = 0;
        for (const Observation& o : seen) {
            const Eigen::Vector4d j = row(o);
            const double r = o.offset_px - j.dot(step.change);
            const double x = r / (kTukey * scale);
            if (std::abs(x) >= 1) continue;
            const double w = (1 - x * x) * (1 - x * x);
            normal.noalias() += (w * j) * j.transpose();
            right += w * o.offset_px * j;
            squares += w * r * r;
            weights += w;
            ++step.inliers;
        }
        step.information = normal;
        step.change = step.information.ldlt().solve(right);
        step.rms_px = weights > 0 ? std::sqrt(squares / weights) : 0;
    }
    return step;
}

}  // namespace

std::optional<EdgeFit> fit_edges(const cv::Mat& grey, const plant::Camera& camera,
                                 const ModuleGrid& modules, const CodePlacement& start) {
    const std::vector<Edge> edges = printed_edges(modules, start.module_px);
    EdgeFit fit;
    fit.placement = start;
    fit.profiles = static_cast<int>(edges.size() * kAlong.size());
    Step step;
    for (const Round& round : kRounds) {
        const auto seen = observe(grey, camera, edges, fit.placement, round);
        if (static_cast<int>(seen.size()) < (round.thorough ? 3 : 1) * kFewestEdges)
            return std::nullopt;
        step = solve(seen, fit.placement.module_px);
        const double c = std::cos(fit.placement.angle_rad);
        const double s = std::sin(fit.placement.angle_rad);
        const double da = step.change[0];
        const double db = step.change[1];
        fit.placement.centre = fit.placement.centre + Pixel{c * da - s * db, s * da + c * db};
        fit.placement.angle_rad += step.change[2];
        fit.placement.module_px *= 1 + step.change[3];
    }
    const Eigen::Matrix4d covariance =
        kCorrelation * step.rms_px * step.rms_px * step.information.inverse();
    fit.sigma_px = std::sqrt(std::max(covariance(0, 0), covariance(1, 1)));
    fit.sigma_angle_rad = std::sqrt(covariance(2, 2));
    fit.rms_px = step.rms_px;
    fit.inlier_share = static_cast<double>(step.inliers) / fit.profiles;
    return fit;
}

}  // namespace pulseline::vision
