#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "server/agent/vehicle.hpp"
#include "server/base/net.hpp"

namespace pulseline::agent {

/// The socket of a hand-held control beside the vehicles (`--hand-held PATH`, a Unix socket that
/// only its owner may open). One JSON object a line in each direction, one control at a time:
///   {"do":"take"}  {"do":"drive","vx_mps":0.2,"vy_mps":0,"turn_radps":0}  {"do":"give_back"}
///   {"do":"where"}; with several vehicles also "vehicle":"MAKER/SERIAL".
/// Each is answered by {"ok":true,"operating_mode":...,"standing":...,"pose":{...}} or
/// {"ok":false,"reason":CODE,"why":...}. "drive" holds for HandDrive::kLetGo_s and must be
/// repeated; a control that goes away leaves the vehicle braking and in MANUAL.
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
