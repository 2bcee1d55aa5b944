#include "api/events/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/api/http/api_world.hpp"

namespace pulseline::events {
namespace {

using api::testing::ApiWorld;
using api::testing::Json;

std::string breach(const std::string& frame) {
    const Json json = Json::parse(frame, nullptr, false);
    if (json.is_discarded()) return "no JSON: " + frame;
    return api::testing::breach(api::testing::schema("StreamFrame"), json);
}

/// A fleet with an order under way, one done and its stop measured.
class FramesTest : public ::testing::Test {
protected:
    FramesTest() {
        EXPECT_TRUE(api.world.order("V1", {2}).has_value());
        api.world.run(120);
        EXPECT_TRUE(api.world.order("V1", {3}).has_value());
        api.world.run(0.3);
        EXPECT_FALSE(api.world.store.stops.empty());
    }
    fleet::VehicleView v1() {
        return *api.world.fleet->vehicle(plant::VehicleId("V1"), api.world.now);
    }

    ApiWorld api;
};

TEST_F(FramesTest, SnapshotOfARunningFleetFitsTheDocument) {
    Snapshot snapshot;
    snapshot.now = api.world.now;
    snapshot.fleet = api.world.fleet->view(api.world.now);
    snapshot.vehicles = api.world.fleet->vehicles(api.world.now);
    snapshot.stations = api.world.fleet->stations();
    snapshot.job_orders = api.world.fleet->orders();
    snapshot.stop_records = api.world.store.stops;

    const std::string frame = snapshot_frame(api.world.plant, api.images, snapshot);

    EXPECT_EQ(breach(frame), "");
    const Json json = Json::parse(frame);
    EXPECT_EQ(json["job_orders"].size(), 2U);
    EXPECT_EQ(json["vehicles"].size(), 2U);
}

TEST_F(FramesTest, ChangesInOneFrameFitTheDocument) {
    const auto vehicle = vehicle_frame(api.world.plant, api.images, v1());
    const auto fleet = fleet_frame(api.world.plant, api.world.fleet->view(api.world.now));

    const std::string frame = changes_frame({vehicle, fleet});

    EXPECT_EQ(breach(frame), "");
    EXPECT_EQ(Json::parse(frame)["changes"][1], Json::parse(fleet));
}

TEST_F(FramesTest, EveryChangeFrameFitsTheDocument) {
    const auto& plant = api.world.plant;
    EXPECT_TRUE(v1().leg.has_value());
    EXPECT_EQ(breach(vehicle_frame(plant, api.images, v1())), "");
    EXPECT_EQ(breach(fleet_frame(plant, api.world.fleet->view(api.world.now))), "");
    for (const auto& station : api.world.fleet->stations()) {
        EXPECT_EQ(breach(station_frame(station)), "");
    }
    for (const auto& order : api.world.fleet->orders()) {
        EXPECT_EQ(breach(job_order_frame(plant, order)), "");
    }
    for (const auto& stop : api.world.store.stops) EXPECT_EQ(breach(stop_record_frame(stop)), "");
    ASSERT_FALSE(api.world.store.events.empty());
    for (const auto& event : api.world.store.events) EXPECT_EQ(breach(event_frame(event)), "");
}

TEST(Frames, AFullyEquippedVehicleFitsTheDocument) {
    ApiWorld api;
    fleet::VehicleView view = *api.world.fleet->vehicle(plant::VehicleId("V1"), api.world.now);
    view.state.errors = {{"wheelFault", true, "hot", {}}};
    view.state.brackets = {{"front left", 1.0, 2.0, 0.3}};
    view.state.wheels = {{"FL", 0.1, 0.2, 40, "overheated"}};
    view.state.parking_feet = {{"front", 0.1, 4.0}};
    vda5050::CameraReading reading;
    reading.camera = "front";
    reading.found = true;
    reading.payload = "ST01-F";
    view.state.cameras = {reading};
    view.needs_resume_reason = {"server_restarted", {}};
    view.reason = Reason{"waits_for", {{"vehicle", std::string("V2")}}};

    const std::string frame = vehicle_frame(api.world.plant, api.images, view);

    EXPECT_EQ(breach(frame), "");
    EXPECT_EQ(Json::parse(frame)["vehicle"]["cameras"][0]["image_at"], "2026-11-21T03:50:36.000Z");
}

TEST(Frames, PosesAreCompactRowsInOneFrame) {
    const std::string frame = poses_frame(
        time_from_ns(0), {{plant::VehicleId("TP-\"1"), {1.0000049, -2, 3.1}, 0.5, 0.123},
                          {plant::VehicleId("TP-02"), {0, 0, 0}, -1, 9.999}});
    EXPECT_EQ(breach(frame), "");
    EXPECT_EQ(Json::parse(frame)["poses"],
              Json::parse(R"([["TP-\"1",1.0,-2.0,3.1,0.5,0.12],["TP-02",0.0,0.0,0.0,-1.0,10.0]])"));
    EXPECT_EQ(breach(poses_frame(time_from_ns(0), {})), "");
}

TEST(Frames, PosesAreRoundedToWhatAVehicleCanMean) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> exponent(-8, 17);
    std::vector<PoseSample> samples;
    for (const double x : {0.0, -0.0, -4e-6, 6e-6, -6e-6, 0.1, 9.999999, -123.45678, 1e9, -1e300}) {
        samples.push_back({plant::VehicleId("V"), {x, -x, x}, x, x});
    }
    for (int i = 0; i < 2000; ++i) {
        const double x = std::pow(10, exponent(random)) * (i % 2 == 0 ? 1 : -1);
        samples.push_back({plant::VehicleId("V"), {x, -x, x}, x, x});
    }
    const std::string frame = poses_frame(time_from_ns(0), samples);
    EXPECT_EQ(breach(frame), "");
    const auto rows = Json::parse(frame)["poses"];
    ASSERT_EQ(rows.size(), samples.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const double x = samples[i].pose.x_m;
        const auto near = [&](double shown, double value, double step) {
            EXPECT_LE(std::abs(shown - value), 0.5001 * step + 1e-15 * std::abs(value)) << value;
        };
        near(rows[i][1], x, 1e-5);
        near(rows[i][2], -x, 1e-5);
        near(rows[i][3], x, 1e-6);
        near(rows[i][4], x, 1e-4);
        near(rows[i][5], x, 1e-2);
    }
    EXPECT_NE(frame.find(R"(["V",0,0,0,0,0])"), std::string::npos);
    EXPECT_NE(frame.find(R"(["V",-123.45678,123.45678,-123.45678,-123.4568,-123.46])"),
              std::string::npos);
    EXPECT_EQ(frame.find("-0,"), std::string::npos);
}

TEST(Frames, ServerSentEventKeepsToItsLines) {
    fleet::Event event;
    event.seq = 7;
    event.type = "vehicle.lost";
    event.vehicle = plant::VehicleId("V1");
    event.params = {{"note", std::string("two\nlines\r\n")}};
    EXPECT_EQ(sse(event),
              "id: 7\nevent: vehicle.lost\ndata: "
              R"({"at":"1970-01-01T00:00:00.000Z","params":{"note":"two\nlines\r\n"},"seq":7,)"
              R"("type":"vehicle.lost","vehicle":"V1"})"
              "\n\n");
    EXPECT_EQ(sse_keep_alive().back(), '\n');
}

TEST(Frames, TextThatIsNoUtf8DoesNotBreakTheFrame) {
    fleet::Event event;
    event.type = "x";
    event.params = {{"note", std::string("\xFF\xC0")}};
    EXPECT_EQ(breach(event_frame(event)), "");
}

}  // namespace
}  // namespace pulseline::events
