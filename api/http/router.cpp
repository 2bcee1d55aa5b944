#include "api/http/router.hpp"

#include <algorithm>
#include <set>
#include <string_view>

#include "api/access/secrets.hpp"
#include "api/http/orders/order_requests.hpp"
#include "api/http/wire/problem.hpp"

namespace pulseline::api {
namespace {

/// Whether `path` has the pattern's shape; its {names} with the decoded segments go to `params`.
bool fits(std::string_view pattern, std::string_view path,
          std::map<std::string, std::string>& params) {
    while (true) {
        const auto pattern_end = pattern.find('/');
        const auto path_end = path.find('/');
        const std::string_view want = pattern.substr(0, pattern_end);
        const std::string_view have = path.substr(0, path_end);
        if (!want.empty() && want.front() == '{') {
            const auto decoded = percent_decoded(have, false);
            if (!decoded || decoded->empty()) return false;
            params[std::string(want.substr(1, want.size() - 2))] = *decoded;
        } else if (want != have) {
            return false;
        }
        const bool pattern_ends = pattern_end == std::string_view::npos;
        const bool path_ends = path_end == std::string_view::npos;
        if (pattern_ends || path_ends) return pattern_ends && path_ends;
        pattern.remove_prefix(pattern_end + 1);
        path.remove_prefix(path_end + 1);
    }
}

Response refuse(int status, const Request& request, std::string code, std::string what,
                std::string field = {}, Params params = {}) {
    return problem(status,
                   Error{Errc::kForbidden,
                         {std::move(code), std::move(params)},
                         std::move(what),
                         std::move(field)},
                   request);
}

bool origin_allowed(const Request& request, const AccessPolicy& policy) {
    const std::string& origin = request.header("origin");
    return !origin.empty() &&
           std::find(policy.origins.begin(), policy.origins.end(), origin) != policy.origins.end();
}

std::string in_lower_case(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Whether the page asked this server under a name that is ours. Somebody else may let a name of
/// his own lead here (DNS rebinding): to the browser his pages are then of the same origin.
bool host_is_ours(const Request& request, const AccessPolicy& policy) {
    const std::string host = "://" + in_lower_case(request.header("host"));
    return std::any_of(policy.origins.begin(), policy.origins.end(), [&](const auto& origin) {
        const auto scheme_end = origin.find("://");
        return scheme_end != std::string::npos && origin.substr(scheme_end) == host;
    });
}

/// The browser itself says that the page is ours, or the caller is no browser page at all.
bool same_site(const Request& request, const AccessPolicy& policy) {
    const std::string& site = request.header("sec-fetch-site");
    if (origin_allowed(request, policy)) return true;
    if (site == "same-origin") return host_is_ours(request, policy);
    return site.empty() && request.header("origin").empty();
}

bool is_json(std::string media_type) {
    media_type = in_lower_case(media_type.substr(0, media_type.find(';')));
    const auto end = media_type.find_last_not_of(" \t");
    return media_type.substr(0, end == std::string::npos ? 0 : end + 1) == "application/json";
}

std::optional<Response> check_role(const Route& route, const Request& request) {
    if (!route.least) return std::nullopt;
    if (request.identity.kind == access::Identity::Kind::kAnonymous) {
        return refuse(401, request, "not_signed_in",
                      "This needs a sign-in or a bearer token that is still valid; sign in.");
    }
    if (!request.identity.at_least(*route.least)) {
        return refuse(403, request, "role_too_low",
                      "Your role may not do this; ask somebody with the role named in params.", {},
                      {{"needed_role", std::string(access::to_string(*route.least))}});
    }
    const auto* socket = std::get_if<Socket>(&route.handler);
    if (socket != nullptr && *socket == Socket::kHandHeld &&
        request.identity.kind != access::Identity::Kind::kUser) {
        return refuse(403, request, "person_needed",
                      "Only a person who is signed in drives a vehicle by hand, no program with a "
                      "token; sign in in the dashboard.");
    }
    return std::nullopt;
}

std::optional<Response> check_cross_site(const Route& route, const Request& request,
                                         const AccessPolicy& policy) {
    const auto* socket = std::get_if<Socket>(&route.handler);
    if (socket != nullptr && *socket != Socket::kEventStream) {
        if (!request.identity.by_cookie() || origin_allowed(request, policy)) return std::nullopt;
        return refuse(403, request, "origin_not_allowed",
                      "A page of this origin may not open the stream; open the dashboard at an "
                      "address the server allows.",
                      "Origin");
    }
    const bool browser = request.identity.by_cookie() || !route.least;
    if (!route.changes() || !browser) return std::nullopt;
    if (!same_site(request, policy)) {
        return refuse(
            403, request, "cross_site",
            "A page of another origin may not change anything here; open the dashboard at an "
            "address the server allows.",
            request.header("origin").empty() ? "Sec-Fetch-Site" : "Origin");
    }
    const std::string& csrf = request.identity.csrf_token;
    if (request.identity.by_cookie() && route.least &&
        (csrf.empty() || !access::same_secret(request.header("x-pulseline-csrf"), csrf))) {
        return refuse(403, request, "csrf_token_wrong",
                      "Send the csrf_token of GET /api/v1/session as X-Pulseline-CSRF.",
                      "X-Pulseline-CSRF");
    }
    if (!request.body.empty() && !is_json(request.header("content-type"))) {
        return refuse(415, request, "not_json_media_type",
                      "Send the body with Content-Type: application/json.", "Content-Type");
    }
    return std::nullopt;
}

std::optional<Response> check_query(const Route& route, const Request& request) {
    for (auto it = request.query.begin(); it != request.query.end(); ++it) {
        const std::string& name = it->first;
        const bool known = std::any_of(route.query.begin(), route.query.end(),
                                       [&](const char* known_name) { return name == known_name; });
        if (!known) {
            return refuse(400, request, "unknown_parameter",
                          "This operation has no such query parameter; remove it.", "?" + name);
        }
        if (request.query.count(name) > 1) {
            return refuse(400, request, "repeated_parameter",
                          "This query parameter is given more than once; give it once.",
                          "?" + name);
        }
    }
    return std::nullopt;
}

}  // namespace

bool Route::changes() const { return std::string_view(method) != "GET"; }

bool Route::asks(const Request& request) const {
    if (!changes() || only_asks) return true;
    return std::string_view(operation) == "createJobOrder" &&
           request.query_value("dryRun").value_or("") == "true";
}

bool Route::stops(const Request& request) const {
    static const std::set<std::string_view> kStops = {"pauseVehicle", "pauseFleet", "pauseJobOrder",
                                                      "cancelJobOrder", "stopLifts"};
    if (kStops.contains(operation)) return true;
    if (std::string_view(operation) != "controlJobOrder") return false;
    const auto control = read_job_control(request);
    return control && (control->method == fleet::JobMethod::kPause ||
                       control->method == fleet::JobMethod::kAbort ||
                       control->method == fleet::JobMethod::kStop);
}

Match match(Request& request) {
    const std::string_view method =
        request.method == "HEAD" ? std::string_view("GET") : std::string_view(request.method);
    Match found;
    for (const Route& route : routes()) {
        std::map<std::string, std::string> params;
        if (!fits(route.pattern, request.path, params)) continue;
        found.allowed.emplace_back(route.method);
        if (method != route.method) continue;
        found.route = &route;
        request.params = std::move(params);
    }
    return found;
}

std::optional<Response> authorise(const Route& route, const Request& request,
                                  const AccessPolicy& policy) {
    if (auto refusal = check_role(route, request)) return refusal;
    if (auto refusal = check_cross_site(route, request, policy)) return refusal;
    return check_query(route, request);
}

Admission admit(Request& request, const AccessPolicy& policy) {
    const Match found = match(request);
    if (found.route != nullptr) return {found.route, authorise(*found.route, request, policy)};
    if (found.allowed.empty()) {
        return {nullptr, refuse(404, request, "unknown_path",
                                "There is nothing at this path; /api/v1/openapi.json lists all.")};
    }
    std::string allowed;
    for (const auto& method : found.allowed) {
        allowed += (allowed.empty() ? "" : ", ") + method;
        if (method == "GET") allowed += ", HEAD";
    }
    Response refusal = refuse(405, request, "method_not_allowed",
                              "This path knows the methods of the Allow header only.");
    refusal.headers.emplace_back("Allow", allowed);
    return {nullptr, std::move(refusal)};
}

}  // namespace pulseline::api
