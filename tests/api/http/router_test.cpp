#include "api/http/router.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/api/http/schema_check.hpp"

namespace pulseline::api {
namespace {

using access::Identity;
using access::Role;
using testing::Json;

const std::string kOrigin = "https://hall.example:8443";
const AccessPolicy kPolicy{{kOrigin}};

/// A path that fits the pattern.
std::string example_path(std::string pattern) {
    for (auto open = pattern.find('{'); open != std::string::npos; open = pattern.find('{')) {
        pattern.replace(open, pattern.find('}') - open + 1, "7");
    }
    return pattern;
}

Identity user(Role role) {
    Identity identity;
    identity.kind = Identity::Kind::kUser;
    identity.name = "mei";
    identity.role = role;
    identity.session_sha256 = "s";
    identity.csrf_token = "csrf";
    return identity;
}

Identity token(std::optional<Role> role) {
    Identity identity;
    identity.kind = role ? Identity::Kind::kToken : Identity::Kind::kVehicle;
    identity.name = "token:1";
    identity.role = role;
    return identity;
}

Request request_of(const std::string& method, const std::string& path, const Identity& identity) {
    Request request;
    request.method = method;
    request.path = path;
    request.identity = identity;
    if (identity.by_cookie()) {
        request.headers = {{"x-pulseline-csrf", identity.csrf_token},
                           {"sec-fetch-site", "same-origin"},
                           {"origin", kOrigin}};
    }
    return request;
}

int status_of(Request request) {
    const Admission admitted = admit(request, kPolicy);
    return admitted.refusal ? admitted.refusal->status : 200;
}

std::string code_of(Request request) {
    const Admission admitted = admit(request, kPolicy);
    return admitted.refusal ? Json::parse(admitted.refusal->body)["code"].get<std::string>() : "";
}

// Written by hand, apart from the table: who may do what is decided here a second time.
const std::set<std::string> kForEverybody = {"signIn", "getOpenApi", "health", "ready"};
const std::set<std::string> kForOperators = {"pauseVehicle",     "initPosition",
                                             "integrateVehicle", "pauseFleet",
                                             "resumeFleet",      "createJobOrder",
                                             "pauseJobOrder",    "resumeJobOrder",
                                             "cancelJobOrder",   "findRoutes",
                                             "controlJobOrder",  "createTemplate",
                                             "deleteTemplate",   "createJobOrderOfTemplate",
                                             "createSchedule",   "deleteSchedule",
                                             "pauseSchedule",    "resumeSchedule",
                                             "closeFloor",       "reopenFloor",
                                             "localize",         "measureByLight",
                                             "previewMotions",   "moveLifts",
                                             "stopLifts",        "placeLoad",
                                             "putLoad",          "retireLoad"};
const std::set<std::string> kForPeople = {"handHeld"};  // operators who are no program

TEST(Authorisation, EveryOperationTimesEveryKindOfCaller) {
    struct Caller {
        const char* name;
        Identity identity;
        bool viewer, oper;
        int refusal;
    };
    const std::vector<Caller> callers = {
        {"anonymous", Identity{}, false, false, 401},
        {"viewer", user(Role::kViewer), true, false, 403},
        {"operator", user(Role::kOperator), true, true, 403},
        {"engineer", user(Role::kEngineer), true, true, 403},
        {"admin", user(Role::kAdmin), true, true, 403},
        {"viewer token", token(Role::kViewer), true, false, 403},
        {"operator token", token(Role::kOperator), true, true, 403},
        {"vehicle token", token(std::nullopt), false, false, 403},
    };
    int checked = 0;
    for (const Route& route : routes()) {
        for (const Caller& caller : callers) {
            const bool is_program = caller.identity.kind != Identity::Kind::kUser;
            const bool may =
                kForPeople.count(route.operation) != 0
                    ? caller.oper && !is_program
                    : kForEverybody.count(route.operation) != 0 ||
                          (kForOperators.count(route.operation) != 0 ? caller.oper : caller.viewer);
            const Request request =
                request_of(route.method, example_path(route.pattern), caller.identity);
            EXPECT_EQ(status_of(request), may ? 200 : caller.refusal)
                << caller.name << " calls " << route.operation;
            ++checked;
        }
    }
    EXPECT_EQ(checked, static_cast<int>(routes().size() * callers.size()));
}

TEST(Authorisation, EveryChangeThatIsNotPublicNeedsAnOperatorOrEndsOnesOwnSession) {
    for (const Route& route : routes()) {
        if (!route.changes() || std::string(route.operation) == "signIn" ||
            std::string(route.operation) == "signOut") {
            continue;
        }
        ASSERT_TRUE(route.least.has_value()) << route.operation;
        EXPECT_GE(*route.least, Role::kOperator) << route.operation;
    }
}

TEST(Routes, AreThoseOfOpenApiAndBack) {
    std::set<std::string> in_table;
    for (const Route& route : routes()) {
        EXPECT_TRUE(in_table.insert(route.operation).second) << route.operation;
        const Json* spec = testing::operation(route.operation);
        ASSERT_NE(spec, nullptr) << route.operation << " is not in openapi.yaml";
        std::string method = route.method;
        for (char& c : method) c = static_cast<char>(std::tolower(c));
        EXPECT_EQ(&testing::openapi()["paths"][route.pattern][method], spec) << route.operation;

        const bool is_public = spec->contains("security") && (*spec)["security"].empty();
        EXPECT_EQ(!route.least.has_value(), is_public) << route.operation;

        std::set<std::string> query;
        for (const auto& parameter : spec->value("parameters", Json::array())) {
            const Json& described = testing::resolved(parameter);
            if (described["in"] == "query") query.insert(described["name"].get<std::string>());
        }
        EXPECT_EQ(query, std::set<std::string>(route.query.begin(), route.query.end()))
            << route.operation;
    }
    for (const auto& path : testing::openapi()["paths"]) {
        for (const auto& spec : path) {
            EXPECT_EQ(in_table.count(spec["operationId"].get<std::string>()), 1U)
                << spec["operationId"];
        }
    }
}

/// Behind them nobody's list waits.
TEST(Routes, WhatTakesLongHasALaneOfItsOwn) {
    std::set<std::string> heavy;
    for (const Route& route : routes()) {
        if (route.heavy) heavy.insert(route.operation);
    }
    EXPECT_EQ(heavy, (std::set<std::string>{"printMarkers", "localize"}));
}

TEST(Match, FillsDecodedParametersAndKnowsHead) {
    Request request;
    request.method = "HEAD";
    request.path = "/api/v1/vehicles/TP%2D01%2Fx/cameras/front%20left";

    const Match found = match(request);

    ASSERT_NE(found.route, nullptr);
    EXPECT_STREQ(found.route->operation, "getCameraImage");
    EXPECT_EQ(request.param("id"), "TP-01/x");
    EXPECT_EQ(request.param("camera"), "front left");
}

TEST(Match, FixedPathsWinOverNothingAndOddOnesAreUnknown) {
    for (const char* path :
         {"/", "/api", "/api/v1", "/api/v1/", "/api/v1/vehicles/", "/api/v1/vehicles//pause",
          "/api/v1/vehicles/a/b", "/api/v1//vehicles", "/API/V1/vehicles", "/api/v1/vehicles/%ZZ",
          "/api/v1/vehicles/%00", "/api/v1/vehicles/%C0%AF", "/healthz/", "//healthz",
          "/api/v1/vehicles/../fleet", ""}) {
        EXPECT_EQ(status_of(request_of("GET", path, user(Role::kAdmin))), 404) << path;
    }
}

TEST(Match, WrongMethodNamesTheRightOnes) {
    Request request = request_of("PUT", "/api/v1/job-orders", user(Role::kAdmin));
    const Admission admitted = admit(request, kPolicy);
    ASSERT_TRUE(admitted.refusal.has_value());
    EXPECT_EQ(admitted.refusal->status, 405);
    EXPECT_EQ(admitted.refusal->headers.back(),
              (std::pair<std::string, std::string>{"Allow", "GET, HEAD, POST"}));
    EXPECT_EQ(status_of(request_of("TRACE", "/healthz", Identity{})), 405);
    EXPECT_EQ(status_of(request_of("get", "/healthz", Identity{})), 405);
    EXPECT_EQ(status_of(request_of("GET", "/api/v1/fleet/pause", user(Role::kAdmin))), 405);
}

TEST(CrossSite, AChangeWithACookieNeedsTokenAndAPageOfOurs) {
    struct Case {
        const char* csrf;
        const char* fetch_site;  // null: header absent
        const char* origin;
        const char* code;  // "" = may pass
    };
    const std::vector<Case> cases = {
        {"csrf", "same-origin", nullptr, ""},
        {"csrf", "same-origin", "https://hall.example:8443", ""},
        {"csrf", nullptr, "https://hall.example:8443", ""},
        {"csrf", nullptr, nullptr, ""},
        {"csrf", "cross-site", "https://hall.example:8443", ""},  // allowed by name
        {"csrf", "cross-site", nullptr, "cross_site"},
        {"csrf", "same-site", nullptr, "cross_site"},
        {"csrf", "none", nullptr, "cross_site"},
        {"csrf", nullptr, "null", "cross_site"},
        {"csrf", nullptr, "https://evil.example", "cross_site"},
        {"csrf", nullptr, "https://hall.example:8443.evil.example", "cross_site"},
        {"csrf", nullptr, "https://xhall.example:8443", "cross_site"},
        {"csrf", nullptr, "https://hall.example", "cross_site"},
        {"csrf", nullptr, "https://hall.example:8444", "cross_site"},
        {"csrf", nullptr, "http://hall.example:8443", "cross_site"},
        {"csrf", nullptr, "HTTPS://HALL.EXAMPLE:8443", "cross_site"},
        {"", "same-origin", nullptr, "csrf_token_wrong"},
        {"csrg", "same-origin", nullptr, "csrf_token_wrong"},
        {"csrfx", "same-origin", nullptr, "csrf_token_wrong"},
    };
    for (const Case& one : cases) {
        Request request = request_of("POST", "/api/v1/fleet/pause", user(Role::kOperator));
        request.headers = {{"host", "hall.example:8443"}, {"x-pulseline-csrf", one.csrf}};
        if (one.fetch_site != nullptr) request.headers["sec-fetch-site"] = one.fetch_site;
        if (one.origin != nullptr) request.headers["origin"] = one.origin;
        EXPECT_EQ(code_of(request), one.code)
            << one.csrf << " " << (one.fetch_site ? one.fetch_site : "-") << " "
            << (one.origin ? one.origin : "-");
    }
}

TEST(CrossSite, ASessionWithoutCsrfTokenNeverPassesAnEmptyHeader) {
    Request request = request_of("POST", "/api/v1/fleet/pause", user(Role::kOperator));
    request.identity.csrf_token.clear();
    request.headers = {{"host", "hall.example:8443"}, {"sec-fetch-site", "same-origin"}};
    EXPECT_EQ(code_of(request), "csrf_token_wrong");
}

TEST(CrossSite, BearerTokensNeedNoneOfIt) {
    Request request = request_of("POST", "/api/v1/job-orders", token(Role::kOperator));
    request.body = "{}";
    request.headers = {{"origin", "https://evil.example"}, {"sec-fetch-site", "cross-site"}};
    EXPECT_EQ(status_of(request), 200);
}

TEST(CrossSite, AStrangersPageMaySignNobodyIn) {
    Request request = request_of("POST", "/api/v1/session", Identity{});
    request.body = "{}";
    request.headers = {{"content-type", "application/json"}};
    EXPECT_EQ(code_of(request), "");
    request.headers["sec-fetch-site"] = "cross-site";
    EXPECT_EQ(code_of(request), "cross_site");
    request.headers = {{"content-type", "text/plain"}};
    EXPECT_EQ(code_of(request), "not_json_media_type");
}

TEST(CrossSite, APageUnderANameThatIsNotOursIsAStrangers) {
    Request request = request_of("POST", "/api/v1/session", Identity{});
    request.body = "{}";
    for (const auto& [host, code] :
         std::map<std::string, std::string>{{"hall.example:8443", ""},
                                            {"Hall.Example:8443", ""},
                                            {"hall.example", "cross_site"},
                                            {"evil.example:8443", "cross_site"},
                                            {"evil.hall.example:8443", "cross_site"},
                                            {"https://hall.example:8443", "cross_site"},
                                            {"", "cross_site"}}) {
        request.headers = {{"content-type", "application/json"},
                           {"sec-fetch-site", "same-origin"},
                           {"host", host}};
        EXPECT_EQ(code_of(request), code) << host;
    }
    request.headers["host"] = "evil.example:8443";
    request.headers["origin"] = "https://evil.example:8443";
    EXPECT_EQ(code_of(request), "cross_site");
    request.headers["origin"] = kOrigin;  // behind a proxy that does not pass the Host on
    EXPECT_EQ(code_of(request), "");
}

TEST(CrossSite, ABodyFromABrowserMustBeJson) {
    for (const auto& [type, status] :
         std::map<std::string, int>{{"application/json", 200},
                                    {"Application/JSON; charset=utf-8", 200},
                                    {"application/json ", 200},
                                    {"", 415},
                                    {"text/plain", 415},
                                    {"application/json-patch+json", 415},
                                    {"application/x-www-form-urlencoded", 415},
                                    {"multipart/form-data; boundary=application/json", 415}}) {
        Request request = request_of("POST", "/api/v1/job-orders", user(Role::kOperator));
        request.body = "{}";
        request.headers["content-type"] = type;
        EXPECT_EQ(status_of(request), status) << type;
    }
}

TEST(CrossSite, AStreamWithACookieNeedsAnAllowedOriginExactly) {
    for (const auto& [origin, status] :
         std::map<std::string, int>{{kOrigin, 200},
                                    {"", 403},
                                    {"null", 403},
                                    {"https://evil.example", 403},
                                    {"https://hall.example:8443/", 403},
                                    {"http://hall.example:8443", 403}}) {
        Request request = request_of("GET", "/api/v1/stream", user(Role::kViewer));
        request.headers = {{"origin", origin}};
        EXPECT_EQ(status_of(request), status) << origin;
    }
    EXPECT_EQ(status_of(request_of("GET", "/api/v1/stream", token(Role::kViewer))), 200);
}

TEST(Query, UnknownAndRepeatedParametersAreRefused) {
    const auto code = [](const std::string& target) {
        Request request = request_of("GET", "", user(Role::kViewer));
        EXPECT_TRUE(parse_target(target, request)) << target;
        return code_of(request);
    };
    EXPECT_EQ(code("/api/v1/job-orders?limit=3&state=Running"), "");
    EXPECT_EQ(code("/api/v1/job-orders?limt=3"), "unknown_parameter");
    EXPECT_EQ(code("/api/v1/job-orders?limit=3&limit=4"), "repeated_parameter");
    EXPECT_EQ(code("/api/v1/fleet?x"), "unknown_parameter");
}

TEST(Target, PathAndQueryAreTakenApart) {
    Request request;
    ASSERT_TRUE(parse_target("/a%20b?x=1%202+3&empty&x=%E4%B8%AD&=v", request));
    EXPECT_EQ(request.path, "/a%20b");
    EXPECT_EQ(request.query, (std::multimap<std::string, std::string>{
                                 {"x", "1 2 3"}, {"empty", ""}, {"x", "中"}, {"", "v"}}));
    for (const char* bad : {"", "*", "http://a/b", "a", "/%", "/%4", "/%GG", "/a?x=%", "/a?%00=1",
                            "/a?x=%FF", "/a?x=%C0%AF", "/a?x=%ED%A0%80", "/a?x=%F4%90%80%80"}) {
        EXPECT_FALSE(parse_target(bad, request)) << bad;
    }
}

}  // namespace
}  // namespace pulseline::api
