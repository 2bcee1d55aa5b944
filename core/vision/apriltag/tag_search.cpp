#include "core/vision/apriltag/tag_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::vision {
namespace {

constexpr int kBins = 90;  // one degree of border direction each
constexpr std::size_t kMostDirections = 3;
// Scores: two evenly lit, sharp levels are 1.
struct Effort {
    std::size_t peaks_per_direction;
    float least_score;
};
constexpr Effort kAnywhere{3, 0.45F};
constexpr Effort kInWindow{6, 0.3F};

/// Directions (radians in [0, pi/2)) with the most border, strongest first.
std::vector<double> border_directions(const cv::Mat& small) {
    cv::Mat gu;
    cv::Mat gv;
    cv::Sobel(small, gu, CV_16S, 1, 0);
    cv::Sobel(small, gv, CV_16S, 0, 1);
    std::array<double, kBins> histogram{};
    for (int v = 1; v + 1 < small.rows; ++v) {
        const auto* u_row = gu.ptr<std::int16_t>(v);
        const auto* v_row = gv.ptr<std::int16_t>(v);
        for (int u = 1; u + 1 < small.cols; ++u) {
            const float x = u_row[u];
            const float y = v_row[u];
            const float strength2 = x * x + y * y;
            constexpr float kLeast = 40;  // 5 grey levels a pixel
            if (strength2 < kLeast * kLeast) continue;
            double angle = static_cast<double>(cv::fastAtan2(y, x));
            angle -= 90 * std::floor(angle / 90);
            histogram[static_cast<std::size_t>(angle) % kBins] +=
                static_cast<double>(std::sqrt(strength2));
        }
    }
    std::array<double, kBins> smooth{};
    for (int i = 0; i < kBins; ++i)
        for (int k = -3; k <= 3; ++k)
            smooth[static_cast<std::size_t>(i)] +=
                (4 - std::abs(k)) * histogram[static_cast<std::size_t>((i + k + kBins) % kBins)];
    std::vector<double> directions;
    for (std::size_t n = 0; n < kMostDirections; ++n) {
        const auto top = std::ranges::max_element(smooth) - smooth.begin();
        if (smooth[static_cast<std::size_t>(top)] <= 0) break;
        // Centre of gravity about the top, then nothing else from there.
        double sum = 0;
        double moment = 0;
        for (int k = -2; k <= 2; ++k) {
            const auto i = static_cast<std::size_t>((top + k + kBins) % kBins);
            sum += histogram[i];
            moment += k * histogram[i];
        }
        directions.push_back(
            radians(static_cast<double>(top) + 0.5 + (sum > 0 ? moment / sum : 0)));
        for (int k = -6; k <= 6; ++k)
            smooth[static_cast<std::size_t>((top + k + kBins) % kBins)] = 0;
    }
    return directions;
}

/// Sums over squares about each pixel. Half sides are rounded to pixels; the shrunk image is
/// blurred by as much.
class BoxSums {
public:
    explicit BoxSums(const cv::Mat& image) {
        cv::integral(image, sum_, square_sum_, CV_32S, CV_64F);
    }

    struct Sums {
        double area = 0;
        double sum = 0;
        double squares = 0;
        Sums operator-(const Sums& inner) const {
            return {area - inner.area, sum - inner.sum, squares - inner.squares};
        }
        double mean() const { return sum / area; }
        double variance() const { return std::max(0.0, squares / area - mean() * mean()); }
    };
    Sums about(int u, int v, int half) const {
        const int l = u - half, r = u + half + 1, t = v - half, b = v + half + 1;
        const auto box = [&](const auto& m, auto zero) {
            using T = decltype(zero);  // sums over a large image wrap, differences do not
            return static_cast<double>(m.template at<T>(b, r) - m.template at<T>(t, r) -
                                       m.template at<T>(b, l) + m.template at<T>(t, l));
        };
        return {static_cast<double>(r - l) * (b - t), box(sum_, 0U), box(square_sum_, 0.0)};
    }

private:
    cv::Mat sum_;
    cv::Mat square_sum_;
};

struct Peak {
    double u = 0;
    double v = 0;
    float score = 0;
};

/// Places in the upright image where a light frame surrounds a dark one.
std::vector<Peak> frames(const cv::Mat& upright, double cell_px, const Effort& effort) {
    const BoxSums sums(upright);
    const auto half = [&](double cells) {
        return std::max(0, static_cast<int>(std::lround(cells * cell_px / 2 - 0.5)));
    };
    const int outer = half(plant::kTagCells + 2);
    const int border = half(plant::kTagCells);
    const int inner = half(plant::kTagCells - 2);
    cv::Mat score = cv::Mat::zeros(upright.size(), CV_32F);
    for (int v = outer; v + outer + 1 < upright.rows; ++v) {
        for (int u = outer; u + outer + 1 < upright.cols; ++u) {
            const auto square = sums.about(u, v, border);
            const auto margin = sums.about(u, v, outer) - square;
            const auto ring = square - sums.about(u, v, inner);
            const double contrast = margin.mean() - ring.mean();
            if (contrast < 6) continue;
            const double spread =
                std::sqrt((margin.variance() * margin.area + ring.variance() * ring.area) /
                          (margin.area + ring.area));
            score.at<float>(v, u) = static_cast<float>(contrast / (contrast + 2 * spread));
        }
    }
    const int apart = 2 * std::max(1, static_cast<int>(cell_px)) + 1;
    cv::Mat highest;
    cv::dilate(score, highest, cv::Mat::ones(apart, apart, CV_8U));
    std::vector<Peak> peaks;
    for (int v = 1; v + 1 < score.rows; ++v)
        for (int u = 1; u + 1 < score.cols; ++u)
            if (const float s = score.at<float>(v, u);
                s >= effort.least_score && s >= highest.at<float>(v, u))
                peaks.push_back({static_cast<double>(u), static_cast<double>(v), s});
    std::ranges::sort(peaks, std::ranges::greater{}, &Peak::score);
    if (peaks.size() > effort.peaks_per_direction) peaks.resize(effort.peaks_per_direction);
    return peaks;
}

double quarter(double angle_rad) { return angle_rad - kPi / 2 * std::floor(angle_rad / (kPi / 2)); }

/// Which of its four turns a tag has is not known yet.
bool is_near(Pixel centre, const SearchImage& image) {
    if (!image.window) return true;
    const Pixel off = centre - image.window->centre;
    return std::hypot(off.u, off.v) <= image.window->reach_px;
}

}  // namespace

std::vector<Placement> search_tags(const SearchImage& image, const plant::Camera& camera,
                                   double expected_cell_px) {
    const cv::Mat& small = image.small;
    if (small.empty()) return {};
    const double cell = expected_cell_px / image.shrink;
    const double room = (plant::kTagCells + 2) * cell;  // margins may reach out of the image
    if (!(room <= small.cols + small.rows)) return {};  // larger than the image
    struct Candidate {
        Placement placement;
        float score;
    };
    std::vector<Candidate> candidates;
    const auto directions =
        image.window ? std::vector{quarter(image.window->angle_rad)} : border_directions(small);
    for (const double direction : directions) {
        const double c = std::cos(direction);
        const double s = std::sin(direction);
        const cv::Size size(static_cast<int>(small.cols * c + small.rows * s + room),
                            static_cast<int>(small.cols * s + small.rows * c + room));
        const Pixel from{(small.cols - 1) / 2.0, (small.rows - 1) / 2.0};
        const Pixel to{(size.width - 1) / 2.0, (size.height - 1) / 2.0};
        const cv::Matx23d turn(c, s, to.u - c * from.u - s * from.v, -s, c,
                               to.v + s * from.u - c * from.v);
        cv::Mat upright;
        cv::warpAffine(small, upright, turn, size, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
        for (const Peak& peak : frames(upright, cell, image.window ? kInWindow : kAnywhere)) {
            const double du = peak.u - to.u;
            const double dv = peak.v - to.v;
            const Pixel at{from.u + c * du - s * dv, from.v + s * du + c * dv};
            if (at.u < 0 || at.v < 0 || at.u > small.cols - 1 || at.v > small.rows - 1) continue;
            Placement p;
            p.centre = image.ideal(camera, at.u, at.v);
            p.angle_rad = direction;
            p.unit_px = expected_cell_px;
            if (!is_near(p.centre, image)) continue;
            candidates.push_back({p, peak.score});
        }
    }
    std::ranges::sort(candidates, std::ranges::greater{}, &Candidate::score);
    std::vector<Placement> placements;
    for (const Candidate& candidate : candidates) placements.push_back(candidate.placement);
    return placements;
}

}  // namespace pulseline::vision
