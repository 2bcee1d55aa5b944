#include <gtest/gtest.h>

#include "core/base/gravity.hpp"
#include "tests/api/http/api_world.hpp"
#include "tests/core/plant/loads.hpp"

// Loads over REST: where they are, where a person says that they are, and vehicles that take them
// over.
namespace pulseline::api::testing {
namespace {

const std::string kLoads = "/api/v1/loads";
const std::string kLifts = "/api/v1/vehicles/V1/lifts";
constexpr double kMass_kg = 400;

/// V1 stands below J-1, which hangs at station 1.
plant::Plant with_load() {
    plant::Plant plant = fleet::testing::small_plant();
    plant.vehicle_types.front().brackets = {{"left", {0, 0.4}}, {"right", {0, -0.4}}};
    plant.stations[0].support = plant.stations[2].support = plant::Support{0.1};
    plant::builders::put_on(plant, 0, "J-1", kMass_kg);
    plant.loads[0].vehicle = {};
    plant.loads[0].station = plant.stations[0].id;
    return plant;
}

class Loads : public ::testing::Test {
protected:
    Loads() : api(with_load()) {
        api.world.announce({"setBracketHeight", "stopLifts", "pick", "drop"});
        api.world.vehicle("V1").lifts_end = false;
        api.world.run(1);
    }
    ApiWorld api;
};

TEST_F(Loads, AreListedWithTheirPlaces) {
    const Json items = api.get(kLoads).json()["items"];
    ASSERT_EQ(items.size(), 1u);
    EXPECT_EQ(items[0]["id"], "J-1");
    EXPECT_EQ(items[0]["station"], 1);
    EXPECT_FALSE(items[0].contains("by")) << "the plant has it there";
    const Answer one = api.get(kLoads + "/J-1");
    EXPECT_EQ(one.status, 200);
    EXPECT_FALSE(one.header("ETag").empty());
    EXPECT_EQ(api.get("/api/v1/stations/1").json()["load"], "J-1");
    EXPECT_EQ(api.get(kLoads + "/none").code(), "unknown_load");
}

TEST_F(Loads, OneOnTheWayIsNamedToWhoCarriesSomething) {
    const fleet::LoadPlace there{{}, api.world.plant.stations[2].id};
    ASSERT_TRUE(api.world.fleet->place_load(plant::LoadId("J-1"), there, "op", api.world.now));
    api.world.run(1);
    const auto linear = [&](const std::string& loaded) {
        const Answer answer = api.post("/api/v1/motion-previews",
                                       R"({"vehicle":"V1","station":4,"loaded":)" + loaded + "}");
        const Json options = answer.json()["options"];
        for (const Json& option : options) {
            if (option["mode"] == "linear") return option;
        }
        return Json();
    };
    EXPECT_EQ(linear("true")["loads_in_the_way"], Json::array({"J-1"}));
    EXPECT_FALSE(linear("true").contains("closures"));
    EXPECT_FALSE(linear("false").contains("loads_in_the_way")) << "it passes below";

    const auto routes = [&](const std::string& loaded) {
        return api
            .post("/api/v1/routes",
                  R"({"vehicle_type":"small","from":1,"to":4,"loaded":)" + loaded + "}")
            .json();
    };
    const Json named = Json::array({{{"id", "J-1"}, {"name", "J-1"}}});
    EXPECT_EQ(routes("true")["blocking"][0]["loads"], named);
    EXPECT_TRUE(routes("false").contains("route"));
}

TEST_F(Loads, APersonSaysWhereOneIs) {
    const Answer put = api.call("PUT", kLoads + "/J-1/place", R"({"vehicle":"V2"})");
    EXPECT_EQ(put.status, 202);
    EXPECT_EQ(put.json()["vehicle"], "V2");
    EXPECT_EQ(put.json()["by"], "token:test");
    EXPECT_EQ(api.get("/api/v1/vehicles/V2").json()["load"], "J-1");
    EXPECT_EQ(api.get("/api/v1/vehicles/V2").json()["load_name"], "J-1");
    EXPECT_EQ(api.call("PUT", kLoads + "/J-1/place", R"({"station":3})").json()["station"], 3);
    const Json nowhere = api.call("PUT", kLoads + "/J-1/place", "{}").json();
    EXPECT_FALSE(nowhere.contains("station") || nowhere.contains("vehicle"));
}

TEST_F(Loads, EachMoveIsKeptNewestFirst) {
    const std::string moves = kLoads + "/J-1/moves";
    EXPECT_TRUE(api.get(moves).json()["items"].empty());
    for (const char* place : {R"({"vehicle":"V2"})", R"({"station":3})", "{}"}) {
        EXPECT_EQ(api.call("PUT", kLoads + "/J-1/place", place).status, 202);
    }
    const Json all = api.get(moves).json();
    ASSERT_EQ(all["items"].size(), 3u);
    EXPECT_FALSE(all.contains("next_cursor"));
    EXPECT_EQ(all["items"][0]["from"], Json::parse(R"({"station":3})"));
    EXPECT_EQ(all["items"][0]["to"], Json::object());
    EXPECT_EQ(all["items"][1]["from"], Json::parse(R"({"vehicle":"V2"})"));
    EXPECT_EQ(all["items"][1]["by"], "token:test");
    EXPECT_TRUE(all["items"][1].contains("at"));

    const Json first = api.get(moves + "?limit=2").json();
    EXPECT_EQ(first["items"].size(), 2u);
    const Json rest =
        api.get(moves + "?limit=2&cursor=" + first["next_cursor"].get<std::string>()).json();
    ASSERT_EQ(rest["items"].size(), 1u);
    EXPECT_EQ(rest["items"][0]["seq"], all["items"][2]["seq"]);
    EXPECT_FALSE(rest.contains("next_cursor"));
    EXPECT_EQ(api.get(kLoads + "/none/moves").status, 404);
    EXPECT_EQ(api.get(kLoads + "/none/moves").code(), "unknown_load");
}

TEST_F(Loads, ANewOneIsRegisteredOnceAndChangedByWhoHasSeenIt) {
    const std::string path = kLoads + "/A-105";
    const std::string sheet =
        R"({"kind":"product","model":"Wing","mass_kg":350,"centre":{"x_m":0.1,"y_m":0}})";
    const Answer made = api.call("PUT", path, sheet, {{"if-none-match", "*"}});
    ASSERT_EQ(made.status, 201) << made.body;
    EXPECT_EQ(made.header("Location"), path);
    const Json json = made.json();
    EXPECT_EQ(json["name"], "A-105");
    EXPECT_EQ(json["registered_by"], "token:test");
    EXPECT_EQ(json["carriers"], Json::parse(R"(["small"])"));
    EXPECT_FALSE(json.contains("vehicle") || json.contains("station"));
    EXPECT_EQ(api.get(path).header("ETag"), made.header("ETag"));

    EXPECT_EQ(api.call("PUT", path, R"({"mass_kg":1})", {{"if-none-match", "*"}}).code(),
              "load_known");
    EXPECT_EQ(api.call("PUT", path, sheet, {{"if-none-match", "*"}}).status, 200)
        << "the same once more, by whoever heard no answer";
    const std::string weighed = R"({"kind":"product","model":"Wing","mass_kg":361.5})";
    const Answer stale = api.call("PUT", path, weighed, {{"if-match", "\"other\""}});
    EXPECT_EQ(stale.status, 412);
    EXPECT_EQ(stale.code(), "stale_load");
    const Answer changed = api.call("PUT", path, weighed, {{"if-match", made.header("ETag")}});
    ASSERT_EQ(changed.status, 200) << changed.body;
    EXPECT_EQ(changed.json()["mass_kg"], 361.5);
    EXPECT_NE(changed.header("ETag"), made.header("ETag"));
    EXPECT_EQ(api.call("PUT", kLoads + "/A-9", weighed, {{"if-match", "*"}}).status, 412);
    EXPECT_EQ(api.get(kLoads).json()["items"].size(), 2u);
    EXPECT_EQ(api.get(path + "/moves").status, 200) << "it has not moved yet, and is known";
}

TEST_F(Loads, WhatIsWrongOfASheetIsNamedWithItsField) {
    const auto expect = [&](const std::string& id, const std::string& body, int status,
                            const std::string& code, const std::string& field) {
        const Answer answer = api.call("PUT", kLoads + "/" + id, body);
        EXPECT_EQ(answer.status, status) << body;
        EXPECT_EQ(answer.code(), code) << body;
        EXPECT_EQ(answer.json()["field"], field) << answer.body;
    };
    expect("N", R"({"mass_kg":1e5})", 422, "load_too_heavy", "/mass_kg");
    expect("N", R"({"mass_kg":-1})", 400, "negative", "/mass_kg");
    expect("N", R"({"kind":"whale"})", 400, "not_one_of", "/kind");
    expect("N", R"({"vehicle":"V1"})", 400, "unknown_field", "/vehicle");
    expect("N", R"({"name":""})", 400, "wrong_length", "/name");
    expect("N", R"({"outline":[{"x_m":0,"y_m":0}]})", 400, "too_few_points", "/outline");
    expect("N", R"({"vehicle_types":["none"]})", 422, "unknown_vehicle_type", "/vehicle_types/0");
    expect(std::string(65, 'x'), "{}", 400, "wrong_length", "/id");
    for (const char* id : {"..", ".", "a%2Fb"}) expect(id, "{}", 400, "bad_id", "/id");
    EXPECT_EQ(api.get(kLoads).json()["items"].size(), 1u);
}

TEST_F(Loads, WhatHasLeftForEverIsRetiredAndItsMovesStay) {
    const std::string path = kLoads + "/J-1";
    EXPECT_EQ(api.call("DELETE", path).code(), "load_in_plant");
    ASSERT_EQ(api.call("PUT", path + "/place", "{}").status, 202);
    EXPECT_EQ(api.call("DELETE", path).status, 204);
    EXPECT_EQ(api.call("DELETE", path).code(), "unknown_load") << "pressed twice";
    EXPECT_EQ(api.get(path).status, 404);
    EXPECT_TRUE(api.get(kLoads).json()["items"].empty());
    EXPECT_EQ(api.get(path + "/moves").json()["items"].size(), 1u);
    EXPECT_EQ(api.call("PUT", path, R"({"mass_kg":400})").code(), "load_retired");
}

TEST_F(Loads, WhatIsNoPlaceIsNamed) {
    const auto put = [&](const std::string& body) {
        return api.call("PUT", kLoads + "/J-1/place", body);
    };
    EXPECT_EQ(put(R"({"station":2})").code(), "no_support");
    EXPECT_EQ(put(R"({"station":99})").code(), "unknown_station");
    EXPECT_EQ(put(R"({"station":99})").status, 422);
    EXPECT_EQ(put(R"({"station":-1})").status, 400);
    EXPECT_EQ(put(R"({"station":1,"vehicle":"V1"})").code(), "two_places");
    EXPECT_EQ(put(R"({"vehicle":""})").status, 400);
    EXPECT_EQ(put(R"({"where":"here"})").status, 400);
    EXPECT_EQ(put("[").status, 400);
    EXPECT_EQ(api.call("PUT", kLoads + "/none/place", "{}").status, 404);
}

TEST_F(Loads, AVehicleTakesOneOverByTheSameWayAsItMovesItsBrackets) {
    EXPECT_EQ(api.post(kLifts, R"({"type":"pick"})").status, 400);
    EXPECT_EQ(api.post(kLifts, R"({"type":"pick","load":"none"})").code(), "unknown_load");
    const Answer taken = api.post(kLifts, R"({"type":"pick","load":"J-1"})");
    ASSERT_EQ(taken.status, 202);
    EXPECT_EQ(taken.json()["lift"]["type"], "pick");
    EXPECT_EQ(taken.json()["lift"]["load"], "J-1");
    auto& vehicle = api.world.vehicle("V1");
    for (const char* name : {"left", "right"}) {
        vehicle.state.brackets.push_back(
            {name, kMass_kg * kGravity_mps2 / 4, kMass_kg * kGravity_mps2 / 4, 0.15});
    }
    vehicle.end_lifts();
    api.world.run(1);
    EXPECT_EQ(api.get(kLoads + "/J-1").json()["vehicle"], "V1");
    EXPECT_EQ(api.post(kLifts, R"({"type":"drop"})").status, 202);
}

}  // namespace
}  // namespace pulseline::api::testing
