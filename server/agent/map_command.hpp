#pragma once

namespace pulseline::agent {

/// `pulseline-agent map`: a vehicle of the simulated world drives along the lanes of a hall and
/// writes the map that its scanners make of it. Returns the exit code.
int map_command(int argc, char** argv);

}  // namespace pulseline::agent
