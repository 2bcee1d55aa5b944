#include "core/simulation/machine/parking_gear.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/base/gravity.hpp"
#include "core/simulation/machine/screw.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kFootStiffness_npm = 5e7;
constexpr double kWheelStiffness_npm = 2e7;  // solid tyres with their bearings
constexpr double kFootTouches_n = 1500;      // by which a foot knows that it stands
constexpr double kFootLost_n = 200;          // below, one that stood does so no more
constexpr double kFootFirm_m = 0.005;        // raised so far, all feet have taken their share
constexpr double kFloorNear_m = 0.012;       // of even floor: from here on it is felt for
constexpr double kFeels_mps = 0.002;
constexpr double kFootThere_m = 5e-5;
constexpr double kFootSettle_s = 0.1;
constexpr double kFootNoise = 0.004;      // share, one sigma
constexpr double kFeetInStep_m = 0.0005;  // one that lags by more makes the others wait

}  // namespace

ParkingGear::ParkingGear(const plant::VehicleType& type, FloorUnder floor_under, std::uint64_t seed)
    : parking_(*type.parking),
      cycle_s_(type.control.cycle_s),
      mass_kg_(type.mass_kg),
      floor_under_(std::move(floor_under)),
      random_(seed) {
    assert(!parking_.feet.empty());
    for (const auto& wheel : type.wheels) wheels_.push_back(wheel.position);
    for (std::size_t i = 0; i < parking_.feet.size(); ++i) {
        feet_.push_back(
            {ServoAxis(screw(parking_.rating_n, parking_.speed_mps, type.control), random_()), 0, 0,
             false});
    }
}

void ParkingGear::set_load(double load_kg, geometry::Point2 centre) {
    const bool same = load_kg == load_kg_ && centre == load_centre_;
    load_kg_ = load_kg;
    load_centre_ = centre;
    if (!same && !moving()) settle();
}

bool ParkingGear::dig(const std::string& foot) {
    const auto which = find(foot);
    if (!which) return false;
    feet_[*which].over_pit = true;
    settle();
    return true;
}

bool ParkingGear::carries(std::size_t foot) const {
    return lifted_m_ > 0 && feet_[foot].force_n >= kFootTouches_n;
}

bool ParkingGear::extended() const {
    return std::ranges::any_of(
        feet_, [](const Foot& foot) { return foot.axis.position() > plant::kFootDown_m; });
}

std::optional<std::size_t> ParkingGear::find(const std::string& name) const {
    const auto found = std::ranges::find(parking_.feet, name, &plant::ParkingFoot::name);
    if (found == parking_.feet.end()) return std::nullopt;
    return static_cast<std::size_t>(found - parking_.feet.begin());
}

void ParkingGear::lower(std::optional<std::size_t> foot) {
    alone_ = foot;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
        if (takes_part(i)) feet_[i].touches = false;
    }
    begin(Phase::kFeels);
}

void ParkingGear::raise(std::optional<std::size_t> foot) {
    alone_ = foot;
    begin(foot ? Phase::kRetracts : Phase::kSinks);
}

void ParkingGear::begin(Phase phase) {
    settle();
    for (Foot& foot : feet_) {
        foot.axis.brake();
        foot.axis.preload(foot.force_n);
        foot.commanded_m = foot.axis.measured_position();
    }
    cause_.reset();
    settled_s_ = 0;
    phase_ = phase;
}

void ParkingGear::stop() {
    for (Foot& foot : feet_) foot.axis.brake();
    phase_ = Phase::kStands;
}

void ParkingGear::step(double dt_s) {
    pending_s_ += dt_s;
    for (; pending_s_ >= cycle_s_ - ServoAxis::kRounding_s; pending_s_ -= cycle_s_) {
        if (moving()) cycle();
    }
}

void ParkingGear::cycle() {
    switch (phase_) {
        case Phase::kStands:
            return;
        case Phase::kFeels:
            feel();
            break;
        case Phase::kLifts:
            move_in_step(1);
            break;
        case Phase::kSinks:
            move_in_step(-1);
            break;
        case Phase::kRetracts:
            retract();
            break;
    }
    settle();
    if (!check()) return;
    const bool there = std::ranges::all_of(feet_, [](const Foot& foot) {
        return std::abs(foot.commanded_m - foot.axis.measured_position()) <= kFootThere_m;
    });
    settled_s_ = there ? settled_s_ + cycle_s_ : 0;
    if (settled_s_ >= kFootSettle_s) advance();
}

/// All are where they were sent to: what comes next, or the end.
void ParkingGear::advance() {
    const auto all = [this](auto holds) {
        for (std::size_t i = 0; i < feet_.size(); ++i) {
            if (takes_part(i) && !holds(feet_[i])) return false;
        }
        return true;
    };
    if (phase_ == Phase::kFeels && all([](const Foot& foot) { return foot.touches; })) {
        if (alone_) return stop();
        phase_ = Phase::kLifts;
    } else if (phase_ == Phase::kLifts && lifted_m_ >= parking_.lift_m) {
        stop();
    } else if (phase_ == Phase::kSinks &&
               all([](const Foot& foot) { return foot.force_n < kFootTouches_n; })) {
        phase_ = Phase::kRetracts;
    } else if (phase_ == Phase::kRetracts &&
               all([](const Foot& foot) { return foot.commanded_m == 0; })) {
        stop();
        for (std::size_t i = 0; i < feet_.size(); ++i) {
            if (takes_part(i)) feet_[i].axis.home(0);
        }
        if (!extended()) lifted_m_ = 0;
    }
}

void ParkingGear::move(Foot& foot, double to_m) {
    const double before_m = std::exchange(foot.commanded_m, to_m);
    foot.axis.set_external_force(-foot.force_n);
    foot.axis.cycle(to_m, (to_m - before_m) / cycle_s_);
}

/// Each by itself: the floor is not even.
void ParkingGear::feel() {
    for (std::size_t i = 0; i < feet_.size(); ++i) {
        Foot& foot = feet_[i];
        foot.touches = foot.force_n >= kFootTouches_n;  // another's push may take it off again
        const bool near = foot.commanded_m >= parking_.clearance_m - kFloorNear_m;
        const double speed_mps =
            near ? std::min(kFeels_mps, parking_.speed_mps) : parking_.speed_mps;
        const bool stays = foot.touches || !takes_part(i);
        const double further_m = stays ? 0 : speed_mps * cycle_s_;
        move(foot, std::min(foot.commanded_m + further_m, parking_.stroke_m));
    }
}

/// By the same way, so that what the floor did to the vehicle's slope stays as it is.
void ParkingGear::move_in_step(double sign) {
    const bool in_step = std::ranges::all_of(feet_, [](const Foot& foot) {
        return std::abs(foot.axis.following_error()) <= kFeetInStep_m;
    });
    double way_m = in_step ? parking_.speed_mps / 2 * cycle_s_ : 0;
    if (sign > 0) way_m = std::min(way_m, std::max(0.0, parking_.lift_m - lifted_m_));
    const bool presses =
        std::ranges::any_of(feet_, [](const Foot& foot) { return foot.force_n >= kFootTouches_n; });
    if (sign < 0 && !presses) way_m = 0;
    lifted_m_ += sign * way_m;
    for (Foot& foot : feet_) {
        move(foot, std::clamp(foot.commanded_m + sign * way_m, 0.0, parking_.stroke_m));
    }
}

void ParkingGear::retract() {
    for (std::size_t i = 0; i < feet_.size(); ++i) {
        const double way_m = takes_part(i) ? parking_.speed_mps * cycle_s_ : 0;
        move(feet_[i], std::max(0.0, feet_[i].commanded_m - way_m));
    }
}

std::optional<double> ParkingGear::floor_under(std::size_t foot) const {
    if (feet_[foot].over_pit) return std::nullopt;
    return floor_under_(parking_.feet[foot].position);
}

/// The vehicle on its wheels and on those feet that reach the floor.
void ParkingGear::settle() {
    std::vector<Support> supports;
    for (const geometry::Point2 wheel : wheels_) {
        if (const auto floor_m = floor_under_(wheel))
            supports.push_back({wheel, *floor_m, kWheelStiffness_npm});
    }
    std::vector<std::optional<std::size_t>> of_foot(feet_.size());
    for (std::size_t i = 0; i < feet_.size(); ++i) {
        const auto floor_m = floor_under(i);
        if (!floor_m) continue;
        of_foot[i] = supports.size();
        supports.push_back({parking_.feet[i].position,
                            *floor_m + feet_[i].axis.position() - parking_.clearance_m,
                            kFootStiffness_npm});
    }
    const double mass_kg = mass_kg_ + load_kg_;
    const auto centre = (load_kg_ / mass_kg) * load_centre_;  // the vehicle's own is its origin
    const auto rest = rest_on(supports, mass_kg * kGravity_mps2, centre);
    if (rest) plane_ = rest->plane;
    for (std::size_t i = 0; i < feet_.size(); ++i) {
        feet_[i].force_n = rest && of_foot[i] ? rest->force_n[*of_foot[i]] : 0;
    }
}

/// False: the movement has failed.
bool ParkingGear::check() {
    for (std::size_t i = 0; i < feet_.size(); ++i) {
        Foot& foot = feet_[i];
        const bool at_end = foot.axis.position() >= parking_.stroke_m - kFootThere_m;
        if (phase_ == Phase::kFeels && takes_part(i) && at_end && !foot.touches) {
            const Params where{{"foot", name(i)}, {"extension_m", foot.axis.position()}};
            fail(alone_ ? Reason{"foot_reaches_no_floor", where}
                        : Reason{"foot_without_floor", where},
                 Phase::kSinks);
            return false;
        }
        if (foot.force_n > parking_.rating_n && phase_ != Phase::kSinks) {
            fail({"foot_overloaded",
                  {{"foot", name(i)}, {"force_n", foot.force_n}, {"limit_n", parking_.rating_n}}},
                 Phase::kSinks);
            return false;
        }
        const bool firm = phase_ == Phase::kLifts && lifted_m_ > kFootFirm_m;
        if (firm && foot.force_n < kFootLost_n) {
            fail({"foot_lost_contact", {{"foot", name(i)}}}, Phase::kSinks);
            return false;
        }
    }
    return true;
}

/// What has begun to carry lets down again, in step. One alone has let down nothing: it stays.
void ParkingGear::fail(Reason cause, Phase next) {
    begin(alone_ ? Phase::kStands : next);
    cause_ = std::move(cause);
}

double ParkingGear::force_n(std::size_t foot) {
    std::normal_distribution<double> noise(1, kFootNoise);
    return feet_[foot].force_n * noise(random_);
}

}  // namespace pulseline::simulation
