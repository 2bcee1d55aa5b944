#pragma once

#include <optional>
#include <vector>

#include "core/localisation/reflector_sights.hpp"

namespace pulseline::onboard {

/// Port: the laser scanner that looks all round for reflectors.
class NavigationScanner {
public:
    virtual ~NavigationScanner() = default;
    /// Time passes by `own_s`, of the vehicle's own time. The bright rays of the turn that has
    /// ended since the last call; nothing: none has.
    virtual std::optional<std::vector<localisation::BrightEcho>> take_turn(double own_s) = 0;
};

}  // namespace pulseline::onboard
