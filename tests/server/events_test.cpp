#include <gtest/gtest.h>

#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"
#include "tests/server/ws_client.hpp"

namespace pulseline::server::testing {
namespace {

void make_events(TestServer& server, int count) {
    const auto headers = server.operator_token();
    for (int i = 0; i < count; ++i) {
        ASSERT_EQ(request(server.port(), "POST", "/api/v1/fleet/pause", headers).status, 202);
    }
}

std::string open_events(TcpClient& client, TestServer& server, const std::string& extra) {
    client.send("GET /api/v1/events HTTP/1.1\r\nHost: x\r\nAuthorization: " +
                server.viewer_token().at("Authorization") + "\r\n" + extra + "\r\n");
    return client.read_until("\r\n\r\n");
}

/// Sequence numbers of the next `count` events.
std::vector<std::int64_t> read_ids(TcpClient& client, std::size_t count) {
    std::vector<std::int64_t> ids;
    while (ids.size() < count) {
        const auto text = client.read_until("\n\n");
        if (text.empty()) break;
        const auto at = text.find("id: ");
        if (at != std::string::npos) ids.push_back(std::stoll(text.substr(at + 4)));
    }
    return ids;
}

TEST(Events, ResumeBehindLastEventIdWithoutGapOrDouble) {
    TestServer server;
    make_events(server, 5);
    const auto before = static_cast<std::int64_t>(server.store().event_count());
    TcpClient client(server.port());

    const auto head = open_events(client, server, "Last-Event-ID: 2\r\n");
    make_events(server, 5);
    const auto total = static_cast<std::int64_t>(server.store().event_count());

    EXPECT_NE(head.find("text/event-stream"), std::string::npos) << head;
    ASSERT_GT(total, before);
    std::vector<std::int64_t> expected;
    for (std::int64_t seq = 3; seq <= total; ++seq) expected.push_back(seq);
    EXPECT_EQ(read_ids(client, expected.size()), expected);
}

TEST(Events, ComeFromTheHistoryWhenTheyAreOlderThanTheServer) {
    MemoryStore store;
    fleet::Records records;
    std::vector<std::int64_t> expected;
    for (std::int64_t seq = 1; seq <= 1200; ++seq) {  // more than two pages
        fleet::Event event;
        event.seq = seq;
        event.type = "test";
        records.events.push_back(event);
        expected.push_back(seq);
    }
    store.commit(records);
    TestServer server({}, &store);
    TcpClient client(server.port());

    open_events(client, server, "Last-Event-ID: 0\r\n");

    EXPECT_EQ(read_ids(client, expected.size()), expected);
}

TEST(Events, TellAReaderOfOlderOnesThatTheyAreGone) {
    MemoryStore store;
    fleet::Records records;
    for (std::int64_t seq = 1; seq <= 20; ++seq) {
        fleet::Event event;
        event.seq = seq;
        event.type = "test";
        records.events.push_back(event);
    }
    store.commit(records);
    store.drop_events_before(11);
    TestServer server({}, &store);
    TcpClient client(server.port());

    open_events(client, server, "Last-Event-ID: 3\r\n");
    const std::string reset = client.read_until("oldest\":11}");

    EXPECT_NE(reset.find("event: stream.reset\ndata: {\"from\":4,"), std::string::npos) << reset;
    EXPECT_EQ(read_ids(client, 2), (std::vector<std::int64_t>{11, 12}));
}

TEST(Events, RefuseAnIdThatIsNoNumberOrNotYetReached) {
    TestServer server;
    const auto headers = server.viewer_token();

    auto wrong = headers;
    wrong["Last-Event-ID"] = "x";
    auto future = headers;
    future["Last-Event-ID"] = "999999";

    const auto no_number = request(server.port(), "GET", "/api/v1/events", wrong);
    const auto not_yet = request(server.port(), "GET", "/api/v1/events?after=999999", headers);

    EXPECT_EQ(no_number.status, 400);
    EXPECT_NE(no_number.body.find("\"wrong_type\""), std::string::npos) << no_number.body;
    EXPECT_EQ(not_yet.status, 400);
    EXPECT_NE(not_yet.body.find("\"event_unknown\""), std::string::npos) << not_yet.body;
    EXPECT_EQ(request(server.port(), "GET", "/api/v1/events", future).status, 400);
}

TEST(Stream, SendsASnapshotThenTheChange) {
    TestServer server;
    WsClient client(server.port(), "/api/v1/stream", server.viewer_token());

    const auto first = client.read();
    make_events(server, 1);
    const auto change = client.read_until("\"type\":\"event\"");

    ASSERT_EQ(client.status(), 101);
    ASSERT_TRUE(first);
    EXPECT_NE(first->find("\"type\":\"snapshot\""), std::string::npos);
    EXPECT_NE(first->find("\"V1\""), std::string::npos);
    ASSERT_TRUE(change);
}

TEST(Stream, RefusesAPageOfAnotherOrigin) {
    TestServer server;
    ASSERT_TRUE(server.server().access().create_user("op", access::Role::kOperator,
                                                     "correct horse 9", Time{}));
    const auto signed_in =
        request(server.port(), "POST", "/api/v1/session",
                {{"Origin", "http://127.0.0.1:" + std::to_string(server.port())}},
                R"({"name":"op","password":"correct horse 9"})");
    ASSERT_EQ(signed_in.status, 200) << signed_in.body;
    const auto set = signed_in.headers.at("set-cookie");
    const auto cookie = set.substr(0, set.find(';'));

    const std::string own = "http://127.0.0.1:" + std::to_string(server.port());
    WsClient good(server.port(), "/api/v1/stream", {{"Cookie", cookie}, {"Origin", own}});

    EXPECT_EQ(good.status(), 101);
    for (const std::string& origin : {std::string("http://evil.example"), std::string("null"),
                                      own + "0", "https" + own.substr(4), own + ".evil.example"}) {
        WsClient bad(server.port(), "/api/v1/stream", {{"Cookie", cookie}, {"Origin", origin}});
        EXPECT_EQ(bad.status(), 403) << origin;
    }
    WsClient none(server.port(), "/api/v1/stream", {{"Cookie", cookie}});
    EXPECT_EQ(none.status(), 403);
    WsClient nobody(server.port(), "/api/v1/stream", {{"Origin", own}});
    EXPECT_EQ(nobody.status(), 401);
}

TEST(Stream, TakesOnlySoManyFramesWithoutAByteInThem) {
    TestServer server;
    TcpClient client(server.port());
    client.send("GET /api/v1/stream HTTP/1.1\r\nHost: x\r\nAuthorization: " +
                server.viewer_token().at("Authorization") +
                "\r\nConnection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
                "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
    ASSERT_NE(client.read_until("\r\n\r\n").find(" 101 "), std::string::npos);
    client.send(std::string("\x01\x80\0\0\0\0", 6));  // a text begins
    std::string more;
    for (int i = 0; i < 100'000; ++i) more.append("\x00\x80\0\0\0\0", 6);

    const auto taken = client.send_for(more, 5);

    EXPECT_LT(taken, 20U << 20U) << "what the kernel keeps, and 64 KB a second";
}

TEST(Stream, EndsWhenTheServerStops) {
    TestServer server;
    WsClient client(server.port(), "/api/v1/stream", server.viewer_token());
    ASSERT_TRUE(client.read());

    std::thread stopper([&] { server.stop(); });

    EXPECT_EQ(client.close_code(), 1001);
    stopper.join();
}

}  // namespace
}  // namespace pulseline::server::testing
