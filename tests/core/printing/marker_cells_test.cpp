#include "core/printing/marker_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace pulseline::printing {
namespace {

using plant::MarkerKind;

TEST(MarkerCells, AQrCodeHasThreeFindersAndNoneAtTheBottomRight) {
    const auto cells = marker_cells(MarkerKind::kQr, "ST01-F");
    ASSERT_TRUE(cells);
    const auto ring = [&](int top, int left) {
        int dark = 0;
        for (int i = 0; i < 7; ++i)
            dark += cells->at(top, left + i) + cells->at(top + 6, left + i) +
                    cells->at(top + i, left) + cells->at(top + i, left + 6);
        return dark == 28;
    };
    EXPECT_TRUE(ring(0, 0));
    EXPECT_TRUE(ring(0, 14));
    EXPECT_TRUE(ring(14, 0));
    EXPECT_FALSE(ring(14, 14));
}

TEST(MarkerCells, AnAprilTagHasABlackBorderAndTagsDifferInElevenCells) {
    const auto a = marker_cells(MarkerKind::kAprilTag, "17");
    const auto b = marker_cells(MarkerKind::kAprilTag, "18");
    ASSERT_TRUE(a && b);
    for (int i = 0; i < a->side; ++i)
        EXPECT_TRUE(a->at(0, i) && a->at(a->side - 1, i) && a->at(i, 0) && a->at(i, a->side - 1));
    int different = 0;
    for (std::size_t i = 0; i < a->dark.size(); ++i) different += a->dark[i] != b->dark[i];
    EXPECT_GE(different, 11);
}

TEST(MarkerCells, RefusesWhatCannotBePrinted) {
    EXPECT_EQ(
        marker_cells(MarkerKind::kQr, "A-PAYLOAD-FAR-TOO-LONG-FOR-VERSION-1").error().reason.code,
        "payload_too_long");
    for (const char* id : {"", "587", "-1", "1x"})
        EXPECT_EQ(marker_cells(MarkerKind::kAprilTag, id).error().reason.code, "payload_unknown");
}

}  // namespace
}  // namespace pulseline::printing
