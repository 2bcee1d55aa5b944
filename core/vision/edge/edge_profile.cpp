#include "core/vision/edge/edge_profile.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/vision/edge/median.hpp"
#include "core/vision/edge/sample.hpp"

namespace pulseline::vision {
namespace {

constexpr double kLeastContrast = 0.35;  // of the usual one
constexpr double kPatchAlong_px = 2.2;   // half widths of the patches the levels are taken from
constexpr double kPatchAcross_px = 3;

struct Levels {
    Pixel foot;    // ideal
    Pixel normal;  // ideal
    Pixel image_foot;
    Pixel image_normal;
    double dark = 0;
    double light = 0;
};

/// Mean of the middle and the corners of a small rectangle; negative when it leaves the image.
double patch_level(const cv::Mat& grey, Pixel middle, Pixel normal) {
    const Pixel across = kPatchAcross_px * normal;
    const Pixel along{-kPatchAlong_px * normal.v, kPatchAlong_px * normal.u};
    // The corners and not their usual distance: a lens may stretch the rectangle.
    const std::array<Pixel, 5> places{middle, middle + across + along, middle + across - along,
                                      middle - across + along, middle - across - along};
    float sum = 0;
    for (const Pixel place : places) {
        if (!sampleable(grey, place)) return -1;
        sum += sample(grey, place);
    }
    return static_cast<double>(sum) / places.size();
}

std::vector<Levels> measure_levels(const cv::Mat& grey, const plant::Camera& camera,
                                   std::span<const EdgeSite> sites, const Placement& placement,
                                   const ProfileShape& shape) {
    const double c = std::cos(placement.angle_rad);
    const double s = std::sin(placement.angle_rad);
    const double r = shape.reference_px;
    std::vector<Levels> all;
    all.reserve(sites.size() / static_cast<std::size_t>(shape.every) + 1);
    for (std::size_t i = 0; i < sites.size(); i += static_cast<std::size_t>(shape.every)) {
        const EdgeSite& site = sites[i];
        Levels at;
        at.foot = placement.at(site.a, site.b);
        at.normal = {c * site.na - s * site.nb, s * site.na + c * site.nb};
        // Lens distortion bends a profile of 20 px by less than 1e-3 px: straight in the image.
        const Pixel dark_end = distorted(camera, at.foot - r * at.normal);
        const Pixel light_end = distorted(camera, at.foot + r * at.normal);
        at.image_foot = 0.5 * (dark_end + light_end);
        at.image_normal = (0.5 / r) * (light_end - dark_end);
        at.dark = patch_level(grey, dark_end, at.image_normal);
        at.light = patch_level(grey, light_end, at.image_normal);
        if (at.dark >= 0 && at.light >= 0) all.push_back(at);
    }
    return all;
}

/// Slope [grey levels per px] of a plane through one side's levels, outliers (dirt) trimmed.
Pixel shading(const std::vector<Levels>& all, double Levels::*level, Pixel about) {
    Eigen::Vector3d plane = Eigen::Vector3d::Zero();
    double limit = 1e9;
    std::vector<double> residuals;
    residuals.reserve(all.size());
    for (int pass = 0; pass < 3; ++pass) {
        double n = 0, su = 0, sv = 0, suu = 0, suv = 0, svv = 0, sl = 0, slu = 0, slv = 0;
        residuals.clear();
        for (const Levels& at : all) {
            const double u = at.foot.u - about.u;
            const double v = at.foot.v - about.v;
            const double l = at.*level;
            const double residual = std::abs(l - plane[0] - plane[1] * u - plane[2] * v);
            if (residual > limit) continue;
            residuals.push_back(residual);
            n += 1, su += u, sv += v, suu += u * u, suv += u * v, svv += v * v;
            sl += l, slu += l * u, slv += l * v;
        }
        if (residuals.size() < 12) return {};
        if (pass == 1) limit = std::max(1.0, 4 * median(residuals).value_or(0));
        Eigen::Matrix3d normal;
        normal << n, su, sv, su, suu, suv, sv, suv, svv;
        plane = normal.ldlt().solve(Eigen::Vector3d{sl, slu, slv});
    }
    return {plane[1], plane[2]};
}

}  // namespace

EdgeObservations observe_edges(const cv::Mat& grey, const plant::Camera& camera,
                               std::span<const EdgeSite> sites, const Placement& placement,
                               const ProfileShape& shape) {
    const std::vector<Levels> all = measure_levels(grey, camera, sites, placement, shape);
    EdgeObservations out;
    out.tried = static_cast<int>(all.size());
    if (all.size() < 12) return out;
    std::vector<double> contrasts;
    contrasts.reserve(all.size());
    for (const Levels& at : all) contrasts.push_back(at.light - at.dark);
    const double least = std::max(4.0, kLeastContrast * median(contrasts).value_or(0));
    const Pixel dark_slope = shading(all, &Levels::dark, placement.centre);
    const Pixel light_slope = shading(all, &Levels::light, placement.centre);
    const int reach = shape.reach_px;
    out.seen.reserve(all.size());
    for (const Levels& at : all) {
        // Levels are carried from where they are taken to the border along the shading.
        const double rise_dark = dark_slope.u * at.normal.u + dark_slope.v * at.normal.v;
        const double rise_light = light_slope.u * at.normal.u + light_slope.v * at.normal.v;
        const double dark = at.dark + rise_dark * shape.reference_px;
        const double light = at.light - rise_light * shape.reference_px;
        if (light - dark < least) continue;
        const Pixel begin = at.image_foot - static_cast<double>(reach) * at.image_normal;
        const Pixel end = begin + static_cast<double>(2 * reach) * at.image_normal;
        // Of a coarse print the profile is longer than the way between its levels.
        if (!sampleable(grey, begin) || !sampleable(grey, end)) continue;
        double sum = 0;
        for (int i = 0; i <= 2 * reach; ++i) {
            const auto grey_level =
                static_cast<double>(sample(grey, begin + static_cast<double>(i) * at.image_normal));
            sum += (i == 0 || i == 2 * reach ? 0.5 : 1.0) * (grey_level - dark);
        }
        // The slopes of dark and light differ: their ramps do not cancel about the border.
        sum -= (rise_light - rise_dark) * reach * reach / 2;
        // All light over the whole profile gives 2 reach; a border at 0 gives reach.
        const double offset = reach - sum / (light - dark);
        if (std::abs(offset) < reach) out.seen.push_back({at.foot, at.normal, offset});
    }
    return out;
}

}  // namespace pulseline::vision
