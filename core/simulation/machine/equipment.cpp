#include "core/simulation/machine/equipment.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <utility>
#include <variant>

#include "core/base/angle.hpp"
#include "core/plant/load_rules.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kBatteryPerMetre = 5e-4;   // per cent
constexpr double kChargePerSecond = 0.028;  // per cent: an hour from empty to full
constexpr double kContact_m = 0.05;
constexpr double kContact_rad = 2 * kPi / 180.0;
constexpr double kFeetDown_m = 0.12;
// At most: an aircraft is set down with care across, and has its weight where it has it along.
constexpr double kLoadAcross_m = 0.025;
constexpr double kLoadAlong_m = 0.5;
// Feet have no force sensors: nothing stops them but their ends.
constexpr LiftParameters kFeet{.stroke_m = 0.15, .speed_mps = 0.02, .accel_mps2 = 0.05};

bool meets(const Pose2& charger, const Pose2& vehicle) {
    return geometry::distance(charger.position(), vehicle.position()) <= kContact_m &&
           std::abs(wrap(charger.heading_rad - vehicle.heading_rad)) <= kContact_rad;
}

/// At the corners of the vehicle (Tang 2020, section 2.1).
std::vector<LiftPlace> foot_places(const plant::VehicleType& type) {
    double x_m = 0;
    double y_m = 0;
    for (const auto& corner : type.footprint) {
        x_m = std::max(x_m, std::abs(corner.x_m));
        y_m = std::max(y_m, std::abs(corner.y_m));
    }
    return {{"front left", {x_m, y_m}},
            {"front right", {x_m, -y_m}},
            {"back left", {-x_m, y_m}},
            {"back right", {-x_m, -y_m}}};
}

LiftingDrive bracket_lifts(const plant::VehicleType& type, double load_kg, std::uint64_t seed) {
    std::vector<LiftPlace> places;
    geometry::Point2 middle;
    const auto count = static_cast<double>(type.brackets.size());
    for (const auto& bracket : type.brackets) {
        places.push_back({bracket.name, bracket.position});
        middle = middle + (1 / count) * bracket.position;
    }
    LiftParameters parameters;
    parameters.most_force_n = plant::bracket_rating_n(type);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(-1, 1);
    const double along_m = kLoadAlong_m * share(random);
    const geometry::Point2 beside{along_m, kLoadAcross_m * share(random)};
    LiftingDrive lifts(std::move(places), parameters, random());
    lifts.set_load(load_kg, middle + beside);
    return lifts;
}

const ParamValue* find(const Params& params, const std::string& name) {
    for (const Param& param : params) {
        if (param.name == name) return &param.value;
    }
    return nullptr;
}

std::optional<double> number(const ParamValue* value) {
    if (value == nullptr) return std::nullopt;
    if (const auto* whole = std::get_if<std::int64_t>(value)) return static_cast<double>(*whole);
    if (const auto* real = std::get_if<double>(value)) return *real;
    return std::nullopt;
}

/// "bracket_force_out_of_range: bracket front left, force_n 81234, limit_n 80000"
std::string sentence(const Reason& reason) {
    std::ostringstream text;
    text << reason.code;
    const char* between = ": ";
    for (const Param& param : reason.params) {
        text << std::exchange(between, ", ") << param.name << ' ';
        if (const auto* name = std::get_if<std::string>(&param.value)) text << *name;
        if (const auto* real = std::get_if<double>(&param.value)) text << *real;
    }
    return text.str();
}

}  // namespace

VehicleEquipment::VehicleEquipment(const plant::VehicleType& type, const Pose2& true_pose,
                                   std::vector<Pose2> chargers, double battery_percent,
                                   double time_factor, double load_kg, std::uint64_t seed)
    : true_pose_(true_pose),
      action_types_{vda5050::kStartCharging, vda5050::kStopCharging},
      chargers_(std::move(chargers)),
      time_factor_(time_factor),
      battery_percent_(battery_percent),
      load_kg_(load_kg) {
    if (type.brackets.empty()) return;
    action_types_.insert(action_types_.end(), {vda5050::kRaiseParking, vda5050::kLowerParking,
                                               vda5050::kSetBracketHeight});
    feet_.emplace(foot_places(type), kFeet, seed);
    brackets_.emplace(bracket_lifts(type, load_kg, seed + 1));
}

std::optional<std::string> VehicleEquipment::begin(const vda5050::Action& action) {
    lifting_ = action.type == vda5050::kSetBracketHeight;
    if (action.type == vda5050::kStopCharging) {
        charging_ = false;
    } else if (action.type == vda5050::kStartCharging) {
        const bool contact = std::any_of(chargers_.begin(), chargers_.end(),
                                         [&](const Pose2& c) { return meets(c, true_pose_); });
        if (!contact) return "noCharger: the contacts of no charger are touched here";
        charging_ = true;
    } else if (lifting_) {
        return begin_bracket(action);
    } else if (auto why_not = feet_->begin(
                   std::nullopt, action.type == vda5050::kLowerParking ? kFeetDown_m : 0)) {
        return sentence(*why_not);
    }
    return std::nullopt;
}

std::optional<std::string> VehicleEquipment::begin_bracket(const vda5050::Action& action) {
    const auto height_m = number(find(action.params, "height_m"));
    const auto* named = find(action.params, "bracket");
    const auto* name = named == nullptr ? nullptr : std::get_if<std::string>(named);
    if (!height_m || name == nullptr) {
        return "bad_parameters: setBracketHeight needs bracket (a name or \"all\") and height_m";
    }
    std::optional<std::size_t> lift;
    if (*name != "all") {
        lift = brackets_->find(*name);
        if (!lift) return "unknown_bracket: there is no bracket " + *name;
    }
    if (const auto why_not = brackets_->begin(lift, *height_m)) return sentence(*why_not);
    return std::nullopt;
}

bool VehicleEquipment::busy() const {
    return (feet_ && feet_->moving()) || (brackets_ && brackets_->moving());
}

std::optional<std::string> VehicleEquipment::failure() const {
    if (!lifting_ || !brackets_->stop_cause()) return std::nullopt;
    return sentence(*brackets_->stop_cause());
}

void VehicleEquipment::abort() {
    if (feet_) feet_->stop();
    if (brackets_) brackets_->stop();
}

void VehicleEquipment::step(double dt_s, double way_m) {
    const double charged = charging_ ? kChargePerSecond * time_factor_ * dt_s : 0;
    battery_percent_ =
        std::clamp(battery_percent_ + charged - kBatteryPerMetre * std::abs(way_m), 0.0, 100.0);
    if (feet_) feet_->step(dt_s * time_factor_);
    if (brackets_) brackets_->step(dt_s * time_factor_);
}

bool VehicleEquipment::holds_vehicle() const {
    return charging_ || busy() || (feet_ && feet_->height_m(0) > 0);
}

std::optional<double> VehicleEquipment::bracket_height_m(const std::string& name) const {
    if (!brackets_) return std::nullopt;
    const auto lift = brackets_->find(name);
    return lift ? std::optional(brackets_->height_m(*lift)) : std::nullopt;
}

void VehicleEquipment::write_state(vda5050::StateMessage& state) {
    state.battery_percent = battery_percent_;
    state.charging = charging_;
    state.load_kg = load_kg_;
    state.parking_feet.clear();
    state.brackets.clear();
    if (!feet_) return;
    for (std::size_t i = 0; i < feet_->places().size(); ++i) {
        state.parking_feet.push_back({feet_->places()[i].name, feet_->height_m(i)});
    }
    for (std::size_t i = 0; i < brackets_->places().size(); ++i) {
        const auto forces = brackets_->forces(i);
        state.brackets.push_back(
            {brackets_->places()[i].name, forces.a_n, forces.b_n, brackets_->height_m(i)});
    }
}

}  // namespace pulseline::simulation
