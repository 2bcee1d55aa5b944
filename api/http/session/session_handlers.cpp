#include "api/http/session/session_handlers.hpp"

#include <cmath>

#include "api/access/access_control.hpp"
#include "api/access/credentials.hpp"
#include "api/http/session/sign_in_request.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {
namespace {

// A token has no end of its own; the far end of RFC 3339 says so to programs that compare.
constexpr const char* kNever = "9999-12-31T23:59:59.999Z";

Json session_json(const access::Identity& identity) {
    return {{"name", identity.name},
            {"role", access::to_string(*identity.role)},
            {"csrf_token", identity.csrf_token},
            {"expires_at", identity.expires ? rfc3339(*identity.expires) : kNever}};
}

}  // namespace

Response get_session(const InlineContext&, const Request& request) {
    return json_response(200, session_json(request.identity));
}

Response sign_in(const WorkerContext& context, const Request& request) {
    const auto sent = read_sign_in(request);
    if (!sent) return problem(400, sent.error(), request);
    const auto signed_in =
        context.access.sign_in(sent->name, sent->password, request.peer, context.now);
    if (!signed_in) return problem(signed_in.error(), request);
    // A new session at every sign-in: the one this browser had before ends.
    if (request.identity.by_cookie()) context.access.sign_out(request.identity);
    Response response = json_response(200, session_json(signed_in->identity));
    const auto age_s = std::lround(std::ceil(seconds(context.access.limits().session_total)));
    response.headers.emplace_back(
        "Set-Cookie", access::session_cookie(signed_in->cookie_token, request.secure, age_s));
    return response;
}

Response sign_out(const WorkerContext& context, const Request& request) {
    if (!request.identity.by_cookie()) {
        return problem(Error{Errc::kForbidden,
                             {"not_a_session", {}},
                             "A bearer token has no session to end; revoke the token instead.",
                             {}},
                       request);
    }
    context.access.sign_out(request.identity);
    return {204, "", {{"Set-Cookie", access::expired_cookie(request.secure)}}, {}};
}

}  // namespace pulseline::api
