#include "core/printing/marker_sheet.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/printing/sheet_list.hpp"

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
        const auto pdf = print_sheets({{m, "station 4"}}, SheetFormat::kPdf);
        ASSERT_TRUE(pdf);
        EXPECT_EQ(pdf->substr(0, 5), "%PDF-");
        EXPECT_NE(pdf->find("595.275"), std::string::npos);  // 210 mm in points
        const auto svg = print_sheets({{m, "station 4"}}, SheetFormat::kSvg);
        ASSERT_TRUE(svg);
        EXPECT_NE(svg->find("<svg"), std::string::npos);
        EXPECT_NE(svg->find("841.889"), std::string::npos);  // 297 mm
    }
}

/// Places where a word stands in a document.
std::size_t count(const std::string& in, const std::string& word) {
    std::size_t found = 0;
    for (auto at = in.find(word); at != std::string::npos; at = in.find(word, at + 1)) ++found;
    return found;
}

TEST(MarkerSheet, SeveralArePagesOfOnePdfAndLieBelowEachOtherInAnSvg) {
    const std::vector<Sheet> sheets{{marker(MarkerKind::kQr, "ST04-F", 0.06), "station 4"},
                                    {marker(MarkerKind::kLandmark, "85", 0.08), "station 5"},
                                    {marker(MarkerKind::kQr, "ST04-B", 0.06), "station 4"}};
    const auto pdf = print_sheets(sheets, SheetFormat::kPdf);
    ASSERT_TRUE(pdf);
    EXPECT_EQ(count(*pdf, "/Type /Page %"), 3u);
    const auto svg = print_sheets(sheets, SheetFormat::kSvg);
    ASSERT_TRUE(svg);
    EXPECT_NE(svg->find("2525.669"), std::string::npos);  // 3 x 297 mm
}

TEST(SheetsOf, AreThoseOfTheStationsNamedOrAll) {
    plant::Plant plant;
    plant.markers = {marker(MarkerKind::kQr, "ST04-F", 0.06),
                     marker(MarkerKind::kQr, "LOOSE", 0.06)};
    plant.markers[0].id = plant::MarkerId("m1");
    plant.markers[1].id = plant::MarkerId("m2");
    plant.stations.resize(1);
    plant.stations[0].number = 4;
    plant.stations[0].name = "Wing";
    plant.stations[0].markers = {plant::MarkerId("m1")};

    EXPECT_EQ(sheets_of(plant, {}).size(), 2u);
    EXPECT_TRUE(sheets_of(plant, {5}).empty());
    const auto named = sheets_of(plant, {4});
    ASSERT_EQ(named.size(), 1u);
    EXPECT_EQ(named[0].caption, "station 4, Wing");
}

TEST(MarkerSheet, RefusesWhatCannotBePrinted) {
    const auto reason = [](const plant::Marker& m) {
        const auto sheet = print_sheets({{m, ""}}, SheetFormat::kPdf);
        return sheet ? "" : sheet.error().reason.code;
    };
    EXPECT_EQ(reason(marker(MarkerKind::kLandmark, "255", 0.08)), "payload_unknown");
    EXPECT_EQ(reason(marker(MarkerKind::kAprilTag, "9999", 0.05)), "payload_unknown");
    EXPECT_EQ(reason(marker(MarkerKind::kQr, "ST04-F", 0.25)), "too_large_for_page");
}

TEST(SheetList, HasOneLineAMarkerAndIsReadBack) {
    const std::vector<Sheet> sheets{{marker(MarkerKind::kAprilTag, "17", 0.05), ""},
                                    {marker(MarkerKind::kQr, "ST04-F", 0.06), ""}};
    const std::string list = sheet_list(sheets);
    EXPECT_EQ(list,
              "kind,payload,size_m,x_m,y_m,up_rad\n"
              "apriltag,17,0.050000,12.500000,3.250000,1.50000000\n"
              "qr,ST04-F,0.060000,12.500000,3.250000,1.50000000\n");
    const auto read = read_sheet_list(list);
    ASSERT_TRUE(read) << read.error().what;
    ASSERT_EQ(read->size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ((*read)[i].kind, sheets[i].marker.kind);
        EXPECT_EQ((*read)[i].payload, sheets[i].marker.payload);
        EXPECT_EQ((*read)[i].size_m, sheets[i].marker.size_m);
        EXPECT_EQ((*read)[i].pose, sheets[i].marker.pose);
    }
}

TEST(SheetList, IsRefusedWithTheLineThatIsNone) {
    const std::string header = "kind,payload,size_m,x_m,y_m,up_rad\n";
    const std::string good = "qr,ST04-F,0.06,1,2,3\r\n";
    EXPECT_TRUE(read_sheet_list(header + good + "\n"));
    const auto wrong_line = [](const std::string& list) -> std::int64_t {
        const auto read = read_sheet_list(list);
        if (read || read.error().reason.code != "bad_list") return 0;
        return std::get<std::int64_t>(read.error().reason.params.at(0).value);
    };
    EXPECT_EQ(wrong_line(good), 1);
    for (const char* line : {"barcode,1,0.06,1,2,3", "qr,,0.06,1,2,3", "qr,A,0,1,2,3",
                             "qr,A,0.06,1,2", "qr,A,0.06,1;2,3", "qr,A,0.06,1,2,3,4", "qr"})
        EXPECT_EQ(wrong_line(header + good + line), 3) << line;
}

}  // namespace
}  // namespace pulseline::printing
