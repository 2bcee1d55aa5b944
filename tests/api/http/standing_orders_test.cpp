#include <gtest/gtest.h>

#include "tests/api/http/api_world.hpp"

/// Templates and schedules over REST.
namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;
using testing::Json;

const std::string kTemplates = "/api/v1/job-order-templates";
const std::string kSchedules = "/api/v1/job-order-schedules";
const std::string kToStation = R"({"name":"to station","parameters":[
    {"name":"station","type":"integer"},{"name":"priority","type":"integer","default":4}],
    "order":{"vehicle":"V1","priority":"${priority}","steps":[{"station":"${station}"}]}})";
const std::string kInstances = kTemplates + "/to%20station/job-orders";

TEST(Templates, AnOrderIsMadeOfOne) {
    ApiWorld api;
    ASSERT_EQ(api.post(kTemplates, kToStation).status, 201);

    const Answer made = api.post(kInstances, R"({"parameters":{"station":3}})");

    ASSERT_EQ(made.status, 201) << made.body;
    EXPECT_EQ(made.json()["template"], "to station");
    EXPECT_EQ(made.json()["priority"], 4) << "the default";
    EXPECT_EQ(made.json()["steps"][0]["number"], 3);
    EXPECT_EQ(api.get(made.header("Location")).json()["id"], made.json()["id"]);
}

TEST(Templates, AreListedReadAndDeleted) {
    ApiWorld api;
    ASSERT_EQ(api.post(kTemplates, kToStation).status, 201);
    api.world.crash_server();
    api.world.run(1);

    EXPECT_EQ(api.get(kTemplates).json()["items"].size(), 1U) << "kept over a restart";
    EXPECT_EQ(api.get(kTemplates + "/to%20station").json()["order"]["steps"][0]["station"],
              "${station}");
    EXPECT_EQ(api.call("DELETE", kTemplates + "/to%20station").status, 204);
    EXPECT_EQ(api.get(kTemplates + "/to%20station").status, 404);
    EXPECT_EQ(api.post(kInstances, "{}").code(), "unknown_template");
    EXPECT_EQ(api.call("DELETE", kTemplates + "/to%20station").status, 404);
}

TEST(Templates, TheSameTwiceIsOneAnotherOfItsNameAConflict) {
    ApiWorld api;
    ASSERT_EQ(api.post(kTemplates, kToStation).status, 201);
    EXPECT_EQ(api.post(kTemplates, kToStation).status, 201);
    const Answer other =
        api.post(kTemplates, R"({"name":"to station","order":{"steps":[{"station":1}]}})");
    EXPECT_EQ(other.status, 409);
    EXPECT_EQ(other.code(), "duplicate_template");
    EXPECT_EQ(other.field(), "/name");
}

TEST(Templates, TheSameKeyMakesOneOrder) {
    ApiWorld api;
    ASSERT_EQ(api.post(kTemplates, kToStation).status, 201);
    const std::string body = R"({"parameters":{"station":3}})";
    const Answer first = api.post(kInstances, body, {{"idempotency-key", "k"}});
    const Answer again = api.post(kInstances, body, {{"idempotency-key", "k"}});
    EXPECT_EQ(first.json()["id"], again.json()["id"]);
    EXPECT_EQ(api.world.store.orders.size(), 1U);
}

TEST(Templates, FaultsOfValuesNameTheParameter) {
    ApiWorld api;
    ASSERT_EQ(api.post(kTemplates, kToStation).status, 201);
    const auto refused = [&](const std::string& body, int status, const std::string& code,
                             const std::string& field) {
        const Answer answer = api.post(kInstances, body);
        EXPECT_EQ(answer.status, status) << answer.body;
        EXPECT_EQ(answer.code(), code) << body;
        EXPECT_EQ(answer.field(), field) << body;
    };
    refused("{}", 400, "missing_field", "/parameters/station");
    refused(R"({"parameters":{"station":"3"}})", 400, "wrong_type", "/parameters/station");
    refused(R"({"parameters":{"station":99}})", 422, "unknown_station", "/parameters/station");
    refused(R"({"parameters":{"station":3,"priority":101}})", 400, "out_of_range",
            "/parameters/priority");
    refused(R"({"parameters":{"station":3,"colour":"red"}})", 400, "unknown_parameter",
            "/parameters/colour");
    refused(R"({"parameters":{"station":3},"vehicle":"V2"})", 400, "unknown_field", "/vehicle");
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(Templates, FaultsOfABodyAreFoundWhenItIsStored) {
    ApiWorld api;
    const auto refused = [&](const std::string& members, const std::string& code,
                             const std::string& field) {
        const Answer answer = api.post(kTemplates, R"({"name":"t",)" + members + "}");
        EXPECT_EQ(answer.status, 400) << answer.body;
        EXPECT_EQ(answer.code(), code) << members;
        EXPECT_EQ(answer.field(), field) << members;
    };
    const std::string ok = R"("order":{"steps":[{"station":2}]})";
    refused(R"("order":{"steps":[{"station":"${s}"}]})", "unknown_parameter",
            "/order/steps/0/station");
    refused(R"("parameters":[{"name":"s","type":"integer"}],)" + ok, "unused_parameter",
            "/parameters/0/name");
    refused(R"("parameters":[{"name":"s","type":"colour"}],)" + ok, "not_one_of",
            "/parameters/0/type");
    refused(R"("parameters":[{"name":"s","type":"integer","default":"x"}],)" + ok, "wrong_type",
            "/parameters/0/default");
    refused(R"("order":{"steps":[{"station":2}],"colour":"red"})", "unknown_field",
            "/order/colour");
    refused(R"("order":{"steps":[]})", "wrong_count", "/order/steps");
    refused(R"("description":"x")", "missing_field", "/order");
    EXPECT_TRUE(api.world.store.templates.empty());
}

const std::string kEvery = R"({"name":"round","every_s":100,
    "order":{"vehicle":"V1","steps":[{"station":2},{"station":1}]}})";

TEST(Schedules, AreMadeShownPausedResumedAndDeleted) {
    ApiWorld api;
    const Answer made = api.post(kSchedules, kEvery);
    ASSERT_EQ(made.status, 201) << made.body;
    const std::string at = made.header("Location");
    api.world.run(50);

    const Json shown = api.get(at).json();
    EXPECT_EQ(shown["made"], 1);
    EXPECT_EQ(shown["window_s"], 100) << "of every_s";
    EXPECT_EQ(shown["order"]["steps"].size(), 2U);
    EXPECT_EQ(api.get("/api/v1/job-orders/" + shown["newest_order"].get<std::string>())
                  .json()["schedule"],
              shown["id"]);

    EXPECT_EQ(api.post(at + "/pause", "", {{"if-match", "\"99\""}}).status, 412);
    const Answer paused = api.post(at + "/pause", "", {{"if-match", api.get(at).header("ETag")}});
    EXPECT_EQ(paused.json()["paused"], true);
    EXPECT_FALSE(paused.json().contains("next_at"));
    EXPECT_EQ(api.post(at + "/resume").json()["paused"], false);
    EXPECT_EQ(api.get(kSchedules).json()["items"].size(), 1U);
    EXPECT_EQ(api.call("DELETE", at).status, 204);
    EXPECT_EQ(api.get(at).status, 404);
    EXPECT_EQ(api.post(at + "/pause").status, 404);
}

TEST(Schedules, DailyOnesHaveTimesOfDay) {
    ApiWorld api;
    const Answer made = api.post(
        kSchedules,
        R"({"name":"d","daily_at":["14:30","06:00:15"],"order":{"steps":[{"station":2}]}})");
    ASSERT_EQ(made.status, 201) << made.body;
    EXPECT_EQ(made.json()["daily_at"], Json({"06:00:15", "14:30:00"}));
    EXPECT_EQ(made.json()["time_zone"], "UTC");
    EXPECT_EQ(made.json()["window_s"], 3600);
}

TEST(Schedules, DailyOnesFollowTheClockOfTheirTimeZone) {
    ApiWorld api;
    const Answer made = api.post(
        kSchedules,
        R"({"name":"d","daily_at":["06:00"],"time_zone":"Asia/Shanghai","order":{"steps":[{"station":2}]}})");
    ASSERT_EQ(made.status, 201) << made.body;
    EXPECT_EQ(made.json()["time_zone"], "Asia/Shanghai");
    EXPECT_EQ(made.json()["next_at"].get<std::string>().substr(10), "T22:00:00.000Z");
}

TEST(Schedules, FaultsNameTheField) {
    ApiWorld api;
    const auto refused = [&](const std::string& members, int status, const std::string& code,
                             const std::string& field) {
        const Answer answer = api.post(kSchedules, R"({"name":"s",)" + members + "}");
        EXPECT_EQ(answer.status, status) << answer.body;
        EXPECT_EQ(answer.code(), code) << members;
        EXPECT_EQ(answer.field(), field) << members;
    };
    const std::string order = R"("order":{"steps":[{"station":2}]})";
    refused(order, 400, "every_or_daily", "/every_s");
    refused(R"("every_s":60,"daily_at":["06:00"],)" + order, 400, "every_or_daily", "/every_s");
    refused(R"("every_s":59,)" + order, 400, "out_of_range", "/every_s");
    refused(R"("daily_at":["6:00"],)" + order, 400, "bad_time_of_day", "/daily_at/0");
    refused(R"("daily_at":["06:60"],)" + order, 400, "bad_time_of_day", "/daily_at/0");
    refused(R"("daily_at":[],)" + order, 400, "wrong_count", "/daily_at");
    refused(R"("daily_at":["06:00"],"time_zone":"Europe/Atlantis",)" + order, 400,
            "unknown_time_zone", "/time_zone");
    refused(R"("daily_at":["06:00"],"time_zone":"../../../etc/passwd",)" + order, 400,
            "unknown_time_zone", "/time_zone");
    refused(R"("every_s":60,"time_zone":"UTC",)" + order, 400, "time_zone_without_daily",
            "/time_zone");
    refused(R"("every_s":60,"until":"2001-01-01T00:00:00Z",)" + order, 422, "schedule_over",
            "/until");
    refused(R"("every_s":60,"order":{"steps":[{"station":2}],"due":"2030-01-01T00:00:00Z"})", 400,
            "unknown_field", "/order/due");
    refused(R"("every_s":60,"order":{"steps":[{"station":99}]})", 422, "unknown_station",
            "/order/steps/0/station");
    refused(R"("every_s":60)", 400, "missing_field", "/order");
    EXPECT_TRUE(api.world.store.schedules.empty());
}

}  // namespace
}  // namespace pulseline::api
