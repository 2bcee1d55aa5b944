#include "server/agent/machine_controller.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

using namespace machine;
using namespace std::chrono_literals;
using kinematics::WheelMotion;

constexpr auto kReach = 2s;
constexpr auto kPictureTime = 2s;  // exposed and carried over
constexpr auto kScanTime = 1s;
constexpr double kAgain_s = 1;               // between two tries to reach it
constexpr std::uint32_t kScanCycles = 4;     // between two turns, while somebody looks at them
constexpr std::uint32_t kFreshCycles = 6;    // older than that a turn is waited for
constexpr std::uint32_t kLookedCycles = 50;  // nobody has looked for so long: no more are asked for

Status same_names(const char* part, const std::vector<std::string>& told,
                  const std::vector<std::string>& wanted) {
    if (told == wanted) return {};
    const auto list = [](const std::vector<std::string>& names) {
        std::string text;
        for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
        return text;
    };
    return fail(Errc::kConflict, "machine_not_of_type",
                std::string("The machine has other ") + part + " than its type in the plant: " +
                    list(told) + " instead of " + list(wanted) + ".",
                {}, {{"part", part}, {"told", list(told)}, {"wanted", list(wanted)}});
}

}  // namespace

std::vector<std::string> feet_of(const plant::VehicleType& type) {
    return type.parking ? names_of(type.parking->feet) : std::vector<std::string>{};
}

MachineController::MachineController(MachineAddress address, const plant::VehicleType& type,
                                     double watchdog_s,
                                     const std::vector<std::string>& own_pictures)
    : address_(std::move(address)),
      type_(type),
      watchdog_s_(watchdog_s),
      pictured_(names_of(type.cameras)) {
    for (const auto& camera : own_pictures) std::erase(pictured_, camera);
}

Hello MachineController::hello() const {
    Hello hello;
    hello.cycle_s = type_.control.cycle_s;
    hello.watchdog_s = watchdog_s_;
    for (const auto& axis : plant::axes_of(type_)) {
        hello.axes.push_back({axis.name, axis.position_gain_per_s});
    }
    return hello;
}

/// It may name the cameras that it takes no pictures of, too.
Status MachineController::fits(const Description& told) const {
    if (auto same = same_names("wheels", told.wheels, names_of(type_.wheels)); !same) return same;
    if (auto same = same_names("brackets", told.brackets, names_of(type_.brackets)); !same)
        return same;
    if (auto same = same_names("feet", told.feet, feet_of(type_)); !same) return same;
    const auto all = names_of(type_.cameras);
    const auto& cameras = told.cameras == pictured_ ? pictured_ : all;
    if (auto same = same_names("cameras", told.cameras, cameras); !same) return same;
    return same_names("scanners", told.scanners, names_of(type_.scanners));
}

Status MachineController::reach() {
    const auto parts = std::max({type_.wheels.size(), plant::axes_of(type_).size(),
                                 type_.brackets.size(), type_.scanners.size()});
    if (parts > kMostParts) {
        return fail(Errc::kInvalid, "machine_too_large",
                    "The vehicle's type has more parts of a kind than a machine over TCP can have.",
                    {},
                    {{"parts", static_cast<std::int64_t>(parts)},
                     {"most", static_cast<std::int64_t>(kMostParts)}});
    }
    auto link = MachineLink::open(address_, kReach);
    if (!link) return fail(link.error());
    if (auto sent = link->send(hello()); !sent) return sent;
    auto answer = link->receive(kReach);
    if (!answer) return fail(answer.error());
    if (const auto* refused = std::get_if<Refused>(&*answer)) {
        return fail(Errc::kConflict, "machine_refused",
                    "The machine refuses: " + refused->why + ".", {}, {{"why", refused->why}});
    }
    const auto* description = std::get_if<Description>(&*answer);
    if (description == nullptr) {
        return fail(Errc::kConflict, "machine_refused", "The machine does not say what it is.", {},
                    {{"why", "no description"}});
    }
    if (description->version != kVersion) {
        const auto why = "it speaks version " + std::to_string(description->version);
        return fail(Errc::kConflict, "machine_refused", "The machine refuses: " + why + ".", {},
                    {{"why", why}});
    }
    if (auto fit = fits(*description); !fit) return fit;
    cameras_ = description->cameras;
    dead_cycles_ = description->dead_cycles;
    link_.emplace(std::move(*link));
    exchange(Mode::kBraked, {});
    return lost() ? fail(Errc::kConflict, "machine_silent", "The machine does not answer.")
                  : Status{};
}

void MachineController::exchange(Mode mode, std::span<const WheelMotion> wanted) {
    ++cycles_;
    if (!link_) return;
    SetPoints points;
    points.cycle = ++number_;
    points.mode = mode;
    for (const auto& wheel : wanted) points.wheels.push_back({wheel.speed_mps, wheel.angle_rad});
    if (!say(points)) return;
    // Asked for beforehand, a turn is there when it is looked at, and no cycle waits for it.
    if (looked_at_ && number_ - *looked_at_ < kLookedCycles && number_ % kScanCycles == 0)
        ask_to_look();
    const auto answer_time = std::chrono::duration_cast<MachineLink::Duration>(
        std::chrono::duration<double>(watchdog_s_));
    while (link_) {
        auto frame = hear(answer_time);
        if (!frame) return;
        auto* told = std::get_if<Feedback>(&*frame);
        if (told == nullptr) {
            note(std::move(*frame));
        } else if (told->cycle == number_) {
            return take(std::move(*told));
        }
    }
}

bool MachineController::say(const Frame& frame) {
    if (!link_) return false;
    const auto sent = link_->send(frame);
    if (!sent) lose(sent.error());
    return sent.has_value();
}

Result<Picture> MachineController::expose(const std::string& camera) {
    const std::uint32_t id = ++pictures_;
    const auto number = std::ranges::find(cameras_, camera) - cameras_.begin();
    if (!say(Expose{id, static_cast<std::uint8_t>(number)})) {
        return fail(Errc::kConflict, "machine_silent", "The machine does not answer.");
    }
    for (;;) {
        auto frame = hear(kPictureTime);
        if (!frame) return fail(frame.error());
        auto* picture = std::get_if<Picture>(&*frame);
        if (picture == nullptr) {
            note(std::move(*frame));
        } else if (picture->id == id) {
            return std::move(*picture);
        }
    }
}

const Scans* MachineController::look() {
    looked_at_ = number_;
    if (scans_ && number_ - scans_at_ <= kFreshCycles) return &*scans_;
    const std::uint32_t id = ask_to_look();
    while (link_) {
        auto frame = hear(kScanTime);
        if (!frame) break;
        note(std::move(*frame));
        if (scans_ && scans_->id == id) return &*scans_;
    }
    return nullptr;
}

void MachineController::try_again(double dt_s) {
    since_try_s_ += dt_s;
    if (link_ || since_try_s_ < kAgain_s) return;
    since_try_s_ = 0;
    if (const auto reached = reach(); !reached) {
        link_.reset();
        return;
    }
    server::log::info("machine.reached", {{"host", address_.host}, {"port", address_.port}});
}

int MachineController::take_cycles() { return std::exchange(cycles_, 0); }

std::vector<LiftEnded> MachineController::take_ended() { return std::exchange(ended_, {}); }

Result<Frame> MachineController::hear(MachineLink::Duration timeout) {
    if (!link_) return fail(Errc::kConflict, "machine_silent", "The machine does not answer.");
    auto frame = link_->receive(timeout);
    if (!frame) {
        lose(frame.error());
    } else if (const auto* refused = std::get_if<Refused>(&*frame)) {
        const Error error{Errc::kConflict,
                          {"machine_refused", {{"why", refused->why}}},
                          "The machine refuses: " + refused->why + ".",
                          {}};
        lose(error);
        return fail(error);
    }
    return frame;
}

void MachineController::note(Frame frame) {
    if (auto* ended = std::get_if<LiftEnded>(&frame)) ended_.push_back(std::move(*ended));
    auto* scans = std::get_if<Scans>(&frame);
    if (scans == nullptr) return;
    if (scans->scans.size() != type_.scanners.size()) {
        return lose({Errc::kInvalid,
                     {"machine_frame_broken", {{"why", "scanners are missing"}}},
                     "The machine tells of other scanners than it has.",
                     {}});
    }
    scans_ = std::move(*scans);
    scans_at_ = number_;
}

std::uint32_t MachineController::ask_to_look() {
    say(Look{++looks_});
    return looks_;
}

void MachineController::take(Feedback told) {
    const bool whole = told.wheels.size() == type_.wheels.size() &&
                       told.brackets.size() == type_.brackets.size() &&
                       told.feet.size() == feet_of(type_).size();
    if (whole) {
        told_ = std::move(told);
        return;
    }
    lose({Errc::kInvalid,
          {"machine_frame_broken", {{"why", "parts are missing"}}},
          "The machine tells of other parts than it has.",
          {}});
}

void MachineController::lose(const Error& error) {
    if (!link_) return;
    server::log::error("machine.lost", {{"what", error.what}});
    link_.reset();
    scans_.reset();
    since_try_s_ = 0;
    for (auto& wheel : told_.wheels) wheel.speed_mps = 0;
}

}  // namespace pulseline::agent
