#include "server/agent/vehicle.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "server/agent/utc.hpp"
#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;

constexpr auto kMinStateInterval = 50ms;
constexpr auto kStateInterval = 1s;
constexpr auto kVisualizationInterval = 100ms;
constexpr auto kPictureInterval = 500ms;
constexpr auto kSettle = 300ms;
constexpr auto kLookInterval = Vehicle::Steady::duration(2s);
// Pictures of standing vehicles may cost this share of the processor, all together.
constexpr int kLookShare = 10;
constexpr double kRounding = 1e-9;

control::MotionCompensation learned_before(const std::optional<LearnedMoves>& learned) {
    if (!learned) return {};
    auto before = learned->load();
    if (before) return std::move(*before);
    server::log::warn("learned.not_read", {{"what", before.error().what}});
    return {};
}

}  // namespace

Vehicle::Vehicle(const plant::Vehicle& vehicle, const plant::VehicleType& type, Machine& machine,
                 const VehicleSettings& settings)
    : vehicle_(vehicle),
      type_(type),
      settings_(settings),
      machine_(machine),
      drive_(machine.drive()),
      cameras_(machine.cameras()),
      stop_senses_(cameras_),
      handling_(machine.equipment(), type),
      learned_(settings.learned.empty() ? std::nullopt
                                        : std::optional<LearnedMoves>(
                                              std::in_place, settings.learned, vehicle.id.str())),
      executor_(drive_, stop_senses_, settings.hall.str(), &handling_, learned_before(learned_)),
      hands_(executor_),
      estimate_(geometry::Pose2{}, settings.odometry),
      rest_watch_(drive_, estimate_),
      watch_(cameras_, drive_, estimate_),
      headers_(vehicle.manufacturer, vehicle.serial_number),
      look_every_(kLookInterval) {
    if (!settings_.learned.empty()) {
        transfer_file_.emplace(settings_.learned, vehicle.id.str());
        kept_transfer_ = transfer_file_->load();
        if (kept_transfer_) handling_.begun_before(*kept_transfer_);
    }
    loaded_ = type_.brackets.empty() ? settings_.loaded : handling_.carries();
    if (!drive_.wheels().empty()) guard_.emplace(type_, loaded_);
    drive_.set_believed({});  // where it stands it is told, or its codes or receivers say
    if (auto* receivers = machine.receivers()) {
        light_.emplace(*receivers, drive_, estimate_, watch_.trail(), settings.errors.receiver);
        stop_senses_.use(*light_);
    }
    if (auto* scanner = machine.navigation_scanner()) {
        reflectors_.emplace(*scanner, drive_, estimate_, watch_.trail(), settings.errors.reflector);
    }
    if (auto* scanners = machine.scanners()) {
        look_out_.emplace(*scanners, loaded_, drive_);
        executor_.see(look_out_->scans());
        going_round_.emplace(type_, loaded_, drive_, *look_out_, executor_);
        if (settings.map) {
            contours_.emplace(*scanners, drive_, estimate_, watch_.trail(), settings.map,
                              settings.particles_seed);
        }
    }
}

void Vehicle::step(double dt_s, Steady::time_point now) {
    drive(dt_s);
    keep_learned();
    machine_.step(dt_s);
    feel_load();
    if (!drive_.standing()) stood_since_ = now;
    if (cameras_.take_fresh()) {
        pictures_due_ = true;
        state_due_ = true;
        last_look_ = now;
    }
    look_while_standing(now);
    if (executor_.take_factsheet_request()) send_factsheet();
    state_due_ |= executor_.take_changed();
    if (look_out_) state_due_ |= look_out_->take_changed() | going_round_->take_changed();
    if (!linked_) return;
    const auto since = now - last_state_;
    if ((state_due_ && since >= kMinStateInterval) || since >= kStateInterval) send_state(now);
    if (executor_.position_initialized() && now - last_visualization_ >= kVisualizationInterval) {
        last_visualization_ = now;
        send_visualization();
    }
    if (pictures_due_ && now - last_pictures_ >= kPictureInterval) send_pictures(now);
}

/// It looks out and is steered by steps of its own time, however fast that runs.
void Vehicle::drive(double dt_s) {
    for (double left_s = dt_s; left_s > 0;) {
        const double parts = std::ceil(left_s * drive_.time_factor() / most_step_s() - kRounding);
        const double part_s = parts > 1 ? left_s / parts : left_s;
        // Whoever drives it by hand looks out.
        if (look_out_ && !executor_.in_hand()) {
            look_out_->step(part_s);
            going_round_->step(part_s);
        }
        limit_speed();
        executor_.step(part_s);
        know_pose(part_s);
        left_s = parts > 1 ? left_s - part_s : 0;
    }
}

/// Once brackets have come to rest it knows its body anew.
void Vehicle::feel_load() {
    handling_.step();
    keep_transfer();
    const bool rests = std::exchange(lifting_, handling_.busy()) && !lifting_;
    if (!rests || type_.brackets.empty()) return;
    const bool loaded = handling_.carries();
    if (std::exchange(loaded_, loaded) == loaded) return;
    if (guard_) guard_.emplace(type_, loaded);
    if (look_out_) look_out_->carry(loaded);
    if (going_round_) going_round_->carry(loaded);
}

/// In the step in which it begins, before any weight can have come or gone: a program that starts
/// anew has to know of it.
void Vehicle::keep_transfer() {
    if (!transfer_file_ || kept_transfer_ == handling_.begun()) return;
    kept_transfer_ = handling_.begun();
    if (const auto kept = transfer_file_->save(kept_transfer_); !kept) {
        server::log::warn("transfer.not_kept",
                          {{"vehicle", vehicle_.id.str()}, {"what", kept.error().what}});
    }
}

void Vehicle::keep_learned() {
    const bool ended = stopping_ && !executor_.acting();
    stopping_ = executor_.acting();
    if (!ended || !learned_) return;
    if (const auto saved = learned_->save(executor_.compensation()); !saved) {
        server::log::warn("learned.not_kept",
                          {{"vehicle", vehicle_.id.str()}, {"what", saved.error().what}});
    }
}

/// What the cameras see lets the server confirm where the vehicle stands.
void Vehicle::look_while_standing(Steady::time_point now) {
    if (!drive_.standing()) {
        cameras_.forget();
        last_look_ = {};
        return;
    }
    if (!linked_ || executor_.acting() || now - stood_since_ < kSettle) return;
    if (now - last_look_ < look_every_) return;
    const auto begin = Steady::now();
    cameras_.look();
    look_every_ =
        std::max(kLookInterval, kLookShare * settings_.vehicles * (Steady::now() - begin));
    last_look_ = now;
}

}  // namespace pulseline::agent
