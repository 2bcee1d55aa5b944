#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/vda5050/actions.hpp"
#include "tests/simulation/fleet_judge_plant.hpp"
#include "tests/simulation/fleet_judge_world.hpp"

// The client that orders, and the person who looks after the hall.
namespace pulseline::fleet_judge {
namespace {

constexpr double kAskAgain_s = 5;     // without an answer
constexpr double kPersonEvery_s = 2;  // looks at the dashboard
constexpr double kLifted_m = 0.2;     // brackets above whatever holds a load
constexpr double kCraneEvery_s = 20;
constexpr double kCraneAfter_s = 300;
// What a platform with a load waits for until somebody moves another one.
const std::set<std::string> kWaitsForLoad{"station_has_load", "load_in_the_way"};
// Why an order cannot take a load over or set it down where it got to.
const std::set<std::string> kInVain{"vehicle_loaded", "vehicle_empty", "load_elsewhere",
                                    "support_taken", "brackets_too_low"};

bool is_taking(const std::optional<fleet::LiftMove>& lift) {
    return lift && lift->state == fleet::LiftMove::State::kUnderWay &&
           vda5050::is_transfer(lift->what.type);
}

fleet::StepAction bracket_height(double height_m) {
    return {vda5050::kSetBracketHeight, {{"bracket", std::string("all")}, {"height_m", height_m}}};
}

const plant::Station& home_of(const plant::Plant& plant, const plant::VehicleId& id) {
    return *plant::find_station(plant, plant::find_vehicle(plant, id)->home);
}

}  // namespace

void World::order_some() {
    for (auto& asked : asked_) {
        if (!asked.acknowledged && now_s_ >= asked.again_s) ask(asked);
    }
    if (now_s_ < next_order_s_ || static_cast<int>(asked_.size()) >= wanted_orders_) return;
    next_order_s_ = now_s_ + pick(1, static_cast<int>(2 * 0.8 * end_s_ / wanted_orders_));
    Asked asked;
    auto& order = asked.order;
    const int kind = pick(0, 9);
    if (kind == 0) {
        order.vehicle = platforms_.back();
        if (platforms_.size() > 1) {
            const int last = static_cast<int>(platforms_.size()) - 1;
            order.vehicle = platforms_[static_cast<std::size_t>(pick(0, last))];
        }
    } else if (kind <= 3) {
        any_vehicle(order.vehicle);
    } else {
        order.vehicle_type = plant::VehicleTypeId(chance(0.7) ? "cart" : "carrier");
    }
    const bool platform = std::ranges::find(platforms_, order.vehicle) != platforms_.end();
    for (int left = pick(1, 3); left > 0; --left) {
        std::vector<int> numbers;
        for (const auto& station : plant_.stations) {
            if (!station.vehicle_types.empty()) continue;
            if (platform && station.pose.y_m != home_of(plant_, order.vehicle).pose.y_m) continue;
            numbers.push_back(station.number);
        }
        const int number =
            numbers[static_cast<std::size_t>(pick(0, static_cast<int>(numbers.size()) - 1))];
        const bool twice = !order.steps.empty() && order.steps.back().station_number == number;
        const auto mode =
            free_ && !platform && chance(0.1) ? plant::MotionMode::kFree : plant::MotionMode::kAuto;
        if (!twice) order.steps.push_back({number, mode});
        if (!twice && platform) transfer_at_times(order.vehicle, order.steps);
    }
    order.priority = pick(0, 2);
    order.actor = "client";
    order.idempotency_client = "client";
    order.idempotency_key = "key-" + std::to_string(asked_.size());
    order.body_sha256 = order.idempotency_key;
    asked_.push_back(std::move(asked));
    ask(asked_.back());
}

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

/// An answer counts when it came out of the server, which is after the commit; without one the
/// client asks again with the same key, and at times it does so anyway.
void World::ask(Asked& asked) {
    auto created = fleet_->create(asked.order, now());
    if (!created && created.error().code == Errc::kNeedsPlan) {
        // As the API does it: planned beside the fleet, then asked again.
        auto order = asked.order;
        order.planned_beside =
            previewer_.plan_ahead(fleet_->preview_task(order, now())).has_value();
        created = fleet_->create(order, now());
    }
    const auto servers = servers_;
    settle();
    if (!created) {
        if (created.error().reason.code == "vehicle_silent" ||
            created.error().reason.code == "vehicle_gone") {
            asked.again_s = now_s_ + 10 * kAskAgain_s;
            return;
        }
        // Nobody there to do it now: asked again later; at the end it must have been taken.
        asked.again_s = now_s_ + 10 * kAskAgain_s;
        ++outcome_.faults["order refused: " + created.error().reason.code];
        return;
    }
    asked.again_s = now_s_ + kAskAgain_s;
    if (servers != servers_ || unstored_) return;  // it died over it
    if (chance(0.05)) {
        ++outcome_.faults["answer lost, order asked again"];
        return;
    }
    asked.acknowledged = true;
    asked.id = created->order.id;
}

void World::let_person_act() {
    if (now_s_ < next_person_s_) return;
    next_person_s_ = now_s_ + kPersonEvery_s;
    for (auto& [id, vehicle] : vehicles_) {
        if (unstored_ || now_s_ < stalled_until_s_) return;
        help_vehicle(id, vehicle);
    }
    if (!unstored_ && now_s_ >= stalled_until_s_) help_orders();
    for (const auto& id : platforms_) {
        if (!unstored_ && now_s_ >= stalled_until_s_) work_platform(id);
    }
    if (!unstored_ && now_s_ >= stalled_until_s_ && platforms_.size() > 1) work_crane();
    if (!unstored_ && now_s_ >= stalled_until_s_) keep_papers();
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
        if (!load) return std::nullopt;
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

void World::help_vehicle(const plant::VehicleId& id, Vehicle& vehicle) {
    Watch& watch = watch_[id];
    const auto view = fleet_->vehicle(id, now(), false);  // what the dashboard shows
    const bool lost = !view->pose_known && view->link == fleet::Link::kLive;
    const bool waits =
        view->needs_resume || view->paused || (view->state.paused && view->order.empty());
    if (!(lost || waits)) {
        watch.person_at_s = 0;
        return;
    }
    if (watch.person_at_s == 0) {
        watch.person_at_s = now_s_ + pick(5, 90);
        return;
    }
    const bool down = vehicle.manual || vehicle.broken || vehicle.dead || vehicle.safety_stopped;
    if (now_s_ < watch.person_at_s || down) return;
    watch.person_at_s = now_s_ + 5;
    const bool in_doubt = view->claimed_pose.has_value();
    // It refuses to begin where the server takes it to stand: a person looks before the next try.
    if (view->needs_resume_reason.code == "order_rejected" && vehicle.standing()) {
        static_cast<void>(fleet_->init_position(id, {vehicle.pose()}, "person", now()));
    }
    if (waits && fleet_->resume_fleet({id}, "person", now())) {
        watch.restarted_on_leg = watch.needs_person = false;
    } else if (in_doubt) {
        // It is not where it says; a person walks there and looks.
        if (vehicle.standing()) {
            static_cast<void>(fleet_->init_position(id, {vehicle.pose()}, "person", now()));
        }
    } else if (waits) {
        return;
    } else if (vehicle.standing() && !vehicle.knows_pose()) {
        // No codes below it: the person says where it stands.
        static_cast<void>(fleet_->init_position(id, {vehicle.pose()}, "person", now()));
    }
    settle();
}

void World::help_orders() {
    for (const auto& order : fleet_->orders()) {
        const bool stopped = order.state == fleet::JobState::kInterrupted ||
                             order.state == fleet::JobState::kNotAllowedToStart;
        // Somebody has a reason for a pause; it is over after a while.
        if (!stopped || !chance(0.05)) continue;
        if (kInVain.contains(order.reason.code)) {
            ++outcome_.faults["person: gives up an order, " + order.reason.code];
            static_cast<void>(fleet_->cancel_order(order.id, std::nullopt, "person", now()));
        } else {
            static_cast<void>(fleet_->resume_order(order.id, std::nullopt, "person", now()));
        }
        settle();
        if (unstored_ || now_s_ < stalled_until_s_) return;
    }
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
