#include "core/vision/qr/finder_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/search/round_search.hpp"

namespace pulseline::vision {
namespace {

constexpr float kLeastScore = 0.3F;
constexpr std::size_t kMostPeaks = 14;
constexpr std::size_t kMostTriples = 4;
constexpr std::size_t kMostPairs = 12;
constexpr std::size_t kMostSingles = 60;
constexpr double kSingleTurn_rad = kPi / 360;
constexpr double kLeg = plant::kQrModules - 7;  // modules between finder centres
constexpr double kLegTolerance = 0.08;          // of the leg: peaks are good to half a module

/// Finder pattern with its light separator, averaged over all rotations.
RoundPattern round_finder(double module_px) {
    return {4.5 * module_px, [module_px](double r_px) {
                const double r = r_px / module_px;
                constexpr int kTurns = 16;
                int light = 0;
                for (int i = 0; i < kTurns; ++i) {
                    // The square repeats after 45 degrees, mirrored.
                    const double t = kPi / 4 * i / kTurns;
                    const double ring = r * std::max(std::cos(t), std::sin(t));
                    light += (ring > 1.5 && ring < 2.5) || ring > 3.5;
                }
                return static_cast<double>(light) / kTurns;
            }};
}

struct Candidate {
    Placement placement;
    float score = 0;
};

/// From the middle of the upper left finder along the upper row and down the left column.
Candidate candidate(Pixel corner, Pixel right, Pixel down, float score) {
    const Pixel x{(right.u + down.v) / 2, (right.v - down.u) / 2};
    Candidate c;
    c.placement.centre = corner + 0.5 * (right + down);
    c.placement.angle_rad = std::atan2(x.v, x.u);
    c.placement.unit_px = std::hypot(x.u, x.v) / kLeg;
    c.score = score;
    return c;
}

/// Placements in the window that put a finder of the code onto a peak.
std::vector<Candidate> singles(const std::vector<RoundPeak>& peaks, const SearchWindow& window,
                               double module_px) {
    constexpr double kHalfLeg = kLeg / 2;
    constexpr std::array<Pixel, 3> kFinders{
        {{-kHalfLeg, -kHalfLeg}, {kHalfLeg, -kHalfLeg}, {-kHalfLeg, kHalfLeg}}};
    const int turns = static_cast<int>(window.reach_rad / kSingleTurn_rad);
    std::vector<Candidate> found;
    for (const RoundPeak& peak : peaks) {
        for (const Pixel finder : kFinders) {
            for (int turn = -turns; turn <= turns; ++turn) {
                Candidate c;
                c.placement.angle_rad = window.angle_rad + turn * kSingleTurn_rad;
                c.placement.unit_px = module_px;
                c.placement.centre = peak.ideal - c.placement.turned(finder.u, finder.v);
                // Odometry is better than its reach mostly.
                c.score = peak.score - 0.1F * static_cast<float>(std::abs(turn));
                if (window.holds(c.placement)) found.push_back(c);
            }
        }
    }
    return found;
}

void keep_best(std::vector<Candidate>& candidates, std::size_t most,
               std::vector<Placement>& placements) {
    std::ranges::sort(candidates, std::ranges::greater{}, &Candidate::score);
    for (std::size_t i = 0; i < std::min(most, candidates.size()); ++i)
        placements.push_back(candidates[i].placement);
}

}  // namespace

std::vector<Placement> search_finders(const SearchImage& image, const plant::Camera& camera,
                                      double expected_module_px) {
    const auto peaks =
        find_round(image, camera, round_finder(expected_module_px), kLeastScore, kMostPeaks);
    const double leg_px = kLeg * expected_module_px;
    const auto is_long = [&](Pixel way, double length) {
        return std::abs(std::hypot(way.u, way.v) - length) < kLegTolerance * leg_px;
    };
    std::vector<Candidate> triples;
    std::vector<Candidate> pairs;
    for (const RoundPeak& first : peaks) {
        for (const RoundPeak& second : peaks) {
            const Pixel a = second.ideal - first.ideal;
            const float score = first.score + second.score;
            if (is_long(a, leg_px)) {
                // A quarter turn from +u to +v: never mirrored.
                const Pixel turned{-a.v, a.u};
                for (const RoundPeak& low : peaks) {
                    const Pixel b = low.ideal - first.ideal;
                    if (std::hypot(b.u - turned.u, b.v - turned.v) < kLegTolerance * leg_px)
                        triples.push_back(candidate(first.ideal, a, b, score + low.score));
                }
                // Upper row, or left column read upwards, with the third finder spoilt.
                pairs.push_back(candidate(first.ideal, a, turned, score));
                pairs.push_back(candidate(second.ideal, turned, Pixel{-a.u, -a.v}, score));
            } else if (is_long(a, std::sqrt(2.0) * leg_px)) {
                // Lower left and upper right: the corner lies to the left of the way.
                const Pixel corner = first.ideal + 0.5 * Pixel{a.u + a.v, a.v - a.u};
                pairs.push_back(
                    candidate(corner, second.ideal - corner, first.ideal - corner, score));
            }
        }
    }
    std::vector<Placement> placements;
    for (auto* found : {&triples, &pairs})
        std::erase_if(*found, [&](const Candidate& c) { return !image.wants(c.placement); });
    keep_best(triples, kMostTriples, placements);
    keep_best(pairs, kMostPairs, placements);
    if (image.window) {
        auto alone = singles(peaks, *image.window, expected_module_px);
        keep_best(alone, kMostSingles, placements);
    }
    return placements;
}

}  // namespace pulseline::vision
