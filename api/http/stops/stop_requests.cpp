#include "api/http/stops/stop_requests.hpp"

#include <limits>
#include <utility>

#include "api/http/wire/base64.hpp"
#include "api/http/wire/body.hpp"
#include "api/http/wire/query.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr std::size_t kMaxImages = 2;
constexpr std::size_t kMaxImageText = 6'000'000;

/// Which stops a page is of, measured or not, and how many.
template <class Query>
Status read_which_stops(const Request& request, Query& query) {
    query.vehicle = plant::VehicleId(request.query_value("vehicle").value_or(""));
    if (const auto text = request.query_value("station")) {
        const auto number = parse_integer(*text, 0, kMaxStation);
        if (!number) {
            return fail(Errc::kInvalid, "wrong_type", "The station is a number.", "?station",
                        {{"expected", std::string("integer")}});
        }
        query.station_number = static_cast<int>(*number);
    }
    if (const auto text = request.query_value("order")) {
        const auto id = fleet::JobOrderId::parse(*text);
        if (!id) {
            return fail(Errc::kInvalid, "wrong_type", "The order is the id of a job order.",
                        "?order", {{"expected", std::string("uuid")}});
        }
        query.order = *id;
    }
    const auto limit = read_limit(request);
    if (!limit) return fail(limit.error());
    query.limit = *limit;
    return {};
}

}  // namespace

Result<localization::LocalizationQuestion> read_localization(const Request& request) {
    return read_object<localization::LocalizationQuestion>(request, [](ObjectReader& in) {
        localization::LocalizationQuestion read;
        read.vehicle = plant::VehicleId(in.text("vehicle", kName));
        if (in.has("station")) {
            read.station = static_cast<int>(in.integer("station", {0, kMaxStation}));
        }
        in.items("images", {1, kMaxImages}, [&](const Json& item, const std::string& pointer) {
            ObjectReader image(item, pointer, in.errors());
            localization::CameraImage& added = read.images.emplace_back();
            added.camera = image.text("camera", kName);
            const std::string coded = image.text("image", {1, kMaxImageText});
            if (auto bytes = from_base64(coded)) {
                added.bytes = std::move(*bytes);
            } else if (!coded.empty()) {
                in.errors().add(pointer + "/image", {"not_base64", {}},
                                "An image is the base64 of the file, without line breaks.");
            }
            image.refuse_unknown();
        });
        return read;
    });
}

Result<fleet::StopQuery> read_stop_query(const Request& request) {
    fleet::StopQuery query;
    if (const Status ok = read_which_stops(request, query); !ok) return fail(ok.error());
    const auto before = read_cursor<fleet::StopRecordId>(request);
    if (!before) return fail(before.error());
    query.before = *before;
    return query;
}

Result<fleet::UnmeasuredQuery> read_unmeasured_query(const Request& request) {
    fleet::UnmeasuredQuery query;
    if (const Status ok = read_which_stops(request, query); !ok) return fail(ok.error());
    if (const auto text = request.query_value("cursor")) {
        query.before = parse_integer(*text, 0, std::numeric_limits<std::int64_t>::max());
        if (!query.before) return bad_cursor();
    }
    return query;
}

}  // namespace pulseline::api
