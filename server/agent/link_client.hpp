#pragma once

#include <memory>
#include <string>

#include "server/agent/options.hpp"
#include "server/agent/vehicle.hpp"
#include "server/base/net.hpp"

namespace pulseline::agent {

/// Keeps one vehicle connected to its server: connects, speaks, comes back after a loss with a
/// jittered delay. When another session took its identity it stays away.
class LinkClient {
public:
    /// Close code of a session replaced by a newer one with the same identity.
    static constexpr std::uint16_t kReplaced = 4409;

    LinkClient(server::net::io_context& io, server::ssl::context& tls, const ServerAddress& address,
               const Identity& identity, bool verify_host, Vehicle& vehicle, std::uint64_t seed);
    ~LinkClient();

    /// Ends when stop() was called or the session was replaced.
    server::net::awaitable<void> run();
    /// Says goodbye and closes.
    void stop();
    bool replaced() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace pulseline::agent
