#pragma once

#include <string>
#include <string_view>

#include "api/vda5050/header.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::server::testing {

/// What vehicle V1 is doing when its message comes.
enum class Situation { kLost, kPlaced, kDriving, kAtStop };

/// The way of a vehicle's text frame through the server without its sockets: decoder, fleet, and
/// the encoders of all that the fleet puts out. V1 has one camera, so that one code gives its pose.
class MessagePath {
public:
    explicit MessagePath(Situation situation);

    /// A state of V1 as it is now, with every field that a vehicle can send.
    std::string state_payload() const;
    /// As it was when it was made.
    void reset();

    struct Outcome {
        bool taken = false;   // by the decoder
        std::string refused;  // else the field it names
        std::string broken;   // what came out of the fleet with a number that is none
    };
    Outcome give(std::string_view frame);
    /// V1 gets an order, and all drive for a second: what a message left behind shows then.
    std::string go_on();

private:
    fleet::testing::World start_;
    std::string snapshot_;
    fleet::testing::World world_;

    void prepare(Situation situation);
    void take(std::string& broken);
};

}  // namespace pulseline::server::testing
