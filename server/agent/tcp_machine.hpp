#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/onboard/motion/wheel_drive.hpp"
#include "server/agent/machine.hpp"
#include "server/agent/machine_controller.hpp"
#include "server/agent/source_shutter.hpp"

namespace pulseline::agent {

/// A machine behind its controller (MACHINE.md): wheels, brackets, feet, charger and pictures. When
/// it does not answer, its own watchdog brakes; the drive stays stopped (machine_silent) until a
/// person has looked, and the line is taken up again by itself.
class TcpMachine final : public Machine {
public:
    struct Settings {
        double time_factor = 1;  // of a simulated machine
        bool loaded = false;
        localisation::ErrorBudget errors = localisation::ErrorBudget::nominal();
        double watchdog_s = machine::Hello{}.watchdog_s;  // silent for longer: the machine brakes
        PictureSources sources = {};  // of cameras that the machine takes no pictures of
    };

    /// `type`: with its cameras as they hang under its load; must outlive it. Errors: those of
    /// MachineController::reach.
    static Result<std::unique_ptr<TcpMachine>> open(const MachineAddress& address,
                                                    const plant::VehicleType& type,
                                                    Settings settings);
    ~TcpMachine() override;

    onboard::Drive& drive() override;
    Cameras& cameras() override;
    onboard::Equipment& equipment() override;
    onboard::Scanners* scanners() override;
    onboard::Receivers* receivers() override { return nullptr; }
    onboard::NavigationScanner* navigation_scanner() override { return nullptr; }
    void step(double dt_s) override;
    void write_state(vda5050::StateMessage& state) override;
    /// Of its set points, the newest.
    std::uint32_t cycle() const;

private:
    class TcpWheels;
    class TcpEquipment;
    class TcpShutter;
    class TcpScanners;

    TcpMachine(std::unique_ptr<MachineController> controller, const plant::VehicleType& type,
               Settings settings);

    const plant::VehicleType& type_;
    std::unique_ptr<MachineController> controller_;
    std::unique_ptr<TcpWheels> wheels_;
    std::unique_ptr<TcpEquipment> equipment_;
    std::unique_ptr<TcpShutter> own_shutter_;
    SourceShutter shutter_;
    std::unique_ptr<TcpScanners> scanners_;  // of a type that has some
    onboard::WheelDrive drive_;
    PictureCameras cameras_;
};

}  // namespace pulseline::agent
