#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <vector>

#include "server/base/descriptors.hpp"
#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

/// No file can be opened as long as it lives.
class NoMoreFiles {
public:
    NoMoreFiles() {
        getrlimit(RLIMIT_NOFILE, &before_);
        rlimit none = before_;
        const int next = ::open("/dev/null", O_RDONLY);
        ::close(next);
        none.rlim_cur = static_cast<rlim_t>(next);
        setrlimit(RLIMIT_NOFILE, &none);
    }
    ~NoMoreFiles() { setrlimit(RLIMIT_NOFILE, &before_); }

private:
    rlimit before_{};
};

TEST(Descriptors, AreAsManyAsTheSystemAllows) {
    rlimit before{};
    ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &before), 0);
    rlimit few = before;
    few.rlim_cur = 100;
    ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);

    const auto allowed = raise_descriptor_limit();

    rlimit after{};
    getrlimit(RLIMIT_NOFILE, &after);
    setrlimit(RLIMIT_NOFILE, &before);
    EXPECT_EQ(allowed, before.rlim_max);
    EXPECT_EQ(after.rlim_cur, before.rlim_max);
}

TEST(Descriptors, WhenTheyRunOutNewConnectionsAreClosedAndOldOnesServed) {
    TestServer server;
    TcpClient old(server.port());
    old.send("GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n");
    ASSERT_EQ(old.read_answer().status, 200);
    std::vector<int> clients;
    for (int i = 0; i < 20; ++i) clients.push_back(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(server.port());
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    {
        const NoMoreFiles no_more;

        for (const int client : clients) {
            const timeval limit{5, 0};
            setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
            ASSERT_EQ(connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address),
                      0);
        }
        for (const int client : clients) {
            std::array<char, 8> bytes{};
            EXPECT_EQ(::recv(client, bytes.data(), bytes.size(), 0), 0);
        }
        old.send("GET /healthz HTTP/1.1\r\nHost: x\r\n\r\n");
        EXPECT_EQ(old.read_answer().status, 200);
    }
    for (const int client : clients) ::close(client);

    EXPECT_EQ(request(server.port(), "GET", "/healthz").status, 200);
}

}  // namespace
}  // namespace pulseline::server::testing
