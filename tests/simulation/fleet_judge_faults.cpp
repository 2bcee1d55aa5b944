#include <algorithm>
#include <cmath>

#include "tests/simulation/fleet_judge_world.hpp"

// What goes wrong in the judge's hall.
namespace pulseline::fleet_judge {
namespace {

constexpr double kPush_m = 0.4;
constexpr int kForGood = 1 << 30;
constexpr double kPushRoom_m = 1.2;  // free floor that a person looks for before pushing

/// Outline of a body grown by the room around it, for a look from afar.
bool near(const Vehicle& a, const Vehicle& b, double room_m) {
    const auto box = [](const Vehicle& v, double grow_m) {
        return geometry::transformed(v.pose(),
                                     geometry::rectangle(v.type().footprint[0].x_m * -2 + grow_m,
                                                         v.type().footprint[0].y_m * -2 + grow_m));
    };
    return geometry::intersects(box(a, room_m), box(b, room_m));
}

}  // namespace

double World::delay_s() {
    // Faster than a tick; late ones are overtaken by those behind them.
    if (!disturbed_ || !chance(bad_line_)) return 0.05;
    ++outcome_.faults["message late, others overtake it"];
    return 0.1 * pick(2, 40);
}

int World::copies() {
    if (!disturbed_ || !chance(bad_line_)) return 1;
    const bool lost = chance(0.5);
    ++outcome_.faults[lost ? "message lost" : "message doubled"];
    return lost ? 0 : 2;
}

void World::disturb() {
    plant::VehicleId id;
    switch (pick(0, 9)) {
        case 0: {
            any_vehicle(id);
            cut_line(id, lines_[id]);
            break;
        }
        case 1:
            server_crashes_ = true;
            break;
        case 2:
            crash("server dies");
            break;
        case 3:
            if (chance(0.4)) {
                long_command_ = true;
                break;
            }
            ++outcome_.faults["server stands still"];
            stalled_until_s_ = now_s_ + pick(1, 30);
            break;
        case 4:
        case 5:
        case 6: {
            Vehicle& vehicle = any_vehicle(id);
            disturb_vehicle(id, vehicle);
            break;
        }
        case 7:
            close_some();
            break;
        default:
            disturb_orders();
            break;
    }
}

void World::cut_line(const plant::VehicleId& id, Line& line) {
    if (line.cut) return;
    ++outcome_.faults["line cut"];
    line.cut = true;
    line.cut_until_s = now_s_ + (chance(0.5) ? pick(1, 5) : pick(5, 120));
    line.up.clear();
    line.down.clear();
    vehicles_.at(id).lose_link();
    // A cable that is pulled says nothing: the server then only hears silence.
    if (line.server_knows && chance(0.5)) fleet_->vehicle_disconnected(id, now());
}

void World::crash(const char* how) {
    if (unstored_) return;
    ++outcome_.faults[how];
    server_crashes_ = false;
    // The clock of the computer may have been set meanwhile; the core's never goes back.
    if (chance(0.3)) {
        ++outcome_.faults["clock step"];
        clock_step_ += from_seconds(chance(0.5) ? pick(-60, 60) : pick(600, 90000));
        if (!store_.events.empty() && now() < store_.events.back().at) {
            clock_step_ += store_.events.back().at - now();
        }
    }
    stalled_until_s_ = now_s_ + pick(0, 15);
    plans_.clear();
    start_server();
}

void World::disturb_vehicle(const plant::VehicleId& id, Vehicle& vehicle) {
    Watch& watch = watch_[id];
    if (vehicle.dead) return;
    switch (pick(0, 8)) {
        case 7:
        case 8:
            misread();
            break;
        case 0:
        case 1:
            ++outcome_.faults["vehicle dies and returns"];
            vehicle.dead = true;
            watch.dead_until_s = now_s_ + pick(1, 180);
            lines_[id].up.clear();
            lines_[id].down.clear();
            if (lines_[id].server_knows && chance(0.5)) {
                fleet_->vehicle_disconnected(id, now());
            }
            break;
        case 2:
            ++outcome_.faults["vehicle switched to manual"];
            vehicle.manual = true;
            watch.manual_until_s = now_s_ + pick(5, 180);
            break;
        case 3:
            ++outcome_.faults["vehicle has a fatal error"];
            vehicle.broken = true;
            watch.broken_until_s = now_s_ + pick(5, 300);
            break;
        case 4:
            pause(id);
            break;
        case 5:
            ++outcome_.faults["safety stop"];
            vehicle.safety_stopped = true;
            watch.safety_until_s = now_s_ + pick(5, 120);
            break;
        default:
            push(id, vehicle);
            break;
    }
}

void World::pause(const plant::VehicleId& id) {
    if (unstored_ || now_s_ < stalled_until_s_) return;
    ++outcome_.faults["vehicle paused by a person"];
    const auto servers = servers_;
    const auto paused = fleet_->pause_vehicle(id, "person", now());
    settle();
    if (paused && servers == servers_ && !unstored_) watch_[id].needs_person = true;
}

/// By hand, a little, where nobody is near, while it stands without an order; the vehicle tells.
void World::push(const plant::VehicleId& id, Vehicle& vehicle) {
    const auto record = store_.vehicles.find(id);
    const bool has_leg = record != store_.vehicles.end() && record->second.has_leg;
    if (vehicle.type().length_m() > 5) return;  // too heavy to be pushed
    if (vehicle.at_work() || has_leg || lines_[id].cut || unstored_) return;
    if (now_s_ < stalled_until_s_ || !lines_[id].server_knows) return;
    for (const auto& [other, body] : vehicles_) {
        if (other != id && near(vehicle, body, 2 * kPushRoom_m)) return;
    }
    const double way = kPush_m * pick(1, 10) / 10.0;
    const double direction = radians(pick(0, 359));
    Pose2 to = vehicle.pose();
    to.x_m += way * std::cos(direction);
    to.y_m += way * std::sin(direction);
    to.heading_rad = wrap(to.heading_rad + radians(pick(-5, 5)));
    vehicle.push(to);
    ++outcome_.faults["vehicle pushed by hand"];
    const auto state = vehicle.state();
    note_told(id, state);
    fleet_->vehicle_state(id, state, now());
    settle();
}

/// A code read wrongly: for one report, for some, or until a person has looked.
void World::misread() {
    const bool driving = chance(0.5);
    std::vector<Vehicle*> some;
    for (auto& [id, one] : vehicles_) {
        if (one.at_work() == driving) some.push_back(&one);
    }
    if (some.empty()) return;
    Vehicle& vehicle = *some[static_cast<std::size_t>(pick(0, static_cast<int>(some.size()) - 1))];
    if (vehicle.dead || !vehicle.knows_pose() || vehicle.misreads()) return;
    const double off_m = 0.5 * pick(1, 40);
    const double direction = radians(pick(0, 359));
    const double turn = chance(0.5) ? 0 : radians(90 * pick(1, 3));
    const int reports = chance(0.3) ? 1 : chance(0.5) ? pick(2, 20) : kForGood;
    vehicle.misread({off_m * std::cos(direction), off_m * std::sin(direction), turn}, reports);
    ++outcome_.faults[vehicle.at_work() ? "wrong pose while driving" : "wrong pose while standing"];
}

void World::disturb_orders() {
    if (unstored_ || now_s_ < stalled_until_s_) return;
    std::vector<fleet::JobOrder> open;
    for (const auto& order : fleet_->orders()) {
        if (!fleet::is_final(order.state)) open.push_back(order);
    }
    if (open.empty()) return;
    const auto& order = open[static_cast<std::size_t>(pick(0, static_cast<int>(open.size()) - 1))];
    if (chance(0.75)) {
        if (fleet_->pause_order(order.id, std::nullopt, "person", now())) {
            ++outcome_.faults["order paused"];
        }
    } else if (fleet_->cancel_order(order.id, std::nullopt, "person", now())) {
        ++outcome_.faults["order cancelled"];
    }
    settle();
}

void World::close_some() {
    if (unstored_ || now_s_ < stalled_until_s_) return;
    fleet::NewClosure wanted;
    wanted.name = "Closure " + std::to_string(outcome_.faults["floor closed"] + 1);
    if (chance(0.5)) {
        const int lane = pick(0, static_cast<int>(plant_.edges.size()) - 1);
        wanted.edges.push_back(plant_.edges[static_cast<std::size_t>(lane)].id);
    } else {
        const int node = pick(0, static_cast<int>(plant_.nodes.size()) - 1);
        const auto at = plant_.nodes[static_cast<std::size_t>(node)].position;
        const double half = 0.5 * pick(1, 6);
        wanted.hall = plant_.halls[0].id;
        wanted.outline = {{at.x_m - half, at.y_m - half},
                          {at.x_m + half, at.y_m - half},
                          {at.x_m + half, at.y_m + half},
                          {at.x_m - half, at.y_m + half}};
    }
    const auto closed = fleet_->close_floor(wanted, "person", now());
    if (!closed) return violate("a closure was refused: " + closed.error().reason.code);
    ++outcome_.faults["floor closed"];
    closed_.push_back({closed->id, now_s_ + pick(30, 600)});
    settle();
}

void World::end_faults() {
    for (auto& [id, vehicle] : vehicles_) {
        Watch& watch = watch_[id];
        Line& line = lines_[id];
        if (line.cut && now_s_ >= line.cut_until_s) {
            line.cut = false;
            line.server_knows = false;
        }
        if (vehicle.manual && now_s_ >= watch.manual_until_s) vehicle.manual = false;
        if (vehicle.safety_stopped && now_s_ >= watch.safety_until_s)
            vehicle.safety_stopped = false;
        if (vehicle.broken && now_s_ >= watch.broken_until_s) vehicle.broken = false;
        if (!vehicle.dead || now_s_ < watch.dead_until_s) continue;
        vehicle.dead = false;
        vehicle.restart();
        line.server_knows = false;
        const auto record = store_.vehicles.find(id);
        watch.restarted_on_leg |= record != store_.vehicles.end() && record->second.has_leg;
    }
    if (unstored_ || now_s_ < stalled_until_s_) return;
    for (std::size_t i = 0; i < closed_.size();) {
        if (now_s_ < closed_[i].until_s) {
            ++i;
            continue;
        }
        // One whose commit was lost is not there any more.
        static_cast<void>(fleet_->reopen_floor(closed_[i].id, "person", now()));
        settle();
        if (unstored_) return;  // whether it is reopened is known when the store answers
        const auto open = fleet_->traffic(now()).closures;
        const bool there = std::any_of(open.begin(), open.end(),
                                       [&](const auto& c) { return c.id == closed_[i].id; });
        if (there) return;  // the server died over it: again at the next tick
        closed_.erase(closed_.begin() + static_cast<std::ptrdiff_t>(i));
    }
}

void World::end_disturbances() {
    disturbed_ = false;
    server_crashes_ = false;
    for (auto& [id, watch] : watch_) {
        watch.dead_until_s = watch.manual_until_s = watch.broken_until_s = now_s_;
        watch.safety_until_s = now_s_;
        lines_[id].cut_until_s = now_s_;
    }
    for (auto& closed : closed_) closed.until_s = now_s_;
}

}  // namespace pulseline::fleet_judge
