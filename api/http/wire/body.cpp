#include "api/http/wire/body.hpp"

#include "api/json/parse.hpp"

namespace pulseline::api {

Result<nlohmann::json> read_body(const Request& request) {
    if (request.body.empty()) {
        return fail(Errc::kInvalid, "body_missing", "This operation needs a JSON body; send one.");
    }
    return json::parse_json(request.body);
}

}  // namespace pulseline::api
