#include <gtest/gtest.h>

#include "tests/api/http/api_world.hpp"

/// Every way a body, a query or a header can be wrong: status, code and field of the answer, and
/// that nothing was stored.
namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;

struct Bad {
    std::string body;
    int status;
    std::string code;
    std::string field;
};

std::string repeated(const std::string& text, std::size_t times) {
    std::string all;
    for (std::size_t i = 0; i < times; ++i) all += text;
    return all;
}

std::string with_steps(const std::string& steps) { return R"({"steps":)" + steps + "}"; }
std::string with(const std::string& member) {
    return R"({"steps":[{"station":2}],)" + member + "}";
}

std::string step_list(std::size_t count) {
    return "[" + repeated(R"({"station":2},)", count - 1) + R"({"station":2}])";
}

void expect_refused(ApiWorld& api, const std::string& path, const std::vector<Bad>& table) {
    for (const Bad& bad : table) {
        const Answer answer = api.post(path, bad.body);
        const std::string shown = path + " " + bad.body.substr(0, 70);
        EXPECT_EQ(answer.status, bad.status) << shown << "\n" << answer.body;
        EXPECT_EQ(answer.code(), bad.code) << shown;
        EXPECT_EQ(answer.field(), bad.field) << shown;
        EXPECT_EQ(answer.content_type, "application/problem+json") << shown;
        EXPECT_GT(answer.json()["detail"].get<std::string>().size(), 15U) << shown;
        EXPECT_LT(answer.body.size(), 2000U) << "echoes the input: " << shown;
    }
}

// What no operation with a body may take, whatever it is for.
const std::vector<Bad> kNotJson = {
    {"", 400, "body_missing", ""},
    {" ", 400, "json_syntax", ""},
    {"no json", 400, "json_syntax", ""},
    {"{", 400, "json_syntax", ""},
    {"{}}", 400, "json_syntax", ""},
    {"{'steps':[]}", 400, "json_syntax", ""},
    {R"({"steps":[],})", 400, "json_syntax", ""},
    {R"({"steps":[] /* why */})", 400, "json_syntax", ""},
    {R"({"a":NaN})", 400, "json_syntax", ""},
    {R"({"a":Infinity})", 400, "json_syntax", ""},
    {R"({"a":-Infinity})", 400, "json_syntax", ""},
    {R"({"a":01})", 400, "json_syntax", ""},
    {R"({"a":+1})", 400, "json_syntax", ""},
    {R"({"a":0x10})", 400, "json_syntax", ""},
    {R"({"a":1e400})", 400, "json_number", ""},
    {R"({"a":-1e400})", 400, "json_number", ""},
    {R"({"a":18446744073709551616})", 400, "json_number", ""},
    {"{\"a\":\"\xC0\xAF\"}", 400, "json_syntax", ""},      // overlong
    {"{\"a\":\"\xED\xA0\x80\"}", 400, "json_syntax", ""},  // surrogate in UTF-8
    {"{\"a\":\"\xFF\"}", 400, "json_syntax", ""},
    {R"({"a":"\uD800"})", 400, "json_syntax", ""},
    {R"({"a":"\uDC00\uD800"})", 400, "json_syntax", ""},
    {"{\"a\":\"line\nend\"}", 400, "json_syntax", ""},
    {std::string("{\"a\":1}\0", 8), 400, "json_syntax", ""},
    {R"({"a":1,"a":2})", 400, "json_duplicate_key", ""},
    {R"({"b":{"a":1,"\u0061":2}})", 400, "json_duplicate_key", ""},
    {repeated("[", 300'000), 400, "json_too_deep", ""},
    {repeated(R"({"a":)", 60'000), 400, "json_too_deep", ""},
    {repeated("[", 33) + repeated("]", 33), 400, "json_too_deep", ""},
    {"[" + repeated("0,", 20'000) + "0]", 400, "json_too_large", ""},
    {"null", 400, "wrong_type", ""},
    {"[]", 400, "wrong_type", ""},
    {"3", 400, "wrong_type", ""},
    {R"("text")", 400, "wrong_type", ""},
    {"true", 400, "wrong_type", ""},
};

TEST(BadInput, WhatIsNoJsonObjectIsRefusedEverywhere) {
    ApiWorld api;
    for (const char* path : {"/api/v1/job-orders", "/api/v1/job-orders?dryRun=true",
                             "/api/v1/vehicles/V1/init-position", "/api/v1/fleet/resume",
                             "/api/v1/session", "/api/v1/motion-previews"}) {
        expect_refused(api, path, kNotJson);
    }
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(BadInput, JobOrdersNameTheFieldAtFault) {
    ApiWorld api;
    const std::string long_text(65, 'x');
    expect_refused(
        api, "/api/v1/job-orders",
        {
            {"{}", 400, "missing_field", "/steps"},
            {with_steps("null"), 400, "wrong_type", "/steps"},
            {with_steps("{}"), 400, "wrong_type", "/steps"},
            {with_steps("[]"), 400, "wrong_count", "/steps"},
            {with_steps(step_list(101)), 400, "wrong_count", "/steps"},
            {with_steps("[2]"), 400, "wrong_type", "/steps/0"},
            {with_steps("[{}]"), 400, "missing_field", "/steps/0/station"},
            {with_steps(R"([{"station":"2"}])"), 400, "wrong_type", "/steps/0/station"},
            {with_steps(R"([{"station":2.5}])"), 400, "wrong_type", "/steps/0/station"},
            {with_steps(R"([{"station":null}])"), 400, "wrong_type", "/steps/0/station"},
            {with_steps(R"([{"station":true}])"), 400, "wrong_type", "/steps/0/station"},
            {with_steps(R"([{"station":-1}])"), 400, "out_of_range", "/steps/0/station"},
            {with_steps(R"([{"station":4294967298}])"), 400, "out_of_range", "/steps/0/station"},
            {with_steps(R"([{"station":18446744073709551615}])"), 400, "out_of_range",
             "/steps/0/station"},
            {with_steps(R"([{"station":18446744073709551616}])"), 400, "json_number", ""},
            {with_steps(R"([{"station":2},{"station":[]}])"), 400, "wrong_type",
             "/steps/1/station"},
            {with_steps(R"([{"station":2,"motion_mode":"fly"}])"), 400, "not_one_of",
             "/steps/0/motion_mode"},
            {with_steps(R"([{"station":2,"motion_mode":"Linear"}])"), 400, "not_one_of",
             "/steps/0/motion_mode"},
            {with_steps(R"([{"station":2,"motion_mode":""}])"), 400, "not_one_of",
             "/steps/0/motion_mode"},
            {with_steps(R"([{"station":2,"motion_mode":1}])"), 400, "wrong_type",
             "/steps/0/motion_mode"},
            {with_steps(R"([{"station":2,"speed_mps":9}])"), 400, "unknown_field",
             "/steps/0/speed_mps"},
            {with_steps(R"([{"station":2,"Station":2}])"), 400, "unknown_field",
             "/steps/0/Station"},
            {with_steps(R"([{"station":2,"a/b~c":2}])"), 400, "unknown_field", "/steps/0/a~1b~0c"},
            {with_steps(R"([{"station":2,"station":3}])"), 400, "json_duplicate_key", ""},
            {with(R"("vehicle":7)"), 400, "wrong_type", "/vehicle"},
            {with(R"("vehicle":null)"), 400, "wrong_type", "/vehicle"},
            {with(R"("vehicle":"")"), 400, "wrong_length", "/vehicle"},
            {with(R"("vehicle":")" + long_text + "\""), 400, "wrong_length", "/vehicle"},
            {with(R"("vehicle":"V1\u0000")"), 400, "control_character", "/vehicle"},
            {with(R"("vehicle":"V1\r\nX-Evil: 1")"), 400, "control_character", "/vehicle"},
            {with(R"("client_order_id":"")"), 400, "wrong_length", "/client_order_id"},
            {with(R"("client_order_id":")" + long_text + "\""), 400, "wrong_length",
             "/client_order_id"},
            {with(R"("client_order_id":{})"), 400, "wrong_type", "/client_order_id"},
            {with(R"("priority":101)"), 400, "out_of_range", "/priority"},
            {with(R"("priority":-101)"), 400, "out_of_range", "/priority"},
            {with(R"("priority":0.5)"), 400, "wrong_type", "/priority"},
            {with(R"("priority":"1")"), 400, "wrong_type", "/priority"},
            {with(R"("state":"Running")"), 400, "unknown_field", "/state"},
            {with(R"("__proto__":{})"), 400, "unknown_field", "/__proto__"},
            {with(R"("":0)"), 400, "unknown_field", "/"},
            {with("\"" + std::string(100'000, 'k') + "\":0"), 400, "unknown_field",
             "/" + std::string(199, 'k')},
            // Well formed, but it asks for what is not there.
            {with_steps(R"([{"station":999}])"), 422, "unknown_station", "/steps/0/station"},
            {with_steps(R"([{"station":2},{"station":999}])"), 422, "unknown_station",
             "/steps/1/station"},
            {with(R"("vehicle":"nobody")"), 422, "unknown_vehicle", "/vehicle"},
            {with(R"("vehicle":"'; DROP TABLE job_orders; --")"), 422, "unknown_vehicle",
             "/vehicle"},
            {with(R"("vehicle":"<script>alert(1)</script>")"), 422, "unknown_vehicle", "/vehicle"},
        });
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(BadInput, PosesNameTheFieldAtFault) {
    ApiWorld api;
    expect_refused(
        api, "/api/v1/vehicles/V1/init-position",
        {
            {"{}", 400, "missing_field", "/x_m"},
            {R"({"x_m":1,"y_m":2})", 400, "missing_field", "/heading_rad"},
            {R"({"x_m":"1","y_m":2,"heading_rad":0})", 400, "wrong_type", "/x_m"},
            {R"({"x_m":1,"y_m":null,"heading_rad":0})", 400, "wrong_type", "/y_m"},
            {R"({"x_m":1e6,"y_m":2,"heading_rad":0})", 400, "out_of_range", "/x_m"},
            {R"({"x_m":1,"y_m":-1e300,"heading_rad":0})", 400, "out_of_range", "/y_m"},
            {R"({"x_m":1,"y_m":2,"heading_rad":6.3})", 400, "out_of_range", "/heading_rad"},
            {R"({"x_m":1,"y_m":2,"heading_rad":0,"z_m":0})", 400, "unknown_field", "/z_m"},
            {R"({"x_m":1,"y_m":2,"heading_rad":0,"within_m":0})", 400, "out_of_range", "/within_m"},
            {R"({"x_m":1,"y_m":2,"heading_rad":0,"within_m":0.2})", 400, "out_of_range",
             "/within_m"},
            {R"({"x_m":1,"y_m":2,"heading_rad":0,"within_rad":-0.01})", 400, "out_of_range",
             "/within_rad"},
            {R"({"x_m":1,"y_m":2,"heading_rad":0,"within_rad":"0.01"})", 400, "wrong_type",
             "/within_rad"},
            {R"({"x_m":1,"x_m":1,"y_m":2,"heading_rad":0})", 400, "json_duplicate_key", ""},
        });
}

TEST(BadInput, ResumeNamesTheFieldAtFault) {
    ApiWorld api;
    expect_refused(api, "/api/v1/fleet/resume",
                   {
                       {"{}", 400, "missing_field", "/vehicles"},
                       {R"({"vehicles":"V1"})", 400, "wrong_type", "/vehicles"},
                       {R"({"vehicles":[]})", 400, "wrong_count", "/vehicles"},
                       {R"({"vehicles":["V1",7]})", 400, "wrong_type", "/vehicles/1"},
                       {R"({"vehicles":["V1",""]})", 400, "wrong_length", "/vehicles/1"},
                       {R"({"vehicles":["V1"],"all":true})", 400, "unknown_field", "/all"},
                       {R"({"vehicles":[)" + repeated("\"V1\",", 1000) + R"("V1"]})", 400,
                        "wrong_count", "/vehicles"},
                       {R"({"vehicles":["nobody"]})", 422, "unknown_vehicle", "/vehicles/0"},
                   });
}

TEST(BadInput, SignInNamesTheFieldAtFault) {
    ApiWorld api;
    expect_refused(
        api, "/api/v1/session",
        {
            {"{}", 400, "missing_field", "/name"},
            {R"({"name":"mei"})", 400, "missing_field", "/password"},
            {R"({"name":"","password":"x"})", 400, "wrong_length", "/name"},
            {R"({"name":["mei"],"password":"x"})", 400, "wrong_type", "/name"},
            {R"({"name":"mei","password":12345678})", 400, "wrong_type", "/password"},
            {R"({"name":"mei","password":""})", 400, "wrong_length", "/password"},
            {R"({"name":"mei","password":")" + std::string(129, 'p') + "\"}", 400, "wrong_length",
             "/password"},
            {R"({"name":"mei","password":"x","role":"admin"})", 400, "unknown_field", "/role"},
            {R"({"name":"mei","password":"wrong"})", 401, "wrong_credentials", ""},
        });
}

TEST(BadInput, QueriesNameTheParameterAtFault) {
    ApiWorld api;
    const std::vector<std::pair<std::string, std::string>> table = {
        {"/api/v1/job-orders?limit=0", "?limit"},
        {"/api/v1/job-orders?limit=501", "?limit"},
        {"/api/v1/job-orders?limit=-1", "?limit"},
        {"/api/v1/job-orders?limit=", "?limit"},
        {"/api/v1/job-orders?limit=1e2", "?limit"},
        {"/api/v1/job-orders?limit=%2B5", "?limit"},
        {"/api/v1/job-orders?limit=5%20", "?limit"},
        {"/api/v1/job-orders?limit=99999999999999999999", "?limit"},
        {"/api/v1/job-orders?cursor=", "?cursor"},
        {"/api/v1/job-orders?cursor=nonsense", "?cursor"},
        {"/api/v1/job-orders?cursor=../../etc/passwd", "?cursor"},
        {"/api/v1/job-orders?state=running", "?state"},
        {"/api/v1/job-orders?state=", "?state"},
        {"/api/v1/job-orders?state=Running,,Ended", "?state"},
        {"/api/v1/job-orders?page=2", "?page"},
        {"/api/v1/stop-records?station=two", "?station"},
        {"/api/v1/stop-records?station=-1", "?station"},
        {"/api/v1/stop-records?order=7", "?order"},
        {"/api/v1/stop-records?limit=x", "?limit"},
        {"/api/v1/stop-records?cursor=AAAA", "?cursor"},
        {"/api/v1/unmeasured-stops?station=two", "?station"},
        {"/api/v1/unmeasured-stops?limit=0", "?limit"},
        {"/api/v1/unmeasured-stops?cursor=-1", "?cursor"},
        {"/api/v1/loads/J-1/moves?limit=0", "?limit"},
        {"/api/v1/loads/J-1/moves?cursor=x", "?cursor"},
        {"/api/v1/loads/J-1/moves?station=1", "?station"},
    };
    for (const auto& [target, field] : table) {
        const Answer answer = api.get(target);
        EXPECT_EQ(answer.status, 400) << target << answer.body;
        EXPECT_EQ(answer.field(), field) << target;
    }
    const Answer dry = api.post("/api/v1/job-orders?dryRun=1", R"({"steps":[{"station":2}]})");
    EXPECT_EQ(dry.status, 400);
    EXPECT_EQ(dry.field(), "?dryRun");
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(BadInput, IdempotencyKeysAreCheckedBeforeAnythingIsStored) {
    ApiWorld api;
    for (const std::string& key :
         {std::string(), std::string("\"\""), std::string(129, 'k'), std::string("a b"),
          std::string("\xC3\xA9"), std::string("a\tb")}) {
        const Answer answer = api.post("/api/v1/job-orders", R"({"steps":[{"station":2}]})",
                                       {{"idempotency-key", key}});
        EXPECT_EQ(answer.status, 400) << key;
        EXPECT_EQ(answer.code(), "bad_idempotency_key");
        EXPECT_EQ(answer.field(), "Idempotency-Key");
    }
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(BadInput, UnknownResourcesAre404WhateverTheirIdLooksLike) {
    ApiWorld api;
    for (const char* target :
         {"/api/v1/job-orders/7", "/api/v1/job-orders/019a0000-0000-7000-8000-000000000000",
          "/api/v1/job-orders/..%2F..%2Fetc", "/api/v1/stop-records/x", "/api/v1/vehicles/nobody",
          "/api/v1/vehicles/%3Cscript%3E", "/api/v1/stations/99", "/api/v1/stations/one",
          "/api/v1/stations/1.0", "/api/v1/halls/nowhere/grid", "/api/v1/vehicles/V1/cameras/side",
          "/api/v1/vehicles/nobody/cameras/front"}) {
        const Answer answer = api.get(target);
        EXPECT_EQ(answer.status, 404) << target;
        EXPECT_NE(answer.code(), "") << target;
    }
    for (const char* target : {"/api/v1/job-orders/7/pause", "/api/v1/job-orders/7/resume",
                               "/api/v1/job-orders/019a0000-0000-7000-8000-000000000000/cancel",
                               "/api/v1/vehicles/nobody/pause"}) {
        EXPECT_EQ(api.post(target).status, 404) << target;
    }
}

}  // namespace
}  // namespace pulseline::api
