#pragma once

#include <optional>
#include <vector>

#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"
#include "core/printing/marker_sheet.hpp"

namespace pulseline::api {

struct SheetsRequest {
    std::vector<int> stations;                    // none: all markers
    std::optional<printing::SheetFormat> format;  // none: the list
};
Result<SheetsRequest> read_sheets(const Request& request);

}  // namespace pulseline::api
