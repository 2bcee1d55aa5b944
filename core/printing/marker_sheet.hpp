#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::printing {

enum class SheetFormat { kPdf, kSvg };

struct Sheet {
    plant::Marker marker;
    std::string caption;  // its station in words
};

/// Sheets of all markers of the stations (numbers), or of the whole plant when none is named.
/// Stations that the plant has not, or that have no marker, give none.
std::vector<Sheet> sheets_of(const plant::Plant& plant, const std::vector<int>& stations);

/// True-scale A4 pages, one a marker: its print on white, id and station in words, an arrow for
/// "up" (to be turned to the surveyed direction, north when it is 90 deg), cutting marks, and a
/// ruler of 100 mm to check that the printer has not scaled it. SVG knows no pages: there they lie
/// below each other. Returns the document's bytes; fails, naming the marker {marker}, with the
/// reasons of marker_cells, payload_unknown for a landmark code out of 1 to 254 and
/// too_large_for_page.
Result<std::string> print_sheets(const std::vector<Sheet>& sheets, SheetFormat format);

}  // namespace pulseline::printing
