#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "tests/api/http/api_world.hpp"

/// The table of OPC 10031-4 once more, as a program meets it over REST.
namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;
using testing::Json;

const std::string kOrders = "/api/v1/job-orders";

struct Pair {
    std::string state, method, outcome;
};

std::vector<Pair> table() {
    std::ifstream file(PULSELINE_JOB_CONTROL_TABLE);
    std::vector<Pair> pairs;
    for (std::string line; std::getline(file, line);) {
        if (line.empty() || line[0] == '#' || line.starts_with("state,")) continue;
        std::istringstream fields(line);
        Pair pair;
        std::getline(fields, pair.state, ',');
        std::getline(fields, pair.method, ',');
        std::getline(fields, pair.outcome, ',');
        pairs.push_back(pair);
    }
    return pairs;
}

Answer control(ApiWorld& api, const std::string& at, const std::string& method,
               const ApiWorld::Headers& headers = {}) {
    Json body = {{"method", method}};
    if (method == "Update") {
        body["order"] = {{"vehicle", "V1"},
                         {"priority", 9},
                         {"earliest_start", "2030-01-01T00:00:00Z"},
                         {"steps", {{{"station", 2}}}}};
    }
    return api.post(at + "/job-control", body.dump(), headers);
}

/// Where an order in that state is.
std::string order_in(ApiWorld& api, const std::string& state) {
    Json body = {{"vehicle", "V1"}, {"steps", {{{"station", 3}}}}};
    if (state == "NotAllowedToStart") body["start"] = false;
    // Far off, so that a free vehicle does not take it between two requests.
    if (state.ends_with("AllowedToStart")) {
        body["earliest_start"] = "2030-01-01T00:00:00Z";
    }
    const Answer created = api.post(kOrders, body.dump());
    EXPECT_EQ(created.status, 201) << created.body;
    const std::string at = created.header("Location");
    if (state == "Running" || state == "Interrupted") api.world.run(1);
    if (state == "Interrupted") {
        EXPECT_EQ(control(api, at, "Pause").status, 202);
    }
    if (state == "Aborted") {
        EXPECT_EQ(control(api, at, "Abort").status, 202);
    }
    if (state == "Ended") api.world.run(60);
    if (state != "Running") api.world.run(3);
    EXPECT_EQ(api.get(at).json()["state"], state);
    return at;
}

class EveryPairOverRest : public ::testing::TestWithParam<Pair> {};

TEST_P(EveryPairOverRest, AnswersWhatTheTableSays) {
    const Pair& pair = GetParam();
    ApiWorld api;
    const std::string at = order_in(api, pair.state);

    const Answer answer = control(api, at, pair.method);

    if (pair.outcome == "-") {
        EXPECT_EQ(answer.status, 409) << answer.body;
        EXPECT_EQ(answer.code(), "not_in_this_state");
        EXPECT_EQ(answer.json()["params"]["state"], pair.state) << "the current state";
        EXPECT_EQ(answer.json()["params"]["method"], pair.method);
        return;
    }
    ASSERT_EQ(answer.status, 202) << answer.body;
    EXPECT_NE(answer.header("ETag"), "");
    if (pair.outcome == "removed") {
        EXPECT_EQ(api.get(at).json()["removed"], true) << "kept as history";
        EXPECT_TRUE(api.get(kOrders).json()["items"].empty());
        EXPECT_EQ(api.get(kOrders + "?removed=true").json()["items"].size(), 1U);
        return;
    }
    const std::string wanted = pair.outcome;
    for (int i = 0; i < 50 && api.get(at).json()["state"] != wanted; ++i) api.world.run(0.1);
    EXPECT_EQ(api.get(at).json()["state"], wanted);
}

INSTANTIATE_TEST_SUITE_P(OpcTable, EveryPairOverRest, ::testing::ValuesIn(table()),
                         [](const auto& one) { return one.param.state + "_" + one.param.method; });

TEST(JobControl, TheRequestIsReadStrictly) {
    ApiWorld api;
    const std::string at = order_in(api, "NotAllowedToStart") + "/job-control";
    const auto refused = [&](const std::string& body, const std::string& code,
                             const std::string& field) {
        const Answer answer = api.post(at, body);
        EXPECT_EQ(answer.status, 400) << answer.body;
        EXPECT_EQ(answer.code(), code) << body;
        EXPECT_EQ(answer.field(), field) << body;
    };
    refused(R"({})", "missing_field", "/method");
    refused(R"({"method":"Restart"})", "not_one_of", "/method");
    refused(R"({"method":"Update"})", "missing_field", "/order");
    refused(R"({"method":"Start","order":{}})", "unknown_field", "/order");
    refused(R"({"method":"Update","order":{"steps":[{"station":2}],"start":true}})",
            "unknown_field", "/order/start");
    refused(R"({"method":"Update","order":{"steps":[{"station":2}],"due":"soon"}})", "bad_time",
            "/order/due");
    const Answer answer = api.post(at, R"({"method":"Update","order":{"steps":[{"station":99}]}})");
    EXPECT_EQ(answer.status, 422);
    EXPECT_EQ(answer.field(), "/order/steps/0/station");
    EXPECT_EQ(api.post(kOrders + "/no-such-id/job-control", R"({"method":"Start"})").status, 404);
}

TEST(JobControl, HonoursIfMatchAndIdempotencyKey) {
    ApiWorld api;
    const std::string at = order_in(api, "NotAllowedToStart");
    const std::string etag = api.get(at).header("ETag");
    EXPECT_EQ(control(api, at, "Cancel", {{"if-match", "\"99\""}}).status, 412);

    const ApiWorld::Headers once = {{"if-match", etag}, {"idempotency-key", "k-1"}};
    const Answer first = control(api, at, "Cancel", once);
    const Answer again = control(api, at, "Cancel", once);
    const Answer other = control(api, at, "Clear", once);

    ASSERT_EQ(first.status, 202) << first.body;
    EXPECT_EQ(again.status, 202) << "a repeated request carries its old revision";
    EXPECT_EQ(again.json()["id"], first.json()["id"]);
    EXPECT_EQ(other.status, 422);
    EXPECT_EQ(other.code(), "idempotency_key_reused");
    EXPECT_EQ(api.world.count_events("job_order.removed"), 1);
}

TEST(JobOrderFields, AreReadShownAndKept) {
    ApiWorld api;
    api.world.announce({"lowerParking"});
    const Answer first =
        api.post(kOrders, R"({"client_order_id":"WO-1","vehicle":"V1","steps":[{"station":2}]})");
    ASSERT_EQ(first.status, 201);
    const Answer created = api.post(kOrders, R"({
        "vehicle_type":"small","priority":3,"start":false,"sequence":"wing",
        "earliest_start":"2030-01-01T02:00:00.5+02:00","due":"2030-01-01T06:00:00Z",
        "after":["WO-1"],
        "steps":[{"station":3,"after":[{"type":"lowerParking","parameters":{"force_n":50.5}}]}]})");
    ASSERT_EQ(created.status, 201) << created.body;

    const Json order = api.get(created.header("Location")).json();
    EXPECT_EQ(order["state"], "NotAllowedToStart");
    EXPECT_EQ(order["reason"]["code"], "waits_for_start");
    EXPECT_EQ(order["vehicle_type"], "small");
    EXPECT_EQ(order["earliest_start"], "2030-01-01T00:00:00.500Z") << "shown in UTC";
    EXPECT_EQ(order["due"], "2030-01-01T06:00:00.000Z");
    EXPECT_EQ(order["sequence"], "wing");
    EXPECT_EQ(order["after"][0]["order"], first.json()["id"]);
    EXPECT_EQ(order["after"][0]["name"], "JO-1");
    EXPECT_EQ(order["steps"][0]["after"][0]["type"], "lowerParking");
    EXPECT_EQ(order["steps"][0]["after"][0]["parameters"]["force_n"], 50.5);
    EXPECT_EQ(order["steps"][0]["phase"], "before");
}

TEST(JobOrderFields, FaultsNameTheField) {
    ApiWorld api;
    api.world.announce({"lowerParking"});
    const auto refused = [&](const std::string& members, int status, const std::string& code,
                             const std::string& field) {
        const Answer answer = api.post(kOrders, "{" + members + "}");
        EXPECT_EQ(answer.status, status) << answer.body;
        EXPECT_EQ(answer.code(), code) << members;
        EXPECT_EQ(answer.field(), field) << members;
        EXPECT_TRUE(api.world.store.orders.empty());
    };
    const std::string steps = R"("steps":[{"station":2}],)";
    refused(steps + R"("due":"2030-02-30T00:00:00Z")", 400, "bad_time", "/due");
    refused(steps + R"("due":"2030-02-20")", 400, "bad_time", "/due");
    refused(steps + R"("due":1893456000)", 400, "wrong_type", "/due");
    refused(steps + R"("earliest_start":"2030-02-20T24:00:00Z")", 400, "bad_time",
            "/earliest_start");
    refused(steps + R"("due":"2030-01-01T00:00:00Z","earliest_start":"2030-01-02T00:00:00Z")", 422,
            "due_before_start", "/due");
    refused(steps + R"("after":["WO-9"])", 422, "unknown_job_order", "/after/0");
    refused(steps + R"("after":"WO-9")", 400, "wrong_type", "/after");
    refused(steps + R"("vehicle_type":"none")", 422, "unknown_vehicle_type", "/vehicle_type");
    refused(steps + R"("start":"no")", 400, "wrong_type", "/start");
    refused(steps + R"("sequence":"")", 400, "wrong_length", "/sequence");
    const auto with_action = [](const std::string& action) {
        return R"("steps":[{"station":2,"before":[)" + action + "]}]";
    };
    refused(with_action(R"({"type":"fly"})"), 422, "unknown_action", "/steps/0/before/0/type");
    refused(with_action(R"({"type":"measureStop"})"), 422, "reserved_action",
            "/steps/0/before/0/type");
    refused(with_action(R"({"type":"lowerParking","parameters":[]})"), 400, "wrong_type",
            "/steps/0/before/0/parameters");
    refused(with_action(R"({"type":"lowerParking","parameters":{"a":null}})"), 400, "wrong_type",
            "/steps/0/before/0/parameters/a");
    refused(with_action(R"({"parameters":{}})"), 400, "missing_field", "/steps/0/before/0/type");
}

}  // namespace
}  // namespace pulseline::api
