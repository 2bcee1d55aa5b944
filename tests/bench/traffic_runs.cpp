#include <malloc.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "core/traffic/monitor.hpp"
#include "tests/bench/traffic_world.hpp"

// The joint plan of core/traffic: each vehicle gets a new order as soon as the stop of the last one
// is made, until the time is over; then all that was begun is brought to its end.
namespace pulseline::bench {
namespace {

using traffic::MoveNumber;
using traffic::VehicleIndex;
using Timer = std::chrono::steady_clock;

constexpr double kDrain_s = 6 * 3600;
constexpr MoveNumber kAhead = 2;     // moves granted ahead
constexpr std::size_t kCheck = 200;  // steps between the monitor's full checks

/// CPU time of this thread: the claim is one core, and other programs must not count. Too slow to
/// read for release decisions, which take less than a microsecond.
double cpu_us() {
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) * 1e6 + static_cast<double>(t.tv_nsec) * 1e-3;
}

double us_since(Timer::time_point begin) {
    return std::chrono::duration<double, std::micro>(Timer::now() - begin).count();
}

Time at(double t_s) { return time_from_ns(static_cast<std::int64_t>(t_s * 1e9)); }

class JointRun {
public:
    explicit JointRun(const World& world)
        : world_(world), orders_(world), vehicles_(world.vehicles.size()) {
        for (const auto& graph : world.graphs) traffic_.add_graph(graph);
        for (std::size_t v = 0; v < vehicles_.size(); ++v) {
            const auto& vehicle = world.vehicles[v];
            traffic_.add_vehicle({"V" + std::to_string(v), vehicle.graph, vehicle.start, {}}, at(0))
                .value();
        }
        settle();
    }

    Run run(double seconds, std::uint64_t releases) {
        for (; now_s_ < seconds || run_.releases < releases; now_s_ += world_.step_s) step(true);
        run_.simulated_s = now_s_;
        for (const Vehicle& vehicle : vehicles_) {
            if (vehicle.goal == traffic::kNoPlace) continue;
            run_.longest_order_s = std::max(run_.longest_order_s, now_s_ - vehicle.given_s);
        }
        measure_memory();
        measure_rebuild();
        const Run counted = run_;
        for (; now_s_ < run_.simulated_s + kDrain_s && !at_rest(); now_s_ += world_.step_s) {
            step(false);
        }
        run_.orders = counted.orders;  // those that count for the throughput
        run_.longest_order_s = counted.longest_order_s;
        run_.sum_order_s = counted.sum_order_s;
        run_.drained_s = now_s_ - run_.simulated_s;
        run_.violations += monitor_.check_all().size();
        for (VehicleIndex v = 0; v < vehicles_.size(); ++v) run_.stuck += ended(v) ? 0 : 1;
        return std::move(run_);
    }

private:
    struct Vehicle {
        int busy_steps = 0;  // left of the move under way
        PlaceIndex goal = traffic::kNoPlace;
        bool admitted = false;
        double retry_s = 0;
        double since_s = 0;  // it has this order
        double given_s = 0;  // to the zone
    };

    void step(bool new_orders) {
        // All that end a move now have ended it before anybody is granted floor, or half of those
        // who wait for another would wait a whole step longer.
        for (VehicleIndex v = 0; v < vehicles_.size(); ++v) drive(v);
        for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
            if (new_orders && world_.vehicles[v].busy && vehicles_[v].goal == traffic::kNoPlace) {
                vehicles_[v].goal = orders_.next(v);
                vehicles_[v].since_s = vehicles_[v].given_s = now_s_;
            }
            // As the fleet does it: an idle platform with its load on it stays, others may leave.
            const bool has_order = vehicles_[v].goal != traffic::kNoPlace;
            const bool waits = has_order && !vehicles_[v].admitted;
            const bool loaded = world_.vehicles[v].loaded;
            traffic_.set_leaves(v, waits || (!has_order && loaded) ? traffic::Leaves::kLast
                                   : has_order                     ? traffic::Leaves::kNever
                                                                   : traffic::Leaves::kFirst);
            admit(v);
            release(v);
        }
        settle();
        const double begin_us = cpu_us();
        traffic_.improve(at(now_s_), 1);
        run_.improve_us.push_back(cpu_us() - begin_us);
        settle();
        if (++steps_ % kCheck == 0) run_.violations += monitor_.check_all().size();
    }

    void drive(VehicleIndex v) {
        Vehicle& vehicle = vehicles_[v];
        const auto& plan = traffic_.plan(v);
        if (plan.released == plan.passed || --vehicle.busy_steps > 0) return;
        if (!traffic_.passed(v, plan.passed + 1, at(now_s_))) ++run_.violations;
        if (vehicle.admitted && traffic_.visits_done(v) == 1) {
            vehicle.admitted = false;
            vehicle.goal = traffic::kNoPlace;
            ++run_.orders;
            run_.longest_order_s = std::max(run_.longest_order_s, now_s_ - vehicle.given_s);
            run_.sum_order_s += now_s_ - vehicle.given_s;
        }
        if (plan.released > plan.passed) begin_move(v);
    }

    void begin_move(VehicleIndex v) {
        const auto& plan = traffic_.plan(v);
        vehicles_[v].busy_steps = world_.steps_of(plan.at(plan.passed + 1).duration_s);
    }

    void admit(VehicleIndex v) {
        Vehicle& vehicle = vehicles_[v];
        if (vehicle.admitted || vehicle.goal == traffic::kNoPlace || now_s_ < vehicle.retry_s) {
            return;
        }
        traffic::Task task;
        task.visits = {{vehicle.goal, world_.dwell_s}};
        const double begin_us = cpu_us();
        const auto admission = traffic_.admit(v, task, at(now_s_));
        run_.admission_us.push_back(cpu_us() - begin_us);
        vehicle.admitted = admission.has_value();
        if (!admission) {
            ++run_.refused[admission.error().reason.code];
            vehicle.retry_s = now_s_ + world_.retry_s;
            if (world_.real_plant && now_s_ - vehicle.since_s >= kHandOver_s) hand_over(v);
        }
        settle();
    }

    /// Where the layout keeps a vehicle from a station for good, one on the other side serves it:
    /// vehicles of a zone in turn, those whose own orders wait take over in exchange.
    void hand_over(VehicleIndex v) {
        const auto count = static_cast<VehicleIndex>(vehicles_.size());
        for (VehicleIndex i = 1; i < count; ++i) {
            const VehicleIndex u = (v + 1 + (i + handed_over_) % (count - 1)) % count;
            if (world_.vehicles[u].zone != world_.vehicles[v].zone || vehicles_[u].admitted) {
                continue;
            }
            std::swap(vehicles_[u].goal, vehicles_[v].goal);
            std::swap(vehicles_[u].given_s, vehicles_[v].given_s);
            vehicles_[u].since_s = vehicles_[v].since_s = now_s_;
            ++handed_over_;
            return;
        }
    }

    void release(VehicleIndex v) {
        const auto& plan = traffic_.plan(v);
        const MoveNumber before = plan.released;
        const auto begin = Timer::now();
        const MoveNumber granted = traffic_.extend(v, kAhead, at(now_s_));
        run_.release_us.push_back(us_since(begin));
        run_.releases += granted - before;
        if (before == plan.passed && granted > before) begin_move(v);
    }

    void settle() { run_.violations += monitor_.apply(traffic_.take_changes()).size(); }

    bool ended(VehicleIndex v) const {
        const auto& plan = traffic_.plan(v);
        return vehicles_[v].goal == traffic::kNoPlace && plan.passed == plan.last() &&
               world_.graphs[world_.vehicles[v].graph].places[plan.place].resting;
    }
    bool at_rest() const {
        for (VehicleIndex v = 0; v < vehicles_.size(); ++v) {
            if (!ended(v)) return false;
        }
        return true;
    }

    /// What a copy takes; graphs, shapes and distance tables are shared and not counted.
    void measure_memory() {
        const auto before = mallinfo2().uordblks;
        const auto copy = std::make_unique<traffic::Traffic>(traffic_);
        run_.bytes_per_vehicle = static_cast<double>(mallinfo2().uordblks - before) /
                                 static_cast<double>(vehicles_.size());
    }

    void measure_rebuild() {
        const double begin_us = cpu_us();
        const auto record = traffic_.record();
        const double recorded_us = cpu_us();
        const auto rebuilt = traffic::Traffic::rebuild(record, world_.graphs);
        run_.rebuild_ms = (cpu_us() - recorded_us) / 1e3;
        run_.record_ms = (recorded_us - begin_us) / 1e3;
        run_.rebuilt_same = rebuilt && rebuilt->record() == record;
    }

    const World& world_;
    traffic::Traffic traffic_{true};
    traffic::Monitor monitor_;
    Orders orders_;
    std::vector<Vehicle> vehicles_;
    double now_s_ = 0;
    std::size_t steps_ = 0;
    VehicleIndex handed_over_ = 0;
    Run run_;
};

}  // namespace

Orders::Orders(const World& world) : world_(world) {
    for (std::size_t v = 0; v < world.vehicles.size(); ++v) random_.emplace_back(1000 + v);
}

PlaceIndex Orders::next(std::size_t vehicle) {
    const auto& goals = world_.goals[world_.vehicles[vehicle].zone];
    return goals[random_[vehicle]() % goals.size()];
}

Run run_traffic(const World& world, double seconds, std::uint64_t releases) {
    return JointRun(world).run(seconds, releases);
}

}  // namespace pulseline::bench
