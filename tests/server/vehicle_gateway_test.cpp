#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "core/fleet/vehicle/state_filter.hpp"
#include "server/base/log.hpp"
#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"
#include "tests/server/ws_client.hpp"

namespace pulseline::server::testing {
namespace {

const std::string kPath = "/vehicles/ACME/0001";

std::map<std::string, std::string> vehicle_headers(const std::string& secret) {
    return {{"Authorization", "Bearer " + secret}, {"Sec-WebSocket-Protocol", "vda5050.v2.json"}};
}

std::string state_frame(int header_id, const std::string& extra = "") {
    return R"({"topic":"state","retain":false,"payload":{"headerId":)" + std::to_string(header_id) +
           R"(,"timestamp":"2026-01-01T00:00:00.000Z","version":"2.1.0","manufacturer":"ACME",)"
           R"("serialNumber":"0001","orderId":"","orderUpdateId":0,"lastNodeId":"",)"
           R"("lastNodeSequenceId":0,"driving":false,"paused":false,"nodeStates":[],)"
           R"("edgeStates":[],"actionStates":[],"batteryState":{"batteryCharge":80,)"
           R"("charging":false},"operatingMode":"AUTOMATIC","errors":[],"safetyState":)"
           R"({"eStop":"NONE","fieldViolation":false},"agvPosition":{"x":5,"y":5,"theta":0,)"
           R"("mapId":"hall","positionInitialized":true})" +
           extra + "}}";
}

/// A vehicle that has reported, and a dashboard that has seen it.
struct Reported {
    Reported()
        : vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token())),
          dashboard(server.port(), "/api/v1/stream", server.viewer_token()) {
        vehicle.send(state_frame(1));
        seen = dashboard.read_until("\"type\":\"poses\"").has_value();
    }
    TestServer server;
    WsClient vehicle;
    WsClient dashboard;
    bool seen = false;
};

TEST(VehicleGateway, LetsOnlyTheBoundTokenIn) {
    TestServer server;
    const auto own = server.vehicle_token();
    const auto other = server.vehicle_token("0002");

    WsClient good(server.port(), kPath, vehicle_headers(own));
    WsClient foreign(server.port(), kPath, vehicle_headers(other));
    WsClient unknown(server.port(), kPath, vehicle_headers("plv_nonsense"));
    WsClient missing(server.port(), kPath, {{"Sec-WebSocket-Protocol", "vda5050.v2.json"}});
    WsClient no_protocol(server.port(), kPath, {{"Authorization", "Bearer " + own}});
    WsClient not_in_plant(server.port(), "/vehicles/ACME/0002", vehicle_headers(other));

    EXPECT_EQ(good.status(), 101);
    EXPECT_EQ(foreign.status(), 403);
    EXPECT_EQ(unknown.status(), 401);
    EXPECT_EQ(missing.status(), 401);
    EXPECT_EQ(no_protocol.status(), 400);
    EXPECT_EQ(not_in_plant.status(), 404);
}

TEST(VehicleGateway, ShowsWhatTheVehicleReports) {
    TestServer server;
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));
    WsClient dashboard(server.port(), "/api/v1/stream", server.viewer_token());

    vehicle.send(state_frame(1));
    const auto pose = dashboard.read_until("\"type\":\"poses\"");

    ASSERT_TRUE(pose);
    EXPECT_NE(pose->find("\"V1\""), std::string::npos);
    const auto answer = request(server.port(), "GET", "/api/v1/vehicles/V1", server.viewer_token());
    EXPECT_NE(answer.body.find("\"link\":\"live\""), std::string::npos) << answer.body;
}

TEST(VehicleGateway, ShowsWhatNobodyDecidesByWhenItsTurnComes) {
    Reported given;
    ASSERT_TRUE(given.seen);
    const auto shown = [&] {
        return request(given.server.port(), "GET", "/api/v1/vehicles/V1",
                       given.server.viewer_token())
            .body;
    };
    ASSERT_NE(shown().find("\"battery_percent\":80"), std::string::npos) << shown();

    // A tenth of a percent is noise: no report of it passes but the one whose turn it is.
    auto frame = state_frame(2);
    frame.replace(frame.find("Charge\":80"), 10, "Charge\":80.1");
    const auto begin = std::chrono::steady_clock::now();
    const auto seen_by = begin + fleet::kStandingEvery + std::chrono::seconds(1);
    bool seen = false;
    while (!seen && std::chrono::steady_clock::now() < seen_by) {
        given.vehicle.send(frame);
        std::this_thread::sleep_for(
            std::chrono::milliseconds(100));  // as often as a vehicle reports
        seen = shown().find("\"battery_percent\":80.1") != std::string::npos;
    }

    EXPECT_TRUE(seen) << shown();
}

TEST(VehicleGateway, NewestConnectionReplacesTheOlder) {
    TestServer server;
    const auto headers = vehicle_headers(server.vehicle_token());
    WsClient first(server.port(), kPath, headers);

    WsClient second(server.port(), kPath, headers);

    EXPECT_EQ(first.close_code(), 4409);
    second.send(state_frame(1));
    WsClient dashboard(server.port(), "/api/v1/stream", server.viewer_token());
    EXPECT_TRUE(dashboard.read_until("\"type\":\"poses\""));
}

TEST(VehicleGateway, RefusesBothAfterThreeTakeovers) {
    TestServer server;
    const auto headers = vehicle_headers(server.vehicle_token());
    WsClient first(server.port(), kPath, headers);
    WsClient second(server.port(), kPath, headers);
    WsClient third(server.port(), kPath, headers);

    WsClient fourth(server.port(), kPath, headers);
    EXPECT_EQ(third.close_code(), 4409);
    EXPECT_EQ(fourth.close_code(), 4409);
    WsClient fifth(server.port(), kPath, headers);

    EXPECT_EQ(fifth.status(), 409);
    const auto resumed = request(server.port(), "POST", "/api/v1/fleet/resume",
                                 server.operator_token(), R"({"vehicles":["V1"]})");
    EXPECT_EQ(resumed.status, 202) << resumed.body;
    WsClient sixth(server.port(), kPath, headers);
    EXPECT_EQ(sixth.status(), 101);
}

TEST(VehicleGateway, ReportsAMalformedMessageAndKeepsTheSocket) {
    Reported given;
    ASSERT_TRUE(given.seen);

    given.vehicle.send(R"({"topic":"state","payload":{"headerId":"one"}})");

    EXPECT_TRUE(given.dashboard.read_until("vehicle.message_malformed"));
    given.vehicle.send(state_frame(2));
    EXPECT_TRUE(given.dashboard.read_until("\"type\":\"poses\""));
}

TEST(VehicleGateway, ClosesAfterTwentyMalformedMessagesInARow) {
    TestServer server;
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));

    for (int i = 0; i < 20; ++i) vehicle.send("[");

    EXPECT_EQ(vehicle.close_code(), 1008);
}

TEST(VehicleGateway, ClosesALinkThatMixesMalformedMessagesWithGoodOnes) {
    TestServer server;
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));

    for (int i = 0; i < 40; ++i) vehicle.send(i % 3 == 2 ? state_frame(i) : "[");

    EXPECT_EQ(vehicle.close_code(), 1008);
}

TEST(VehicleGateway, LogsMalformedMessagesOnceInAWhile) {
    TestServer server;
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));
    WsClient dashboard(server.port(), "/api/v1/stream", server.viewer_token());
    ::testing::internal::CaptureStderr();

    for (int i = 0; i < 15; ++i) vehicle.send("[");
    vehicle.send(state_frame(1));

    EXPECT_TRUE(dashboard.read_until("\"type\":\"poses\""));
    EXPECT_TRUE(log::flush());
    const std::string logged = ::testing::internal::GetCapturedStderr();
    const auto first = logged.find("vehicle_message_refused");
    ASSERT_NE(first, std::string::npos) << logged;
    EXPECT_EQ(logged.find("vehicle_message_refused", first + 1), std::string::npos) << logged;
}

TEST(VehicleGateway, TakesTheNewestOfTooManyMessagesAndTellsOfItOnce) {
    Options options;
    options.limits.vehicle_messages_per_second = 5;
    TestServer server(options);
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));
    WsClient dashboard(server.port(), "/api/v1/stream", server.viewer_token());
    ASSERT_TRUE(dashboard.read_until("\"type\":\"snapshot\""));

    for (int i = 1; i <= 100; ++i) {
        std::string frame = state_frame(i);
        if (i == 100) frame.replace(frame.find("\"x\":5"), 5, "\"x\":7");
        vehicle.send(frame);
    }

    const auto told = dashboard.read_until("too_many_messages");
    ASSERT_TRUE(told);
    const auto metrics = request(server.port(), "GET", "/metrics", server.viewer_token()).body;
    const auto at = metrics.find("\npulseline_vehicle_messages_withheld_total ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_GT(std::stoi(metrics.substr(at + 43)), 0);
    EXPECT_TRUE(dashboard.read_until("[\"V1\",7")) << "the last one waits for its turn";
}

TEST(VehicleGateway, ClosesALinkThatSaysTooMuchForTooLong) {
    Options options;
    options.limits.vehicle_messages_per_second = 5;
    options.limits.vehicle_excess_time = std::chrono::milliseconds(500);
    TestServer server(options);
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));

    const auto token = server.viewer_token();
    const auto is_open = [&] {
        const auto metrics = request(server.port(), "GET", "/metrics", token).body;
        return metrics.find("\npulseline_vehicle_sockets 1\n") != std::string::npos;
    };
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(8);
    while (is_open() && std::chrono::steady_clock::now() < end) {
        for (int i = 1; i <= 100; ++i) vehicle.send(state_frame(i));
    }

    EXPECT_FALSE(is_open());
}

TEST(VehicleGateway, DropsPicturesBeyondARateAndKeepsTheLink) {
    Options options;
    options.limits.vehicle_pictures_per_second = 2;
    TestServer server(options);
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));

    for (int i = 0; i < 50; ++i) vehicle.send_binary("no picture");  // each would be malformed

    vehicle.send(state_frame(1));
    WsClient dashboard(server.port(), "/api/v1/stream", server.viewer_token());
    EXPECT_TRUE(dashboard.read_until("\"type\":\"poses\""));
}

TEST(VehicleGateway, KeepsTheNewestPictureOfAKnownCamera) {
    TestServer server;
    WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));
    const auto picture = [](const std::string& camera, const std::string& bytes) {
        const std::string head = R"({"camera":")" + camera +
                                 R"(","timestamp":"2026-01-01T00:00:00Z","mime":"image/jpeg"})";
        std::string frame;
        for (int i = 0; i < 4; ++i) frame += static_cast<char>((head.size() >> (8 * i)) & 0xFFU);
        return frame + head + bytes;
    };
    const auto viewer = server.viewer_token();
    const std::string path = "/api/v1/vehicles/V1/cameras/front";
    EXPECT_EQ(request(server.port(), "GET", path, viewer).status, 404);

    vehicle.send_binary(picture("front", "old"));
    vehicle.send_binary(picture("front", "new"));
    vehicle.send_binary(picture("cellar", "x"));
    vehicle.send(state_frame(1));
    WsClient dashboard(server.port(), "/api/v1/stream", viewer);
    ASSERT_TRUE(dashboard.read_until("\"type\":\"poses\""));

    const auto answer = request(server.port(), "GET", path, viewer);
    EXPECT_EQ(answer.status, 200);
    EXPECT_EQ(answer.headers.at("content-type"), "image/jpeg");
    EXPECT_EQ(answer.body, "new");
}

TEST(VehicleGateway, SaysThatTheVehicleIsGoneWhenItsSocketDies) {
    TestServer server;
    WsClient dashboard(server.port(), "/api/v1/stream", server.viewer_token());
    ASSERT_TRUE(dashboard.read());
    {
        WsClient vehicle(server.port(), kPath, vehicle_headers(server.vehicle_token()));
        vehicle.send(state_frame(1));
        ASSERT_TRUE(dashboard.read_until("\"type\":\"poses\""));
        vehicle.cut();
    }

    EXPECT_TRUE(dashboard.read_until("vehicle.disconnected"));
}

}  // namespace
}  // namespace pulseline::server::testing
