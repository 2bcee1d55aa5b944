#include "core/vision/landmark/landmark_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/search/round_search.hpp"

namespace pulseline::vision {
namespace {

namespace landmark = plant::landmark;

constexpr float kLeastScore = 0.4F;
constexpr std::size_t kMostPeaks = 40;
constexpr std::size_t kMostPlacements = 6;
constexpr int kFewestDots = 4;
constexpr int kFewestDotsInWindow = 3;
constexpr double kScaleTolerance = 0.06;  // of a pair's distance: peaks are good to 0.3 mm
constexpr double kDotTolerance_m = 0.0012;

/// Dot i in marker coordinates: right, down.
Pixel dot(std::size_t i) { return {landmark::kDots[i].right_m, -landmark::kDots[i].up_m}; }

RoundPattern dark_dot(double px_per_m) {
    const double radius = landmark::kDot_m * px_per_m;
    return {1.8 * radius, [radius](double r) { return r < radius ? 0.0 : 1.0; }};
}

struct Similarity {  // image = shift + (c, s; -s, c) marker
    double c = 0;
    double s = 0;
    Pixel shift;
    Pixel at(Pixel m) const { return {shift.u + c * m.u - s * m.v, shift.v + s * m.u + c * m.v}; }
};

struct Match {
    std::array<const RoundPeak*, 5> peaks{};
    int count = 0;
    float score = 0;
};

Match match(const Similarity& place, const std::vector<RoundPeak>& peaks, double tolerance_px) {
    Match m;
    for (std::size_t i = 0; i < landmark::kDots.size(); ++i) {
        const Pixel want = place.at(dot(i));
        double nearest = tolerance_px;
        for (const RoundPeak& peak : peaks) {
            const double d = std::hypot(peak.ideal.u - want.u, peak.ideal.v - want.v);
            if (d >= nearest) continue;
            nearest = d;
            m.peaks[i] = &peak;
        }
        if (m.peaks[i] == nullptr) continue;
        ++m.count;
        m.score += m.peaks[i]->score - static_cast<float>(0.5 * nearest / tolerance_px);
    }
    return m;
}

/// Least squares over the matched dots (core/localisation/README.md, with scale).
Similarity refined(const Match& m) {
    Pixel marker;
    Pixel image;
    for (std::size_t i = 0; i < m.peaks.size(); ++i) {
        if (m.peaks[i] == nullptr) continue;
        marker = marker + (1.0 / m.count) * dot(i);
        image = image + (1.0 / m.count) * m.peaks[i]->ideal;
    }
    double along = 0, across = 0, size2 = 0;
    for (std::size_t i = 0; i < m.peaks.size(); ++i) {
        if (m.peaks[i] == nullptr) continue;
        const Pixel p = dot(i) - marker;
        const Pixel q = m.peaks[i]->ideal - image;
        along += p.u * q.u + p.v * q.v;
        across += p.u * q.v - p.v * q.u;
        size2 += p.u * p.u + p.v * p.v;
    }
    Similarity fit{along / size2, across / size2, {}};
    fit.shift = image - fit.at(marker);
    return fit;
}

}  // namespace

std::vector<Placement> search_landmarks(const SearchImage& image, const plant::Camera& camera,
                                        double expected_px_per_m) {
    const auto peaks =
        find_round(image, camera, dark_dot(expected_px_per_m), kLeastScore, kMostPeaks);
    const int fewest = image.window ? kFewestDotsInWindow : kFewestDots;
    const double tolerance_px = kDotTolerance_m * expected_px_per_m;
    struct Candidate {
        Placement placement;
        float score;
    };
    std::vector<Candidate> candidates;
    const auto consider = [&](const RoundPeak& first, const RoundPeak& second, std::size_t i,
                              std::size_t j) {
        const Pixel m = dot(j) - dot(i);
        const Pixel p = second.ideal - first.ideal;
        const double length = expected_px_per_m * std::hypot(m.u, m.v);
        if (std::abs(std::hypot(p.u, p.v) - length) > kScaleTolerance * length) return;
        const double size2 = m.u * m.u + m.v * m.v;
        Similarity start{(m.u * p.u + m.v * p.v) / size2, (m.u * p.v - m.v * p.u) / size2, {}};
        start.shift = first.ideal - start.at(dot(i));
        const Match rough = match(start, peaks, 1.5 * tolerance_px);
        if (rough.count < fewest) return;
        const Match fine = match(refined(rough), peaks, tolerance_px);
        if (fine.count < fewest) return;
        const Similarity place = refined(fine);
        Placement placement;
        placement.centre = place.shift;
        placement.angle_rad = std::atan2(place.s, place.c);
        placement.unit_px = std::hypot(place.c, place.s);
        if (image.wants(placement)) candidates.push_back({placement, fine.score});
    };
    for (const RoundPeak& first : peaks)
        for (const RoundPeak& second : peaks)
            if (&first != &second)
                for (std::size_t i = 0; i < landmark::kDots.size(); ++i)
                    for (std::size_t j = i + 1; j < landmark::kDots.size(); ++j)
                        consider(first, second, i, j);
    std::ranges::sort(candidates, std::ranges::greater{}, &Candidate::score);
    std::vector<Placement> placements;
    for (const Candidate& c : candidates) {
        const bool known = std::ranges::any_of(placements, [&](const Placement& p) {
            return std::hypot(p.centre.u - c.placement.centre.u,
                              p.centre.v - c.placement.centre.v) < 2 * tolerance_px &&
                   std::abs(wrap(p.angle_rad - c.placement.angle_rad)) < 0.1;
        });
        if (!known) placements.push_back(c.placement);
        if (placements.size() == kMostPlacements) break;
    }
    return placements;
}

}  // namespace pulseline::vision
