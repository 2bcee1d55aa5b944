#include "tests/simulation/fleet_judge_world.hpp"

#include <algorithm>
#include <utility>

#include "core/onboard/acceptance.hpp"
#include "tests/simulation/fleet_judge_plant.hpp"

namespace pulseline::fleet_judge {
namespace {

constexpr double kTick_s = 0.2;
constexpr double kStall_s = 1;  // of the server: its runtime takes as much for one
constexpr double kStateEvery_s = 1;
constexpr double kDrain_s = 3600;           // at most, after the faults have stopped
constexpr int kRounds = 4;                  // of commits in one tick
constexpr std::uint64_t kFreeEvery = 4;     // so many seeds have vehicles that may leave the lanes
constexpr std::uint64_t kSeveralEvery = 3;  // and several platforms

}  // namespace

Outcome judge_seed(std::uint64_t seed, const Options& options) {
    return World(seed, options).run();
}

World::World(std::uint64_t seed, const Options& options)
    : random_(seed), options_(options), foot_random_(seed), papers_random_(seed) {
    free_ = seed % kFreeEvery == 0;
    plant_ = random_plant(random_, free_, seed % kSeveralEvery == 0);
    supports_ = std::make_shared<simulation::Supports>(plant_, seed);
    for (const auto& vehicle : plant_.vehicles) {
        vehicles_.emplace(std::piecewise_construct, std::forward_as_tuple(vehicle.id),
                          std::forward_as_tuple(plant_, vehicle, supports_, random_()));
        if (vehicles_.at(vehicle.id).type().parking) platforms_.push_back(vehicle.id);
        lines_[vehicle.id];
        watch_[vehicle.id];
    }
    end_s_ = options.hours * 3600;
    wanted_orders_ = std::max(1, static_cast<int>(pick(30, 60) * options.hours));
    // One seed in ten has no faults: it must do as well.
    const bool calm = pick(0, 9) == 0;
    fault_rate_ = calm ? 0 : 1.0 / pick(20, 150);
    bad_line_ = calm || chance(0.3) ? 0 : 0.001 * pick(1, 30);
    disturbed_ = !calm;
    outcome_.vehicles = static_cast<int>(vehicles_.size());
    std::set<plant::VehicleTypeId> classes;
    for (const auto& vehicle : plant_.vehicles) classes.insert(vehicle.type);
    const bool platform = classes.count(plant::VehicleTypeId("platform")) != 0;
    outcome_.classes = platform ? static_cast<int>(classes.size()) : 0;
    if (options.journal) shadow_.emplace(plant_);
    has_dashboards_ = options.journal || seed % 5 == 0;  // views cost more than all the rest
    start_server();
}

int World::pick(int low, int high) { return fleet_judge::pick(random_, low, high); }

Outcome World::run() {
    while (now_s_ < end_s_ && outcome_.violations.empty()) step(kTick_s);
    end_disturbances();
    while (!all_over() && now_s_ < end_s_ + kDrain_s && outcome_.violations.empty()) step(kTick_s);
    if (outcome_.violations.empty()) check_end();
    outcome_.end_s = now_s_;
    if (shadow_) {
        outcome_.inputs = shadow_->inputs;
        outcome_.input_bytes = shadow_->input_bytes;
        outcome_.snapshots = shadow_->snapshots;
        outcome_.snapshot_bytes = shadow_->snapshot_bytes;
    }
    outcome_.orders = static_cast<int>(store_.orders.size());
    for (const auto& [id, order] : store_.orders) {
        outcome_.ended += order.state == fleet::JobState::kEnded ? 1 : 0;
    }
    return std::move(outcome_);
}

void World::step(double dt_s) {
    now_s_ += dt_s;
    if (now_s_ >= stalled_until_s_ && !unstored_) listen(dt_s);
    end_faults();
    if (disturbed_ && chance(fault_rate_ * dt_s)) disturb();
    move_vehicles(dt_s);
    check_bodies();
    check_movement();
    check_place_of_load();
    check_papers();
    if (unstored_) {
        retry_store();
        if (!unstored_ && now_s_ >= stalled_until_s_) listen(dt_s);
    }
    // A stalled or read-only server takes nothing; vehicles go on.
    if (now_s_ >= stalled_until_s_ && !unstored_) {
        settle();  // what was decided before a long command
    }
    if (now_s_ >= stalled_until_s_ && !unstored_) {
        decided_s_ = now_s_;
        carry_messages();
        if (!unstored_) answer_plans();
        if (!unstored_) fleet_->tick(now());
        if (std::exchange(long_command_, false) && !unstored_) {
            ++outcome_.faults["long command"];
            stalled_until_s_ = now_s_ + pick(2, 15);
            return check_all();
        }
        settle();
        if (!unstored_) order_some();
        if (!unstored_) let_person_act();
    }
    check_all();
}

/// After a stall the first tick may come before anything that waits was read.
void World::listen(double dt_s) {
    const double still_s = now_s_ - listened_s_;
    if (still_s > kStall_s) settle();  // what was decided before goes out now
    if (unstored_) return;             // it stands still again
    listened_s_ = now_s_;
    for (auto& [id, watch] : watch_) watch.unheard_s += dt_s;
    if (still_s <= kStall_s) return;
    for (auto& [id, watch] : watch_) watch.told_since_stall = false;
    fleet_->server_stood_still(now() - from_seconds(still_s), now());
    settle();
    if (!unstored_) fleet_->tick(now());
    settle();
}

void World::move_vehicles(double dt_s) {
    for (auto& [id, vehicle] : vehicles_) {
        Line& line = lines_[id];
        if (!line.cut) {
            for (std::size_t i = 0; i < line.down.size();) {
                if (line.down[i].at_s > now_s_) {
                    ++i;
                    continue;
                }
                auto mail = std::move(line.down[i]);
                line.down.erase(line.down.begin() + static_cast<std::ptrdiff_t>(i));
                if (!vehicle.dead) vehicle.receive(mail.content);
            }
        }
        vehicle.step(dt_s);
        const bool due = now_s_ >= line.next_state_s;
        if (vehicle.dead || line.cut || !(vehicle.take_changed() || due)) continue;
        line.next_state_s = now_s_ + kStateEvery_s;
        const auto state = vehicle.state();
        for (int i = copies(); i > 0; --i) line.up.push_back({now_s_ + delay_s(), state});
    }
}

void World::carry_messages() {
    for (auto& [id, line] : lines_) {
        if (line.cut || vehicles_.at(id).dead) continue;
        if (!line.server_knows) {
            line.server_knows = true;
            watch_[id].told = {false, now_s_, 0};
            watch_[id].unheard_s = 0;
            fleet_->vehicle_connected(id, now());
            if (vehicles_.at(id).type().parking) {
                vda5050::Factsheet sheet;
                sheet.node_actions = onboard::stop_action_types();
                if (!vehicles_.at(id).type().brackets.empty())
                    sheet.node_actions.insert(sheet.node_actions.end(),
                                              {vda5050::kPick, vda5050::kDrop});
                sheet.instant_actions = onboard::instant_action_types(vehicles_.at(id).type());
                sheet.actions = sheet.instant_actions;
                fleet_->vehicle_factsheet(id, sheet, now());
            }
        }
        for (std::size_t i = 0; i < line.up.size() && !unstored_;) {
            if (line.up[i].at_s > now_s_) {
                ++i;
                continue;
            }
            auto mail = std::move(line.up[i]);
            line.up.erase(line.up.begin() + static_cast<std::ptrdiff_t>(i));
            note_told(id, mail.content);
            fleet_->vehicle_state(id, mail.content, now());
            // Mostly several reports become one commit, as in the server.
            if (chance(0.1)) settle();
        }
    }
}

void World::start_server() {
    fleet_ = std::make_unique<fleet::Fleet>(plant_, store_.load(), ++servers_, now(),
                                            fleet_ ? fleet_->tables() : nullptr);
    if (!has_dashboards_) fleet_->leave_out_views();
    shown_.clear();  // a dashboard that comes back looks at everything
    for (auto& view : fleet_->stations()) shown_[view.id] = view;
    if (shadow_) shadow_->follow(*fleet_);
    forget_patience();
    for (auto& [id, line] : lines_) {
        line.server_knows = false;
        line.up.clear();
        line.down.clear();
        vehicles_.at(id).lose_link();
        watch_[id].told = watch_[id].counted = {};
        const auto record = store_.vehicles.find(id);
        watch_[id].needs_person |= record != store_.vehicles.end() && record->second.has_leg;
    }
    for (const auto& [id, order] : store_.orders) {
        const bool works = !order.assigned_vehicle.empty() && !fleet::is_final(order.state);
        if (works) watch_[order.assigned_vehicle].needs_person = true;
    }
}

fleet::Outputs World::take_outputs() {
    fleet::Outputs out = fleet_->take_outputs(now());
    for (const auto& view : out.stations) shown_[view.id] = view;
    if (has_dashboards_) check_shown();
    if (!shadow_) return out;
    if (const auto found = shadow_->step(fleet_, out); !found.empty()) violate(found);
    return out;
}

void World::settle() {
    for (int round = 0; round < kRounds && !unstored_; ++round) {
        fleet::Outputs out = take_outputs();
        if (out.records.empty() && out.messages.empty() && out.plans_wanted.empty()) break;
        if (!commit(out)) return;
        send(out);
    }
    for (auto& [id, watch] : watch_) watch.counted = watch.told;
}

/// False: the server died, or the store refused; nothing of it leaves the server.
bool World::commit(fleet::Outputs& out) {
    if (server_crashes_ && !out.records.empty() && chance(0.3)) {
        server_crashes_ = false;
        switch (pick(0, 3)) {
            case 3:
                ++outcome_.faults["store hangs"];
                store_hangs_ = true;
                unstored_ = std::move(out);
                store_back_s_ = now_s_ + pick(1, 60);
                return false;
            case 0:
                crash("server dies before a commit");
                return false;
            case 1:
                check_records(out.records);
                store_.commit(out.records);
                crash("server dies after a commit");
                return false;
            default:
                ++outcome_.faults["commit fails"];
                fail_commit();
                return false;
        }
    }
    check_records(out.records);
    store_.commit(out.records);
    take_in(out);
    return true;
}

void World::fail_commit() {
    start_server();
    fleet_->store_failed({"disk_full", now()}, now());
    unstored_ = take_outputs();
    store_back_s_ = now_s_ + pick(1, 20);
}

void World::retry_store() {
    if (now_s_ < store_back_s_) return;
    const bool hung = std::exchange(store_hangs_, false);
    if (hung && chance(0.5)) return fail_commit();
    fleet::Outputs out = std::move(*unstored_);
    unstored_.reset();
    check_records(out.records);
    store_.commit(out.records);
    take_in(out);
    if (!hung) {  // else it finds out itself that it stood still
        fleet_->store_works_again(now());
        listened_s_ = now_s_;
    }
    send(out);
}

/// What another thread of the server has worked out, for this fleet or for one that is no more.
void World::answer_plans() {
    for (std::size_t i = 0; i < plans_.size() && !unstored_;) {
        if (plans_[i].at_s > now_s_) {
            ++i;
            continue;
        }
        const auto question = std::move(plans_[i].content);
        plans_.erase(plans_.begin() + static_cast<std::ptrdiff_t>(i));
        const auto answer = answerer_.answer(question);
        ++outcome_.faults[answer.plan ? "way planned beside the fleet" : "no free way"];
        fleet_->leg_planned(question.vehicle, question.number, answer, now());
    }
}

void World::send(const fleet::Outputs& out) {
    for (const auto& question : out.plans_wanted) {
        if (disturbed_ && chance(0.05)) {
            ++outcome_.faults["question after a way lost"];
            continue;
        }
        // Tens of milliseconds, or after all that others asked.
        const double late_s = disturbed_ && chance(0.1) ? pick(1, 15) : 0.2 * pick(0, 2);
        plans_.push_back({now_s_ + late_s, question});
    }
    for (const auto& message : out.messages) {
        check_sent(message);
        Line& line = lines_[message.vehicle];
        if (line.cut || !line.server_knows) continue;  // it was for a connection of before
        for (int i = copies(); i > 0; --i) line.down.push_back({now_s_ + delay_s(), message});
    }
}

Vehicle& World::any_vehicle(plant::VehicleId& id) {
    auto it = vehicles_.begin();
    std::advance(it, pick(0, static_cast<int>(vehicles_.size()) - 1));
    id = it->first;
    return it->second;
}

}  // namespace pulseline::fleet_judge
