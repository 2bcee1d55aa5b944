// The demo hall as people use it: its twelve vehicles, the real fleet, orders drawn at random for
// hours, nothing going wrong. Held against what people can live with: every order ends, no vehicle
// is moved aside twice for one order, and none waits for others more than ten times what it takes
// alone. Virtual clock; a seed gives the same run.
//   test_demo_hall [--hours H] [--seeds N] [--first N] [--plant FILE] [--trace 1]
//                  [--every S] [--cancel-every S] [--type TYPE]
// With --cancel-every a person cancels orders under way, wherever their vehicles are: then the
// manners towards single orders are not judged, only that each ends and nobody waits for ever.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>

#include "api/plant/plant_file.hpp"
#include "core/fleet/fleet.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "tests/core/fleet/fleet_world.hpp"
#include "tests/simulation/fleet_judge_vehicle.hpp"

namespace pulseline::demo_hall {
namespace {

using fleet::JobOrder;
using fleet::JobState;
using fleet_judge::Vehicle;

constexpr double kTick_s = 0.2;
constexpr double kStateEvery_s = 1;
constexpr double kPersonEvery_s = 30;
constexpr double kDrain_s = 2 * 3600;    // at most, after the last order
constexpr double kStop_s = 20;           // a stop alone, measured and corrected
constexpr double kShortest_s = 60;       // what an order counts at least as its own drive
constexpr std::uint64_t kMostTold = 20;  // failures of a run
constexpr double kMostWait = 10;         // times its own drive

struct Options {
    double hours = 1;
    double every_s = 75;        // between two orders, on the average
    double cancel_every_s = 0;  // of those under way; 0: nobody does
    std::string type;           // only for vehicles of it, each by name; empty: all
    std::uint64_t first = 1;
    std::uint64_t seeds = 1;
    bool trace = false;
    std::string plant = PULSELINE_DEMO_HALL;
};

/// What an order needs of the hall, and what it got.
struct Watched {
    double own_s = 0;      // drives and stops, alone on an empty floor
    double running_s = 0;  // with a vehicle, but for what was stated to bar it outside traffic
    double unassigned_s = 0;
    std::map<std::pair<std::string, std::string>, double> reasons;
    std::map<plant::VehicleId, int> moved_aside;
};

struct Sums {
    std::uint64_t orders = 0;
    std::uint64_t ended = 0;
    std::uint64_t made_way = 0;
    double wait_s = 0;
    double longest_wait_s = 0;
    double worst_ratio = 0;
    std::uint64_t failures = 0;
};

class World {
public:
    World(const plant::Plant& plant, std::uint64_t seed, const Options& options)
        : plant_(plant), planner_(plant), random_(seed), options_(options) {
        const auto supports = std::make_shared<simulation::Supports>(plant_, seed);
        for (const auto& vehicle : plant_.vehicles) {
            vehicles_.emplace(std::piecewise_construct, std::forward_as_tuple(vehicle.id),
                              std::forward_as_tuple(plant_, vehicle, supports, random_()));
            vehicles_.at(vehicle.id).shows_codes = true;
            next_state_s_[vehicle.id] = 0;
        }
        fleet_ = std::make_unique<fleet::Fleet>(plant_, store_.load(), 1, now(), nullptr);
        fleet_->leave_out_views();
        for (const auto& [id, vehicle] : vehicles_) fleet_->vehicle_connected(id, now());
    }

    Sums run() {
        const double end_s = options_.hours * 3600;
        while (now_s_ < end_s) {
            if (now_s_ >= next_order_s_) order();
            if (options_.cancel_every_s > 0 && now_s_ >= next_cancel_s_) cancel();
            step();
        }
        while (!all_over() && now_s_ < end_s + kDrain_s) step();
        judge();
        return sums_;
    }

private:
    Time now() const { return time_from_ns(1'800'000'000'000'000'000) + from_seconds(now_s_); }
    int pick(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<std::uint64_t>(high - low + 1));
    }

    void step() {
        now_s_ += kTick_s;
        for (auto& [id, vehicle] : vehicles_) {
            vehicle.step(kTick_s);
            double& due_s = next_state_s_[id];
            if (!vehicle.take_changed() && now_s_ < due_s) continue;
            due_s = now_s_ + kStateEvery_s;
            fleet_->vehicle_state(id, vehicle.state(), now());
        }
        fleet_->tick(now());
        settle();
        help();
        watch();
    }

    void settle() {
        for (fleet::Outputs out = fleet_->take_outputs(now());
             !out.records.empty() || !out.messages.empty() || !out.plans_wanted.empty();
             out = fleet_->take_outputs(now())) {
            store_.commit(out.records);
            for (const auto& question : out.plans_wanted) {
                fleet_->leg_planned(question.vehicle, question.number, answerer_.answer(question),
                                    now());
            }
            for (const auto& order : out.records.orders) open_.insert(order.id);
            for (const auto& event : out.records.events) note(event);
            for (const auto& message : out.messages) vehicles_.at(message.vehicle).receive(message);
        }
    }

    void note(const fleet::Event& event) {
        if (options_.trace) {
            std::string text;
            for (const auto& param : event.params) {
                text += " " + param.name + "=";
                if (const auto* word = std::get_if<std::string>(&param.value)) text += *word;
                if (const auto* number = std::get_if<std::int64_t>(&param.value))
                    text += std::to_string(*number);
            }
            std::printf("%9.1f %-18s %-6s %s%s\n", now_s_, event.type.c_str(),
                        event.vehicle.str().c_str(),
                        event.order.empty() ? "" : name(event.order).c_str(), text.c_str());
        }
        if (event.type == "traffic.violation") fail("the monitor found a violation");
        if (event.type == "step.started") {
            for (auto& [id, watched] : watched_) watched.moved_aside.erase(event.vehicle);
        }
        if (event.type != "vehicle.makes_way") return;
        ++sums_.made_way;
        if (!event.order.empty()) ++watched_[event.order].moved_aside[event.vehicle];
    }

    std::string name(fleet::JobOrderId id) const {
        const auto found = store_.orders.find(id);
        return found == store_.orders.end() ? id.str()
                                            : "JO-" + std::to_string(found->second.number);
    }

    /// One that some vehicle can do: stations of one type, for it by name, by type or for anybody.
    void order() {
        next_order_s_ =
            now_s_ + options_.every_s * 2 * (static_cast<double>(random_() % 1000) / 1000);
        std::vector<const plant::Vehicle*> asked;
        for (const auto& one : plant_.vehicles) {
            if (options_.type.empty() || one.type.str() == options_.type) asked.push_back(&one);
        }
        const auto& vehicle =
            *asked[static_cast<std::size_t>(pick(0, static_cast<int>(asked.size()) - 1))];
        std::vector<int> numbers;
        for (const auto& station : plant_.stations) {
            const auto& types = station.vehicle_types;
            const bool fits =
                types.empty() || std::find(types.begin(), types.end(), vehicle.type) != types.end();
            if (fits) numbers.push_back(station.number);
        }
        fleet::NewOrder wanted;
        const int kind = options_.type.empty() ? pick(0, 2) : 0;
        if (kind == 0) wanted.vehicle = vehicle.id;
        if (kind == 1) wanted.vehicle_type = vehicle.type;
        wanted.actor = "mes";
        for (int left = pick(1, 3); left > 0; --left) {
            const int number =
                numbers[static_cast<std::size_t>(pick(0, static_cast<int>(numbers.size()) - 1))];
            const bool twice =
                !wanted.steps.empty() && wanted.steps.back().station_number == number;
            if (!twice) wanted.steps.push_back({number, plant::MotionMode::kAuto});
        }
        const auto created = fleet_->create(wanted, now());
        if (!created) {
            std::printf("%9.1f refused: %s\n", now_s_, created.error().reason.code.c_str());
            return;
        }
        ++sums_.orders;
        settle();
    }

    /// A person has thought better of one that is under way.
    void cancel() {
        next_cancel_s_ = now_s_ + pick(1, static_cast<int>(2 * options_.cancel_every_s));
        std::vector<fleet::JobOrderId> running;
        for (const auto& id : open_) {
            if (store_.orders.at(id).state == JobState::kRunning) running.push_back(id);
        }
        if (running.empty()) return;
        const auto which = static_cast<std::size_t>(pick(0, static_cast<int>(running.size()) - 1));
        static_cast<void>(fleet_->cancel_order(running[which], std::nullopt, "person", now()));
        settle();
    }

    /// A person helps where one is waited for, as after stops that could not be measured.
    void help() {
        if (now_s_ < next_help_s_) return;
        next_help_s_ = now_s_ + kPersonEvery_s;
        for (const auto& id : open_) {
            const JobOrder& order = store_.orders.at(id);
            if (order.state == JobState::kInterrupted)
                static_cast<void>(fleet_->resume_order(id, std::nullopt, "person", now()));
        }
        for (const auto& [id, record] : store_.vehicles) {
            if (record.claim) say_where(id);
            if (record.needs_resume) static_cast<void>(fleet_->resume_fleet({id}, "person", now()));
        }
        settle();
    }

    /// The person who put it there, or has looked.
    void say_where(const plant::VehicleId& id) {
        static_cast<void>(fleet_->init_position(id, {vehicles_.at(id).pose()}, "person", now()));
    }

    static bool is_traffic(const std::string& code) {
        static const std::set<std::string> kTraffic{
            "",           "floor_held",    "floor_closed", "gives_way", "traffic_blocked",
            "goes_first", "floor_conflict"};
        return kTraffic.contains(code);
    }

    void watch() {
        for (auto it = open_.begin(); it != open_.end();) {
            const JobOrder& order = store_.orders.at(*it);
            if (fleet::is_final(order.state)) {
                it = open_.erase(it);
                continue;
            }
            ++it;
            Watched& watched = watched_[order.id];
            if (order.state == JobState::kAllowedToStart) watched.unassigned_s += kTick_s;
            if (order.state != JobState::kRunning) continue;
            if (watched.own_s == 0) watched.own_s = own_s(order);
            if (order.expected && *order.expected < now()) late_views_ += 1;
            if (!is_traffic(order.reason.code)) continue;
            watched.running_s += kTick_s;
            if (!order.reason.code.empty()) {
                std::string other;
                for (const auto& param : order.reason.params) {
                    const auto* text = std::get_if<std::string>(&param.value);
                    if (param.name == "vehicle" && text) other = *text;
                }
                watched.reasons[{order.reason.code, other}] += kTick_s;
            }
        }
    }

    /// Its drives and stops from where the vehicle stands now, with nobody else in the hall.
    double own_s(const JobOrder& order) {
        const auto& vehicle = vehicles_.at(order.assigned_vehicle);
        geometry::Pose2 at = vehicle.pose();
        double sum_s = 0;
        for (const auto& step : order.steps) {
            const auto* station = plant::find_station(plant_, step.station);
            planning::LegRequest request;
            request.type = &vehicle.type();
            request.loaded = plant::first_load(plant_, vehicle.what().id) != nullptr;
            request.hall = station->hall;
            request.start = at;
            request.target = step.station;
            request.mode = plant::MotionMode::kAuto;
            if (const auto plan = planner_.plan_leg(request)) sum_s += plan->duration_s;
            sum_s += kStop_s;
            at = station->pose;
        }
        return std::max(sum_s, kShortest_s);
    }

    bool all_over() const { return open_.empty(); }

    void fail(const std::string& what) {
        if (++sums_.failures > kMostTold) return;
        std::printf("  %s\n", what.c_str());
    }

    void judge() {
        for (const auto& [id, order] : store_.orders) {
            sums_.ended += order.state == JobState::kEnded ? 1 : 0;
            const Watched& watched = watched_[id];
            if (!fleet::is_final(order.state)) {
                fail(name(id) + " of " + order.assigned_vehicle.str() +
                     " has not ended: " + fleet::to_string(order.state) + " " + order.reason.code);
            }
            for (const auto& [vehicle, times] : watched.moved_aside) {
                if (times > 1 && options_.cancel_every_s == 0) {
                    fail(vehicle.str() + " was moved aside " + std::to_string(times) +
                         " times for " + name(id));
                }
            }
            const double wait_s = std::max(0.0, watched.running_s - watched.own_s);
            const double ratio = wait_s / std::max(watched.own_s, kShortest_s);
            sums_.wait_s += wait_s;
            sums_.longest_wait_s = std::max(sums_.longest_wait_s, wait_s);
            sums_.worst_ratio = std::max(sums_.worst_ratio, ratio);
            if (ratio <= kMostWait) continue;
            char text[200];
            std::snprintf(text, sizeof text, "%s of %s waited %.0f s, alone it takes %.0f s",
                          name(id).c_str(), order.assigned_vehicle.str().c_str(), wait_s,
                          watched.own_s);
            std::string why = text;
            for (const auto& [reason, seconds] : watched.reasons) {
                if (seconds > 30) {
                    why += ", " + reason.first + " " + reason.second + " " +
                           std::to_string(static_cast<int>(seconds)) + " s";
                }
            }
            fail(why);
        }
        if (const auto waits = fleet_->traffic(now()).waits; !waits.empty() && all_over()) {
            for (const auto& wait : waits)
                fail("after all orders have ended " + wait.vehicle.str() + " is said to wait");
        }
        if (late_views_ > 0)
            fail("an expected time lay in the past " + std::to_string(late_views_));
    }

    const plant::Plant& plant_;
    planning::LegPlanner planner_;
    std::mt19937_64 random_;
    const Options& options_;
    fleet::testing::MemoryStore store_;
    fleet::LegPlanAnswerer answerer_;
    std::unique_ptr<fleet::Fleet> fleet_;
    std::map<plant::VehicleId, Vehicle> vehicles_;
    std::map<plant::VehicleId, double> next_state_s_;
    std::set<fleet::JobOrderId> open_;
    std::map<fleet::JobOrderId, Watched> watched_;
    std::uint64_t late_views_ = 0;
    double now_s_ = 0;
    double next_order_s_ = 10;
    double next_cancel_s_ = 100;
    double next_help_s_ = 0;
    Sums sums_;
};

Options options_from(int argc, char** argv) {
    Options options;
    for (int i = 1; i < argc; i += 2) {
        const std::string name = argv[i];
        const char* value = i + 1 < argc ? argv[i + 1] : "";
        if (name == "--hours") {
            options.hours = std::strtod(value, nullptr);
        } else if (name == "--seeds") {
            options.seeds = std::strtoull(value, nullptr, 10);
        } else if (name == "--first") {
            options.first = std::strtoull(value, nullptr, 10);
        } else if (name == "--plant") {
            options.plant = value;
        } else if (name == "--every") {
            options.every_s = std::strtod(value, nullptr);
        } else if (name == "--cancel-every") {
            options.cancel_every_s = std::strtod(value, nullptr);
        } else if (name == "--type") {
            options.type = value;
        } else if (name == "--trace") {
            options.trace = *value == '1';
        } else {
            std::fprintf(stderr, "unknown option %s\n", name.c_str());
            std::exit(2);
        }
    }
    return options;
}

int run(const Options& options) {
    const auto plant = api::plant_file::load_plant_file(options.plant);
    if (!plant) {
        std::printf("%s\n", plant.error().what.c_str());
        return 2;
    }
    if (!options.type.empty() &&
        std::ranges::none_of(plant->vehicles, [&](const plant::Vehicle& vehicle) {
            return vehicle.type.str() == options.type;
        })) {
        std::printf("the plant has no vehicle of type %s\n", options.type.c_str());
        return 2;
    }
    std::uint64_t failed = 0;
    for (std::uint64_t seed = options.first; seed < options.first + options.seeds; ++seed) {
        const Sums sums = World(*plant, seed, options).run();
        std::printf(
            "seed %llu: %.1f hours, %llu orders, %llu ended, made way %llu times; waits %.0f s an "
            "order, longest %.0f s, at most %.1f times its own drive\n",
            static_cast<unsigned long long>(seed), options.hours,
            static_cast<unsigned long long>(sums.orders),
            static_cast<unsigned long long>(sums.ended),
            static_cast<unsigned long long>(sums.made_way),
            sums.wait_s / static_cast<double>(std::max<std::uint64_t>(1, sums.orders)),
            sums.longest_wait_s, sums.worst_ratio);
        std::fflush(stdout);
        const bool empty = sums.orders == 0 || sums.ended == 0;
        failed += sums.failures > 0 || empty ? 1 : 0;
    }
    std::printf("# pass %llu\n# fail %llu\n",
                static_cast<unsigned long long>(options.seeds - failed),
                static_cast<unsigned long long>(failed));
    return failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace pulseline::demo_hall

int main(int argc, char** argv) {
    using namespace pulseline::demo_hall;
    return run(options_from(argc, argv));
}
