#include "core/onboard/load_handling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/gravity.hpp"
#include "core/base/params.hpp"
#include "core/plant/load_rules.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::onboard {
namespace {

constexpr double kStep_m = 0.004;
constexpr double kClear_m = 0.010;   // between the load and what held it, in the end
constexpr double kFeel_mps = 0.002;  // nobody knows yet where the load is
constexpr double kTransfer_mps = 0.004;
constexpr double kLevel_m = 0.001;  // of heights that are the same
constexpr double kNoMore = 0.01;    // of the weight so far: a step has brought nothing

}  // namespace

LoadHandling::LoadHandling(Equipment& machine, const plant::VehicleType& type)
    : machine_(machine), type_(type), action_types_(machine.action_types()) {
    if (type.brackets.empty()) return;
    action_types_.emplace_back(vda5050::kPick);
    action_types_.emplace_back(vda5050::kDrop);
}

LoadHandling::Cells LoadHandling::read_cells() {
    Cells cells;
    std::vector<plant::BracketForce> forces;
    cells.lowest_m = type_.bracket_lift.stroke_m;
    for (const auto& bracket : machine_.brackets()) {
        forces.push_back({bracket.name, bracket.force_a_n + bracket.force_b_n});
        cells.force_n += forces.back().force_n;
        cells.lowest_m = std::min(cells.lowest_m, bracket.height_m.value_or(0));
        cells.highest_m = std::max(cells.highest_m, bracket.height_m.value_or(0));
    }
    cells.feels = plant::load_on(type_, forces).has_value();
    cells.fault = plant::load_fault(type_, forces);
    return cells;
}

std::optional<std::string> LoadHandling::begin(const vda5050::Action& action) {
    transfers_ = vda5050::is_transfer(action.type);
    if (!transfers_) {
        // They would raise or lower the whole below what still hangs.
        const bool feet =
            action.type == vda5050::kLowerParking || action.type == vda5050::kRaiseParking;
        if (feet && half_transferred()) return "load_half_taken";
        return machine_.begin(action);
    }
    failure_.reset();
    moved_ = false;
    if (busy()) return "lifts_moving";
    const Cells cells = read_cells();
    told_kg_ = number_param(action.params, "weight").value_or(0);
    began_m_ = cells.lowest_m;
    before_n_ = 0;
    const bool drops = action.type == vda5050::kDrop;
    if (drops && !cells.feels) return "load_not_felt";
    const bool anew = !begun_;
    if (anew) note_begun(cells, drops);
    if (drops) {
        phase_ = Phase::kSetsDown;
        return std::nullopt;
    }
    begun_->load_kg = told_kg_;
    // Of one that was broken off a part is on the brackets already.
    if (cells.feels) {
        phase_ = Phase::kTakes;
        return std::nullopt;
    }
    if (!move_to(type_.bracket_lift.stroke_m, kFeel_mps)) {
        if (anew) begun_.reset();
        return failure_;
    }
    phase_ = Phase::kFeels;
    return std::nullopt;
}

void LoadHandling::note_begun(const Cells& cells, bool drops) {
    const double measured_kg = cells.force_n / kGravity_mps2;
    begun_.emplace().load_kg = drops && told_kg_ == 0 ? measured_kg : told_kg_;
    lowest_felt_m_.reset();
    if (!cells.feels) begun_->empty_m = cells.highest_m;
    if (drops && plant::weighs_as_known(measured_kg, told_kg_)) begun_->laden_m = cells.lowest_m;
}

std::optional<std::string> LoadHandling::failure() const {
    return transfers_ ? failure_ : machine_.failure();
}

void LoadHandling::abort() {
    machine_.abort();
    phase_ = Phase::kRests;
}

/// False, with the failure: the machine does not.
bool LoadHandling::move_to(double height_m, double speed_mps) {
    vda5050::Action action;
    action.type = vda5050::kSetBracketHeight;
    const double most_m = type_.bracket_lift.stroke_m;
    action.params = {{"bracket", "all"},
                     {"height_m", std::clamp(height_m, 0.0, most_m)},
                     {"speed_mps", std::min(speed_mps, type_.bracket_lift.speed_mps)}};
    auto why_not = machine_.begin(action);
    moved_ = !why_not;
    if (!why_not) return true;
    failure_ = std::move(why_not);
    return false;
}

bool LoadHandling::is_clear(const Cells& cells) const {
    const auto is_at = [&](double height_m) { return cells.highest_m <= height_m + kLevel_m; };
    return is_at(0) || (begun_->empty_m && is_at(*begun_->empty_m)) ||
           (lowest_felt_m_ && is_at(*lowest_felt_m_ - kClear_m));
}

bool LoadHandling::has_all(const Cells& cells) const {
    if (!begun_->laden_m || cells.lowest_m < *begun_->laden_m - kLevel_m) return false;
    return plant::weighs_as_known(cells.force_n / kGravity_mps2, begun_->load_kg);
}

void LoadHandling::note_felt() {
    const Cells cells = read_cells();
    if (!cells.feels) return;
    lowest_felt_m_ = std::min(lowest_felt_m_.value_or(cells.lowest_m), cells.lowest_m);
}

bool LoadHandling::half_transferred() {
    if (!begun_) return false;
    const Cells cells = read_cells();
    return cells.feels ? !has_all(cells) : !is_clear(cells);
}

void LoadHandling::step() {
    const bool moves = machine_.busy();
    const bool came_to_rest = std::exchange(machine_moved_, moves) && !moves;
    if (begun_ && (moves || came_to_rest)) note_felt();
    if (phase_ == Phase::kRests) {
        // Brackets that were lowered by hand have given it back.
        if (came_to_rest && begun_ && !half_transferred()) begun_.reset();
        return;
    }
    if (moves && phase_ != Phase::kFeels) return;
    const Cells cells = read_cells();
    if (moves) {
        if (!cells.feels) return;
        machine_.abort();
        moved_ = false;  // what it was told to break off it has not failed in
        phase_ = Phase::kTakes;
        return;
    }
    if (const auto broken = machine_.failure(); broken && moved_) {
        if (!failure_) failure_ = broken;
        return end();
    }
    switch (phase_) {
        case Phase::kRests:
            return;
        case Phase::kFeels:
            if (cells.feels) return take(cells);
            return give_up({"load_not_felt", {{"height_m", cells.lowest_m}}}, Phase::kGivesBack);
        case Phase::kTakes:
            return take(cells);
        case Phase::kSetsDown:
            return set_down(cells);
        case Phase::kClears: {
            const double measured_kg = cells.force_n / kGravity_mps2;
            if (!plant::weighs_as_known(measured_kg, told_kg_)) {
                return give_up(
                    {"load_differs", {{"load_kg", told_kg_}, {"measured_kg", measured_kg}}},
                    Phase::kGivesBack);
            }
            begun_.reset();
            return end();
        }
        case Phase::kLeaves:
            begun_.reset();
            return end();
        case Phase::kGivesBack:
        case Phase::kTakesBack:
            return end();
    }
}

void LoadHandling::take(const Cells& cells) {
    phase_ = Phase::kTakes;
    if (cells.fault) return give_up(*cells.fault, Phase::kGivesBack);
    const bool all = before_n_ > 0 && cells.force_n - before_n_ < kNoMore * cells.force_n;
    before_n_ = cells.force_n;
    if (all) {
        phase_ = Phase::kClears;
        if (!move_to(cells.lowest_m + kClear_m, kTransfer_mps)) end();
        return;
    }
    if (cells.lowest_m >= type_.bracket_lift.stroke_m - kStep_m / 2) {
        return give_up({"load_not_lifted", {{"height_m", cells.lowest_m}}}, Phase::kGivesBack);
    }
    if (!move_to(cells.lowest_m + kStep_m, kTransfer_mps)) end();
}

void LoadHandling::set_down(const Cells& cells) {
    if (!cells.feels) {
        phase_ = Phase::kLeaves;
        if (!move_to(cells.lowest_m - kClear_m, kTransfer_mps)) end();
        return;
    }
    if (cells.fault) return give_up(*cells.fault, Phase::kTakesBack);
    if (cells.lowest_m <= kStep_m / 2) {
        return give_up({"load_not_taken", {{"height_m", cells.lowest_m}}}, Phase::kTakesBack);
    }
    if (!move_to(cells.lowest_m - kStep_m, kTransfer_mps)) end();
}

void LoadHandling::give_up(Reason why, Phase back) {
    failure_ = sentence_of(why);
    phase_ = back;
    if (!move_to(began_m_, kTransfer_mps)) end();
}

void LoadHandling::end() {
    phase_ = Phase::kRests;
    if (!half_transferred()) begun_.reset();
}

}  // namespace pulseline::onboard
