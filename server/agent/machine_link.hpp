#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "api/machine/frames.hpp"
#include "core/base/result.hpp"

namespace pulseline::agent {

struct MachineAddress {
    std::string host;
    std::string port;
};
/// "tcp://host:port". Errors: bad_machine.
[[nodiscard]] Result<MachineAddress> parse_machine(const std::string& url);

/// The line to the controller of a machine (MACHINE.md), one cycle after the other: it waits for
/// answers, and never long. Thread safety: none.
class MachineLink {
public:
    using Duration = std::chrono::microseconds;

    /// Errors: machine_not_reached {what}.
    static Result<MachineLink> open(const MachineAddress& address, Duration timeout);
    MachineLink(MachineLink&&) noexcept;
    MachineLink& operator=(MachineLink&&) noexcept;
    ~MachineLink();

    /// Errors: machine_lost {what}.
    Status send(const machine::Frame& frame);
    /// The next frame. Errors: machine_silent, machine_lost {what}, and those of machine::decode.
    Result<machine::Frame> receive(Duration timeout);

private:
    struct Impl;
    explicit MachineLink(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace pulseline::agent
