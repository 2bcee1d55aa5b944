#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <thread>

#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"

/// What somebody without any right can make the server hold, wait for or misread.
namespace pulseline::server::testing {
namespace {

using Steady = std::chrono::steady_clock;

double seconds_since(Steady::time_point begin) {
    return std::chrono::duration<double>(Steady::now() - begin).count();
}

std::size_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t total = 0;
    std::size_t resident = 0;
    statm >> total >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

/// Until the server has let go of all connections but the one that asks.
bool becomes_alone(TestServer& server, double within_s) {
    const auto begin = Steady::now();
    while (seconds_since(begin) < within_s) {
        const auto text = request(server.port(), "GET", "/metrics", server.viewer_token()).body;
        if (text.find("\npulseline_connections 1\n") != std::string::npos) return true;
    }
    return false;
}

TEST(Strangers, AreRefusedBeforeTheirBodyIsRead) {
    TestServer server;
    TcpClient client(server.port());

    client.send("POST /api/v1/job-orders HTTP/1.1\r\nHost: x\r\nContent-Length: 200000\r\n\r\n{");

    EXPECT_EQ(client.read_answer().status, 401);
    EXPECT_TRUE(client.at_end());
}

TEST(Strangers, MaySendNoMoreThanASignInNeeds) {
    TestServer server;
    TcpClient client(server.port());

    client.send("POST /api/v1/session HTTP/1.1\r\nHost: x\r\nContent-Length: 5000\r\n\r\n{");

    EXPECT_EQ(client.read_answer().status, 413);
}

TEST(Strangers, FillNoMemoryWithBodies) {
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the sanitizer's own memory is several times the server's";
#endif
    TestServer server;
    request(server.port(), "GET", "/healthz");
    const auto before = resident_bytes();
    std::vector<std::unique_ptr<TcpClient>> clients;
    const std::string head =
        "POST /api/v1/job-orders HTTP/1.1\r\nHost: x\r\nContent-Length: 250000\r\n\r\n";
    const std::string body(240'000, ' ');

    for (int i = 0; i < 300; ++i) {
        clients.push_back(std::make_unique<TcpClient>(server.port()));
        clients.back()->send(head);
        clients.back()->send(body);
    }
    request(server.port(), "GET", "/healthz");

    EXPECT_LT(resident_bytes(), before + (20U << 20U));  // 72 MB were sent
}

TEST(Strangers, CannotHideARequestInATransferCoding) {
    TestServer server;
    for (const char* coding : {"identity", "gzip", "xchunked", "chunked, identity", "gzip, chunked",
                               "chunked, chunked", "\"chunked\"", "chunked;a=b"}) {
        TcpClient client(server.port());

        client.send("POST /api/v1/session HTTP/1.1\r\nHost: x\r\nTransfer-Encoding: " +
                    std::string(coding) + "\r\n\r\nGET /healthz HTTP/1.1\r\nHost: x\r\n\r\n");

        EXPECT_EQ(client.read_answer().status, 400) << coding;
        EXPECT_EQ(client.read_until("no second answer"), "") << coding;
    }
}

TEST(Strangers, CannotHideARequestInAChunkedBodyOfHttp10) {
    TestServer server;
    TcpClient client(server.port());

    client.send("POST /api/v1/session HTTP/1.0\r\nTransfer-Encoding: chunked\r\n\r\n0\r\n\r\n");

    EXPECT_EQ(client.read_answer().status, 400);
}

TEST(Strangers, ChunkedBodiesAreReadAsBefore) {
    TestServer server;
    TcpClient client(server.port());

    client.send("POST /api/v1/job-orders HTTP/1.1\r\nHost: x\r\nAuthorization: " +
                server.operator_token().at("Authorization") +
                "\r\nTransfer-Encoding: Chunked\r\n\r\n2\r\n{}\r\n0\r\n\r\n");

    EXPECT_EQ(client.read_answer().status, 400);  // of the body: an order needs steps
    client.send("GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n");
    EXPECT_EQ(client.read_answer().status, 200);
}

TEST(Strangers, GetNoBodyToHead) {
    TestServer server;
    const std::string token =
        "Authorization: " + server.viewer_token().at("Authorization") + "\r\n";
    const std::vector<std::string> requests = {
        "HEAD /api/v1/events?after=0 HTTP/1.1\r\nHost: x\r\n" + token + "\r\n",
        "HEAD /api/v1/plant HTTP/1.1\r\n\r\n",  // without Host
        "HEAD /api/v1/plant HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"};
    for (const std::string& request : requests) {
        TcpClient client(server.port());

        client.send(request);

        EXPECT_FALSE(client.read_until("\r\n\r\n").empty());
        EXPECT_EQ(client.read_until("\n"), "") << request;
    }
}

TEST(Strangers, ReadEventsInHttp10ToTheEndOfTheConnection) {
    TestServer server;
    TcpClient client(server.port());

    client.send("GET /api/v1/events HTTP/1.0\r\nAuthorization: " +
                server.viewer_token().at("Authorization") + "\r\n\r\n");

    EXPECT_EQ(client.read_until("\r\n\r\n").find("chunked"), std::string::npos);
    EXPECT_EQ(client.read_until("\n\n").front(), ':');
}

TEST(Strangers, AreCutByOneDeadlineForTheWholeHead) {
    Options options;
    options.limits.header_time = std::chrono::seconds(2);
    TestServer server(options);
    TcpClient client(server.port());
    const auto begin = Steady::now();

    std::this_thread::sleep_for(std::chrono::milliseconds(1800));  // a client that is slow
    client.send("GET /healthz HTTP/1.1\r\nHost: x\r\nX-Slow: ");

    EXPECT_TRUE(client.at_end());
    EXPECT_LT(seconds_since(begin), 3.2);
}

TEST(Strangers, AreCutWhenTheirBodyTrickles) {
    TestServer server;
    TcpClient client(server.port());
    client.send("POST /api/v1/session HTTP/1.1\r\nHost: x\r\nContent-Length: 4000\r\n\r\n");
    const auto begin = Steady::now();

    EXPECT_TRUE(client.at_end());

    EXPECT_LT(seconds_since(begin), 6);
}

TEST(Strangers, AreCutWhenTheyDoNotReadTheirAnswer) {
    Options options;
    options.limits.write_time = std::chrono::milliseconds(500);
    TestServer server(options);
    TcpClient one(server.port(), nullptr, 2048);
    TcpClient many(server.port(), nullptr, 2048);
    const std::string ask = "GET /api/v1/openapi.json HTTP/1.1\r\nHost: x\r\n\r\n";

    one.send(ask);
    for (int i = 0; i < 50; ++i) many.send(ask);

    EXPECT_TRUE(becomes_alone(server, 8));
}

}  // namespace
}  // namespace pulseline::server::testing
