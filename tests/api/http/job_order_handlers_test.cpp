#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/api/http/api_world.hpp"

namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;
using testing::Json;

const std::string kOrders = "/api/v1/job-orders";
const std::string kToTwo = R"({"vehicle":"V1","steps":[{"station":2,"motion_mode":"linear"}]})";

TEST(JobOrders, CreatedOneIsStoredAndFoundAtItsLocation) {
    ApiWorld api;

    const Answer created = api.post(kOrders, kToTwo);

    ASSERT_EQ(created.status, 201) << created.body;
    EXPECT_EQ(created.json()["name"], "JO-1");
    EXPECT_EQ(created.json()["created_by"], "token:test");
    EXPECT_EQ(created.json()["steps"][0]["number"], 2);
    EXPECT_EQ(created.header("Location"), kOrders + "/" + created.json()["id"].get<std::string>());
    EXPECT_EQ(created.header("ETag"),
              "\"" + std::to_string(created.json()["revision"].get<int>()) + "\"");
    EXPECT_EQ(api.world.store.orders.size(), 1U);
    const Answer found = api.get(created.header("Location"));
    EXPECT_EQ(found.status, 200);
    EXPECT_EQ(found.json()["id"], created.json()["id"]);
}

TEST(JobOrders, SameKeyAndBodyGiveTheSameOrderAnotherBodyIsRefused) {
    ApiWorld api;
    const ApiWorld::Headers key = {{"idempotency-key", "takt-17"}};

    const Answer first = api.post(kOrders, kToTwo, key);
    const Answer again = api.post(kOrders, kToTwo, {{"idempotency-key", "\"takt-17\""}});
    const Answer other = api.post(kOrders, R"({"vehicle":"V1","steps":[{"station":3}]})", key);

    ASSERT_EQ(first.status, 201) << first.body;
    EXPECT_EQ(again.status, 201);
    EXPECT_EQ(again.json()["id"], first.json()["id"]);
    EXPECT_EQ(again.header("Location"), first.header("Location"));
    EXPECT_EQ(other.status, 422);
    EXPECT_EQ(other.code(), "idempotency_key_reused");
    EXPECT_EQ(api.world.store.orders.size(), 1U);
}

TEST(JobOrders, SameKeyOfAnotherClientIsAnotherOrder) {
    ApiWorld api;
    const ApiWorld::Headers key = {{"idempotency-key", "takt-17"}};
    const Answer first = api.post(kOrders, R"({"vehicle":"V1","steps":[{"station":2}]})", key);
    api.identity.name = "token:other";

    const Answer second = api.post(kOrders, R"({"vehicle":"V1","steps":[{"station":2}]})", key);

    ASSERT_EQ(second.status, 201) << second.body;
    EXPECT_NE(second.json()["id"], first.json()["id"]);
}

TEST(JobOrders, RepeatedAfterARestartStillGivesTheSameOrder) {
    ApiWorld api;
    const ApiWorld::Headers key = {{"idempotency-key", "takt-17"}};
    const Answer first = api.post(kOrders, kToTwo, key);

    api.world.crash_server();

    EXPECT_EQ(api.post(kOrders, kToTwo, key).json()["id"], first.json()["id"]);
    EXPECT_EQ(api.world.store.orders.size(), 1U);
}

TEST(JobOrders, SameClientOrderIdTwiceIsAConflict) {
    ApiWorld api;
    const std::string body = R"({"client_order_id":"WO-7","steps":[{"station":2}]})";

    ASSERT_EQ(api.post(kOrders, body).status, 201);
    const Answer second = api.post(kOrders, body);

    EXPECT_EQ(second.status, 409);
    EXPECT_EQ(second.field(), "/client_order_id");
}

TEST(JobOrders, OrderForAGoneVehicleIsAConflictWithTheReason) {
    ApiWorld api;
    for (auto& [id, connected] : api.world.connected) connected = false;
    api.world.fleet->vehicle_disconnected(plant::VehicleId("V1"), api.world.now);
    api.world.run(61);

    const Answer answer = api.post(kOrders, kToTwo);

    EXPECT_EQ(answer.status, 409) << answer.body;
    EXPECT_EQ(answer.code(), "vehicle_gone");
    EXPECT_EQ(answer.field(), "/vehicle");
}

TEST(JobOrders, DryRunAnswersThePreviewAndStoresNothing) {
    ApiWorld api;

    const Answer preview = api.post(kOrders + "?dryRun=true", kToTwo);

    ASSERT_EQ(preview.status, 200) << preview.body;
    EXPECT_EQ(preview.json()["accepted"], true);
    EXPECT_EQ(preview.json()["steps"][0]["chosen"], "linear");
    EXPECT_FALSE(preview.json()["steps"][0].contains("expected_deviation"));
    EXPECT_TRUE(preview.json()["steps"][0]["alternatives"].is_array());
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(JobOrders, DryRunShowsWhatEarlierStopsCameTo) {
    ApiWorld api;
    ASSERT_EQ(api.post(kOrders, kToTwo).status, 201);
    api.world.run(120);
    ASSERT_FALSE(api.world.store.stops.empty());

    const Answer preview =
        api.post(kOrders + "?dryRun=true",
                 R"({"vehicle":"V1","steps":[{"station":3,"motion_mode":"linear"}]})");

    ASSERT_EQ(preview.status, 200) << preview.body;
    EXPECT_EQ(preview.json()["steps"][0]["expected_deviation"]["stops"], 1) << preview.body;
}

TEST(JobOrders, DryRunLearnsWhatToExpectFromTheVehiclesOwnArrivals) {
    ApiWorld api;
    const auto expected = [&] {
        const Answer preview =
            api.post(kOrders + "?dryRun=true",
                     R"({"vehicle":"V1","steps":[{"station":3,"motion_mode":"linear"}]})");
        const Json answer = preview.json();
        for (const Json& option : answer["steps"][0]["options"]) {
            if (option["mode"] == "linear") return option["expected_deviation"];
        }
        return Json::object();
    };
    const auto drive_to = [&](int station) {
        const std::string body = R"({"vehicle":"V1","steps":[{"station":)" +
                                 std::to_string(station) + R"(,"motion_mode":"linear"}]})";
        ASSERT_EQ(api.post(kOrders, body).status, 201);
        api.world.run(120);
    };
    api.world.vehicle("V1").arrival_error = geometry::Pose2{0.03, 0, 0};
    drive_to(2);  // from where nobody had measured it: teaches nothing
    const Json usual = expected();
    EXPECT_EQ(usual["arrivals"], 0) << usual.dump();
    EXPECT_LT(usual["position_m"], 0.01);

    for (const int station : {3, 2, 3, 2, 3, 2, 3, 2}) drive_to(station);
    const Json learned = expected();
    EXPECT_EQ(learned["arrivals"], 8) << learned.dump();
    EXPECT_GT(learned["position_m"], 3 * usual["position_m"].get<double>()) << learned.dump();
    EXPECT_LT(learned["heading_rad"], usual["heading_rad"]) << "it arrives straighter than usual";

    const Json stop = api.get("/api/v1/stop-records").json()["items"][0];
    EXPECT_NEAR(stop["arrival"]["dx_m"].get<double>(), 0.03, 1e-9) << stop.dump();
    EXPECT_GT(stop["arrival"]["expected_m"], 0.0);
}

TEST(JobOrders, DryRunOfWhatCannotBeSaysWhy) {
    ApiWorld api;
    const Answer preview =
        api.post(kOrders + "?dryRun=true", R"({"vehicle":"V1","steps":[{"station":999}]})");
    ASSERT_EQ(preview.status, 200) << preview.body;
    EXPECT_EQ(preview.json()["accepted"], false);
    EXPECT_EQ(preview.json()["problem"]["code"], "unknown_station");
}

TEST(JobOrders, ADryRunAndAnOrderOfManyStepsArePlannedOffTheFleetsThread) {
    ApiWorld api;
    FleetContext context{*api.world.fleet, api.world.plant, api.images, api.world.now};
    const auto answer = [&](int steps, bool dry_run) {
        Request request;
        request.method = "POST";
        request.identity = api.identity;
        request.headers = {{"content-type", "application/json"}};
        EXPECT_TRUE(parse_target(kOrders + (dry_run ? "?dryRun=true" : ""), request));
        Json body = {{"vehicle", "V1"}, {"steps", Json::array()}};
        for (int i = 0; i < steps; ++i) body["steps"].push_back({{"station", 2 + i % 2}});
        request.body = body.dump();
        const Match found = match(request);
        EXPECT_EQ(found.route->asks(request), dry_run);
        return std::get<FleetHandler>(found.route->handler)(context, request);
    };

    EXPECT_TRUE(answer(1, true).plan);
    EXPECT_TRUE(answer(100, true).plan);
    EXPECT_TRUE(answer(100, false).plan);
    EXPECT_EQ(api.world.fleet->orders().size(), 0U) << "none of them is made yet";
    EXPECT_EQ(answer(1, false).response.status, 201);
}

TEST(JobOrders, ManyStepsOfATemplateAScheduleAndAnUpdateArePlannedOffTheFleetsThreadToo) {
    ApiWorld api;
    Json order = {{"vehicle", "V1"}, {"steps", Json::array()}};
    for (int i = 0; i < 100; ++i) order["steps"].push_back({{"station", 2 + i % 2}});
    ASSERT_EQ(api.post("/api/v1/job-order-templates", Json{{"name", "t"}, {"order", order}}.dump())
                  .status,
              201);
    const Answer waiting =
        api.post(kOrders, R"({"vehicle":"V1","start":false,"steps":[{"station":2}]})");
    const std::string control = waiting.header("Location") + "/job-control";
    const auto is_planned_beside = [&](const std::string& target, const Json& body) {
        FleetContext context{*api.world.fleet, api.world.plant, api.images, api.world.now};
        Request request;
        request.method = "POST";
        request.identity = api.identity;
        request.headers = {{"content-type", "application/json"}};
        EXPECT_TRUE(parse_target(target, request));
        request.body = body.dump();
        const Match found = match(request);
        return bool(std::get<FleetHandler>(found.route->handler)(context, request).plan);
    };

    EXPECT_TRUE(is_planned_beside("/api/v1/job-order-templates/t/job-orders", Json::object()));
    EXPECT_TRUE(is_planned_beside("/api/v1/job-order-schedules",
                                  {{"name", "s"}, {"every_s", 3600}, {"order", order}}));
    EXPECT_TRUE(is_planned_beside(control, {{"method", "Update"}, {"order", order}}));
    EXPECT_FALSE(is_planned_beside(control, {{"method", "Start"}}));
}

TEST(JobOrders, ChangesHonourIfMatch) {
    ApiWorld api;
    const Answer created = api.post(kOrders, kToTwo);
    const std::string at = created.header("Location");
    const std::string etag = api.get(at).header("ETag");

    const Answer stale = api.post(at + "/pause", "", {{"if-match", "\"999\""}});
    EXPECT_EQ(stale.status, 412);
    EXPECT_EQ(stale.code(), "stale_revision");
    EXPECT_EQ(stale.header("ETag"), etag);
    EXPECT_EQ(api.post(at + "/pause", "", {{"if-match", "W/" + etag}}).status, 412);
    EXPECT_EQ(api.post(at + "/pause", "", {{"if-match", "nonsense"}}).status, 412);

    EXPECT_EQ(api.post(at + "/pause", "", {{"if-match", "\"999\", " + etag}}).status, 202);
    EXPECT_EQ(api.post(at + "/resume", "", {{"if-match", etag}}).status, 412);
    EXPECT_EQ(api.post(at + "/resume", "", {{"if-match", "*"}}).status, 202);
    EXPECT_EQ(api.post(at + "/cancel").status, 202);
}

TEST(JobOrders, ChangeThatDoesNotFitTheStateIsAConflict) {
    ApiWorld api;
    const std::string at = api.post(kOrders, kToTwo).header("Location");
    EXPECT_EQ(api.post(at + "/resume").status, 409);
    ASSERT_EQ(api.post(at + "/cancel").status, 202);
    api.world.run(30);
    ASSERT_EQ(api.get(at).json()["state"], "Aborted");
    for (const char* change : {"/pause", "/resume", "/cancel"}) {
        EXPECT_EQ(api.post(at + change).status, 409) << change;
    }
}

TEST(JobOrders, PagesCoverEverythingOnceAlsoWhileOrdersComeIn) {
    ApiWorld api;
    std::set<std::string> there;
    for (int i = 0; i < 23; ++i) {
        const Answer created = api.post(kOrders, R"({"steps":[{"station":2}]})");
        ASSERT_EQ(created.status, 201) << created.body;
        there.insert(created.json()["id"].get<std::string>());
        api.world.run(0.1);
    }

    std::set<std::string> seen;
    std::string cursor;
    int pages = 0;
    do {
        const Answer page =
            api.get(kOrders + "?limit=5" + (cursor.empty() ? "" : "&cursor=" + cursor));
        ASSERT_EQ(page.status, 200) << page.body;
        const Json body = page.json();
        EXPECT_LE(body["items"].size(), 5U);
        for (const auto& item : body["items"]) {
            EXPECT_TRUE(seen.insert(item["id"].get<std::string>()).second) << "twice";
        }
        cursor = body.value("next_cursor", "");
        ASSERT_EQ(api.post(kOrders, R"({"steps":[{"station":3}]})").status, 201);
        ASSERT_LT(++pages, 10);
    } while (!cursor.empty());

    EXPECT_EQ(seen, there);
    EXPECT_EQ(pages, 5);
}

TEST(JobOrders, ListFiltersByStateAndVehicle) {
    ApiWorld api;
    ASSERT_EQ(api.post(kOrders, kToTwo).status, 201);

    EXPECT_EQ(api.get(kOrders + "?state=Running&vehicle=V1").json()["items"].size(), 1U);
    EXPECT_EQ(api.get(kOrders + "?state=Ended,Aborted").json()["items"].size(), 0U);
    EXPECT_EQ(api.get(kOrders + "?vehicle=V2").json()["items"].size(), 0U);
}

TEST(StopRecords, MeasuredStopIsListedFilteredAndFound) {
    ApiWorld api;
    const Answer order = api.post(kOrders, kToTwo);
    api.world.run(120);

    const Answer list = api.get("/api/v1/stop-records?vehicle=V1&station=2&order=" +
                                order.json()["id"].get<std::string>());

    ASSERT_EQ(list.status, 200) << list.body;
    ASSERT_EQ(list.json()["items"].size(), 1U);
    const Json stop = list.json()["items"][0];
    EXPECT_EQ(stop["inside"], true);
    EXPECT_EQ(stop["number"], 2);
    EXPECT_EQ(api.get("/api/v1/stop-records/" + stop["id"].get<std::string>()).json(), stop);
    EXPECT_EQ(api.get("/api/v1/stop-records?station=3").json()["items"].size(), 0U);
    EXPECT_EQ(api.get("/api/v1/stations/2").json()["ready"], true);
}

TEST(StopRecords, AStopThatWasNotMeasuredIsListedAndPagedOn) {
    ApiWorld api;
    api.world.vehicle("V1").measure_fails = "no_marker_in_view";
    const Answer order = api.post(kOrders, kToTwo);
    api.world.run(120);
    const std::string list = "/api/v1/unmeasured-stops";

    const Json found = api.get(list + "?vehicle=V1&station=2").json()["items"];
    ASSERT_GE(found.size(), 1U);
    EXPECT_EQ(found[0]["type"], "stop.not_measured");
    EXPECT_EQ(found[0]["order"], order.json()["id"]);
    EXPECT_EQ(found[0]["params"]["station"], 2);
    EXPECT_EQ(api.get(list + "?vehicle=V2").json()["items"].size(), 0U);

    std::vector<std::int64_t> paged;
    std::string cursor;
    for (std::size_t page = 0; page < found.size(); ++page) {
        const Json one = api.get(list + "?limit=1" + cursor).json();
        paged.push_back(one["items"].at(0)["seq"]);
        ASSERT_EQ(one.contains("next_cursor"), page + 1 < found.size());
        if (one.contains("next_cursor"))
            cursor = "&cursor=" + one["next_cursor"].get<std::string>();
    }
    EXPECT_TRUE(std::is_sorted(paged.rbegin(), paged.rend()));
    EXPECT_EQ(std::set<std::int64_t>(paged.begin(), paged.end()).size(), found.size());
}

}  // namespace
}  // namespace pulseline::api
