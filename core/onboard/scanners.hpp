#pragma once

#include <vector>

#include "core/control/scan.hpp"

namespace pulseline::onboard {

/// Port: the laser scanners of a vehicle, as its look-out needs them.
class Scanners {
public:
    virtual ~Scanners() = default;
    /// What they see now, one scan a scanner, always in the same order.
    virtual void scan(std::vector<control::Scan>& scans) = 0;
};

}  // namespace pulseline::onboard
