#include "core/vision/landmark/landmark_code.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/plant/marker_geometry.hpp"
#include "core/vision/edge/median.hpp"
#include "core/vision/edge/sample.hpp"
#include "core/vision/optics/level_plane.hpp"

namespace pulseline::vision {
namespace {

namespace landmark = plant::landmark;

constexpr double kSite_m = 0.0008;  // between neighbouring border sites
constexpr double kSector_rad = kPi / 4;
constexpr double kClipped = 252;
constexpr double kNearlyClipped = 244;  // what clips in the mean, and noise
constexpr double kLeastContrast = 8;
constexpr std::size_t kFewestAround = 4;  // samples of the paper about a dot
constexpr double kFaint = 0.15;           // step that counts as one where paper is clipped
constexpr double kPlain = 0.3;            // and elsewhere, relative to ink on paper in that light
constexpr double kInformed = 0.4;  // least share of the outline that is not clipped on both sides

/// Direction clockwise from "up", as an offset right and down.
Pixel direction(double turn) { return {std::sin(turn), -std::cos(turn)}; }

std::optional<float> level(const cv::Mat& grey, const plant::Camera& camera,
                           const Placement& placement, double radius, double turn) {
    const Pixel at = radius * direction(turn);
    const Pixel p = distorted(camera, placement.at(at.u, at.v));
    if (!sampleable(grey, p)) return std::nullopt;
    return sample(grey, p);
}

/// Shares, 0 to 1.
struct Sector {
    double dark = 0;           // of the samples: darker than midway
    double clipped = 0;        // of the samples: clipped or nearly
    double informed = 0;       // of the places on the outline: ring or paper beside it not clipped
    double shown = 0;          // of those: the ring is darker than the paper beside it
    bool light_clips = false;  // the light alone clips paper here, without glare
};

/// Black over white on this print in this light, from the dots and the paper between them.
std::optional<double> ink_ratio(const cv::Mat& grey, const plant::Camera& camera,
                                const Placement& placement) {
    std::vector<double> ratios;
    for (const auto& dot : landmark::kDots) {
        const Pixel middle{dot.right_m, -dot.up_m};
        const Pixel p = distorted(camera, placement.at(middle.u, middle.v));
        if (!sampleable(grey, p)) return std::nullopt;
        std::vector<float> around;
        for (int i = 0; i < 8; ++i) {
            const Pixel at = middle + 0.0055 * direction(i * kSector_rad);
            const Pixel q = distorted(camera, placement.at(at.u, at.v));
            if (sampleable(grey, q)) around.push_back(sample(grey, q));
        }
        if (around.size() < kFewestAround) return std::nullopt;
        const float ink = sample(grey, p);
        const auto paper = median(around);
        if (static_cast<double>(*paper - ink) > kLeastContrast)
            ratios.push_back(static_cast<double>(ink / *paper));
    }
    if (ratios.size() < 3) return std::nullopt;
    return median(ratios);
}

/// Level of white paper over the landmark, from what is surely paper: the ground between the dots
/// and the ring. Clipped paper says nothing about the light, so it is left out where it can be.
class PaperLight {
public:
    PaperLight(const cv::Mat& grey, const plant::Camera& camera, const Placement& placement) {
        int looked = 0;
        for (const double radius : {0.0245, 0.0260, 0.0275}) {
            for (int i = 0; i < 48; ++i) {
                const double turn = i * 2 * kPi / 48;
                const auto l = level(grey, camera, placement, radius, turn);
                if (!l) continue;
                ++looked;
                const Pixel at = radius * direction(turn);
                if (static_cast<double>(*l) < kClipped)
                    plane_.add(at.u, at.v, static_cast<double>(*l));
            }
        }
        too_bright_ = plane_.size() < static_cast<std::size_t>(looked) / 3;
        known_ = looked > 100;
        if (!too_bright_) plane_.fit();
    }
    bool known() const { return known_; }
    double at(Pixel marker) const {
        return too_bright_ ? 255 : std::min(255.0, plane_.at(marker.u, marker.v));
    }

private:
    LevelPlane plane_;
    bool too_bright_ = false;
    bool known_ = false;
};

std::optional<Sector> sample_sector(const cv::Mat& grey, const plant::Camera& camera,
                                    const Placement& placement, int k, double ratio,
                                    const PaperLight& light) {
    constexpr int kAcross = 13;
    constexpr int kDeep = 9;
    Sector sector;
    int dark = 0, clipped = 0, informed = 0, shown = 0, looked = 0;
    for (int i = 0; i < kAcross; ++i) {
        const double turn = (k + 0.08 + 0.84 * (i + 0.5) / kAcross) * kSector_rad;
        for (int j = 0; j < kDeep; ++j) {
            const double radius = 0.0311 + 0.00095 * j;
            const auto l = level(grey, camera, placement, radius, turn);
            if (!l) return std::nullopt;
            const double white = light.at(radius * direction(turn));
            dark += static_cast<double>(*l) < std::max(white, kLeastContrast) * (1 + ratio) / 2;
            clipped += static_cast<double>(*l) >= kNearlyClipped;
        }
        const double step = (1 - ratio) * light.at(landmark::kInner_m * direction(turn));
        for (const auto& [on_ring, on_paper] : {std::pair{0.0312, 0.0287}, {0.0388, 0.0413}}) {
            const auto a = level(grey, camera, placement, on_ring, turn);
            const auto b = level(grey, camera, placement, on_paper, turn);
            if (!a || !b) continue;
            ++looked;
            const bool paper_clipped = static_cast<double>(*b) >= kClipped;
            if (paper_clipped && static_cast<double>(*a) >= kClipped) continue;
            ++informed;
            shown += static_cast<double>(*b - *a) > (paper_clipped ? kFaint : kPlain) * step;
        }
    }
    const auto share = [](int part, int whole) {
        return whole == 0 ? 0 : static_cast<double>(part) / whole;
    };
    sector.dark = share(dark, kAcross * kDeep);
    sector.clipped = share(clipped, kAcross * kDeep);
    sector.informed = share(informed, looked);
    sector.shown = share(shown, informed);
    const Pixel middle = landmark::kOuter_m * direction((k + 0.5) * kSector_rad);
    sector.light_clips = light.at(middle) >= kClipped;
    return sector;
}

enum class Colour { kBlack, kWhite, kUnsure };

/// The outline decides, for glare lifts black to white but keeps the step to the paper until both
/// clip. Two specks of dirt take less than a third of an outline or of a sector.
Colour colour(const Sector& s) {
    if (s.informed < kInformed)
        return s.clipped > 0.9 && s.light_clips ? Colour::kWhite : Colour::kUnsure;
    if (s.shown >= 0.7 || (s.shown >= 0.4 && s.dark >= 0.6)) return Colour::kBlack;
    if (s.shown <= 0.3 && s.dark <= 0.35) return Colour::kWhite;
    return Colour::kUnsure;
}

void add_circle(std::vector<EdgeSite>& sites, Pixel middle, double radius, double from, double to,
                double sign) {
    const int count = std::max(1, static_cast<int>(radius * (to - from) / kSite_m));
    for (int i = 0; i < count; ++i) {
        const Pixel out = direction(from + (to - from) * (i + 0.5) / count);
        sites.push_back(
            {middle.u + radius * out.u, middle.v + radius * out.v, sign * out.u, sign * out.v});
    }
}

}  // namespace

RingCode read_ring(const cv::Mat& grey, const plant::Camera& camera, const Placement& placement) {
    RingCode ring;
    const auto ratio = ink_ratio(grey, camera, placement);
    if (!ratio || *ratio > 0.8) return ring;
    const PaperLight light(grey, camera, placement);
    if (!light.known()) return ring;
    bool unsure = false;
    for (int k = 0; k < landmark::kSectors; ++k) {
        const auto sector = sample_sector(grey, camera, placement, k, *ratio, light);
        if (!sector) return ring;
        const Colour c = colour(*sector);
        unsure |= c == Colour::kUnsure;
        ring.code = 2 * ring.code + (c == Colour::kWhite ? 1 : 0);
    }
    if (unsure) {
        ring.state = RingCode::State::kAmbiguous;
    } else if (landmark::is_code(ring.code)) {
        ring.state = RingCode::State::kRead;
    }
    return ring;
}

const std::vector<EdgeSite>& dot_borders() {
    static const std::vector<EdgeSite> sites = [] {
        std::vector<EdgeSite> all;
        for (const auto& dot : landmark::kDots)
            add_circle(all, {dot.right_m, -dot.up_m}, landmark::kDot_m, 0, 2 * kPi, 1);
        return all;
    }();
    return sites;
}

std::vector<EdgeSite> landmark_borders(int code) {
    std::vector<EdgeSite> sites = dot_borders();
    // Clear of the corners by about the blur.
    constexpr double kCorner_m = 0.0015;
    for (int k = 0; k < landmark::kSectors; ++k) {
        const bool dark = landmark::sector_dark(code, k);
        const bool before =
            landmark::sector_dark(code, (k + landmark::kSectors - 1) % landmark::kSectors);
        if (dark) {
            for (const auto& [radius, sign] :
                 {std::pair{landmark::kInner_m, -1.0}, {landmark::kOuter_m, 1.0}})
                add_circle(sites, {}, radius, k * kSector_rad + kCorner_m / radius,
                           (k + 1) * kSector_rad - kCorner_m / radius, sign);
        }
        if (dark == before) continue;
        const Pixel out = direction(k * kSector_rad);
        const double sign = dark ? -1 : 1;  // clockwise of the border lies sector k
        for (double r = landmark::kInner_m + kCorner_m; r < landmark::kOuter_m - kCorner_m;
             r += kSite_m)
            sites.push_back({r * out.u, r * out.v, -sign * out.v, sign * out.u});
    }
    return sites;
}

}  // namespace pulseline::vision
