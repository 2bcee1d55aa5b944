#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/printing/marker_sheet.hpp"

namespace pulseline::printing {

/// The list that goes with a set of sheets: a header and one line of CSV a marker.
std::string sheet_list(const std::vector<Sheet>& sheets);

/// The markers of such a list; they have no id. Fails with bad_list {line} at the first line, from
/// 1, that is none of a list's.
Result<std::vector<plant::Marker>> read_sheet_list(const std::string& list);

}  // namespace pulseline::printing
