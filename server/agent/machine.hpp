#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/onboard/drive.hpp"
#include "core/onboard/equipment.hpp"
#include "core/onboard/navigation_scanner.hpp"
#include "core/onboard/receivers.hpp"
#include "core/onboard/scanners.hpp"
#include "core/onboard/stop_sensing.hpp"
#include "core/onboard/way_sensing.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::agent {

/// Port: the cameras of a vehicle, standing and under way, and what people are shown of them.
class Cameras : public onboard::StopSensing, public onboard::WaySensing {
public:
    struct Picture {
        std::string camera;
        std::string jpeg;
    };

    /// Takes new images and reads them.
    virtual void look() = 0;
    virtual const std::vector<vda5050::CameraReading>& readings() const = 0;
    /// The fix of the newest measurement, once.
    virtual std::optional<localisation::PoseFix> take_fix() = 0;
    /// True once after each look.
    virtual bool take_fresh() = 0;
    /// The images of the last look as pictures for people; none where there are none.
    virtual std::vector<Picture> pictures() const = 0;
    /// The vehicle left the place: its readings say nothing any more. Pictures on their way stay.
    virtual void forget() = 0;
};

/// Port: all of a vehicle that is not its program: what drives, lifts, charges and sees. Its parts
/// live as long as it. Thread safety: none. No clock: time passes by step().
class Machine {
public:
    virtual ~Machine() = default;

    virtual onboard::Drive& drive() = 0;
    const onboard::Drive& drive() const { return const_cast<Machine*>(this)->drive(); }
    virtual Cameras& cameras() = 0;
    virtual onboard::Equipment& equipment() = 0;
    // nullptr: it has none.
    virtual onboard::Scanners* scanners() = 0;
    virtual onboard::Receivers* receivers() = 0;
    virtual onboard::NavigationScanner* navigation_scanner() = 0;

    /// All but its drive, which the vehicle's program steps.
    virtual void step(double dt_s) = 0;
    /// What its body reports: wheels, battery, brackets, feet, and what is wrong with them.
    virtual void write_state(vda5050::StateMessage& state) = 0;
};

}  // namespace pulseline::agent
