#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "server/agent/vehicle.hpp"
#include "server/base/net.hpp"

namespace pulseline::agent {

/// The socket of a hand-held control beside the vehicles (`--hand-held PATH`, a Unix socket that
/// only its owner may open): a command a line, as api/vda5050/hand_held.hpp says, and with several
/// vehicles also "vehicle":"MAKER/SERIAL"; an answer a line. One control at a time. A drive holds
/// for HandDrive::kLetGo_s and must be repeated; a control that goes away leaves the vehicle
/// braking and in MANUAL.
class HandHeldLink {
public:
    /// Fails with socket_not_made {path}; a socket left over by an ended agent is replaced.
    /// `vehicles` must outlive it.
    static Result<std::unique_ptr<HandHeldLink>> open(server::net::io_context& io,
                                                      const std::string& path,
                                                      std::vector<Vehicle*> vehicles);
    ~HandHeldLink();
    HandHeldLink(const HandHeldLink&) = delete;
    HandHeldLink& operator=(const HandHeldLink&) = delete;

    /// Serves until stop().
    server::net::awaitable<void> run();
    void stop();

private:
    struct Impl;
    explicit HandHeldLink(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace pulseline::agent
