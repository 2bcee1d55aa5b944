#pragma once

namespace pulseline::agent {

/// `pulseline-agent machine`: the simulated machine of a vehicle behind the protocol of MACHINE.md,
/// for `pulseline-agent --machine`. Returns the exit code.
int machine_command(int argc, char** argv);

}  // namespace pulseline::agent
