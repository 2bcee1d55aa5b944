#include "core/printing/marker_sheet.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <utility>

#include "core/plant/marker_geometry.hpp"
#include "core/printing/marker_cells.hpp"

namespace pulseline::printing {
namespace {

using plant::MarkerKind;
namespace landmark = plant::landmark;

// Millimetres on the page.
constexpr double kPointsPerMm = 72 / 25.4;
constexpr double kWidth = 210;
constexpr double kHeight = 297;
constexpr double kMiddleX = kWidth / 2;
constexpr double kMiddleY = 120;
constexpr double kMostSheet = 180;

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

cairo_status_t append(void* to, const unsigned char* data, unsigned length) {
    static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

void line(cairo_t* pen, double x0, double y0, double x1, double y1, double width = 0.2) {
    cairo_set_line_width(pen, width);
    cairo_move_to(pen, x0, y0);
    cairo_line_to(pen, x1, y1);
    cairo_stroke(pen);
}

void text(cairo_t* pen, double x, double y, double size, const std::string& words) {
    cairo_set_font_size(pen, size);
    cairo_move_to(pen, x, y);
    cairo_show_text(pen, words.c_str());
}

/// About the origin, unit mm. Rows of dark cells as one piece: no hairlines between them.
void draw_cells(cairo_t* pen, const MarkerCells& cells, double size_mm) {
    const double cell = size_mm / cells.side;
    for (int row = 0; row < cells.side; ++row) {
        for (int column = 0; column < cells.side; ++column) {
            if (!cells.at(row, column)) continue;
            int end = column;
            while (end < cells.side && cells.at(row, end)) ++end;
            cairo_rectangle(pen, column * cell - size_mm / 2, row * cell - size_mm / 2,
                            (end - column) * cell, cell);
            column = end;
        }
    }
    cairo_fill(pen);
}

void draw_landmark(cairo_t* pen, int code, double size_mm) {
    const double scale = size_mm / (2 * landmark::kOuter_m);
    for (const auto& dot : landmark::kDots) {
        cairo_arc(pen, scale * dot.right_m, -scale * dot.up_m, scale * landmark::kDot_m, 0,
                  2 * kPi);
        cairo_fill(pen);
    }
    for (int k = 0; k < landmark::kSectors; ++k) {
        if (!landmark::sector_dark(code, k)) continue;
        int end = k;  // neighbouring black sectors as one piece
        while (end + 1 < landmark::kSectors && landmark::sector_dark(code, end + 1)) ++end;
        // cairo counts clockwise from the right; ours from up.
        const double from = k * kPi / 4 - kPi / 2;
        const double to = (end + 1) * kPi / 4 - kPi / 2;
        cairo_new_path(pen);
        cairo_arc(pen, 0, 0, scale * landmark::kOuter_m, from, to);
        cairo_arc_negative(pen, 0, 0, scale * landmark::kInner_m, to, from);
        cairo_close_path(pen);
        cairo_fill(pen);
        k = end;
    }
}

/// White around the print that belongs to the marker, mm.
double margin_mm(const plant::Marker& marker) {
    const double size = 1e3 * marker.size_m;
    switch (marker.kind) {
        case MarkerKind::kQr:
            return size * plant::kQrQuietZone / plant::kQrModules;
        case MarkerKind::kAprilTag:
            return size * plant::kTagMargin / plant::kTagCells;
        case MarkerKind::kLandmark:
            return size / 16;
    }
    return 0;
}

void draw_frame(cairo_t* pen, const plant::Marker& marker, const std::string& caption) {
    const double half = 500 * marker.size_m + margin_mm(marker);
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {  // outside the white, so that they fall off
            line(pen, x * (half + 2), y * half, x * (half + 8), y * half);
            line(pen, x * half, y * (half + 2), x * half, y * (half + 8));
        }
    }
    line(pen, 0, -half - 3, 0, -half - 12, 0.5);
    line(pen, -1.5, -half - 10, 0, -half - 12, 0.5);
    line(pen, 1.5, -half - 10, 0, -half - 12, 0.5);
    char up[64];
    std::snprintf(up, sizeof up, "up = %.2f deg from east", degrees(marker.pose.heading_rad));
    text(pen, 3, -half - 8, 3, up);
    text(pen, -kMiddleX + 15, -kMiddleY + 15, 6, marker.payload + "   " + caption);
    char size[96];
    std::snprintf(size, sizeof size, "%s, %.1f mm. Print at 100 %%, do not fit to the page.",
                  plant::to_string(marker.kind), 1e3 * marker.size_m);
    text(pen, -kMiddleX + 15, -kMiddleY + 22, 3.5, size);
}

void draw_ruler(cairo_t* pen) {
    constexpr double kY = 275;
    constexpr double kX = 55;
    for (int mm = 0; mm <= 100; ++mm)
        line(pen, kX + mm, kY, kX + mm, kY - (mm % 10 == 0 ? 5 : (mm % 5 == 0 ? 3.5 : 2)), 0.1);
    line(pen, kX, kY, kX + 100, kY, 0.1);
    text(pen, kX, kY + 5, 3.5, "100 mm: measure it before use");
}

/// What is printed of a marker besides the page's furniture.
struct Print {
    MarkerCells cells;  // of QR and AprilTag
    int code = 0;       // of a landmark
};

Result<Print> print_of(const plant::Marker& marker) {
    if (!(marker.size_m > 0) || 1e3 * marker.size_m + 2 * margin_mm(marker) > kMostSheet)
        return fail(Errc::kInvalid, "too_large_for_page",
                    "The marker does not fit an A4 page at its true size.");
    Print print;
    if (marker.kind != MarkerKind::kLandmark) {
        auto made = marker_cells(marker.kind, marker.payload);
        if (!made) return fail(made.error());
        print.cells = std::move(*made);
        return print;
    }
    const char* end = marker.payload.data() + marker.payload.size();
    const auto parsed = std::from_chars(marker.payload.data(), end, print.code);
    if (parsed.ec != std::errc() || parsed.ptr != end || !landmark::is_code(print.code))
        return fail(Errc::kInvalid, "payload_unknown",
                    "\"" + marker.payload + "\" is no landmark code (1 to 254).");
    return print;
}

void draw_page(cairo_t* pen, const Sheet& sheet, const Print& print) {
    draw_ruler(pen);
    cairo_translate(pen, kMiddleX, kMiddleY);
    draw_frame(pen, sheet.marker, sheet.caption);
    const double size_mm = 1e3 * sheet.marker.size_m;
    if (sheet.marker.kind == MarkerKind::kLandmark) {
        draw_landmark(pen, print.code, size_mm);
    } else {
        draw_cells(pen, print.cells, size_mm);
    }
}

}  // namespace

std::vector<Sheet> sheets_of(const plant::Plant& plant, const std::vector<int>& stations) {
    std::vector<Sheet> sheets;
    for (const plant::Marker& marker : plant.markers) {
        const auto station = std::ranges::find_if(plant.stations, [&](const plant::Station& s) {
            return std::ranges::count(s.markers, marker.id) != 0;
        });
        const bool belongs = station != plant.stations.end();
        if (!stations.empty() && (!belongs || std::ranges::count(stations, station->number) == 0))
            continue;
        sheets.push_back(
            {marker,
             belongs ? "station " + std::to_string(station->number) + ", " + station->name : ""});
    }
    return sheets;
}

Result<std::string> print_sheets(const std::vector<Sheet>& sheets, SheetFormat format) {
    std::vector<Print> prints;
    for (const Sheet& sheet : sheets) {
        auto print = print_of(sheet.marker);
        if (!print) {
            print.error().reason.params.push_back({"marker", sheet.marker.payload});
            return fail(print.error());
        }
        prints.push_back(std::move(*print));
    }
    const bool pages = format == SheetFormat::kPdf;
    const double height = pages ? kHeight : kHeight * static_cast<double>(sheets.size());
    const auto create =
        pages ? cairo_pdf_surface_create_for_stream : cairo_svg_surface_create_for_stream;
    std::string bytes;
    const Surface surface(create(append, &bytes, kWidth * kPointsPerMm, height * kPointsPerMm),
                          cairo_surface_destroy);
    if (!pages) cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PT);
    {
        const Pen pen(cairo_create(surface.get()), cairo_destroy);
        cairo_scale(pen.get(), kPointsPerMm, kPointsPerMm);
        cairo_set_source_rgb(pen.get(), 0, 0, 0);
        // Edges exactly where they belong, not where a screen would like them.
        cairo_set_antialias(pen.get(), CAIRO_ANTIALIAS_NONE);
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            cairo_save(pen.get());
            if (!pages) cairo_translate(pen.get(), 0, kHeight * static_cast<double>(i));
            draw_page(pen.get(), sheets[i], prints[i]);
            cairo_restore(pen.get());
            if (pages) cairo_show_page(pen.get());
        }
    }
    cairo_surface_finish(surface.get());
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS)
        return fail(Errc::kUnavailable, "print_failed", "The sheets could not be drawn.");
    return bytes;
}

}  // namespace pulseline::printing
