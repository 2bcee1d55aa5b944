#include "core/localisation/reflector_sights.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/base/square.hpp"

namespace pulseline::localisation {
namespace {

constexpr double kBeamAtLens_m = 0.020;
constexpr double kBeamSpread_rad = 0.005;
constexpr double kNearest_m = 0.3;  // nearer the lens sees nothing
constexpr double kSameRange_m = 0.15;
constexpr double kNeighbour = 1.5;  // steps between rays side by side
constexpr double kTooWide = 1.5;    // times as wide as a reflector and the beam are
constexpr int kWays = 32;           // that the rays may fall beside the axis, looked at
// Mean over a lit half circle of how far its face lies before the axis.
constexpr double kFace = kPi / 4;

/// Left of a line at distance u from the middle, of a disc of radius 1.
double share_of_disc(double u) {
    const double c = std::clamp(u, -1.0, 1.0);
    return 0.5 + (c * std::sqrt(1 - c * c) + std::asin(c)) / kPi;
}

/// Bright rays about a bearing, without noise.
std::vector<BrightEcho> rays_about(const plant::NavigationScanner& scanner, double range_m,
                                   double bearing_rad) {
    std::vector<BrightEcho> rays;
    const double reach_m = scanner.reflector_radius_m + beam_radius_m(range_m);
    const int most = static_cast<int>(reach_m / (range_m * scanner.step_rad)) + 1;
    for (int i = -most; i <= most; ++i) {
        const double angle_rad = i * scanner.step_rad;
        const double remission =
            remission_at(scanner, range_m, (angle_rad - bearing_rad) * range_m);
        if (remission >= kLeastRemission) rays.push_back({angle_rad, range_m, remission, 0});
    }
    return rays;
}

double middle_rad(std::span<const BrightEcho> rays) {
    double sum = 0;
    double weighted_rad = 0;
    for (const BrightEcho& ray : rays) {
        sum += ray.remission;
        weighted_rad += ray.remission * wrap(ray.angle_rad - rays.front().angle_rad);
    }
    return wrap(rays.front().angle_rad + weighted_rad / sum);
}

/// How far the middle of so many samples of its brightness lies from a reflector's, over all ways
/// that the rays may fall on it.
double sampling_rad(const plant::NavigationScanner& scanner, double range_m, std::size_t count) {
    double off2 = 0;
    int ways = 0;
    for (int way = 0; way < kWays; ++way) {
        const double bearing_rad = (way + 0.5) / kWays * scanner.step_rad;
        const auto rays = rays_about(scanner, range_m, bearing_rad);
        if (rays.size() != count) continue;
        off2 += square(middle_rad(rays) - bearing_rad);
        ++ways;
    }
    return ways > 0 ? std::sqrt(off2 / ways) : scanner.step_rad / std::sqrt(12.0);
}

/// Spread of the middle of brightness by noise of each ray's.
double noise_rad(std::span<const BrightEcho> rays, double middle_rad, double remission) {
    double sum = 0;
    double moved = 0;
    for (const BrightEcho& ray : rays) {
        sum += ray.remission;
        moved += square(ray.remission * remission * wrap(ray.angle_rad - middle_rad));
    }
    return std::sqrt(moved) / sum;
}

ReflectorSight sight_of(std::span<const BrightEcho> rays, const plant::NavigationScanner& scanner,
                        const ReflectorErrors& errors) {
    ReflectorSight sight;
    double sum = 0;
    for (const BrightEcho& ray : rays) {
        sum += ray.remission;
        sight.range_m += ray.remission * ray.range_m;
        sight.age_s += ray.remission * ray.age_s;
    }
    sight.rays = static_cast<int>(rays.size());
    sight.bearing_rad = middle_rad(rays);
    sight.range_m = sight.range_m / sum + kFace * scanner.reflector_radius_m;
    sight.age_s /= sum;
    sight.sigma_range_m = scanner.sigma_range_m / std::sqrt(sum);
    sight.sigma_bearing_rad = std::hypot(scanner.sigma_bearing_rad / std::sqrt(sight.rays),
                                         sampling_rad(scanner, sight.range_m, rays.size()),
                                         noise_rad(rays, sight.bearing_rad, errors.remission));
    return sight;
}

/// Wider than a reflector that fills the beam from edge to edge.
bool too_wide(std::span<const BrightEcho> rays, const plant::NavigationScanner& scanner) {
    const double range_m = rays.front().range_m;
    const double width_rad = std::abs(wrap(rays.back().angle_rad - rays.front().angle_rad));
    const double most_m = 2 * (scanner.reflector_radius_m + beam_radius_m(range_m));
    return width_rad * range_m > kTooWide * most_m;
}

}  // namespace

double beam_radius_m(double range_m) { return (kBeamAtLens_m + kBeamSpread_rad * range_m) / 2; }

double remission_at(const plant::NavigationScanner& scanner, double range_m, double beside_m) {
    const double beam_m = beam_radius_m(range_m);
    return share_of_disc((scanner.reflector_radius_m - beside_m) / beam_m) -
           share_of_disc((-scanner.reflector_radius_m - beside_m) / beam_m);
}

std::vector<ReflectorSight> reflector_sights(std::span<const BrightEcho> echoes,
                                             const plant::NavigationScanner& scanner,
                                             const ReflectorErrors& errors) {
    std::vector<BrightEcho> rays(echoes.begin(), echoes.end());
    std::erase_if(rays, [](const BrightEcho& ray) {
        return !(ray.remission >= kLeastRemission) || !(ray.range_m >= kNearest_m) ||
               !std::isfinite(ray.range_m) || !std::isfinite(ray.angle_rad);
    });
    std::ranges::sort(rays, {}, [](const BrightEcho& ray) { return wrap(ray.angle_rad); });
    const auto together = [&](const BrightEcho& a, const BrightEcho& b) {
        return std::abs(wrap(b.angle_rad - a.angle_rad)) <= kNeighbour * scanner.step_rad &&
               std::abs(b.range_m - a.range_m) <= kSameRange_m;
    };
    // The turn has no end: what lies across its seam begins with the last rays.
    auto begin = std::ranges::adjacent_find(
        rays, [&](const BrightEcho& a, const BrightEcho& b) { return !together(a, b); });
    if (begin != rays.end()) std::rotate(rays.begin(), begin + 1, rays.end());

    std::vector<ReflectorSight> sights;
    for (std::size_t from = 0; from < rays.size();) {
        std::size_t to = from + 1;
        while (to < rays.size() && together(rays[to - 1], rays[to])) ++to;
        const std::span<const BrightEcho> one(rays.data() + from, to - from);
        if (!too_wide(one, scanner)) sights.push_back(sight_of(one, scanner, errors));
        from = to;
    }
    return sights;
}

}  // namespace pulseline::localisation
