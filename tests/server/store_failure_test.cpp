#include <gtest/gtest.h>

#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"
#include "tests/server/ws_client.hpp"

namespace pulseline::server::testing {
namespace {

const std::string kOrder = R"({"steps":[{"station":2}]})";

TEST(StoreFailure, AnswersUnavailableAndTellsNobody) {
    TestServer server;
    const auto headers = server.operator_token();
    const auto events = server.store().event_count();
    WsClient dashboard(server.port(), "/api/v1/stream", headers);
    ASSERT_TRUE(dashboard.read());

    server.store().fails = true;
    const auto refused = request(server.port(), "POST", "/api/v1/job-orders", headers, kOrder);
    const auto reading = request(server.port(), "GET", "/api/v1/fleet", headers);
    server.store().fails = false;

    EXPECT_EQ(refused.status, 503);
    EXPECT_NE(refused.body.find("store_unavailable"), std::string::npos);
    EXPECT_EQ(server.store().event_count(), events);
    EXPECT_EQ(reading.status, 200) << reading.body;
    EXPECT_EQ(server.store().order_count(), 0u);

    // Once the store works again so does the fleet, and the sequence has no gap (the store checks).
    HttpAnswer accepted;
    const auto give_up = std::chrono::steady_clock::now() + std::chrono::seconds(8);
    while (accepted.status != 201 && std::chrono::steady_clock::now() < give_up) {
        accepted = request(server.port(), "POST", "/api/v1/job-orders", headers, kOrder);
    }
    EXPECT_EQ(accepted.status, 201) << accepted.body;
    EXPECT_GT(server.store().event_count(), events);
    const auto told = dashboard.read_until("\"type\":\"event\"");
    ASSERT_TRUE(told);
    EXPECT_NE(told->find("\"seq\":" + std::to_string(events + 1)), std::string::npos) << *told;
}

TEST(StoreFailure, LosesNoAcknowledgedOrder) {
    TestServer server;
    const auto headers = server.operator_token();
    const std::string body = R"({"steps":[{"station":2}]})";

    int stored = 0;
    for (int i = 0; i < 20; ++i) {
        server.store().fails = i % 3 == 1;
        const auto answer = request(server.port(), "POST", "/api/v1/job-orders", headers, body);
        if (answer.status == 201) ++stored;
    }

    EXPECT_GT(stored, 0);
    EXPECT_EQ(server.store().order_count(), static_cast<std::size_t>(stored));
}

TEST(StoreFailure, IsNotReadyWhileItLasts) {
    TestServer server;
    const auto headers = server.operator_token();
    ASSERT_EQ(request(server.port(), "GET", "/readyz").status, 200);

    server.store().fails = true;
    request(server.port(), "POST", "/api/v1/job-orders", headers, kOrder);
    const auto not_ready = request(server.port(), "GET", "/readyz");
    const auto alive = request(server.port(), "GET", "/healthz");

    EXPECT_EQ(not_ready.status, 503);
    EXPECT_EQ(alive.status, 200);
}

TEST(StoreFailure, IsShownWithItsCauseWhileItLastsAndToldAsEventsAfterwards) {
    TestServer server;
    const auto headers = server.operator_token();
    WsClient dashboard(server.port(), "/api/v1/stream", headers);
    ASSERT_TRUE(dashboard.read());

    server.store().fails = true;
    request(server.port(), "POST", "/api/v1/job-orders", headers, kOrder);
    const auto told = dashboard.read_until("\"read_only\"");
    const auto fleet = request(server.port(), "GET", "/api/v1/fleet", headers);
    const auto metrics = request(server.port(), "GET", "/metrics", headers);
    const auto refused = request(server.port(), "POST", "/api/v1/job-orders", headers, kOrder);
    server.store().fails = false;

    ASSERT_TRUE(told);
    EXPECT_NE(told->find("disk_error"), std::string::npos) << *told;
    EXPECT_NE(fleet.body.find("\"cause\":\"disk_error\""), std::string::npos) << fleet.body;
    EXPECT_NE(metrics.body.find("pulseline_read_only 1"), std::string::npos);
    EXPECT_NE(refused.body.find("disk_error"), std::string::npos) << refused.body;
    EXPECT_TRUE(dashboard.read_until("store.failed"));
    EXPECT_TRUE(dashboard.read_until("store.recovered"));
}

TEST(StoreFailure, APauseIsAcceptedAllTheSameAndStoredLater) {
    TestServer server;
    const auto headers = server.operator_token();
    WsClient dashboard(server.port(), "/api/v1/stream", headers);
    ASSERT_TRUE(dashboard.read());
    server.store().fails = true;
    ASSERT_EQ(request(server.port(), "POST", "/api/v1/job-orders", headers, kOrder).status, 503);

    const auto paused = request(server.port(), "POST", "/api/v1/fleet/pause", headers);
    const auto resumed =
        request(server.port(), "POST", "/api/v1/fleet/resume", headers, R"({"vehicles":["V1"]})");
    server.store().fails = false;

    EXPECT_EQ(paused.status, 202) << paused.body;
    EXPECT_EQ(resumed.status, 503) << resumed.body;
    EXPECT_TRUE(dashboard.read_until("fleet.paused"));
    const auto fleet = request(server.port(), "GET", "/api/v1/fleet", headers);
    EXPECT_NE(fleet.body.find("\"paused\":true"), std::string::npos) << fleet.body;
}

}  // namespace
}  // namespace pulseline::server::testing
