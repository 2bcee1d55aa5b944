#include "api/http/wire/query.hpp"

#include <limits>

namespace pulseline::api {

Result<bool> read_flag(const Request& request, const std::string& name) {
    const auto text = request.query_value(name);
    if (!text || *text == "false") return false;
    if (*text == "true") return true;
    return fail(Errc::kInvalid, "wrong_type", name + " is true or false.", "?" + name,
                {{"expected", std::string("boolean")}});
}

Result<int> read_limit(const Request& request) {
    const auto text = request.query_value("limit");
    if (!text) return kDefaultPage;
    const auto limit = parse_integer(*text, 1, kLargestPage);
    if (!limit) {
        return fail(Errc::kInvalid, "out_of_range", "The limit is a whole number from 1 to 500.",
                    "?limit", {{"min", std::int64_t{1}}, {"max", std::int64_t{kLargestPage}}});
    }
    return static_cast<int>(*limit);
}

tl::unexpected<Error> bad_cursor() {
    return fail(Errc::kInvalid, "bad_cursor",
                "Take the cursor unchanged from next_cursor of an earlier page.", "?cursor");
}

Result<std::optional<std::int64_t>> read_event_start(const Request& request) {
    const std::string& header = request.header("last-event-id");
    const bool in_header = !header.empty();
    const auto text = in_header ? std::optional<std::string>(header) : request.query_value("after");
    if (!text) return std::optional<std::int64_t>();
    const auto seq = parse_integer(*text, 0, std::numeric_limits<std::int64_t>::max());
    if (!seq) {
        return fail(Errc::kInvalid, "wrong_type",
                    "Name the sequence number of the last event you have, 0 for none.",
                    in_header ? "Last-Event-ID" : "?after", {{"expected", std::string("integer")}});
    }
    return seq;
}

}  // namespace pulseline::api
