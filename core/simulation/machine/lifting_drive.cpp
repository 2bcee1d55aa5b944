#include "core/simulation/machine/lifting_drive.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/base/gravity.hpp"
#include "core/simulation/machine/resting_body.hpp"
#include "core/simulation/machine/screw.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kLevel_m = 1e-7;  // heights that count as the same
constexpr double kLiftThere_m = 1e-4;
constexpr double kLiftSettle_s = 0.1;

}  // namespace

LiftingDrive::LiftingDrive(std::vector<LiftPlace> places, const LiftParameters& parameters,
                           std::uint64_t seed)
    : places_(std::move(places)), parameters_(parameters), random_(seed) {
    assert(!places_.empty());
    std::uniform_real_distribution<double> uneven(-parameters_.uneven, parameters_.uneven);
    for (std::size_t i = 0; i < places_.size(); ++i) {
        lifts_.push_back(
            {ServoAxis(screw(parameters_.most_force_n, parameters_.speed_mps, parameters_.control),
                       random_()),
             0, 0, 0, uneven(random_), 0, 0, false});
    }
}

void LiftingDrive::set_load(double load_kg, geometry::Point2 centre) {
    load_kg_ = load_kg;
    centre_ = centre;
    for (Lift& lift : lifts_) lift.axis.set_load(load_kg / static_cast<double>(lifts_.size()));
    share_load();
}

std::optional<std::size_t> LiftingDrive::find(const std::string& name) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
        if (places_[i].name == name) return i;
    }
    return std::nullopt;
}

std::optional<Reason> LiftingDrive::begin(std::optional<std::size_t> lift, double height_m,
                                          std::optional<double> speed_mps) {
    if (moving_) return Reason{"lifts_moving", {}};
    if (!(height_m >= 0 && height_m <= parameters_.stroke_m)) {
        return Reason{"out_of_stroke",
                      {{"height_m", height_m}, {"stroke_m", parameters_.stroke_m}}};
    }
    const double wanted_mps = speed_mps.value_or(parameters_.speed_mps);
    if (!(wanted_mps > 0 && wanted_mps <= parameters_.speed_mps)) {
        return Reason{"out_of_speed",
                      {{"speed_mps", wanted_mps}, {"most_mps", parameters_.speed_mps}}};
    }
    wanted_mps_ = wanted_mps;
    for (std::size_t i = 0; i < lifts_.size(); ++i) {
        lifts_[i].moves = !lift || *lift == i;
        lifts_[i].wanted_m = height_m;
        lifts_[i].axis.brake();
        lifts_[i].axis.preload(lifts_[i].force_n);
        lifts_[i].commanded_m = lifts_[i].axis.measured_position();
    }
    cause_.reset();
    speed_mps_ = settled_s_ = 0;
    moving_ = true;
    return std::nullopt;
}

void LiftingDrive::step(double dt_s) {
    pending_s_ += dt_s;
    for (; pending_s_ >= parameters_.control.cycle_s - ServoAxis::kRounding_s;
         pending_s_ -= parameters_.control.cycle_s) {
        if (moving_) cycle();
    }
}

void LiftingDrive::cycle() {
    double left_m = 0;
    bool in_step = true;
    for (const Lift& lift : lifts_) {
        if (!lift.moves) continue;
        left_m = std::max(left_m, std::abs(lift.wanted_m - lift.commanded_m));
        in_step &= std::abs(lift.axis.following_error()) <= parameters_.in_step_m;
    }
    speed_mps_ =
        in_step ? pace(left_m)
                : std::max(0.0, speed_mps_ - parameters_.accel_mps2 * parameters_.control.cycle_s);
    std::vector<double> before_m;
    for (const Lift& lift : lifts_) before_m.push_back(lift.commanded_m);
    advance(1);
    advance(-1);
    bool there = true;
    for (std::size_t i = 0; i < lifts_.size(); ++i) {
        Lift& lift = lifts_[i];
        if (!lift.moves) continue;
        lift.axis.set_external_force(-lift.force_n);
        lift.axis.cycle(lift.commanded_m,
                        (lift.commanded_m - before_m[i]) / parameters_.control.cycle_s);
        there &= std::abs(lift.wanted_m - lift.axis.measured_position()) <= kLiftThere_m;
    }
    for (Lift& lift : lifts_) lift.last_force_n = lift.force_n;
    share_load();
    check_forces();
    settled_s_ = there ? settled_s_ + parameters_.control.cycle_s : 0;
    if (moving_ && settled_s_ >= kLiftSettle_s) finish();
}

/// Trapezoidal profile: speed of the next cycle with `left_m` to go.
double LiftingDrive::pace(double left_m) const {
    const double step = parameters_.accel_mps2 * parameters_.control.cycle_s;
    const double braking = std::sqrt(step * step + 2 * parameters_.accel_mps2 * left_m) - step;
    return std::min({wanted_mps_, speed_mps_ + step, braking});
}

/// Those that go up (`sign` 1) or down (-1): the hindmost leads, whom it reaches go on with it.
void LiftingDrive::advance(double sign) {
    double hindmost_m = 0;
    bool any = false;
    for (const Lift& lift : lifts_) {
        if (!lift.moves || sign * (lift.wanted_m - lift.commanded_m) <= 0) continue;
        hindmost_m = any ? std::min(hindmost_m, sign * lift.commanded_m) : sign * lift.commanded_m;
        any = true;
    }
    if (!any) return;
    const double front_m = hindmost_m + speed_mps_ * parameters_.control.cycle_s;
    for (Lift& lift : lifts_) {
        if (!lift.moves || sign * (lift.wanted_m - lift.commanded_m) <= 0) continue;
        const double to_m =
            std::min(std::max(sign * lift.commanded_m, front_m), sign * lift.wanted_m);
        lift.commanded_m = sign * to_m;
        if (std::abs(lift.wanted_m - lift.commanded_m) < kLevel_m) lift.commanded_m = lift.wanted_m;
    }
}

void LiftingDrive::share_load() {
    std::vector<Support> supports;
    for (std::size_t i = 0; i < lifts_.size(); ++i) {
        supports.push_back({places_[i].position, lifts_[i].axis.position() + lifts_[i].above_m,
                            parameters_.stiffness_npm});
    }
    const auto rest = rest_on(supports, load_kg_ * kGravity_mps2, centre_);
    for (std::size_t i = 0; i < lifts_.size(); ++i) {
        lifts_[i].force_n = rest ? rest->force_n[i] : 0;
    }
}

void LiftingDrive::check_forces() {
    if (load_kg_ <= 0) return;  // nothing there that could be lost or too heavy
    const double even_n = load_kg_ * kGravity_mps2 / static_cast<double>(lifts_.size());
    const double least_n = parameters_.least_share * even_n;
    for (std::size_t i = 0; i < lifts_.size(); ++i) {
        const double force_n = lifts_[i].force_n;
        const bool above = force_n > parameters_.most_force_n;
        if (!above && force_n >= least_n) continue;
        // A way back into the range stays open.
        const bool worse =
            above ? force_n > lifts_[i].last_force_n : force_n < lifts_[i].last_force_n;
        if (!worse) continue;
        stop();
        cause_ = Reason{"bracket_force_out_of_range",
                        {{"bracket", places_[i].name},
                         {"force_n", force_n},
                         {"limit_n", above ? parameters_.most_force_n : least_n}}};
        return;
    }
}

void LiftingDrive::stop() {
    for (Lift& lift : lifts_) lift.axis.brake();
    moving_ = false;
}

/// The lower limit switch is where heights are counted from.
void LiftingDrive::finish() {
    stop();
    for (Lift& lift : lifts_) {
        if (lift.moves && lift.wanted_m == 0) lift.axis.home(0);
    }
    share_load();
}

LiftingDrive::Forces LiftingDrive::forces(std::size_t lift) {
    std::normal_distribution<double> noise(1, parameters_.sensor_noise);
    const double half_n = lifts_[lift].force_n / 2;
    const double split = lifts_[lift].split;
    const double a_n = half_n * (1 + split) * noise(random_);
    return {a_n, half_n * (1 - split) * noise(random_)};
}

}  // namespace pulseline::simulation
