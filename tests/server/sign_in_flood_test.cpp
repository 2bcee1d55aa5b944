#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "server/sessions/sign_in_gate.hpp"
#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

using Steady = std::chrono::steady_clock;
using std::chrono::hours;
using std::chrono::minutes;
using std::chrono::seconds;
using Way = SignInGate::Way;

std::string sign_in_body(const std::string& name, const std::string& password) {
    return R"({"name":")" + name + R"(","password":")" + password + "\"}";
}

HttpAnswer sign_in(TestServer& server, const std::string& name, const std::string& password,
                   const char* from = nullptr) {
    return request(server.port(), "POST", "/api/v1/session", {}, sign_in_body(name, password),
                   from);
}

/// 24 connections that try invented names as fast as they are answered.
class Flood {
public:
    explicit Flood(TestServer& server) {
        for (int i = 0; i < 24; ++i) {
            threads_.emplace_back([this, &server, i] {
                for (int n = 0; !stop_; ++n) {
                    const auto name = "x" + std::to_string(i) + "-" + std::to_string(n);
                    const auto answer = sign_in(server, name, "invented password");
                    if (answer.status != 429) continue;
                    ++refused_;
                    refused_.notify_one();
                }
            });
        }
        refused_.wait(0);  // as much waits as may
    }
    ~Flood() {
        stop_ = true;
        for (auto& thread : threads_) thread.join();
    }

private:
    std::atomic<bool> stop_{false};
    std::atomic<int> refused_{0};
    std::vector<std::thread> threads_;
};

double slowest_of_ten_reads_s(TestServer& server) {
    const auto token = server.viewer_token();
    double slowest = 0;
    for (int i = 0; i < 10; ++i) {
        const auto begin = Steady::now();
        EXPECT_EQ(request(server.port(), "GET", "/api/v1/fleet", token).status, 200);
        slowest = std::max(slowest, std::chrono::duration<double>(Steady::now() - begin).count());
    }
    return slowest;
}

/// The least of several: what others on the machine do is not the flood's.
double usual_read_s(TestServer& server) {
    double usual = 10;
    for (int i = 0; i < 8; ++i) usual = std::min(usual, slowest_of_ten_reads_s(server));
    return usual;
}

class SignInFlood : public ::testing::Test {
protected:
    void SetUp() override {
        ASSERT_TRUE(server.server().access().create_user("ann", access::Role::kOperator,
                                                         "right password", Time{}));
    }
    TestServer server;
};

TEST_F(SignInFlood, LetsThoseInWhoSignedInLately) {
    ASSERT_EQ(sign_in(server, "ann", "right password").status, 200);
    const Flood flood(server);

    for (int i = 0; i < 3; ++i) EXPECT_EQ(sign_in(server, "ann", "right password").status, 200);
}

TEST_F(SignInFlood, LetsAPersonAtAnotherAddressIn) {
    const Flood flood(server);

    EXPECT_EQ(sign_in(server, "ann", "right password", "127.0.0.9").status, 200);
}

TEST_F(SignInFlood, LetsPeopleSignOutAtOnce) {
    const auto signed_in = sign_in(server, "ann", "right password");
    const auto cookie = signed_in.headers.at("set-cookie");
    const auto at = signed_in.body.find("\"csrf_token\":\"") + 14;
    const Flood flood(server);

    const auto answer = request(
        server.port(), "DELETE", "/api/v1/session",
        {{"Cookie", cookie.substr(0, cookie.find(';'))},
         {"X-Pulseline-CSRF", signed_in.body.substr(at, signed_in.body.find('"', at) - at)}});

    EXPECT_EQ(answer.status, 204);
}

TEST_F(SignInFlood, SlowsNobodyElse) {
    const double before_s = usual_read_s(server);
    const Flood flood(server);

    EXPECT_LT(usual_read_s(server), 3 * before_s + 0.010);
}

TEST(SignInGate, CountsAPeersAttemptsBeforeTheyWait) {
    SignInGate gate;
    const Time now{hours(1)};
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(gate.admit("name" + std::to_string(i), "10.0.0.1", 0, now), Way::kStranger);
    }

    EXPECT_EQ(gate.admit("another", "10.0.0.1", 0, now), Way::kLater);
    EXPECT_EQ(gate.admit("another", "10.0.0.2", 0, now), Way::kStranger);
    EXPECT_EQ(gate.admit("another", "10.0.0.1", 0, now + seconds(7)), Way::kStranger);
}

TEST(SignInGate, KeepsHalfOfTheKnownLaneForPeopleAtTheirUsualAddress) {
    SignInGate gate;
    const Time now{hours(1)};
    gate.succeeded("ann", "10.0.0.1", now);

    EXPECT_EQ(gate.admit("ann", "10.0.0.1", 0.9, now), Way::kKnown);
    EXPECT_EQ(gate.admit("ann", "10.0.0.2", 0.1, now), Way::kKnown);
    EXPECT_EQ(gate.admit("ann", "10.0.0.2", 0.9, now), Way::kStranger);
    EXPECT_EQ(gate.admit("bob", "10.0.0.1", 0.0, now), Way::kKnown);
    EXPECT_EQ(gate.admit("bob", "10.0.0.1", 0.2, now), Way::kStranger);
    EXPECT_EQ(gate.admit("ann", "10.0.0.1", 0, now + hours(24 * 8)), Way::kStranger);
}

TEST(SignInGate, IsBoundedHoweverManyAddressesSomebodyHas) {
    SignInGate gate;
    const Time now{hours(1)};
    int admitted = 0;
    for (int i = 0; i < 20'000; ++i) {
        if (gate.admit("a", "2001:db8:" + std::to_string(i) + "::/64", 0, now) != Way::kLater) {
            ++admitted;
        }
    }

    EXPECT_LT(admitted, 4200);
}

}  // namespace
}  // namespace pulseline::server::testing
