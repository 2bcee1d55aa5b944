#include "core/simulation/machine/equipment.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <variant>

#include "core/base/angle.hpp"
#include "core/base/params.hpp"
#include "core/plant/load_rules.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::simulation {
namespace {

constexpr double kBatteryPerMetre = 5e-4;   // per cent
constexpr double kChargePerSecond = 0.028;  // per cent: an hour from empty to full
constexpr double kContact_m = 0.05;
constexpr double kContact_rad = 2 * kPi / 180.0;
// At most.
constexpr double kLoadAcross_m = 0.025;
constexpr double kLoadAlong_m = 0.5;
constexpr double kGives_m = 0.02;  // a hoist, from all of the weight to none of it

bool meets(const Pose2& charger, const Pose2& vehicle) {
    return geometry::distance(charger.position(), vehicle.position()) <= kContact_m &&
           std::abs(wrap(charger.heading_rad - vehicle.heading_rad)) <= kContact_rad;
}

/// Where the weight of what lies on the brackets acts: an aircraft is set down with care across,
/// and has its weight where it has it along.
geometry::Point2 load_centre(const plant::VehicleType& type, std::mt19937_64& random) {
    geometry::Point2 middle;
    const auto count = static_cast<double>(type.brackets.size());
    for (const auto& bracket : type.brackets) middle = middle + (1 / count) * bracket.position;
    std::uniform_real_distribution<double> share(-1, 1);
    const double along_m = kLoadAlong_m * share(random);
    return middle + geometry::Point2{along_m, kLoadAcross_m * share(random)};
}

LiftingDrive bracket_lifts(const plant::VehicleType& type, std::mt19937_64& random) {
    std::vector<LiftPlace> places;
    for (const auto& bracket : type.brackets) places.push_back({bracket.name, bracket.position});
    LiftParameters parameters;
    parameters.most_force_n = plant::bracket_rating_n(type);
    parameters.stroke_m = type.bracket_lift.stroke_m;
    parameters.speed_mps = type.bracket_lift.speed_mps;
    parameters.control = type.control;
    return {std::move(places), parameters, random()};
}

}  // namespace

VehicleEquipment::VehicleEquipment(const plant::VehicleType& type, const Pose2& true_pose,
                                   std::vector<Pose2> chargers, double battery_percent,
                                   double time_factor, double load_kg, std::uint64_t seed,
                                   FloorHeight floor_height)
    : true_pose_(true_pose),
      action_types_{vda5050::kStartCharging, vda5050::kStopCharging},
      chargers_(std::move(chargers)),
      time_factor_(time_factor),
      battery_percent_(battery_percent),
      load_kg_(load_kg) {
    std::mt19937_64 random(seed);
    if (!type.brackets.empty()) {
        action_types_.emplace_back(vda5050::kSetBracketHeight);
        load_centre_ = load_centre(type, random);
        brackets_.emplace(bracket_lifts(type, random));
        brackets_->set_load(load_kg, load_centre_);
        for (const auto& bracket : type.brackets) {
            middle_ =
                middle_ + (1.0 / static_cast<double>(type.brackets.size())) * bracket.position;
        }
    }
    if (!type.parking) return;
    action_types_.insert(action_types_.end(), {vda5050::kRaiseParking, vda5050::kLowerParking});
    feet_.emplace(
        type,
        [&pose = true_pose, height = std::move(floor_height)](geometry::Point2 body) {
            return height(pose * body);
        },
        random());
    feet_->set_load(load_kg, load_centre_);
}

void VehicleEquipment::work_below(std::shared_ptr<Supports> supports, plant::HallId hall,
                                  std::optional<TrueLoad> carried) {
    supports_ = std::move(supports);
    hall_ = std::move(hall);
    carried_ = std::move(carried);
}

/// Brackets that move, by themselves or with all on its feet, below a load that hangs there take it
/// over, and those that carry one set it down on what is free, as they go through its height.
void VehicleEquipment::meet_support() {
    support_ = supports_ ? supports_->above(hall_, true_pose_) : nullptr;
    if (support_ == nullptr || !brackets_) return;
    const bool sets_down = carried_ && !support_->load && mean_height_m() >= support_->height_m;
    if (sets_down) support_->load = carried_;
    const bool takes_over = support_->load && (!carried_ || carried_->id == support_->load->id);
    if (!takes_over) support_ = nullptr;
}

/// A hoist gives as its load becomes lighter, and stands spring back.
void VehicleEquipment::share_with_support() {
    if (support_ == nullptr) return;
    const TrueLoad& load = *support_->load;
    const double share = std::clamp((mean_height_m() - support_->height_m) / kGives_m, 0.0, 1.0);
    load_kg_ = share * load.mass_kg;
    if (!carried_) load_centre_ = middle_ + load.centre;
    carried_.reset();
    if (share > 0) carried_ = load;
    brackets_->set_load(load_kg_, load_centre_);
    if (feet_) feet_->set_load(load_kg_, load_centre_);
    if (busy()) return;
    if (share == 1) support_->load.reset();
    support_ = nullptr;
}

bool VehicleEquipment::displace_bracket(const std::string& name, double by_m) {
    const auto lift = brackets_ ? brackets_->find(name) : std::nullopt;
    if (!lift) return false;
    brackets_->displace(*lift, by_m);
    brackets_->set_load(load_kg_, load_centre_);
    return true;
}

double VehicleEquipment::mean_height_m() const {
    double sum_m = 0;
    for (std::size_t i = 0; i < brackets_->places().size(); ++i) sum_m += brackets_->height_m(i);
    // On its feet the whole is higher.
    const double raised_m = feet_ && feet_->extended() ? std::max(0.0, feet_->plane()[0]) : 0;
    return raised_m + sum_m / static_cast<double>(brackets_->places().size());
}

std::optional<std::string> VehicleEquipment::begin(const vda5050::Action& action) {
    lifting_ = action.type == vda5050::kSetBracketHeight;
    parking_ = action.type == vda5050::kLowerParking || action.type == vda5050::kRaiseParking;
    if (action.type == vda5050::kStopCharging) {
        charging_ = false;
    } else if (action.type == vda5050::kStartCharging) {
        const bool contact = std::any_of(chargers_.begin(), chargers_.end(),
                                         [&](const Pose2& c) { return meets(c, true_pose_); });
        if (!contact) return "noCharger: the contacts of no charger are touched here";
        charging_ = true;
    } else if (lifting_) {
        return begin_bracket(action);
    } else {
        return begin_feet(action);
    }
    return std::nullopt;
}

std::optional<std::string> VehicleEquipment::begin_feet(const vda5050::Action& action) {
    std::optional<std::size_t> foot;
    if (const auto* named = find_param(action.params, "foot")) {
        const auto* name = std::get_if<std::string>(named);
        if (name == nullptr) return "bad_parameters: foot is the name of one, or all";
        if (*name != "all") {
            foot = feet_->find(*name);
            if (!foot) return "unknown_foot: there is no foot " + *name;
        }
    }
    const bool lower = action.type == vda5050::kLowerParking;
    if (!lower && foot && feet_->carries(*foot)) {
        return onboard::sentence_of(Reason{
            "foot_carries", {{"foot", feet_->name(*foot)}, {"force_n", feet_->force_n(*foot)}}});
    }
    lower ? feet_->lower(foot) : feet_->raise(foot);
    meet_support();
    return std::nullopt;
}

std::optional<std::string> VehicleEquipment::begin_bracket(const vda5050::Action& action) {
    const auto height_m = number_param(action.params, "height_m");
    const auto* name = text_param(action.params, "bracket");
    if (!height_m || name == nullptr) {
        return "bad_parameters: setBracketHeight needs bracket (a name or \"all\") and height_m";
    }
    const auto speed_mps = number_param(action.params, "speed_mps");
    if (find_param(action.params, "speed_mps") != nullptr && !speed_mps) {
        return "bad_parameters: speed_mps is a number";
    }
    std::optional<std::size_t> lift;
    if (*name != "all") {
        lift = brackets_->find(*name);
        if (!lift) return "unknown_bracket: there is no bracket " + *name;
    }
    if (const auto why_not = brackets_->begin(lift, *height_m, speed_mps)) {
        return onboard::sentence_of(*why_not);
    }
    meet_support();
    return std::nullopt;
}

bool VehicleEquipment::busy() const {
    return (feet_ && feet_->moving()) || (brackets_ && brackets_->moving());
}

std::optional<std::string> VehicleEquipment::failure() const {
    const std::optional<Reason> none;
    const auto& cause = lifting_ ? brackets_->stop_cause() : parking_ ? feet_->stop_cause() : none;
    return cause ? std::optional(onboard::sentence_of(*cause)) : std::nullopt;
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
    share_with_support();
}

bool VehicleEquipment::holds_vehicle() const {
    return charging_ || busy() || (feet_ && feet_->extended());
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
    for (std::size_t i = 0; feet_ && i < feet_->count(); ++i) {
        state.parking_feet.push_back({feet_->name(i), feet_->extension_m(i), feet_->force_n(i)});
    }
    state.brackets = brackets();
}

std::vector<vda5050::BracketStatus> VehicleEquipment::brackets() {
    std::vector<vda5050::BracketStatus> told;
    for (std::size_t i = 0; brackets_ && i < brackets_->places().size(); ++i) {
        const auto forces = brackets_->forces(i);
        told.push_back(
            {brackets_->places()[i].name, forces.a_n, forces.b_n, brackets_->height_m(i)});
    }
    return told;
}

}  // namespace pulseline::simulation
