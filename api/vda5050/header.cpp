#include "api/vda5050/header.hpp"

#include <cmath>
#include <cstdio>
#include <ctime>

namespace pulseline::vda5050 {

const char* to_string(Topic topic) {
    switch (topic) {
        case Topic::kOrder:
            return "order";
        case Topic::kInstantActions:
            return "instantActions";
        case Topic::kState:
            return "state";
        case Topic::kVisualization:
            return "visualization";
        case Topic::kConnection:
            return "connection";
        case Topic::kFactsheet:
            return "factsheet";
        case Topic::kHandHeld:
            return "handHeld";
    }
    return "";
}

std::string timestamp(Time time) {
    const std::int64_t ms = to_ns(time) / 1'000'000;
    const std::time_t s = static_cast<std::time_t>(ms / 1000);
    std::tm utc{};
    gmtime_r(&s, &utc);
    char text[64];
    const std::size_t n = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &utc);
    std::snprintf(text + n, sizeof text - n, ".%03dZ", static_cast<int>(ms % 1000));
    return text;
}

Header HeaderSource::next(Topic topic, Time now) {
    constexpr std::int64_t kWrap = std::int64_t{1} << 32;  // headerId is a uint32
    std::int64_t& sent = sent_[static_cast<std::size_t>(topic)];
    const std::int64_t id = sent;
    sent = (sent + 1) % kWrap;
    return {id, timestamp(now), manufacturer_, serial_number_};
}

Json begin_message(const Header& header) {
    return {{"headerId", header.header_id},
            {"timestamp", header.timestamp},
            {"version", kVersion},
            {"manufacturer", header.manufacturer},
            {"serialNumber", header.serial_number}};
}

Result<Header> decode_header(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    Header header;
    header.header_id = in.integer_or("headerId", 0, {0, 4294967295});
    header.timestamp = in.text_or("timestamp", "", {0, 64});
    header.manufacturer = in.text("manufacturer", {1, 200});
    header.serial_number = in.text("serialNumber", {1, 200});
    const std::string version = in.text("version", {1, 32});
    if (auto status = errors.status(); !status) return fail(status.error());
    if (version.rfind("2.", 0) != 0) {
        return fail(Errc::kInvalid, "wrong_version",
                    "VDA 5050 version " + version + " is not spoken here; send 2.0 or 2.1",
                    "/version");
    }
    return header;
}

std::string print(const Json& message) {
    return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

double finite(double value) {
    if (!std::isfinite(value)) throw NotFinite();
    return value;
}

}  // namespace pulseline::vda5050
