#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/plant/plant.hpp"

namespace pulseline::printing {

enum class SheetFormat { kPdf, kSvg };

/// True-scale A4 sheet of one marker: its print on white, id and station in words, an arrow for
/// "up" (to be turned to the surveyed direction, north when it is 90 deg), cutting marks, and a
/// ruler of 100 mm to check that the printer has not scaled it. Returns the document's bytes; fails
/// with the reasons of marker_cells, payload_unknown for a landmark code out of 1 to 254 and
/// too_large_for_page.
Result<std::string> marker_sheet(const plant::Marker& marker, const std::string& caption,
                                 SheetFormat format);

/// The list that goes with a set of sheets: a header and one line of CSV a marker.
std::string sheet_list(const std::vector<plant::Marker>& markers);

}  // namespace pulseline::printing
