#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "server/base/log.hpp"
#include "server/sessions/listener.hpp"
#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

TEST(Http, AnswersHealthWithoutSignIn) {
    TestServer server;

    const auto answer = request(server.port(), "GET", "/healthz");

    EXPECT_EQ(answer.status, 200);
    EXPECT_FALSE(answer.headers.contains("server"));
    EXPECT_EQ(answer.headers.at("x-content-type-options"), "nosniff");
    EXPECT_NE(answer.headers.at("content-security-policy").find("frame-ancestors 'none'"),
              std::string::npos);
    EXPECT_EQ(answer.headers.at("content-security-policy").find("unsafe-inline"),
              std::string::npos);
}

TEST(Http, RefusesABodyOverTheLimitAndStillDeliversTheAnswer) {
    TestServer server;

    const auto answer = request(server.port(), "POST", "/api/v1/job-orders",
                                server.operator_token(), std::string(300 * 1024, '['));

    EXPECT_EQ(answer.status, 413);
    EXPECT_NE(answer.body.find("urn:pulseline:problem:"), std::string::npos);
}

TEST(Http, RefusesAChunkedBodyOverTheLimit) {
    TestServer server;
    TcpClient client(server.port());

    client.send("POST /api/v1/job-orders HTTP/1.1\r\nHost: x\r\nAuthorization: " +
                server.operator_token().at("Authorization") +
                "\r\nTransfer-Encoding: chunked\r\n\r\n");
    for (int i = 0; i < 5; ++i) client.send("10000\r\n" + std::string(65536, ' ') + "\r\n");

    EXPECT_EQ(client.read_answer().status, 413);
}

TEST(Http, RefusesDeepNestingAsAProblemOfTheBody) {
    TestServer server;

    const auto answer = request(server.port(), "POST", "/api/v1/job-orders",
                                server.operator_token(), std::string(200 * 1024, '['));

    EXPECT_EQ(answer.status, 400);
    EXPECT_NE(answer.body.find("json_too_deep"), std::string::npos);
}

TEST(Http, CutsAHeaderThatNeverEnds) {
    Options options;
    options.limits.header_time = std::chrono::milliseconds(100);
    TestServer server(options);
    TcpClient client(server.port());

    client.send("GET /healthz HTTP/1.1\r\nHost: x\r\nX-Slow: ");

    EXPECT_TRUE(client.at_end());
    EXPECT_EQ(request(server.port(), "GET", "/healthz").status, 200);
}

TEST(Http, RefusesAHeaderOverTheLimit) {
    TestServer server;

    const auto answer =
        request(server.port(), "GET", "/healthz", {{"X-Long", std::string(9000, 'a')}});

    EXPECT_EQ(answer.status, 431);
}

TEST(Http, NamesWhatItCouldNotReadByOneRequestId) {
    TestServer server;
    for (const std::string& text :
         {"GET /healthz HTTP/1.1\r\nHost: x\r\nX-Long: " + std::string(9000, 'a') + "\r\n\r\n",
          std::string("GET /%zz HTTP/1.1\r\nHost: x\r\n\r\n"),
          std::string("POST /api/v1/session HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n"
                      "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n")}) {
        TcpClient client(server.port());
        client.send(text);

        const auto answer = client.read_answer();

        EXPECT_GE(answer.status, 400);
        EXPECT_NE(answer.body.find(answer.headers.at("x-request-id")), std::string::npos)
            << answer.body;
    }
}

TEST(Http, RefusesTwoLengthsInOneRequest) {
    TestServer server;
    TcpClient client(server.port());

    client.send(
        "POST /api/v1/session HTTP/1.1\r\nHost: x\r\nContent-Length: 4\r\n"
        "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\n");

    EXPECT_EQ(client.read_answer().status, 400);
    EXPECT_TRUE(client.at_end());
}

TEST(Http, KeepsTheConnectionAndAnswersInOrder) {
    TestServer server;
    TcpClient client(server.port());

    client.send(
        "GET /healthz HTTP/1.1\r\nHost: x\r\nX-Request-Id: one\r\n\r\n"
        "GET /nothing.txt HTTP/1.1\r\nHost: x\r\nX-Request-Id: two\r\n\r\n");
    const auto first = client.read_answer();
    const auto second = client.read_answer();

    EXPECT_EQ(first.status, 200);
    EXPECT_EQ(first.headers.at("x-request-id"), "one");
    EXPECT_EQ(second.status, 404);
    EXPECT_EQ(second.headers.at("x-request-id"), "two");
}

TEST(Http, MakesItsOwnRequestIdWhenTheOfferedOneCouldForgeALogLine) {
    TestServer server;

    const auto answer = request(server.port(), "GET", "/healthz", {{"X-Request-Id", "a b\"c"}});

    EXPECT_EQ(answer.headers.at("x-request-id").size(), 24U);
}

TEST(Http, LogsTheBeginningOfAPathOnly) {
    TestServer server;
    ::testing::internal::CaptureStderr();

    request(server.port(), "GET", "/api/v1/" + std::string(6000, 'x'));

    EXPECT_TRUE(log::flush());
    const std::string logged = ::testing::internal::GetCapturedStderr();
    EXPECT_NE(logged.find("path=/api/v1/xxx"), std::string::npos) << logged;
    EXPECT_LT(logged.size(), 1000U);
}

/// A store whose lists take a while.
struct SlowStore : MemoryStore {
    std::atomic<int> asked{0};
    std::vector<fleet::JobOrder> orders(const fleet::OrderQuery& query) override {
        ++asked;
        std::this_thread::sleep_for(std::chrono::milliseconds(200));
        return MemoryStore::orders(query);
    }
};

TEST(Http, EndsWithoutWhatStillWaits) {
    SlowStore store;
    auto server = std::make_unique<TestServer>(Options{}, &store);
    const std::string ask = "GET /api/v1/job-orders HTTP/1.1\r\nHost: x\r\nAuthorization: " +
                            server->viewer_token().at("Authorization") + "\r\n\r\n";
    std::vector<std::unique_ptr<TcpClient>> clients;
    for (int i = 0; i < 50; ++i) {
        clients.push_back(std::make_unique<TcpClient>(server->port()));
        clients.back()->send(ask);
    }
    while (store.asked < 1) std::this_thread::yield();
    EXPECT_EQ(request(server->port(), "GET", "/healthz").status, 200);  // all of them are in by now
    const auto begin = std::chrono::steady_clock::now();

    server.reset();

    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
    EXPECT_LT(store.asked, 40);
}

TEST(Http, AnswersHeadLikeGetWithoutABody) {
    TestServer server;
    const auto get = request(server.port(), "GET", "/");

    const auto head = request(server.port(), "HEAD", "/");

    EXPECT_EQ(head.status, 200);
    EXPECT_EQ(head.headers.at("content-length"), get.headers.at("content-length"));
    EXPECT_TRUE(head.body.empty());
}

TEST(Http, ServesThePageForItsOwnPathsAndNotForMissingFiles) {
    TestServer server;

    const auto page = request(server.port(), "GET", "/orders/12");
    const auto again =
        request(server.port(), "GET", "/", {{"If-None-Match", page.headers.at("etag")}});

    EXPECT_EQ(page.status, 200);
    EXPECT_EQ(page.headers.at("content-type"), "text/html; charset=utf-8");
    EXPECT_EQ(again.status, 304);
    EXPECT_EQ(request(server.port(), "GET", "/assets/none.js").status, 404);
    EXPECT_EQ(request(server.port(), "GET", "/api/v1/none").status, 404);
    EXPECT_EQ(request(server.port(), "GET", "/../etc/passwd.txt").status, 404);
}

TEST(Http, AnswersTheSameOrderToARepeatedCreate) {
    TestServer server;
    auto headers = server.operator_token();
    headers["Idempotency-Key"] = "k1";
    const std::string body = R"({"steps":[{"station":2}]})";

    const auto first = request(server.port(), "POST", "/api/v1/job-orders", headers, body);
    const auto second = request(server.port(), "POST", "/api/v1/job-orders", headers, body);
    const auto other = request(server.port(), "POST", "/api/v1/job-orders", headers,
                               R"({"steps":[{"station":1}]})");

    ASSERT_EQ(first.status, 201) << first.body;
    EXPECT_EQ(second.status, 201);
    EXPECT_EQ(first.headers.at("location"), second.headers.at("location"));
    EXPECT_EQ(other.status, 422);
    EXPECT_EQ(server.store().order_count(), 1U);
}

TEST(Http, DeniesAViewerEveryChange) {
    TestServer server;

    const auto answer =
        request(server.port(), "POST", "/api/v1/fleet/pause", server.viewer_token());

    EXPECT_EQ(answer.status, 403);
}

TEST(Http, WritesMetricsInPrometheusForm) {
    TestServer server;
    request(server.port(), "GET", "/healthz");

    const auto answer = request(server.port(), "GET", "/metrics", server.viewer_token());

    EXPECT_EQ(answer.status, 200);
    EXPECT_NE(
        answer.body.find("pulseline_http_requests_total{route=\"/healthz\",status=\"200\"} 1"),
        std::string::npos)
        << answer.body;
    EXPECT_NE(answer.body.find("process_resident_memory_bytes "), std::string::npos);
    EXPECT_NE(answer.body.find("pulseline_vehicles{link=\"never\"} 1"), std::string::npos);
}

TEST(Listener, NamesTheAddressInUseAndTheRemedy) {
    TestServer server;
    net::io_context io;

    const auto second = open_acceptor(io, Address{"127.0.0.1", server.port()});

    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().reason.code, "address_in_use");
    EXPECT_NE(second.error().what.find("127.0.0.1:" + std::to_string(server.port())),
              std::string::npos);
    EXPECT_NE(second.error().what.find("--listen"), std::string::npos);
}

TEST(Listener, ServesOtherMachinesOnlyEncryptedOrBehindAProxy) {
    Options options;
    const Address open{"0.0.0.0", 8080};

    EXPECT_FALSE(check_exposure(options, open));
    EXPECT_TRUE(check_exposure(options, Address{"127.0.0.1", 8080}));
    EXPECT_TRUE(check_exposure(options, Address{"::1", 8080}));
    options.behind_proxy = {"10.0.0.2"};
    EXPECT_TRUE(check_exposure(options, open));
    options.behind_proxy = {"the proxy"};
    EXPECT_FALSE(check_exposure(options, open));
    options.behind_proxy.clear();
    options.tls_self_signed = true;
    EXPECT_TRUE(check_exposure(options, open));
}

TEST(Listener, ReadsAddressesAndRefusesTheRest) {
    EXPECT_EQ(parse_address("[::1]:80")->host, "::1");
    EXPECT_EQ(parse_address("localhost:0")->host, "127.0.0.1");
    for (const char* wrong : {"", "8080", "127.0.0.1:", "127.0.0.1:70000", ":80", "a:b"}) {
        EXPECT_FALSE(parse_address(wrong)) << wrong;
    }
}

}  // namespace
}  // namespace pulseline::server::testing
