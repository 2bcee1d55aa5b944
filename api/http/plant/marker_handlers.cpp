#include "api/http/plant/marker_handlers.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "api/http/plant/sheets_request.hpp"
#include "api/http/wire/problem.hpp"
#include "core/printing/sheet_list.hpp"

namespace pulseline::api {
namespace {

// Half a second of drawing on the history thread each; for SVG it grows with the square of sheets.
constexpr std::size_t kMostPdfSheets = 300;
constexpr std::size_t kMostSvgSheets = 100;

Response file(const char* content_type, const char* extension, std::string bytes) {
    return {200,
            content_type,
            {{"Content-Disposition",
              std::string("attachment; filename=\"floor-codes.") + extension + "\""},
             {"Cache-Control", "private, no-cache"}},
            std::move(bytes)};
}

/// A station that is not there would be missed on the floor only.
std::optional<Error> unknown_among(const std::vector<int>& stations, const plant::Plant& plant) {
    for (const int number : stations) {
        const auto is_it = [&](const plant::Station& s) { return s.number == number; };
        if (std::ranges::any_of(plant.stations, is_it)) continue;
        return Error{Errc::kUnreachable,
                     {"unknown_station", {{"station", std::int64_t{number}}}},
                     "There is no station " + std::to_string(number) + ".",
                     "?stations"};
    }
    return std::nullopt;
}

}  // namespace

Response print_markers(const HistoryContext& context, const Request& request) {
    const auto wanted = read_sheets(request);
    if (!wanted) return problem(400, wanted.error(), request);
    if (const auto error = unknown_among(wanted->stations, context.plant)) {
        return problem(422, *error, request);
    }
    const auto sheets = printing::sheets_of(context.plant, wanted->stations);
    const bool as_list = !wanted->format;
    const std::size_t most =
        wanted->format == printing::SheetFormat::kSvg ? kMostSvgSheets : kMostPdfSheets;
    if (sheets.empty() || (!as_list && sheets.size() > most)) {
        return problem(422,
                       {Errc::kUnreachable,
                        {sheets.empty() ? "no_markers" : "too_many_sheets",
                         {{"sheets", static_cast<std::int64_t>(sheets.size())},
                          {"max", static_cast<std::int64_t>(most)}}},
                        sheets.empty() ? "These stations have no floor codes."
                                       : "These are too many sheets for one file: name fewer "
                                         "stations.",
                        "?stations"},
                       request);
    }
    if (as_list) return file("text/csv; charset=utf-8", "csv", printing::sheet_list(sheets));
    auto bytes = printing::print_sheets(sheets, *wanted->format);
    if (!bytes) return problem(422, bytes.error(), request);
    return *wanted->format == printing::SheetFormat::kPdf
               ? file("application/pdf", "pdf", std::move(*bytes))
               : file("image/svg+xml", "svg", std::move(*bytes));
}

}  // namespace pulseline::api
