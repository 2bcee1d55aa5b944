#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/simulation/fleet_judge_plant.hpp"
#include "tests/simulation/fleet_judge_world.hpp"

// The client that orders, and the person who looks after the hall.
namespace pulseline::fleet_judge {
namespace {

constexpr double kAskAgain_s = 5;     // without an answer
constexpr double kPersonEvery_s = 2;  // looks at the dashboard
// Why an order cannot take a load over or set it down where it got to.
const std::set<std::string> kInVain{"vehicle_loaded", "vehicle_empty", "load_elsewhere",
                                    "support_taken", "brackets_too_low"};

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

}  // namespace pulseline::fleet_judge
