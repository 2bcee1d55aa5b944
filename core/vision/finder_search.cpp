#include "core/vision/finder_search.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::vision {
namespace {

constexpr float kLeastScore = 0.35F;
constexpr std::size_t kMostPeaks = 14;
constexpr std::size_t kMostPlacements = 4;
constexpr double kLeg = plant::kQrModules - 7;  // modules between finder centres
constexpr double kLegTolerance = 0.08;          // of the leg: peaks are good to about half a module

struct Peak {
    Pixel ideal;
    float score;
};

/// Finder pattern with its light separator, averaged over all rotations.
cv::Mat round_finder(double module_px) {
    const int reach = static_cast<int>(std::lround(4.5 * module_px));
    cv::Mat pattern(2 * reach + 1, 2 * reach + 1, CV_8U);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const double r = std::hypot(x, y) / module_px;
            constexpr int kTurns = 16;
            int light = 0;
            for (int i = 0; i < kTurns; ++i) {
                const double t =
                    kPi / 4 * i / kTurns;  // the square repeats after 45 degrees, mirrored
                const double ring = r * std::max(std::cos(t), std::sin(t));
                light += (ring > 1.5 && ring < 2.5) || ring > 3.5;
            }
            pattern.at<std::uint8_t>(y + reach, x + reach) =
                static_cast<std::uint8_t>(255 * light / kTurns);
        }
    }
    return pattern;
}

std::vector<Peak> find_peaks(const cv::Mat& grey, const plant::Camera& camera, double module_px,
                             int shrink) {
    cv::Mat small = grey;  // halved step by step: OpenCV vectorises only that
    for (int step = shrink; step > 1; step /= 2)
        cv::resize(small, small, cv::Size(small.cols / 2, small.rows / 2), 0, 0, cv::INTER_AREA);
    const cv::Mat pattern = round_finder(module_px / shrink);
    const int reach = pattern.cols / 2;
    cv::Mat padded;  // finders near the border of the image
    cv::copyMakeBorder(small, padded, reach, reach, reach, reach, cv::BORDER_REPLICATE);
    cv::Mat score;
    cv::matchTemplate(padded, pattern, score, cv::TM_CCOEFF_NORMED);
    const int apart = static_cast<int>(1.5 * module_px / shrink);
    const auto is_highest = [&](int u, int v) {
        const float s = score.at<float>(v, u);
        for (int y = std::max(0, v - apart); y <= std::min(score.rows - 1, v + apart); ++y)
            for (int x = std::max(0, u - apart); x <= std::min(score.cols - 1, u + apart); ++x)
                if (score.at<float>(y, x) > s) return false;
        return true;
    };
    std::vector<Peak> peaks;
    for (int v = 1; v + 1 < score.rows; ++v) {
        for (int u = 1; u + 1 < score.cols; ++u) {
            const float s = score.at<float>(v, u);
            if (s < kLeastScore || !is_highest(u, v)) continue;
            const auto vertex = [s](float before, float after) -> double {
                const float bend = before + after - 2 * s;
                return bend < 0 ? (before - after) / (2 * bend) : 0.0F;
            };
            const double su = u + vertex(score.at<float>(v, u - 1), score.at<float>(v, u + 1));
            const double sv = v + vertex(score.at<float>(v - 1, u), score.at<float>(v + 1, u));
            const Pixel image{shrink * (su + 0.5) - 0.5, shrink * (sv + 0.5) - 0.5};
            peaks.push_back({undistorted(camera, image), s});
        }
    }
    std::ranges::sort(peaks, std::ranges::greater{}, &Peak::score);
    if (peaks.size() > kMostPeaks) peaks.resize(kMostPeaks);
    return peaks;
}

}  // namespace

std::vector<Placement> search_finders(const cv::Mat& grey, const plant::Camera& camera,
                                      double expected_module_px, int shrink) {
    const std::vector<Peak> peaks = find_peaks(grey, camera, expected_module_px, shrink);
    const double leg_px = kLeg * expected_module_px;
    struct Candidate {
        Placement placement;
        float score;
    };
    std::vector<Candidate> candidates;
    for (const Peak& corner : peaks) {
        for (const Peak& right : peaks) {
            const Pixel a = right.ideal - corner.ideal;
            const double leg = std::hypot(a.u, a.v);
            if (std::abs(leg - leg_px) > kLegTolerance * leg_px) continue;
            for (const Peak& low : peaks) {  // a quarter turn from +u to +v: never mirrored
                const Pixel b = low.ideal - corner.ideal;
                if (std::hypot(b.u + a.v, b.v - a.u) > kLegTolerance * leg_px) continue;
                const Pixel x{(a.u + b.v) / 2, (a.v - b.u) / 2};
                candidates.push_back({{corner.ideal + 0.5 * (a + b), std::atan2(x.v, x.u),
                                       std::hypot(x.u, x.v) / kLeg},
                                      corner.score + right.score + low.score});
            }
        }
    }
    std::ranges::sort(candidates, std::ranges::greater{}, &Candidate::score);
    std::vector<Placement> placements;
    for (const Candidate& c : candidates)
        if (placements.size() < kMostPlacements) placements.push_back(c.placement);
    return placements;
}

}  // namespace pulseline::vision
