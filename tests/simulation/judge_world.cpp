#include "tests/simulation/judge_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pulseline::judge {
namespace {

constexpr double kStep_s = 2;
constexpr std::size_t kMostViolations = 5;

bool meet(const VehicleClass& a, Point at, const VehicleClass& b, Point bt) {
    return std::abs(at.x_m - bt.x_m) < (a.length_m + b.length_m) / 2 &&
           std::abs(at.y_m - bt.y_m) < (a.width_m + b.width_m) / 2;
}

}  // namespace

World::World(std::uint64_t seed, JudgeOptions options)
    : options_(options), random_(seed), plant_(random_plant(random_)), traffic_(true) {
    for (const VehicleClass& c : plant_.classes) {
        graphs_.push_back(c.graph);
        traffic_.add_graph(c.graph);
    }
    for (std::size_t c = 0; c < plant_.classes.size(); ++c) {
        auto resting = plant_.classes[c].resting;
        std::shuffle(resting.begin(), resting.end(), random_);
        for (std::size_t i = 0; i < plant_.classes[c].vehicles; ++i) {
            const std::string name = (c == 0 ? "S" : "P") + std::to_string(i);
            const auto added = traffic_.add_vehicle(
                {name, static_cast<traffic::GraphIndex>(c), resting[i], {}}, now());
            if (!added) violate("no floor for " + name);
            Body body;
            body.of_class = c;
            body.at = body.from = plant_.classes[c].points[resting[i]];
            body.from_place = resting[i];
            bodies_.push_back(std::move(body));
        }
    }
    outcome_.vehicles = static_cast<int>(bodies_.size());
    fault_rate_ = chance(0.1) ? 0 : 0.002 * pick(1, 20);
    make_orders();
}

int World::pick(int low, int high) {
    return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
}

bool World::chance(double probability) {
    return static_cast<double>(random_() >> 11) * 0x1p-53 < probability;
}

const VehicleClass& World::class_of(VehicleIndex v) const {
    return plant_.classes[bodies_[v].of_class];
}

void World::violate(const std::string& what) {
    if (outcome_.violations.size() < kMostViolations) {
        outcome_.violations.push_back("t=" + std::to_string(static_cast<int>(now_s_)) +
                                      " s: " + what);
    }
}

void World::take_grants(VehicleIndex v, MoveNumber upto) {
    Body& body = bodies_[v];
    const auto& plan = traffic_.plan(v);
    MoveNumber known = body.base.empty() ? body.last_reported : body.base.back().number;
    for (MoveNumber n = known + 1; n <= upto; ++n) {
        const auto& move = plan.at(n);
        const bool stop = move.visit != traffic::kNoVisit;
        const double slow = chance(0.1) ? 2.5 : 0.8 + 0.01 * pick(0, 50);
        body.base.push_back(
            {n, class_of(v).points[move.place], move.place, stop, move.duration_s * slow});
        ++outcome_.grants;
        outcome_.digest =
            outcome_.digest * 1099511628211ULL ^
            (static_cast<std::uint64_t>(v) << 40 ^ static_cast<std::uint64_t>(n) << 20 ^
             move.place ^ static_cast<std::uint64_t>(now_s_));
    }
}

void World::drive(VehicleIndex v) {
    Body& body = bodies_[v];
    body.moved = false;
    if (body.dead || now_s_ < body.stands_until_s) return;
    double left_s = kStep_s;
    while (!body.base.empty() && left_s > 0) {
        body.moved = true;
        const Granted& move = body.base.front();
        const double need_s = move.duration_s - body.in_move_s;
        if (need_s > left_s) {
            body.in_move_s += left_s;
            const double share = body.in_move_s / move.duration_s;
            body.at = {body.from.x_m + share * (move.to.x_m - body.from.x_m),
                       body.from.y_m + share * (move.to.y_m - body.from.y_m)};
            return;
        }
        left_s -= need_s;
        arrive(v);
    }
}

void World::arrive(VehicleIndex v) {
    Body& body = bodies_[v];
    const Granted move = body.base.front();
    body.base.pop_front();
    body.at = body.from = move.to;
    body.from_place = move.place;
    body.in_move_s = 0;
    body.last_reported = move.number;
    if (move.stop && body.order) {
        Order& order = orders_[*body.order];
        if (order.done >= order.visits.size() || order.visits[order.done].place != move.place) {
            violate("vehicle " + traffic_.name(v) + " made a stop nobody asked for");
        } else {
            ++order.done;
        }
    }
    // Reports are late, doubled and overtake each other.
    body.reports.emplace_back(now_s_ + (chance(0.3) ? pick(0, 12) : 0), move.number);
    if (chance(0.1)) body.reports.emplace_back(now_s_ + pick(1, 30), move.number);
}

void World::deliver(VehicleIndex v) {
    Body& body = bodies_[v];
    for (std::size_t i = 0; i < body.reports.size();) {
        if (body.reports[i].first > now_s_) {
            ++i;
            continue;
        }
        const MoveNumber number = body.reports[i].second;
        body.reports.erase(body.reports.begin() + static_cast<std::ptrdiff_t>(i));
        if (const auto status = traffic_.passed(v, number, now()); !status) {
            violate("a move that was driven counts as not granted: " + traffic_.name(v));
        }
    }
}

/// Hands traffic's changes to the monitor.
void World::settle() {
    const auto changes = traffic_.take_changes();
    if (changes.empty()) return;
    bool plans = false;
    for (const auto& change : changes) {
        plans |= change.kind == traffic::Change::Kind::kPlan ||
                 change.kind == traffic::Change::Kind::kStand;
    }
    for (const auto& violation : monitor_.apply(changes)) violate(to_string(violation));
    if (!plans) return;
    for (const auto& violation : monitor_.check_all()) violate(to_string(violation));
}

void World::check_bodies() {
    for (VehicleIndex a = 0; a < bodies_.size(); ++a) {
        if (bodies_[a].moved) {
            const TileSet under = floor_at(class_of(a), bodies_[a].at, 0);
            const auto outside = monitor_.check_footprint(a, under);
            if (!outside.empty()) violate(to_string(outside.front()));
        }
        for (VehicleIndex b = a + 1; b < bodies_.size(); ++b) {
            if (!bodies_[a].moved && !bodies_[b].moved) continue;
            if (meet(class_of(a), bodies_[a].at, class_of(b), bodies_[b].at)) {
                violate("bodies meet: " + traffic_.name(a) + ", " + traffic_.name(b));
            }
        }
    }
}

/// Who stands where and why, for a person who looks into a failing seed.
void World::describe() const {
    for (VehicleIndex v = 0; v < bodies_.size(); ++v) {
        const auto& plan = traffic_.plan(v);
        const Body& body = bodies_[v];
        std::printf("%s at (%.1f, %.1f) place %d, passed %u released %u last %u%s%s%s",
                    traffic_.name(v).c_str(), body.at.x_m, body.at.y_m,
                    static_cast<int>(plan.place), plan.passed, plan.released, plan.last(),
                    plan.halted ? ", halted" : "", traffic_.postponed(v) ? ", postponed" : "",
                    body.order ? ", has an order" : "");
        if (body.order) {
            for (const auto& visit : orders_[*body.order].visits) std::printf(" %u", visit.place);
        }
        if (const auto block = traffic_.blocked_by(v)) {
            std::printf(", last refusal: cause %d vehicle %s move %u",
                        static_cast<int>(block->cause), traffic_.name(block->vehicle).c_str(),
                        block->move);
        }
        std::printf("\n");
    }
    for (const auto& wait : traffic_.waits()) {
        std::printf("%s move %u waits for cause %d %s move %u until %.0f\n",
                    traffic_.name(wait.vehicle).c_str(), wait.move,
                    static_cast<int>(wait.block.cause), traffic_.name(wait.block.vehicle).c_str(),
                    wait.block.move, wait.until_s);
    }
}

Outcome World::run() {
    settle();
    const double end_s = options_.disturbed_s + options_.finish_limit_s;
    while (now_s_ < end_s && outcome_.violations.empty()) {
        now_s_ += kStep_s;
        if (disturbed_ && now_s_ >= options_.disturbed_s) end_disturbances();
        for (VehicleIndex v = 0; v < bodies_.size(); ++v) drive(v);
        check_bodies();
        for (VehicleIndex v = 0; v < bodies_.size(); ++v) deliver(v);
        settle();
        finish_orders();
        disturb();
        assign();
        grant();
        if (chance(0.15)) {
            traffic_.improve(now(), 2);
            settle();
        }
        if (!disturbed_ && all_done()) break;
    }
    if (outcome_.violations.empty() && !all_done()) {
        std::string open;
        for (const Order& order : orders_) {
            if (order.done < order.visits.size()) {
                open += " of " + (order.vehicle ? traffic_.name(*order.vehicle) : "nobody");
            }
        }
        violate("tasks do not end:" + open);
        if (options_.verbose) describe();
    }
    for (const auto& violation : monitor_.check_all()) violate(to_string(violation));
    outcome_.end_s = now_s_;
    return outcome_;
}

Outcome judge_seed(std::uint64_t seed, const JudgeOptions& options) {
    return World(seed, options).run();
}

}  // namespace pulseline::judge
