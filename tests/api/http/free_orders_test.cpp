#include <gtest/gtest.h>

#include "tests/api/http/api_world.hpp"

// Orders of free manoeuvres are planned beside the fleet before anything is made of them.
namespace pulseline::api::testing {
namespace {

const std::string kOrders = "/api/v1/job-orders";

/// Station 3 is walled in; the others can be reached.
plant::Plant walled_in() {
    plant::Plant plant = fleet::testing::small_plant();
    plant.vehicle_types.front().motion_modes.push_back(plant::MotionMode::kFree);
    const auto wall = [&plant](const std::string& id, double x_m, double y_m, double wide_m,
                               double high_m) {
        plant.areas.push_back(
            {plant::AreaId(id),
             plant::AreaKind::kObstacle,
             id,
             plant.halls.front().id,
             {{x_m, y_m}, {x_m + wide_m, y_m}, {x_m + wide_m, y_m + high_m}, {x_m, y_m + high_m}},
             {}});
    };
    wall("west", 32, 16, 0.5, 8);
    wall("east", 39.5, 16, 0.5, 8);
    wall("south", 32, 16, 8, 0.5);
    wall("north", 32, 23.5, 8, 0.5);
    return plant;
}

std::string free_to(int station) {
    return R"({"vehicle":"V1","steps":[{"station":)" + std::to_string(station) +
           R"(,"motion_mode":"free"}]})";
}

TEST(FreeOrders, OneThatCannotBeDrivenIsRefusedWithItsFieldAndNothingIsMade) {
    ApiWorld api(walled_in());

    const Answer answer = api.post(kOrders, free_to(3));

    EXPECT_EQ(answer.status, 422) << answer.body;
    EXPECT_EQ(answer.json()["code"], "no_free_way");
    EXPECT_EQ(answer.json()["field"], "/steps/0/motion_mode");
    EXPECT_TRUE(api.world.fleet->orders().empty());
}

TEST(FreeOrders, OneThatCanBeDrivenIsAndARepeatedRequestGetsItsAnswer) {
    ApiWorld api(walled_in());
    const ApiWorld::Headers key{{"idempotency-key", "\"free-1\""}};

    const Answer first = api.post(kOrders, free_to(2), key);
    ASSERT_EQ(first.status, 201) << first.body;
    api.world.run(120);
    EXPECT_EQ(api.world.fleet->orders().front().state, fleet::JobState::kEnded);

    // What it asks for cannot be had any more: the vehicle is walled in.
    const Answer again = api.post(kOrders, free_to(2), key);
    EXPECT_EQ(again.status, 201) << again.body;
    EXPECT_EQ(again.json()["id"], first.json()["id"]);
}

TEST(FreeOrders, OneForAnyVehicleIsNotRefusedForWhatOneOfThemCannotDo) {
    plant::Plant plant = walled_in();
    plant::VehicleType lanes_only = plant.vehicle_types.front();
    lanes_only.id = plant::VehicleTypeId("lanes-only");
    std::erase(lanes_only.motion_modes, plant::MotionMode::kFree);
    plant.vehicle_types.push_back(lanes_only);
    plant.vehicles.front().type = lanes_only.id;
    ApiWorld api(plant);

    const Answer made = api.post(kOrders, R"({"steps":[{"station":2,"motion_mode":"free"}]})");
    ASSERT_EQ(made.status, 201) << made.body;
    api.world.run(120);

    const auto order = api.world.fleet->orders().front();
    EXPECT_EQ(order.state, fleet::JobState::kEnded) << order.reason.code;
    EXPECT_EQ(order.assigned_vehicle, plant::VehicleId("V2"));
}

TEST(FreeOrders, AnUpdateThatCannotBeDrivenChangesNothing) {
    ApiWorld api(walled_in());
    const Answer made = api.post(
        kOrders, R"({"vehicle":"V1","start":false,"steps":[{"station":2,"motion_mode":"free"}]})");
    ASSERT_EQ(made.status, 201) << made.body;
    const std::string path = kOrders + "/" + made.json()["id"].get<std::string>() + "/job-control";
    const auto update = [&](int station) {
        return api.post(path, R"({"method":"Update","order":)" + free_to(station) + "}");
    };

    const Answer refused = update(3);
    EXPECT_EQ(refused.status, 422) << refused.body;
    EXPECT_EQ(refused.json()["field"], "/order/steps/0/motion_mode");
    EXPECT_EQ(api.world.fleet->orders().front().steps.front().station, plant::StationId("s2"));

    EXPECT_EQ(update(4).status, 202);
    EXPECT_EQ(api.world.fleet->orders().front().steps.front().station, plant::StationId("s4"));
}

TEST(FreeOrders, AScheduleOfOneThatCannotBeDrivenIsRefused) {
    ApiWorld api(walled_in());
    const auto scheduled = [&](const std::string& name, int station) {
        return api.post(
            "/api/v1/job-order-schedules",
            R"({"name":")" + name + R"(","every_s":3600,"order":)" + free_to(station) + "}");
    };

    const Answer refused = scheduled("never", 3);
    EXPECT_EQ(refused.status, 422) << refused.body;
    EXPECT_EQ(refused.json()["field"], "/order/steps/0/motion_mode");
    EXPECT_EQ(scheduled("hourly", 2).status, 201);
    EXPECT_EQ(scheduled("hourly", 2).status, 201) << "the same once more gives the stored one";
}

TEST(FreeOrders, OneMadeOfATemplateIsPlannedFirstToo) {
    ApiWorld api(walled_in());
    const std::string templates = "/api/v1/job-order-templates";
    ASSERT_EQ(api.post(templates, R"({"name":"free","parameters":[{"name":"station",
                  "type":"integer"}],"order":{"vehicle":"V1","steps":[{"station":"${station}",
                  "motion_mode":"free"}]}})")
                  .status,
              201);
    const auto made = [&](int station) {
        return api.post(templates + "/free/job-orders",
                        R"({"parameters":{"station":)" + std::to_string(station) + "}}");
    };

    const Answer refused = made(3);
    EXPECT_EQ(refused.status, 422) << refused.body;
    EXPECT_EQ(refused.code(), "no_free_way");
    EXPECT_TRUE(api.world.fleet->orders().empty());
    EXPECT_EQ(made(2).status, 201);
}

}  // namespace
}  // namespace pulseline::api::testing
