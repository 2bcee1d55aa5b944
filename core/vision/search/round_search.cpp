#include "core/vision/search/round_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/imgproc.hpp>

namespace pulseline::vision {
namespace {

struct Tap {
    int du;
    int dv;
    float weight;
};

/// Rings a pixel apart or a little more, taps as far apart on them; weights of mean 0, norm 1.
std::vector<Tap> ring_taps(const RoundPattern& pattern, int shrink) {
    const double reach = pattern.reach_px / shrink;
    const double spacing = std::max(1.0, reach / 10);
    std::vector<Tap> taps;
    for (double r = 0; r <= reach; r += spacing) {
        const int count = std::max(1, static_cast<int>(2 * kPi * r / (2.2 * spacing)));
        const auto light = static_cast<float>(pattern.light(r * shrink));
        for (int i = 0; i < count; ++i) {
            const double t = 2 * kPi * (i + r) / count;
            taps.push_back({static_cast<int>(std::lround(r * std::cos(t))),
                            static_cast<int>(std::lround(r * std::sin(t))), light});
        }
    }
    float mean = 0;
    for (const Tap& tap : taps) mean += tap.weight / static_cast<float>(taps.size());
    float norm2 = 0;
    for (Tap& tap : taps) {
        tap.weight -= mean;
        norm2 += tap.weight * tap.weight;
    }
    if (!(norm2 > 0)) return {};  // smaller than a pixel: no pattern
    for (Tap& tap : taps) tap.weight /= std::sqrt(norm2 * static_cast<float>(taps.size()));
    return taps;
}

// A plain floor's noise and grain must not look like a pattern, nor cost time.
constexpr float kLeastDeviation = 5;
constexpr int kBlock = 16;  // pixels whose sums stay in registers

/// Standard deviation over the square about each pixel of the unpadded image.
cv::Mat local_deviation(const cv::Mat& padded, cv::Size size, int reach) {
    cv::Mat sum;
    cv::Mat squares;
    cv::integral(padded, sum, squares, CV_32S, CV_64F);
    const int side = 2 * reach + 1;
    const auto share = 1 / static_cast<float>(side * side);
    cv::Mat deviation(size, CV_32F);
    for (int v = 0; v < size.height; ++v) {
        // Sums over a large image wrap; their differences over a square do not.
        const auto* s0 = sum.ptr<std::uint32_t>(v);
        const auto* s1 = sum.ptr<std::uint32_t>(v + side);
        const double* q0 = squares.ptr<double>(v);
        const double* q1 = squares.ptr<double>(v + side);
        auto* out = deviation.ptr<float>(v);
        for (int u = 0; u < size.width; ++u) {
            const float mean =
                share * static_cast<float>(s1[u + side] - s1[u] - s0[u + side] + s0[u]);
            const float square =
                share * static_cast<float>(q1[u + side] - q1[u] - q0[u + side] + q0[u]);
            out[u] = std::sqrt(std::max(square - mean * mean, 0.0F));
        }
    }
    return deviation;
}

cv::Mat correlate(const cv::Mat& small, const std::vector<Tap>& taps, int reach) {
    cv::Mat padded;  // patterns near the border of the image; whole blocks to the right
    cv::copyMakeBorder(small, padded, reach, reach, reach, reach + kBlock, cv::BORDER_REPLICATE);
    cv::Mat image;
    padded.convertTo(image, CV_32F);
    const cv::Mat deviation = local_deviation(padded, {small.cols + kBlock, small.rows}, reach);
    cv::Mat score = cv::Mat::zeros(small.size(), CV_32F);
    for (int v = 0; v < score.rows; ++v) {
        const float* spread = deviation.ptr<float>(v);
        for (int u = 0; u < score.cols; u += kBlock) {
            if (*std::max_element(spread + u, spread + u + kBlock) < kLeastDeviation) continue;
            std::array<float, kBlock> sum{};
            for (const Tap& tap : taps) {
                const float* from = image.ptr<float>(v + reach + tap.dv) + reach + tap.du + u;
                for (std::size_t i = 0; i < kBlock; ++i) sum[i] += tap.weight * from[i];
            }
            auto* out = score.ptr<float>(v) + u;
            for (int i = 0; i < std::min(kBlock, score.cols - u); ++i)
                out[i] =
                    sum[static_cast<std::size_t>(i)] / std::max(spread[u + i], kLeastDeviation);
        }
    }
    return score;
}

double vertex(float before, float top, float after) {
    const float bend = before + after - 2 * top;
    return bend < 0 ? static_cast<double>((before - after) / (2 * bend)) : 0;
}

}  // namespace

std::vector<RoundPeak> find_round(const SearchImage& image, const plant::Camera& camera,
                                  const RoundPattern& pattern, float least_score,
                                  std::size_t most) {
    if (image.small.empty()) return {};
    // What is larger than the image cannot be on it, and the border around it has to be bounded.
    if (!(pattern.reach_px / image.shrink <= std::max(image.small.cols, image.small.rows)))
        return {};
    const int reach = static_cast<int>(std::ceil(pattern.reach_px / image.shrink));
    const auto taps = ring_taps(pattern, image.shrink);
    if (taps.empty()) return {};
    const cv::Mat score = correlate(image.small, taps, reach);
    const int apart = 2 * std::max(1, reach / 3) + 1;
    cv::Mat highest;
    cv::dilate(score, highest, cv::Mat::ones(apart, apart, CV_8U));
    std::vector<RoundPeak> peaks;
    for (int v = 1; v + 1 < score.rows; ++v) {
        const float* row = score.ptr<float>(v);
        const float* top = highest.ptr<float>(v);
        for (int u = 1; u + 1 < score.cols; ++u) {
            if (row[u] < least_score || row[u] < top[u]) continue;
            const double su = u + vertex(row[u - 1], row[u], row[u + 1]);
            const double sv =
                v + vertex(score.at<float>(v - 1, u), row[u], score.at<float>(v + 1, u));
            peaks.push_back({image.ideal(camera, su, sv), row[u]});
        }
    }
    std::ranges::sort(peaks, std::ranges::greater{}, &RoundPeak::score);
    if (peaks.size() > most) peaks.resize(most);
    return peaks;
}

}  // namespace pulseline::vision
