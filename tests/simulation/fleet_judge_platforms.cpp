#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/vda5050/actions.hpp"
#include "tests/simulation/fleet_judge_plant.hpp"
#include "tests/simulation/fleet_judge_world.hpp"

// Who works the platforms and their loads, and the crane.
namespace pulseline::fleet_judge {
namespace {

constexpr double kLifted_m = 0.2;  // brackets above whatever holds a load
constexpr double kCraneEvery_s = 20;
constexpr double kCraneAfter_s = 300;
// What a platform with a load waits for until somebody moves another one.
const std::set<std::string> kWaitsForLoad{"station_has_load", "load_in_the_way"};

fleet::StepAction bracket_height(double height_m) {
    return {vda5050::kSetBracketHeight, {{"bracket", std::string("all")}, {"height_m", height_m}}};
}

bool is_taking(const std::optional<fleet::LiftMove>& lift) {
    return lift && lift->state == fleet::LiftMove::State::kUnderWay &&
           vda5050::is_transfer(lift->what.type);
}

}  // namespace

/// Sent for a load where it is now, or to set it down; it may be otherwise when it gets there.
void World::transfer_at_times(const plant::VehicleId& id, std::vector<fleet::NewStep>& steps) {
    if (fleet_judge::pick(foot_random_, 0, 2) != 0) return;
    const auto* there = load_to_take(id);
    bool loaded = fleet_->vehicle(id, now(), false)->carries.has_value();
    for (const auto& step : steps) {
        if (!step.after.empty()) loaded = step.after.front().type == vda5050::kPick;
    }
    if (loaded) {
        steps.back().after = {{vda5050::kDrop, {}}};
    } else if (steps.size() == 1 && there != nullptr) {
        const auto& at = fleet_->load(there->id)->place.station;
        const auto& station = *plant::find_station(plant_, at);
        // In a bay of its row another platform may rest, which could only leave past this one.
        if (station.resting_place && platforms_.size() > 1) return;
        steps = {{station.number}};
        steps.back().after = {{vda5050::kPick, {{"load", there->id.str()}}}};
    }
}

/// One that stands or hangs in the row of the platform; nullptr: none.
const plant::Load* World::load_to_take(const plant::VehicleId& id) {
    std::vector<const plant::Load*> there;
    for (const auto& load : plant_.loads) {
        const auto* at = plant::find_station(plant_, fleet_->load(load.id)->place.station);
        if (at && at->pose.y_m == home_of(plant_, id).pose.y_m) there.push_back(&load);
    }
    if (there.size() < 2) return there.empty() ? nullptr : there.front();
    const int last = static_cast<int>(there.size()) - 1;
    return there[static_cast<std::size_t>(fleet_judge::pick(foot_random_, 0, last))];
}

/// What is to be done about a load that the platform does not carry as the server has it: what was
/// broken off is done again, what has been done meanwhile is said.
std::optional<fleet::StepAction> World::mend_load(const plant::VehicleId& id,
                                                  const fleet::VehicleView& view) {
    const Vehicle& vehicle = vehicles_.at(id);
    if (!view.load.fault) return std::nullopt;
    if (view.load.fault->code == "brackets_raised") return bracket_height(0);
    if (!view.carries) {
        const auto load = vehicle.load();
        if (!load) return bracket_height(0);  // until they are clear of what is on the support
        return fleet::StepAction{vda5050::kPick, {{"load", load->str()}}};
    }
    if (vehicle.load()) return bracket_height(kLifted_m);  // a part of it is on the support yet
    const auto said = fleet_->place_load(view.carries->id, {{}, view.at_station}, "fitter", now());
    if (said) ++outcome_.faults["person: says where the load is"];
    settle();
    return std::nullopt;
}

/// Works a platform where it stands: on its feet and down again, its load taken over and set down.
void World::work_platform(const plant::VehicleId& id) {
    Watch& watch = watch_[id];
    const bool stands_on_them = vehicles_.at(id).on_feet();
    const auto view = fleet_->vehicle(id, now(), false);
    if (disturbed_ && is_taking(view->lift) && fleet_judge::pick(foot_random_, 0, 14) == 0) {
        if (fleet_->stop_lifts(id, "fitter", now())) ++outcome_.faults["person: holds a transfer"];
        settle();
        if (unstored_) return;
    }
    if (now_s_ < watch.next_lift_s) return;
    std::optional<fleet::StepAction> wanted = mend_load(id, *view);
    if (unstored_) return;
    if (!wanted && stands_on_them) wanted = {vda5050::kRaiseParking, {}};
    if (!wanted && disturbed_) {
        const bool parks = fleet_judge::pick(foot_random_, 0, 1) == 0;
        const auto* there = view->carries ? nullptr : load_to_take(id);
        wanted = {vda5050::kLowerParking, {}};
        if (!parks && view->carries) {
            wanted = {vda5050::kDrop, {}};
        } else if (!parks && there != nullptr) {
            wanted = {vda5050::kPick, {{"load", there->id.str()}}};
        } else if (!parks) {
            wanted = bracket_height(kLifted_m);  // nothing hangs in its row to be run into
        }
    }
    if (!wanted) return;
    const auto moves = fleet_->move_lifts(id, *wanted, "fitter", now());
    const bool taken = moves.has_value();
    if (taken) lifts_asked_.insert(moves->lift->action_id);
    if (taken) ++outcome_.faults["person: " + wanted->type];
    const int wait_s = taken ? fleet_judge::pick(foot_random_, 10, 60) : 5;
    watch.next_lift_s = now_s_ + (taken && !stands_on_them ? wait_s : 2 * wait_s);
    settle();
}

/// The crane takes away what stands in the way of platforms with a load for long, which nobody else
/// can, and brings it back later.
void World::work_crane() {
    if (now_s_ < next_crane_s_) return;
    next_crane_s_ = now_s_ + kCraneEvery_s;
    const bool in_vain = std::ranges::any_of(store_.orders, [&](const auto& entry) {
        const auto& [id, order] = entry;
        const auto patience = patience_.find(id);
        if (order.state != fleet::JobState::kRunning || patience == patience_.end()) return false;
        if (kWaitsForLoad.contains(order.reason.code)) return true;
        return order.reason.code == "floor_held" &&
               now_s_ - patience->second.waits_since_s > kCraneAfter_s;
    });
    for (const auto& load : plant_.loads) {
        const auto place = fleet_->load(load.id)->place;
        if (in_vain && !place.station.empty()) {
            move_by_crane(load, place.station, {});
        } else if (disturbed_ && place.station.empty() && place.vehicle.empty()) {
            const int last = static_cast<int>(plant_.stations.size()) - 1;
            const auto& station =
                plant_.stations[static_cast<std::size_t>(fleet_judge::pick(foot_random_, 0, last))];
            if (station.support) move_by_crane(load, {}, station.id);
        }
        if (unstored_ || now_s_ < stalled_until_s_) return;
    }
}

/// Said first, and done when nothing speaks against it; who works the crane sees what is below it.
void World::move_by_crane(const plant::Load& load, const plant::StationId& from,
                          const plant::StationId& to) {
    const auto place_of = [&](const plant::StationId& id) {
        const auto* station = plant::find_station(plant_, id);
        return station ? supports_->above(station->hall, station->pose) : nullptr;
    };
    auto* taken_from = place_of(from);
    auto* brought_to = place_of(to);
    const auto* station = plant::find_station(plant_, from.empty() ? to : from);
    const bool below = std::ranges::any_of(platforms_, [&](const auto& id) {
        const auto& body = vehicles_.at(id);
        return geometry::distance(body.pose().position(), station->pose.position()) <
               body.type().length_m();
    });
    if (below || (taken_from && !taken_from->load) || (brought_to && brought_to->load)) return;
    const auto servers = servers_;
    if (!fleet_->place_load(load.id, {{}, to}, "crane", now())) return;
    settle();
    if (servers != servers_ || unstored_) return;  // said again when it is known to be heard
    ++outcome_.faults[to.empty() ? "crane: takes a load away" : "crane: brings a load"];
    if (taken_from) taken_from->load.reset();
    if (brought_to) brought_to->load = {load.id, load.mass_kg, load.centre};
}

}  // namespace pulseline::fleet_judge
