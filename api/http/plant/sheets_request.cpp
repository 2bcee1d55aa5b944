#include "api/http/plant/sheets_request.hpp"

#include <algorithm>

#include "api/http/wire/query.hpp"

namespace pulseline::api {

Result<SheetsRequest> read_sheets(const Request& request) {
    SheetsRequest wanted;
    const std::string format = request.query_value("format").value_or("pdf");
    if (format == "pdf") {
        wanted.format = printing::SheetFormat::kPdf;
    } else if (format == "svg") {
        wanted.format = printing::SheetFormat::kSvg;
    } else if (format != "csv") {
        return fail(Errc::kInvalid, "unknown_value", "The format is pdf, svg or csv (the list).",
                    "?format", {{"value", format.substr(0, 64)}});
    }
    const auto text = request.query_value("stations");
    if (!text) return wanted;
    for (std::size_t at = 0; at <= text->size();) {
        const std::size_t end = std::min(text->find(',', at), text->size());
        const auto number = parse_integer(text->substr(at, end - at), 0, kMaxStation);
        if (!number) {
            return fail(Errc::kInvalid, "wrong_type",
                        "The stations are numbers with commas between them.", "?stations",
                        {{"expected", std::string("integers")}});
        }
        wanted.stations.push_back(static_cast<int>(*number));
        at = end + 1;
    }
    return wanted;
}

}  // namespace pulseline::api
