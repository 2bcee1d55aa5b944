#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "api/vda5050/hand_held.hpp"
#include "api/vda5050/header.hpp"
#include "core/onboard/executor.hpp"
#include "core/onboard/going_round.hpp"
#include "core/onboard/hand_controls.hpp"
#include "core/onboard/load_handling.hpp"
#include "core/onboard/look_out.hpp"
#include "core/onboard/pose/contour_watch.hpp"
#include "core/onboard/pose/light_watch.hpp"
#include "core/onboard/pose/marker_watch.hpp"
#include "core/onboard/pose/pose_estimate.hpp"
#include "core/onboard/pose/pose_guard.hpp"
#include "core/onboard/pose/reflector_watch.hpp"
#include "core/onboard/pose/rest_watch.hpp"
#include "server/agent/kept_transfer.hpp"
#include "server/agent/learned_moves.hpp"
#include "server/agent/machine.hpp"
#include "server/agent/outbox.hpp"
#include "server/agent/stop_senses.hpp"

namespace pulseline::agent {

/// What a vehicle's program knows beforehand, beside its plant.
struct VehicleSettings {
    plant::HallId hall;
    /// How well its machine drives and sees, as it is stated.
    localisation::ErrorBudget errors;
    localisation::OdometryNoise odometry;
    bool loaded = false;       // at first; one with brackets feels it
    int vehicles = 1;          // in this process: they share one processor for pictures
    std::string learned = {};  // folder for what it learns; empty: forgotten at the end
    std::shared_ptr<const mapping::MatchedMap> map = {};  // of its hall; none: it has none
    std::uint64_t particles_seed = 1;
};

/// The program of one vehicle, which knows its machine by its ports only. Frames come in by
/// receive() and go out through outbox(); time passes by step().
/// Thread safety: none. What it is made of must outlive it.
class Vehicle {
public:
    using Steady = std::chrono::steady_clock;

    /// `type`: with its cameras as they hang under its load.
    Vehicle(const plant::Vehicle& vehicle, const plant::VehicleType& type, Machine& machine,
            const VehicleSettings& settings);

    void step(double dt_s, Steady::time_point now);
    Outbox& outbox() { return outbox_; }
    /// Something has happened that the next state shall tell soon.
    void tell_soon() { state_due_ = true; }
    void link_up();
    void link_down();
    void receive(std::string_view frame);
    /// The message that says goodbye on a clean exit.
    std::string offline_frame();

    /// Does what a hand-held control says, or refuses it as onboard::HandControls does.
    vda5050::HandAnswer hand_held(const onboard::HandControl& control,
                                  const vda5050::HandCommand& command, Steady::time_point now);

    bool standing() const { return drive_.standing(); }

    const plant::Vehicle& plant_vehicle() const { return vehicle_; }

    const plant::VehicleType& type() const { return type_; }
    const onboard::Executor& executor() const { return executor_; }
    const onboard::PoseEstimate& estimate() const { return estimate_; }

private:
    vda5050::StateMessage state();
    void report(const Error& error, const char* topic);
    void send_factsheet();
    /// Leaves out a message that cannot be written, and says so.
    template <class Put>
    void put_whole(Put put);
    void send_state(Steady::time_point now);
    void send_visualization();
    void send_pictures(Steady::time_point now);
    void drive(double dt_s);
    void feel_load();
    void keep_transfer();
    void know_pose(double dt_s);
    void lead_at_rest(double dt_s);
    void log_refused() const;
    void guard_pose(double dt_s);
    void limit_speed();
    double most_step_s() const;
    void write_navigation(vda5050::NavigationStatus& status) const;
    void write_advice(vda5050::StateMessage& state) const;
    bool lacks_pose() const;
    void write_codes(vda5050::StateMessage& state) const;
    void write_light(vda5050::StateMessage& state) const;
    void write_reflectors(vda5050::StateMessage& state) const;
    void look_while_standing(Steady::time_point now);
    void keep_learned();

    const plant::Vehicle& vehicle_;
    const plant::VehicleType& type_;
    VehicleSettings settings_;
    Machine& machine_;
    onboard::Drive& drive_;
    Cameras& cameras_;
    StopSenses stop_senses_;
    onboard::LoadHandling handling_;
    std::optional<LearnedMoves> learned_;
    std::optional<KeptTransfer> transfer_file_;
    std::optional<onboard::BegunTransfer> kept_transfer_;  // as its file has it
    onboard::Executor executor_;
    onboard::HandControls hands_;
    std::optional<onboard::LookOut> look_out_;        // with scanners
    std::optional<onboard::GoingRound> going_round_;  // with a look-out
    onboard::PoseEstimate estimate_;
    std::optional<onboard::PoseGuard> guard_;  // of those that drive by their wheels
    onboard::RestWatch rest_watch_;
    onboard::MarkerWatch watch_;
    std::optional<onboard::LightWatch> light_;           // with receivers
    std::optional<onboard::ReflectorWatch> reflectors_;  // with a navigation scanner
    std::optional<onboard::ContourWatch> contours_;      // with scanners and a map
    vda5050::HeaderSource headers_;
    Outbox outbox_;
    onboard::PoseGuard::Advice advice_ = onboard::PoseGuard::Advice::kDrive;
    bool lost_ = false;      // on its way, and nothing has told it since
    bool loaded_ = false;    // as its brackets feel, or it knows beforehand
    bool lifting_ = false;   // moves brackets or feet
    bool stopping_ = false;  // at a stop, measuring or adjusting
    bool linked_ = false;
    bool state_due_ = true;
    Steady::time_point last_state_{};
    Steady::time_point last_visualization_{};
    Steady::time_point last_look_{};
    Steady::time_point last_pictures_{};
    Steady::time_point stood_since_{};
    Steady::duration look_every_{};
    bool pictures_due_ = false;
};

}  // namespace pulseline::agent
