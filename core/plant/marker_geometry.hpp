#pragma once

#include <array>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/plant/plant.hpp"

/// What is printed on the floor (core/vision/README.md): the one thing printing, simulation and
/// detection share. Right and down are as printed, seen from above.
namespace pulseline::plant {

/// QR version 1.
inline constexpr int kQrModules = 21;
inline constexpr int kQrQuietZone = 4;  // modules
/// AprilTag 36h11: the black border square is 8 cells, the white margin around it one more.
inline constexpr int kTagCells = 8;
inline constexpr int kTagMargin = 1;  // cells

/// Circular landmark of Li 2020, for a ring of 80 mm; lengths scale with the size.
namespace landmark {

inline constexpr double kInner_m = 0.030;
inline constexpr double kOuter_m = 0.040;
inline constexpr double kDot_m = 0.003;  // radius
inline constexpr int kSectors = 8;
inline constexpr double kCrossRatio = 1.657895;  // (AC/BC)/(AD/BD), B = line AD x line EF

struct Dot {
    double right_m;
    double up_m;
};
/// A, C, D, E, F: "up" is the direction from D to A.
inline constexpr std::array<Dot, 5> kDots{
    {{0, 0.018}, {0, 0}, {0, -0.020}, {-0.014, 0.008}, {0.014, 0.008}}};

/// Sector of a direction: clockwise from "up", the first one begins there.
inline int sector(double right, double up) {
    const double turn = std::atan2(right, up);
    const int k = static_cast<int>(std::floor((turn < 0 ? turn + 2 * kPi : turn) / (kPi / 4)));
    return k % kSectors;
}
/// Sector 0 is the most significant bit; black is 0.
inline bool sector_dark(int code, int k) { return (code >> (kSectors - 1 - k) & 1) == 0; }
/// Codes 0 and 255 have no edge on the ring and are unused.
inline bool is_code(int code) { return code > 0 && code < 255; }

}  // namespace landmark

/// Outer size of the black print: side of the square, diameter of the ring.
inline double usual_size_m(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::kQr:
            return 0.060;
        case MarkerKind::kAprilTag:
            return 0.050;
        case MarkerKind::kLandmark:
            return 2 * landmark::kOuter_m;
    }
    return 0;
}

}  // namespace pulseline::plant
