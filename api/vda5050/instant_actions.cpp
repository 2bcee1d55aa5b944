#include "api/vda5050/instant_actions.hpp"

#include "api/vda5050/action.hpp"

namespace pulseline::vda5050 {

std::string encode_instant_actions(const InstantActionsMessage& message, const Header& header) {
    Json out = begin_message(header);
    out["actions"] = Json::array();
    for (const auto& action : message.actions) out["actions"].push_back(encode_action(action));
    return print(out);
}

Result<InstantActionsMessage> decode_instant_actions(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    InstantActionsMessage message;
    in.items("actions", {1, 100}, [&](const Json& item, const std::string& at) {
        message.actions.push_back(decode_action(item, at, errors));
    });
    if (auto status = errors.status(); !status) return fail(status.error());
    return message;
}

}  // namespace pulseline::vda5050
