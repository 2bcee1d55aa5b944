#include "api/vda5050/connection.hpp"

namespace pulseline::vda5050 {

// Beside the type, so that the reader finds it.
static const char* to_string(ConnectionState state) {
    switch (state) {
        case ConnectionState::kOnline:
            return "ONLINE";
        case ConnectionState::kOffline:
            return "OFFLINE";
        case ConnectionState::kConnectionBroken:
            return "CONNECTIONBROKEN";
    }
    return "";
}

std::string encode_connection(ConnectionState state, const Header& header) {
    Json out = begin_message(header);
    out["connectionState"] = to_string(state);
    return print(out);
}

Result<ConnectionState> decode_connection(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    const auto state = in.one_of(
        "connectionState",
        {ConnectionState::kOnline, ConnectionState::kOffline, ConnectionState::kConnectionBroken});
    if (auto status = errors.status(); !status) return fail(status.error());
    return state;
}

}  // namespace pulseline::vda5050
