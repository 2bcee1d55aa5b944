#include "core/simulation/world/printed_sheet.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/plant/marker_geometry.hpp"

namespace pulseline::simulation {
namespace {

Piece square(double x, double y, double side) {
    Piece p;
    p.push({x, y});
    p.push({x + side, y});
    p.push({x + side, y + side});
    p.push({x, y + side});
    return p;
}

TEST(Piece, AreaInADiscIsThatOfTheDiscOrOfThePieceWhenOneHoldsTheOther) {
    EXPECT_NEAR(square(-5, -5, 10).area_in_disc({0.3, -0.2}, 2), kPi * 4, 1e-12);
    EXPECT_NEAR(square(-1, -1, 1).area_in_disc({0, 0}, 3), 1, 1e-12);
    EXPECT_NEAR(square(4, 4, 1).area_in_disc({0, 0}, 3), 0, 1e-12);
    EXPECT_NEAR(square(0, 0, 5).area_in_disc({0, 0}, 2), kPi, 1e-12);  // a quarter
}

/// Law of parts: the means of small squares must add up to the printed area, wherever they lie.
TEST(LandmarkSheet, MeansAddUpToTheInkOfTheDesign) {
    for (const int code : {1, 77, 170, 254}) {
        const LandmarkSheet sheet(code, false);
        constexpr double kStep = 0.137;
        double ink = 0;
        for (double x = -0.05; x < 90; x += kStep) {
            for (double y = -0.03; y < 90; y += kStep) {
                const Piece quad = square(x, y, kStep);
                const int region = sheet.region(quad[0]);
                bool same = true;
                for (int i = 1; i < 4; ++i) same &= sheet.region(quad[i]) == region;
                const float mean =
                    same ? sheet.reflectance(region, kPaper) : sheet.mean(quad, kPaper);
                ink += kStep * kStep * static_cast<double>((kPaper - mean) / (kPaper - kInk));
            }
        }
        const int dark = 8 - __builtin_popcount(static_cast<unsigned>(code));
        EXPECT_NEAR(ink, dark * kPi / 8 * (1600 - 900) + 5 * kPi * 9, 0.5) << code;
    }
}

TEST(CellSheet, AQuarterOfAPixelOnInkIsAQuarterDark) {
    const CellSheet sheet(plant::MarkerKind::kAprilTag, "0", false);
    // The corner of the black border lies at (1, 1).
    EXPECT_NEAR(sheet.mean(square(0.95, 0.95, 0.1), 0.4F), 0.75F * kPaper + 0.25F * kInk, 1e-6F);
    EXPECT_NEAR(sheet.mean(square(-0.05, 0.5, 0.1), 0.4F), 0.5F * kPaper + 0.5F * 0.4F, 1e-6F);
}

}  // namespace
}  // namespace pulseline::simulation
