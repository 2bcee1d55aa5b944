#include <algorithm>
#include <cstdio>
#include <map>
#include <ranges>
#include <set>

#include "core/fleet/vehicle/link.hpp"
#include "core/kinematics/motion.hpp"
#include "tests/simulation/fleet_judge_world.hpp"

// What must hold, whatever goes wrong.
namespace pulseline::fleet_judge {
namespace {

constexpr std::size_t kEventsShown = 60;
constexpr double kStep_s = 0.5;  // two steps of the world and what they round
constexpr double kHeard_s = 3;   // the fleet's own limit is 2 s

bool meet(const Vehicle& a, const Vehicle& b) {
    const double reach = (a.type().length_m() + b.type().length_m()) / 2 + 3;
    if (geometry::distance(a.pose().position(), b.pose().position()) > reach) return false;
    return geometry::intersects(geometry::transformed(a.pose(), a.type().footprint),
                                geometry::transformed(b.pose(), b.type().footprint));
}

std::string text_of(const ParamValue& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
    if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
    if (const auto* number = std::get_if<std::int64_t>(&value)) return std::to_string(*number);
    char buffer[40];
    std::snprintf(buffer, sizeof buffer, "%.17g", std::get<double>(value));
    return buffer;
}

std::string text_of(const Params& params) {
    std::string text;
    for (const auto& param : params) text += " " + param.name + "=" + text_of(param.value);
    return text;
}

std::string text_of(const Pose2& pose) {
    char buffer[100];
    std::snprintf(buffer, sizeof buffer, " (%.17g %.17g %.17g)", pose.x_m, pose.y_m,
                  pose.heading_rad);
    return buffer;
}

std::string text_of(const fleet::Event& event) {
    return std::to_string(event.seq) + " " + std::to_string(to_ns(event.at)) + " " + event.type +
           " " + event.vehicle.str() + " order " + event.order.str() + " leg " + event.leg.str() +
           " " + event.actor + text_of(event.params);
}

}  // namespace

void World::check_bodies() {
    for (auto a = vehicles_.begin(); a != vehicles_.end(); ++a) {
        if (!a->second.moved()) continue;
        for (const auto& [other, body] : vehicles_) {
            if (other == a->first || !meet(a->second, body)) continue;
            violate(a->first.str() + " runs into " + other.str());
        }
    }
}

/// Nothing moves that was restarted on its way and that nobody has allowed to move again, or that
/// stands on its feet; nothing stands or drives beyond the base that the store knows. Feet move at
/// a person's word only.
void World::check_movement() {
    for (const auto& [id, vehicle] : vehicles_) {
        check_lifts(id, vehicle);
        if (!vehicle.moved()) continue;
        if (vehicle.on_feet()) violate(id.str() + " drives on its feet");
        check_load(id, vehicle);
        if (watch_[id].restarted_on_leg) {
            violate(id.str() + " moves after its restart without a person's act");
        }
        const auto& record = store_.vehicles[id];
        const auto& executor = vehicle.executor();
        if (!record.has_leg || record.leg.str() != executor.order_id()) {
            violate(id.str() + " drives " + executor.order_id() + ", the store has " +
                    (record.has_leg ? record.leg.str() : std::string("no leg")));
            continue;
        }
        const auto released = 2 * (static_cast<std::int64_t>(record.leg_data.released_nodes) - 1);
        if (executor.base_end_sequence_id() > released) {
            violate(id.str() + " has a base up to " +
                    std::to_string(executor.base_end_sequence_id()) + ", the store one up to " +
                    std::to_string(released));
        }
    }
}

void World::check_sent(const fleet::VehicleMessage& message) {
    if (options_.trace && message.instant_actions) {
        for (const auto& action : message.instant_actions->actions) {
            std::printf("%9.1f -> %s %s %s\n", now_s_, message.vehicle.str().c_str(),
                        action.type.c_str(), action.id.c_str());
        }
    }
    if (!message.order) return;
    if (options_.trace) {
        std::printf("%9.1f -> %s order %s update %lld from %lld\n", now_s_,
                    message.vehicle.str().c_str(), message.order->order_id.c_str(),
                    static_cast<long long>(message.order->order_update_id),
                    static_cast<long long>(message.order->nodes.front().sequence_id));
    }
    std::int64_t base = 0;
    for (const auto& node : message.order->nodes) {
        if (options_.trace) {
            std::printf("      %s%s %zu actions%s\n", node.node_id.c_str(),
                        node.released ? "" : " horizon", node.actions.size(),
                        text_of(node.pose).c_str());
        }
        if (node.released) base = std::max(base, node.sequence_id);
    }
    check_way(message);
    const auto& record = store_.vehicles[message.vehicle];
    if (record.needs_resume || record.paused || watch_[message.vehicle].needs_person)
        violate(message.vehicle.str() + " is sent an order while it waits for a person");
    auto& known = watch_[message.vehicle].base;
    const auto before = known.find(message.order->order_id);
    const bool extends = before == known.end() || before->second < base;
    if (!extends) return;
    if (!watch_[message.vehicle].told_since_stall)
        violate(message.vehicle.str() + " is given floor and has said nothing since the server " +
                "stood still");
    const std::int64_t base_before = before == known.end() ? 0 : before->second;
    known[message.order->order_id] = base;
    if (base == 0) return;
    check_given_floor(message.vehicle);
    check_true_bodies(message, base_before);
}

/// Nobody is given floor on which the true body of another stands, whatever that one says.
void World::check_true_bodies(const fleet::VehicleMessage& message, std::int64_t base_before) {
    const auto& order = *message.order;
    const std::vector<geometry::Polygon> body{vehicles_.at(message.vehicle).type().footprint};
    for (std::size_t i = 0; i < order.edges.size(); ++i) {
        if (!order.edges[i].released || order.edges[i].sequence_id <= base_before) continue;
        const auto swept = kinematics::sweep(body, {order.edges[i].segment});
        for (const auto& [id, other] : vehicles_) {
            if (id == message.vehicle) continue;
            const auto outline = geometry::transformed(other.pose(), other.type().footprint);
            const bool meets = std::any_of(swept.begin(), swept.end(), [&](const auto& piece) {
                return geometry::intersects(piece, outline);
            });
            if (!meets) continue;
            violate(message.vehicle.str() + " is given floor on which " + id.str() + " stands" +
                    text_of(other.pose()));
        }
    }
}

/// Nobody is told to drive sideways who cannot, as a way with a turn left out would.
void World::check_way(const fleet::VehicleMessage& message) {
    constexpr double kLong_m = 1;  // a short one may make up for where it stands
    const auto& vehicle = *plant::find_vehicle(plant_, message.vehicle);
    const auto& modes = plant::find_vehicle_type(plant_, vehicle.type)->motion_modes;
    if (std::find(modes.begin(), modes.end(), plant::MotionMode::kLateral) != modes.end()) return;
    for (const auto& edge : message.order->edges) {
        const auto& way = edge.segment;
        if (way.kind != kinematics::Segment::Kind::kStraight) continue;
        if (std::abs(way.length_m) < kLong_m || std::abs(std::sin(way.direction_rad)) < 0.3)
            continue;
        violate(message.vehicle.str() + " is told to drive sideways on " + edge.edge_id);
    }
}

/// Nobody gets floor who cannot drive or is not heard, as far as the server had been told when it
/// decided.
void World::check_given_floor(const plant::VehicleId& id) {
    const Watch& watch = watch_[id];
    // Before and after what was heard last: it may have become fit in between.
    if (watch.counted.unfit && watch.told.unfit)
        violate(id.str() + " is given floor and says that it cannot drive");
    if (decided_s_ - watch.told.at_s > kHeard_s)
        violate(id.str() + " is silent and is given floor");
}

void World::note_told(const plant::VehicleId& id, const vda5050::StateMessage& state) {
    auto& told = watch_[id].told;
    told.at_s = now_s_;
    watch_[id].unheard_s = 0;
    watch_[id].told_since_stall = true;
    if (state.header_id <= told.header) return;  // overtaken
    told.header = state.header_id;
    told.unfit = state.operating_mode != "AUTOMATIC" || state.e_stop != "NONE" || state.paused;
    for (const auto& error : state.errors) told.unfit |= error.fatal;
}

/// Only what was not heard while the server listened is silence.
void World::check_link(const fleet::Event& event) {
    const bool lost = std::any_of(event.params.begin(), event.params.end(), [](const auto& param) {
        const auto* to = std::get_if<std::string>(&param.value);
        return param.name == "to" && to && *to == "lost";
    });
    if (lost && watch_[event.vehicle].unheard_s < seconds(fleet::kLostAfter) - kStep_s)
        violate("lost without having been silent: " + text_of(event));
}

void World::check_transition(const fleet::Event& event) {
    if (ended_.contains(event.order)) violate("over before: " + text_of(event));
    for (const auto& param : event.params) {
        const auto* to = std::get_if<std::string>(&param.value);
        if (param.name == "to" && to && (*to == "Ended" || *to == "Aborted"))
            ended_.insert(event.order);
    }
}

/// No vehicle has two orders, be they of these records or of before.
void World::check_one_order_each(const fleet::Records& records) {
    std::map<plant::VehicleId, fleet::JobOrderId> has;
    const auto note = [&](const fleet::JobOrder& order) {
        if (order.assigned_vehicle.empty() || fleet::is_final(order.state)) return;
        const auto [other, fresh] = has.try_emplace(order.assigned_vehicle, order.id);
        if (!fresh && other->second != order.id)
            violate(order.assigned_vehicle.str() + " has the orders " + other->second.str() +
                    " and " + order.id.str());
    };
    std::set<fleet::JobOrderId> told;
    for (const auto& order : std::views::reverse(records.orders)) {
        if (told.insert(order.id).second) note(order);
    }
    for (const auto& [id, order] : store_.orders) {
        if (!told.contains(id)) note(order);
    }
}

void World::check_records(const fleet::Records& records) {
    if (!records.orders.empty()) check_one_order_each(records);
    for (const auto& event : records.events) {
        if (event.seq != last_seq_ + 1) {
            violate("event " + std::to_string(event.seq) + " follows " + std::to_string(last_seq_));
        }
        last_seq_ = event.seq;
        if (event.type == "traffic.violation") violate("traffic: " + text_of(event));
        if (event.type == "job_order.state") check_transition(event);
        if (event.type == "vehicle.link") check_link(event);
        check_making_way(event);
        if (event.type == "load.moved" && !event.order.empty())
            ++outcome_.faults["order: a load moved"];
        if (options_.trace) std::printf("%9.1f %s\n", now_s_, text_of(event).c_str());
    }
    for (const auto& stop : records.stops) {
        if (options_.trace)
            std::printf("   stop by %s method %s\n", stop.vehicle.str().c_str(),
                        stop.method.c_str());
        if (stop.method != "dual_camera") {
            violate("the stop of step " + std::to_string(stop.step) + " of " + stop.order.str() +
                    " was not measured but taken as " + stop.method);
        }
        check_overtaking(stop);
        if (!stop.inside) continue;
        if (!good_stops_.insert({stop.order, stop.step}).second) {
            violate("step " + std::to_string(stop.step) + " of " + stop.order.str() +
                    " was done twice");
        }
    }
    for (const auto& order : records.orders) {
        const auto known = store_.orders.find(order.id);
        if (known != store_.orders.end() && fleet::is_final(known->second.state) &&
            known->second.state != order.state) {
            violate("order " + order.id.str() + " was over and is not any more");
        }
        if (const auto found = vehicles_.find(order.assigned_vehicle); found != vehicles_.end()) {
            const bool other =
                !order.wanted_vehicle.empty() && order.wanted_vehicle != found->first;
            const bool type =
                !order.wanted_type.empty() && order.wanted_type != found->second.type().id;
            if (other || type)
                violate("order " + order.id.str() + " has a vehicle it must not have");
        }
        if (order.state != fleet::JobState::kEnded || order.stop_requested) continue;
        for (std::size_t i = 0; i < order.steps.size(); ++i) {
            if (good_stops_.count({order.id, static_cast<int>(i)}) == 0) {
                violate("order " + order.id.str() + " ended without step " + std::to_string(i));
            }
        }
    }
}

/// Who has read everything since its start knows the stations as they are.
void World::check_shown() {
    for (const auto& is : fleet_->stations()) {
        const auto& was = shown_.at(is.id);
        if (is.occupied_by == was.occupied_by && is.reserved_by == was.reserved_by &&
            is.ready == was.ready && is.last_stop == was.last_stop) {
            continue;
        }
        violate("station " + std::to_string(is.number) + " is shown occupied by '" +
                was.occupied_by.str() + "', reserved by '" + was.reserved_by.str() + "'" +
                (was.ready ? ", ready" : "") + ", and is occupied by '" + is.occupied_by.str() +
                "', reserved by '" + is.reserved_by.str() + "'" + (is.ready ? ", ready" : ""));
    }
}

void World::check_all() {
    const auto every = static_cast<std::int64_t>(now_s_ * 5) % 25 == 0;
    if (!every) return;
    note_patience();
    const auto traffic = fleet_->traffic(now());
    if (traffic.stopped) violate("traffic stopped:" + text_of(traffic.stopped->params));
    for (const auto& asked : asked_) {
        if (asked.acknowledged && store_.orders.count(asked.id) == 0) {
            violate("acknowledged order " + asked.id.str() + " is lost");
        }
    }
    if (store_.orders.size() > asked_.size()) violate("a doubled request made two orders");
}

bool World::all_over() const {
    if (static_cast<int>(asked_.size()) < wanted_orders_) return false;
    const bool taken = std::all_of(asked_.begin(), asked_.end(),
                                   [](const Asked& asked) { return asked.acknowledged; });
    return taken && !unknown_load() &&
           std::all_of(store_.orders.begin(), store_.orders.end(),
                       [](const auto& entry) { return fleet::is_final(entry.second.state); });
}

void World::check_end() {
    if (const auto of = unknown_load())
        violate("a load is elsewhere than the server has it: " + *of);
    for (const auto& asked : asked_) {
        if (!asked.acknowledged) violate("order " + asked.order.idempotency_key + " is not taken");
    }
    for (const auto& [id, order] : store_.orders) {
        if (fleet::is_final(order.state)) continue;
        violate("order " + id.str() + " of " + order.assigned_vehicle.str() + " is still " +
                fleet::to_string(order.state) + ": " + order.reason.code +
                text_of(order.reason.params));
    }
    if (outcome_.violations.empty()) return;
    for (const auto& view : fleet_->vehicles(now())) {
        violate("  " + view.id.str() + (view.leg ? " on leg " + view.leg->id.str() : "") +
                (view.reason ? " " + view.reason->code + text_of(view.reason->params) : "") +
                (view.pose ? text_of(*view.pose) : "") + " at node " +
                std::to_string(view.state.last_node_sequence_id) + " update " +
                std::to_string(view.state.order_update_id) + (view.state.paused ? " paused" : "") +
                (view.claimed_pose ? " claims" + text_of(*view.claimed_pose) : std::string()));
        const auto& leg = store_.vehicles[view.id].leg_data;
        if (view.leg) {
            violate("    leg " + std::to_string(leg.nodes.size()) + " nodes, " +
                    std::to_string(leg.released_nodes) + " released, " +
                    std::to_string(leg.passed_nodes) + " passed, update " +
                    std::to_string(leg.update_id));
        }
    }
    for (const auto& wait : fleet_->traffic(now()).waits) {
        violate("  wait " + wait.vehicle.str() + " for " + wait.waits_for.str() + " " +
                wait.reason.code + text_of(wait.reason.params));
    }
}

void World::violate(const std::string& what) {
    char at[32];
    std::snprintf(at, sizeof at, "at %.1f s: ", now_s_);
    outcome_.violations.push_back(at + what);
    if (outcome_.violations.size() > 1) return;
    const auto& events = store_.events;
    auto& shown = outcome_.last_events;
    for (auto event = events.rbegin(); event != events.rend() && shown.size() < kEventsShown;
         ++event) {
        const bool noise = event->type == "vehicle.link" || event->type == "vehicle.connected";
        if (!noise) shown.push_back(text_of(*event));
    }
    std::reverse(shown.begin(), shown.end());
}

void World::take_in(const std::string& text) {
    for (const char c : text) {
        outcome_.digest = (outcome_.digest ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    }
}

void World::take_in(const fleet::Outputs& out) {
    for (const auto& event : out.records.events) take_in(text_of(event));
    for (const auto& order : out.records.orders) {
        take_in(order.id.str() + fleet::to_string(order.state) + std::to_string(order.revision) +
                order.reason.code + text_of(order.reason.params) +
                std::to_string(order.current_step) + order.assigned_vehicle.str());
    }
    for (const auto& record : out.records.vehicles) {
        take_in(record.id.str() + text_of(record.pose) + record.at_station.str() +
                (record.claim ? text_of(record.claim->pose) : std::string()) + record.leg.str() +
                std::to_string(record.leg_data.released_nodes) +
                std::to_string(record.leg_data.passed_nodes) + (record.needs_resume ? "!" : "."));
    }
    for (const auto& stop : out.records.stops) take_in(stop.id.str() + text_of(stop.measured));
    for (const auto& message : out.messages) {
        take_in(message.vehicle.str());
        if (message.order) {
            take_in(message.order->order_id + std::to_string(message.order->order_update_id));
            for (const auto& node : message.order->nodes) {
                take_in(node.node_id + (node.released ? "+" : "-") + text_of(node.pose));
            }
        }
        if (!message.instant_actions) continue;
        for (const auto& action : message.instant_actions->actions)
            take_in(action.type + action.id);
    }
}

}  // namespace pulseline::fleet_judge
