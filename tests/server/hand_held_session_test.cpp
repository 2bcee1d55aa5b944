#include <gtest/gtest.h>

#include <thread>

#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"
#include "tests/server/ws_client.hpp"

namespace pulseline::server::testing {
namespace {

constexpr const char* kPath = "/api/v1/vehicles/V1/hand-held";
using Headers = std::map<std::string, std::string>;

/// A server with people who have signed in.
class HandHeldSession : public ::testing::Test {
protected:
    std::string origin() const { return "http://127.0.0.1:" + std::to_string(server.port()); }
    Headers person(const std::string& name, access::Role role = access::Role::kOperator) {
        const std::string password = "correct horse 9";
        EXPECT_TRUE(server.server().access().create_user(name, role, password, Time{}));
        const auto signed_in =
            request(server.port(), "POST", "/api/v1/session", {{"Origin", origin()}},
                    R"({"name":")" + name + R"(","password":")" + password + R"("})");
        EXPECT_EQ(signed_in.status, 200) << signed_in.body;
        const auto set = signed_in.headers.at("set-cookie");
        return {{"Cookie", set.substr(0, set.find(';'))}, {"Origin", origin()}};
    }
    Headers vehicle_headers() {
        return {{"Authorization", "Bearer " + server.vehicle_token()},
                {"Sec-WebSocket-Protocol", "vda5050.v2.json"}};
    }
    static std::string control_of(const std::string& frame) {
        const auto at = frame.find("\"control\":\"") + 11;
        return frame.substr(at, frame.find('"', at) - at);
    }
    static std::string answer(const std::string& control, const std::string& rest) {
        return R"({"topic":"handHeld","retain":false,"payload":{"headerId":1,)"
               R"("timestamp":"2026-01-01T00:00:00.000Z","version":"2.1.0","manufacturer":"ACME",)"
               R"("serialNumber":"0001","control":")" +
               control + R"(",)" + rest + "}}";
    }

    TestServer server;
};

TEST_F(HandHeldSession, IsForPeopleWhoMayDriveAndForVehiclesThatThereAre) {
    const auto ann = person("ann");
    EXPECT_EQ(WsClient(server.port(), kPath, ann).status(), 101);
    EXPECT_EQ(WsClient(server.port(), kPath, {{"Origin", origin()}}).status(), 401);
    EXPECT_EQ(WsClient(server.port(), kPath, person("vera", access::Role::kViewer)).status(), 403);
    WsClient program(server.port(), kPath, server.operator_token());
    EXPECT_EQ(program.status(), 403);
    EXPECT_NE(program.problem().find("person_needed"), std::string::npos) << program.problem();
    auto elsewhere = ann;
    elsewhere["Origin"] = "http://evil.example";
    EXPECT_EQ(WsClient(server.port(), kPath, elsewhere).status(), 403);
    EXPECT_EQ(WsClient(server.port(), "/api/v1/vehicles/V9/hand-held", ann).status(), 404);
    EXPECT_EQ(request(server.port(), "GET", kPath, ann).status, 426);
}

TEST_F(HandHeldSession, PassesWhatIsSaidWithTheNameOfWhoSaysItAndTheAnswerBack) {
    WsClient vehicle(server.port(), "/vehicles/ACME/0001", vehicle_headers());
    WsClient ann(server.port(), kPath, person("ann"));
    WsClient bob(server.port(), kPath, person("bob"));
    ann.send(R"({"do":"take","sequence":1})");
    const auto taken = vehicle.read_until("\"handHeld\"");
    ASSERT_TRUE(taken);
    EXPECT_NE(taken->find(R"("person":"ann")"), std::string::npos) << *taken;
    EXPECT_NE(taken->find(R"("do":"take")"), std::string::npos) << *taken;
    bob.send(R"({"do":"drive","vx_mps":0.1,"sent_ms":5,"sequence":2})");
    const auto driven = vehicle.read_until(R"("person":"bob")");
    ASSERT_TRUE(driven);
    EXPECT_NE(control_of(*driven), control_of(*taken));

    vehicle.send(answer(
        control_of(*driven),
        R"("sequence":2,"ok":false,"reason":"in_other_hands","params":{"person":"ann"},"why":"no")"));
    vehicle.send(
        answer(control_of(*taken),
               R"("sequence":1,"ok":true,"operating_mode":"MANUAL","standing":true,"mine":true)"));
    const auto refused = bob.read();
    ASSERT_TRUE(refused);
    EXPECT_NE(refused->find("in_other_hands"), std::string::npos) << *refused;
    const auto done = ann.read();
    ASSERT_TRUE(done);
    EXPECT_NE(done->find(R"("mine":true)"), std::string::npos) << *done;
    EXPECT_EQ(done->find("in_other_hands"), std::string::npos) << "nobody reads another's answer";
}

TEST_F(HandHeldSession, TellsTheVehicleThatAControlHasGoneAndTheControlThatTheVehicleHas) {
    WsClient ann(server.port(), kPath, person("ann"));
    ann.send(R"({"do":"take"})");
    const auto away = ann.read();
    ASSERT_TRUE(away);
    EXPECT_NE(away->find("vehicle_not_connected"), std::string::npos) << *away;
    {
        WsClient vehicle(server.port(), "/vehicles/ACME/0001", vehicle_headers());
        ann.send(R"({"do":"take"})");
        ASSERT_TRUE(vehicle.read_until(R"("do":"take")"));
    }
    EXPECT_TRUE(ann.read_until("vehicle_not_connected")) << "it is told without asking";

    WsClient vehicle(server.port(), "/vehicles/ACME/0001", vehicle_headers());
    ann.send(R"({"do":"where"})");
    ASSERT_TRUE(vehicle.read_until(R"("do":"where")"));
    ann.cut();
    EXPECT_TRUE(vehicle.read_until(R"("do":"left")"));
}

TEST_F(HandHeldSession, RefusesWhatItCannotReadAndSendsAwayWhoSaysTooMuch) {
    WsClient vehicle(server.port(), "/vehicles/ACME/0001", vehicle_headers());
    const auto ann = person("ann");
    WsClient page(server.port(), kPath, ann);
    for (const char* text : {"{}", "[", R"({"do":"left"})", R"({"do":"drive","vx_mps":1e9})",
                             R"({"do":"take","person":"boss"})"}) {
        page.send(text);
        const auto answer = page.read();
        ASSERT_TRUE(answer) << text;
        EXPECT_NE(answer->find(R"("ok":false)"), std::string::npos) << *answer;
    }
    for (int i = 0; i < 60; ++i) page.send(R"({"do":"where"})");
    EXPECT_EQ(page.close_code(), 1008);
    WsClient long_winded(server.port(), kPath, ann);
    long_winded.send(std::string(5000, ' '));
    EXPECT_NE(long_winded.close_code(), 1000);
}

TEST_F(HandHeldSession, AVehicleHasThreeControlsOpenAtMost) {
    const auto ann = person("ann");
    WsClient first(server.port(), kPath, ann), second(server.port(), kPath, ann);
    auto third = std::make_unique<WsClient>(server.port(), kPath, ann);
    first.send(R"({"do":"where"})");
    second.send(R"({"do":"where"})");
    third->send(R"({"do":"where"})");
    ASSERT_TRUE(third->read());
    EXPECT_EQ(WsClient(server.port(), kPath, ann).close_code(), 1013);
    third->cut();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    bool open = false;
    while (!open && std::chrono::steady_clock::now() < deadline) {
        first.send(R"({"do":"where"})");
        second.send(R"({"do":"where"})");
        WsClient again(server.port(), kPath, ann);
        again.send(R"({"do":"where"})");
        open = again.read().has_value();
        if (!open) std::this_thread::sleep_for(std::chrono::milliseconds(100));  // its budget
    }
    EXPECT_TRUE(open) << "one has gone";
}

TEST_F(HandHeldSession, EndsWithTheSessionBehindIt) {
    WsClient vehicle(server.port(), "/vehicles/ACME/0001", vehicle_headers());
    const auto ann = person("ann");
    WsClient page(server.port(), kPath, ann);
    page.send(R"({"do":"take"})");
    ASSERT_TRUE(vehicle.read_until(R"("do":"take")"));
    // A new password ends every session of hers.
    ASSERT_TRUE(server.server().access().create_user("ann", access::Role::kOperator,
                                                     "another horse 9", Time{}));
    EXPECT_EQ(page.close_code(), 4401);
    EXPECT_TRUE(vehicle.read_until(R"("do":"left")"));
}

}  // namespace
}  // namespace pulseline::server::testing
