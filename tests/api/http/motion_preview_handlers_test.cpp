#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "api/http/wire/common_json.hpp"
#include "tests/api/http/api_world.hpp"

namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;

const std::string kPreviews = "/api/v1/motion-previews";

Json option(const Json& answer, const std::string& mode) {
    for (const Json& option : answer["options"]) {
        if (option["mode"] == mode) return option;
    }
    ADD_FAILURE() << "no " << mode << " in " << answer;
    return {};
}

TEST(MotionPreviews, SayOfEveryModeWhatItDoesOrWhyNot) {
    ApiWorld api;

    const Answer answer = api.post(kPreviews, R"({"vehicle":"V1","station":2})");

    ASSERT_EQ(answer.status, 200) << answer.body;
    const Json json = answer.json();
    EXPECT_EQ(json["vehicle"], "V1");
    EXPECT_EQ(json["station"], 2);
    EXPECT_EQ(json["hall"], "h1");
    EXPECT_EQ(json["loaded"], false);
    EXPECT_NEAR(json["start"]["x_m"].get<double>(), 12, 1e-9);
    EXPECT_EQ(json["target"]["x_m"], 24.0);
    ASSERT_EQ(json["options"].size(), 3u);
    const Json linear = option(json, "linear");
    EXPECT_EQ(linear["feasible"], true);
    EXPECT_EQ(linear["suggested"], true);
    EXPECT_NEAR(linear["length_m"].get<double>(), 12, 1e-9);
    // Body of 3 m by 1.2 m over 12 m.
    EXPECT_NEAR(linear["swept_area_m2"].get<double>(), 15 * 1.2, 0.05);
    EXPECT_GT(linear["expected_deviation"]["position_m"], 0);
    EXPECT_EQ(option(json, "self_rotation")["reason"]["code"], "not_in_place");
    EXPECT_EQ(option(json, "fixed_axis_rotation")["reason"]["code"], "target_on_heading_line");
}

TEST(MotionPreviews, AnswerAsADryRunDoes) {
    ApiWorld api;

    const Answer asked = api.post(kPreviews, R"({"vehicle":"V1","station":3})");
    const Answer dry =
        api.post("/api/v1/job-orders?dryRun=true", R"({"vehicle":"V1","steps":[{"station":3}]})");

    ASSERT_EQ(asked.status, 200) << asked.body;
    EXPECT_EQ(asked.json()["options"], dry.json()["steps"][0]["options"]);
}

TEST(MotionPreviews, TakeAPoseFromAnyStart) {
    ApiWorld api;

    const Answer answer = api.post(kPreviews,
                                   R"({"vehicle":"V1","start":{"x_m":10,"y_m":10,"heading_rad":0},
                                       "target":{"x_m":20,"y_m":14,"heading_rad":0}})");

    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_FALSE(answer.json().contains("station"));
    const Json linear = option(answer.json(), "linear");
    EXPECT_NEAR(linear["length_m"].get<double>(), std::hypot(10, 4), 1e-6);
    EXPECT_EQ(linear["segments"].size(), 3u);  // turn, drive, turn back
    EXPECT_EQ(linear["segments"][0]["start"]["x_m"], 10.0);
    EXPECT_EQ(linear["route"].size(), 0u);
    EXPECT_TRUE(api.world.store.orders.empty());
}

TEST(MotionPreviews, NameWhatBlocksTheDirectWayToAPose) {
    ApiWorld api;

    const Answer answer =
        api.post(kPreviews, R"({"vehicle":"V1","target":{"x_m":59.5,"y_m":20,"heading_rad":0}})");

    ASSERT_EQ(answer.status, 200) << answer.body;
    const Json linear = option(answer.json(), "linear");
    EXPECT_EQ(linear["reason"]["code"], "blocked");
    EXPECT_EQ(linear["reason"]["params"]["by"], "wall");
}

TEST(MotionPreviews, RefuseAModeThatIsNotTheTypes) {
    ApiWorld api;

    const Answer answer =
        api.post(kPreviews, R"({"vehicle":"V1","station":2,"modes":["free","linear"]})");

    ASSERT_EQ(answer.status, 200) << answer.body;
    ASSERT_EQ(answer.json()["options"].size(), 2u);
    EXPECT_EQ(answer.json()["options"][0]["mode"], "linear");
    const Json free = option(answer.json(), "free");
    EXPECT_EQ(free["reason"]["code"], "mode_not_supported");
    EXPECT_EQ(free["suggested"], false);
}

TEST(MotionPreviews, CountClosedFloorAndStandingVehicles) {
    ApiWorld api;
    ASSERT_EQ(api.post("/api/v1/closures",
                       R"({"name":"Wet","hall":"h1","outline":[{"x_m":17,"y_m":15},
                           {"x_m":19,"y_m":15},{"x_m":19,"y_m":25},{"x_m":17,"y_m":25}]})")
                  .status,
              201);

    const Answer closed = api.post(kPreviews, R"({"vehicle":"V1","station":2})");
    const Answer near = api.post(kPreviews, R"({"vehicle":"V1","station":3})");

    EXPECT_EQ(option(closed.json(), "linear")["closures"].size(), 1u) << closed.body;
    // V2 stands on station 4, 12 m behind, both with 1.5 m ahead of their centres.
    EXPECT_EQ(option(near.json(), "linear")["nearest"], "V2");
    EXPECT_NEAR(option(near.json(), "linear")["clearance_m"].get<double>(), 9, 1e-6);
}

TEST(MotionPreviews, OnlyAskSoThatTheyAreAnsweredWhileNothingCanBeStored) {
    const auto asks = [](const Route& route) {
        return std::string(route.operation) == "previewMotions" && route.only_asks;
    };
    EXPECT_EQ(std::ranges::count_if(routes(), asks), 1);
}

TEST(MotionPreviews, NameTheFieldAtFault) {
    ApiWorld api;
    const auto refused = [&](const std::string& body, int status) {
        const Answer answer = api.post(kPreviews, body);
        EXPECT_EQ(answer.status, status) << body << "\n" << answer.body;
        return answer.code() + " " + answer.field();
    };
    const std::string v1 = R"({"vehicle":"V1",)";
    const std::string inside = R"({"x_m":20,"y_m":14,"heading_rad":0})";
    EXPECT_EQ(refused("{}", 400), "missing_field /vehicle");
    EXPECT_EQ(refused(R"({"vehicle":"V1"})", 400), "station_or_target /station");
    EXPECT_EQ(refused(v1 + R"("station":2,"target":)" + inside + "}", 400),
              "station_or_target /target");
    EXPECT_EQ(refused(v1 + R"("station":"2"})", 400), "wrong_type /station");
    EXPECT_EQ(refused(v1 + R"("target":{"x_m":1,"y_m":2}})", 400),
              "missing_field /target/heading_rad");
    EXPECT_EQ(refused(v1 + R"("target":{"x_m":1,"y_m":2,"heading_rad":0,"z_m":1}})", 400),
              "unknown_field /target/z_m");
    EXPECT_EQ(refused(v1 + R"("target":{"x_m":1e6,"y_m":2,"heading_rad":0}})", 400),
              "out_of_range /target/x_m");
    EXPECT_EQ(refused(v1 + R"("target":{"x_m":1e400,"y_m":2,"heading_rad":0}})", 400),
              "json_number ");
    EXPECT_EQ(refused(v1 + R"("station":2,"loaded":1})", 400), "wrong_type /loaded");
    EXPECT_EQ(refused(v1 + R"("station":2,"modes":[]})", 400), "wrong_count /modes");
    EXPECT_EQ(refused(v1 + R"("station":2,"modes":["auto"]})", 400), "not_one_of /modes/0");
    EXPECT_EQ(refused(v1 + R"("station":2,"modes":["linear",7]})", 400), "wrong_type /modes/1");
    EXPECT_EQ(refused(v1 + R"("station":2,"mode":"linear"})", 400), "unknown_field /mode");
    // Well formed, but it asks for what is not there.
    EXPECT_EQ(refused(R"({"vehicle":"X","station":2})", 422), "unknown_vehicle /vehicle");
    EXPECT_EQ(refused(v1 + R"("station":99})", 422), "unknown_station /station");
    EXPECT_EQ(refused(v1 + R"("station":2,"hall":"h9"})", 422), "unknown_hall /hall");
    EXPECT_EQ(refused(v1 + R"("target":{"x_m":70,"y_m":20,"heading_rad":0}})", 422),
              "outside_hall /target");
    EXPECT_EQ(refused(v1 + R"("station":2,"start":{"x_m":-1,"y_m":20,"heading_rad":0}})", 422),
              "outside_hall /start");
}

TEST(MotionPreviews, NeedAPlaceToStartFrom) {
    ApiWorld api;
    ASSERT_EQ(
        api.call("PUT", "/api/v1/vehicles/V1/integration", R"({"level":"ignore","off_floor":true})")
            .status,
        202);

    const Answer lost = api.post(kPreviews, R"({"vehicle":"V1","station":2})");
    const Answer from = api.post(
        kPreviews, R"({"vehicle":"V1","station":2,"start":{"x_m":12,"y_m":20,"heading_rad":0}})");

    EXPECT_EQ(lost.status, 409) << lost.body;
    EXPECT_EQ(lost.code() + " " + lost.field(), "pose_unknown /start");
    EXPECT_EQ(from.status, 200) << from.body;
}

TEST(MotionPreviews, StartInAnotherHallOnlyWhereTheyAreToldTo) {
    plant::Plant plant = fleet::testing::small_plant();
    plant::Hall second = plant.halls.front();
    second.id = plant::HallId("h2");
    plant.halls.push_back(second);
    ApiWorld api(plant);

    const Answer nowhere = api.post(kPreviews, R"({"vehicle":"V1","hall":"h2",
        "target":{"x_m":20,"y_m":14,"heading_rad":0}})");
    const Answer there = api.post(kPreviews, R"({"vehicle":"V1","hall":"h2",
        "start":{"x_m":12,"y_m":20,"heading_rad":0},"target":{"x_m":24,"y_m":20,"heading_rad":0}})");
    const Answer station = api.post(kPreviews, R"({"vehicle":"V1","hall":"h2",
        "start":{"x_m":12,"y_m":20,"heading_rad":0},"station":2})");

    EXPECT_EQ(nowhere.status, 422) << nowhere.body;
    EXPECT_EQ(nowhere.code() + " " + nowhere.field(), "other_hall /hall");
    ASSERT_EQ(there.status, 200) << there.body;
    EXPECT_EQ(there.json()["hall"], "h2");
    // V2 stands in the first hall: nothing is near but the wall.
    EXPECT_EQ(option(there.json(), "linear")["nearest"], "wall");
    EXPECT_EQ(option(station.json(), "linear")["reason"]["code"], "other_hall");
}

}  // namespace
}  // namespace pulseline::api
