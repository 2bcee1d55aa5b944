#include <gtest/gtest.h>

#include <filesystem>

#include "server/base/net.hpp"
#include "server/base/server_clock.hpp"
#include "server/base/tls.hpp"
#include "tests/server/tcp_client.hpp"
#include "tests/server/test_server.hpp"

namespace pulseline::server::testing {
namespace {

std::string get_over_tls(std::uint16_t port, const std::string& path) {
    net::io_context io;
    ssl::context context(ssl::context::tls_client);
    ssl::stream<tcp::socket> stream(io, context);
    stream.next_layer().connect({net::ip::address_v4::loopback(), port});
    stream.handshake(ssl::stream_base::client);
    net::write(stream,
               net::buffer("GET " + path + " HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"));
    std::string answer;
    std::array<char, 4096> chunk{};
    error_code ec;
    while (!ec) {
        const auto n = stream.read_some(net::buffer(chunk), ec);
        answer.append(chunk.data(), n);
    }
    return answer;
}

TEST(Tls, ServesEncryptedWithACertificateOfItsOwnThatStays) {
    const auto directory =
        std::filesystem::temp_directory_path() / ("pulseline-tls-" + std::to_string(::getpid()));
    std::filesystem::create_directories(directory);
    Options options;
    options.database = (directory / "p.db").string();
    options.tls_self_signed = true;

    std::string first;
    {
        TestServer server(options);
        first = server.server().tls_fingerprint();
        const auto answer = get_over_tls(server.port(), "/healthz");
        EXPECT_EQ(answer.rfind("HTTP/1.1 200", 0), 0U) << answer;
        EXPECT_NE(answer.find("Strict-Transport-Security"), std::string::npos);
        // Plain HTTP on the same port gets no answer.
        EXPECT_EQ(request(server.port(), "GET", "/healthz").status, 0);
    }
    TestServer again(options);

    EXPECT_EQ(first.size(), 95U);
    EXPECT_EQ(again.server().tls_fingerprint(), first);
    const auto key = std::filesystem::status(options.database + ".tls.pem").permissions();
    EXPECT_EQ(key, std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
    std::filesystem::remove_all(directory);
}

TEST(Tls, ACertificateMadeByAWrongClockIsGoodByARightOne) {
    const std::int64_t right_s = to_ns(ServerClock::built()) / 1'000'000'000 + 24 * 3600;
    for (const std::int64_t clock_s : {std::int64_t{600}, right_s - 3600, right_s + 365L * 86400}) {
        const Validity validity = self_signed_validity(clock_s);
        EXPECT_LT(validity.from_s, right_s) << clock_s;
        EXPECT_GT(validity.until_s, right_s + 2L * 365 * 86400) << clock_s;
    }
}

TEST(Tls, NamesTheFileThatIsNoCertificate) {
    static const plant::Plant plant = small_plant();
    MemoryStore store;
    MemoryAccess access;
    Options options;
    options.listen = "127.0.0.1:0";
    options.tls_cert = "/nonexistent/cert.pem";
    options.tls_key = "/nonexistent/key.pem";
    Server server(options, {plant, store, store, access});

    const auto started = server.start();

    ASSERT_FALSE(started);
    EXPECT_NE(started.error().what.find("/nonexistent/cert.pem"), std::string::npos);
}

}  // namespace
}  // namespace pulseline::server::testing
