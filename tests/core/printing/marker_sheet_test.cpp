#include "core/printing/marker_sheet.hpp"

#include <gtest/gtest.h>

namespace pulseline::printing {
namespace {

using plant::MarkerKind;

plant::Marker marker(MarkerKind kind, const std::string& payload, double size_m) {
    plant::Marker m;
    m.kind = kind;
    m.payload = payload;
    m.size_m = size_m;
    m.pose = {12.5, 3.25, 1.5};
    return m;
}

TEST(MarkerSheet, IsAPdfOrAnSvgOfAnA4Page) {
    for (const auto& m :
         {marker(MarkerKind::kQr, "ST04-F", 0.06), marker(MarkerKind::kAprilTag, "17", 0.05),
          marker(MarkerKind::kLandmark, "85", 0.08)}) {
        const auto pdf = marker_sheet(m, "station 4", SheetFormat::kPdf);
        ASSERT_TRUE(pdf);
        EXPECT_EQ(pdf->substr(0, 5), "%PDF-");
        EXPECT_NE(pdf->find("595.275"), std::string::npos);  // 210 mm in points
        const auto svg = marker_sheet(m, "station 4", SheetFormat::kSvg);
        ASSERT_TRUE(svg);
        EXPECT_NE(svg->find("<svg"), std::string::npos);
        EXPECT_NE(svg->find("841.889"), std::string::npos);  // 297 mm
    }
}

TEST(MarkerSheet, RefusesWhatCannotBePrinted) {
    const auto reason = [](const plant::Marker& m) {
        const auto sheet = marker_sheet(m, "", SheetFormat::kPdf);
        return sheet ? "" : sheet.error().reason.code;
    };
    EXPECT_EQ(reason(marker(MarkerKind::kLandmark, "255", 0.08)), "payload_unknown");
    EXPECT_EQ(reason(marker(MarkerKind::kAprilTag, "9999", 0.05)), "payload_unknown");
    EXPECT_EQ(reason(marker(MarkerKind::kQr, "ST04-F", 0.25)), "too_large_for_page");
}

TEST(SheetList, HasOneLineAMarker) {
    EXPECT_EQ(sheet_list({marker(MarkerKind::kAprilTag, "17", 0.05)}),
              "kind,payload,size_m,x_m,y_m,up_rad\n"
              "apriltag,17,0.050000,12.500000,3.250000,1.50000000\n");
}

}  // namespace
}  // namespace pulseline::printing
