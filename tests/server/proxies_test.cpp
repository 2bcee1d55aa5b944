#include "server/base/proxies.hpp"

#include <gtest/gtest.h>

#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

TEST(TrustedProxies, AreAddressesAndBlocks) {
    const auto proxies = TrustedProxies::parse({"10.0.0.2", "192.168.16.0/20", "fd00::/8"});
    ASSERT_TRUE(proxies);

    for (const char* ours : {"10.0.0.2", "::ffff:10.0.0.2", "192.168.31.255", "fd12::1"}) {
        EXPECT_TRUE(proxies->contains(ours)) << ours;
    }
    for (const char* other : {"10.0.0.3", "192.168.32.0", "fe80::1", "", "proxy"}) {
        EXPECT_FALSE(proxies->contains(other)) << other;
    }
    for (const char* wrong :
         {"", "proxy", "10.0.0.0/33", "10.0.0.0/", "10.0.0.0/x", "fd00::/129"}) {
        EXPECT_FALSE(TrustedProxies::parse({wrong})) << wrong;
    }
}

TEST(TrustedProxies, TakeTheLastAddressThatIsNotTheirOwn) {
    const auto proxies = TrustedProxies::parse({"10.0.0.0/24"}).value();

    EXPECT_EQ(proxies.client("10.0.0.2", "1.2.3.4"), "1.2.3.4");
    EXPECT_EQ(proxies.client("10.0.0.2", "6.6.6.6, 1.2.3.4, 10.0.0.3"), "1.2.3.4");
    EXPECT_EQ(proxies.client("10.0.0.2", "6.6.6.6, what,10.0.0.3"), "10.0.0.3");
    EXPECT_EQ(proxies.client("10.0.0.2", ""), "10.0.0.2");
    EXPECT_EQ(proxies.client("5.5.5.5", "1.2.3.4"), "5.5.5.5");
}

TEST(TrustedProxies, APeersNeighbourhoodIsWhatOneMayHaveAtHand) {
    EXPECT_EQ(neighbourhood("10.0.0.1"), "10.0.0.1");
    EXPECT_EQ(neighbourhood("::ffff:10.0.0.1"), "10.0.0.1");
    EXPECT_EQ(neighbourhood("2001:db8:1:2:3:4:5:6"), neighbourhood("2001:db8:1:2::"));
    EXPECT_NE(neighbourhood("2001:db8:1:2::"), neighbourhood("2001:db8:1:3::"));
}

/// Statuses of wrong passwords, each with another address in X-Forwarded-For.
std::vector<int> wrong_passwords(const Options& options) {
    TestServer server(options);
    (void)server.server().access().create_user("ann", access::Role::kOperator, "right password",
                                               Time{});
    std::vector<int> statuses;
    for (int i = 0; i < 7; ++i) {
        statuses.push_back(request(server.port(), "POST", "/api/v1/session",
                                   {{"X-Forwarded-For", "9.9.9." + std::to_string(i)}},
                                   R"({"name":"ann","password":"wrong password"})")
                               .status);
    }
    return statuses;
}

TEST(TrustedProxies, NobodyElseMayNameAnAddress) {
    Options options;
    options.limits.sign_in_refusal = std::chrono::milliseconds(0);
    options.behind_proxy = {"10.9.9.9"};

    EXPECT_EQ(wrong_passwords(options), (std::vector<int>{401, 401, 401, 401, 401, 429, 429}));

    options.behind_proxy = {"127.0.0.1"};

    EXPECT_EQ(wrong_passwords(options), (std::vector<int>{401, 401, 401, 401, 401, 401, 401}));
}

TEST(TrustedProxies, NobodyElseMaySayThatAConnectionIsSecure) {
    for (const auto& [proxy, secure] : {std::pair{"10.9.9.9", false}, {"127.0.0.1", true}}) {
        Options options;
        options.behind_proxy = {proxy};
        TestServer server(options);
        (void)server.server().access().create_user("ann", access::Role::kOperator, "right password",
                                                   Time{});

        const auto answer =
            request(server.port(), "POST", "/api/v1/session", {{"X-Forwarded-Proto", "https"}},
                    R"({"name":"ann","password":"right password"})");

        ASSERT_EQ(answer.status, 200) << answer.body;
        const auto& cookie = answer.headers.at("set-cookie");
        EXPECT_EQ(cookie.find("; Secure") != std::string::npos, secure) << cookie;
    }
}

}  // namespace
}  // namespace pulseline::server::testing
