#include <gtest/gtest.h>

#include "api/http/wire/common_json.hpp"
#include "tests/api/http/api_world.hpp"

namespace pulseline::api {
namespace {

using testing::Answer;
using testing::ApiWorld;

const std::string kRoutes = "/api/v1/routes";

TEST(Routes, AnswerTheRouteWithTheCostOfEachLeg) {
    ApiWorld api;

    const Answer answer = api.post(kRoutes, R"({"vehicle_type":"small","from":1,"to":4})");

    ASSERT_EQ(answer.status, 200) << answer.body;
    const Json route = answer.json()["route"];
    EXPECT_EQ(route["cost"], 360.0);
    EXPECT_EQ(route["length_m"], 36.0);
    EXPECT_EQ(route["turns"], 0);
    ASSERT_EQ(route["legs"].size(), 3u);
    EXPECT_EQ(route["legs"][1]["edge"], "n2n3");
    EXPECT_EQ(route["legs"][1]["backwards"], false);
    EXPECT_EQ(route["legs"][1]["cost"]["length"], 120.0);
    EXPECT_FALSE(answer.json().contains("reason"));
}

TEST(Routes, NameTheReasonAndWhatToOpenWithoutOne) {
    ApiWorld api;

    const Answer answer =
        api.post(kRoutes, R"({"vehicle_type":"small","from":1,"to":4,"closed_edges":["n2n3"]})");

    ASSERT_EQ(answer.status, 200) << answer.body;
    EXPECT_FALSE(answer.json().contains("route"));
    EXPECT_EQ(answer.json()["reason"]["code"], "no_route");
    EXPECT_EQ(answer.json()["blocking"], Json::parse(R"([{"edge":"n2n3","why":"closed"}])"));
}

TEST(Routes, NameTheClosureInTheWayUnlessAskedNotToCountIt) {
    ApiWorld api;
    const Answer closed =
        api.post("/api/v1/closures", R"({"name":"Wet paint","edges":["n2n3","n3n2"]})");
    ASSERT_EQ(closed.status, 201) << closed.body;

    const Answer barred = api.post(kRoutes, R"({"vehicle_type":"small","from":1,"to":4})");
    const Answer free =
        api.post(kRoutes, R"({"vehicle_type":"small","from":1,"to":4,"present_closures":false})");

    ASSERT_EQ(barred.status, 200) << barred.body;
    EXPECT_FALSE(barred.json().contains("route"));
    const Json closure{{"id", closed.json()["id"]}, {"name", "Wet paint"}};
    EXPECT_EQ(barred.json()["blocking"][0]["closures"], Json::array({closure}));
    EXPECT_TRUE(free.json().contains("route")) << free.body;
}

TEST(Routes, RefuseWhatTheyDoNotKnow) {
    ApiWorld api;
    const auto code = [&](const std::string& body, int status) {
        const Answer answer = api.post(kRoutes, body);
        EXPECT_EQ(answer.status, status) << answer.body;
        return answer.code() + " " + answer.field();
    };
    EXPECT_EQ(code(R"({"vehicle_type":"x","from":1,"to":4})", 422),
              "unknown_vehicle_type /vehicle_type");
    EXPECT_EQ(code(R"({"vehicle_type":"small","from":9,"to":4})", 422), "unknown_station /from");
    EXPECT_EQ(code(R"({"vehicle_type":"small","from":1,"to":4,"closed_edges":["x"]})", 422),
              "unknown_edge /closed_edges/0");
    EXPECT_EQ(code(R"({"vehicle_type":"small","from":1})", 400), "missing_field /to");
    EXPECT_EQ(code(R"({"vehicle_type":"small","from":1,"to":4,"alternatives":99})", 400),
              "out_of_range /alternatives");
}

}  // namespace
}  // namespace pulseline::api
