#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "api/access/access_control.hpp"
#include "core/fleet/state/ports.hpp"
#include "core/plant/plant.hpp"
#include "server/base/options.hpp"

namespace pulseline::server {

/// The whole service in one process: sockets on the thread that calls run(), the fleet and its
/// commits on two more, history reads and password hashing on pools.
class Server {
public:
    /// What outlives the server.
    struct Parts {
        const plant::Plant& plant;
        fleet::Store& store;
        fleet::History& history;
        access::Store& access;
    };

    Server(Options options, Parts parts);
    ~Server();
    Server(const Server&) = delete;
    Server& operator=(const Server&) = delete;

    /// Whether these options may be served at all; touches nothing.
    static Status check(const Options& options);
    /// Loads the state, binds the address and begins to listen; nothing is answered before run().
    Status start();
    /// Serves until stop() was called, all that was asked is committed and the sessions ended; the
    /// latter within two seconds.
    void run();
    /// Thread safety: may be called from any thread.
    void stop();
    /// SIGTERM and SIGINT call stop(), and end the process after eight seconds whatever hangs; a
    /// second one ends it at once.
    void stop_on_signals();

    std::string url() const;
    std::uint16_t port() const;
    std::string tls_fingerprint() const;  // empty without TLS
    api::access::AccessControl& access();

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

extern const char* const kVersion;

}  // namespace pulseline::server
