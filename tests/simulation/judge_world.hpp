#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/traffic/monitor.hpp"
#include "core/traffic/traffic.hpp"
#include "tests/simulation/judge_plant.hpp"

/// One seed of the simulation judge: vehicles with bodies that drive what they were granted, an
/// owner that gives out orders as core/fleet would, disturbances, and the laws checked at every
/// step. A virtual clock; the same seed replays identically.
namespace pulseline::judge {

using traffic::MoveNumber;
using traffic::VehicleIndex;

struct JudgeOptions {
    double disturbed_s = 3600;         // orders and disturbances come during this time
    double finish_limit_s = 6 * 3600;  // then everything must end within this
    bool verbose = false;
};

/// What happened in one seed.
struct Outcome {
    std::vector<std::string> violations;  // empty: all laws held
    std::map<std::string, int> events;    // faults and plan changes by name
    int orders = 0;
    int vehicles = 0;
    std::uint64_t grants = 0;
    double end_s = 0;
    std::uint64_t digest = 0;  // of all grants, to compare replays
};

class World {
public:
    World(std::uint64_t seed, JudgeOptions options);
    Outcome run();

private:
    struct Order {
        std::size_t of_class = 0;
        std::vector<traffic::Visit> visits;
        double from_s = 0;
        std::size_t done = 0;  // stops made, as the vehicles saw it
        std::optional<VehicleIndex> vehicle;
        bool may_delay_others = false;
    };
    struct Granted {  // a move as the vehicle knows it
        MoveNumber number = 0;
        Point to;
        PlaceIndex place = traffic::kNoPlace;
        bool stop = false;
        double duration_s = 0;  // true, not the predicted one
    };
    struct Body {
        std::size_t of_class = 0;
        Point at;
        Point from;  // where the move under way began
        PlaceIndex from_place = 0;
        std::deque<Granted> base;
        double in_move_s = 0;
        double stands_until_s = 0;  // a random stop
        bool dead = false;
        double returns_s = 0;
        bool strays = false;  // it is given up and found at an unexpected place
        std::vector<std::pair<double, MoveNumber>> reports;  // on their way
        MoveNumber last_reported = 0;
        std::optional<std::size_t> order;
        double retry_s = 0;
        PlaceIndex stray_from = traffic::kNoPlace;  // ends of the move it was found on
        PlaceIndex stray_to = traffic::kNoPlace;
        bool moved = true;
    };
    struct Closed {
        traffic::ClosureIndex closure;
        double until_s;
    };

    // judge_world.cpp: the plant's side
    int pick(int low, int high);
    bool chance(double probability);
    const VehicleClass& class_of(VehicleIndex v) const;
    Time now() const { return time_from_ns(static_cast<std::int64_t>(now_s_ * 1e9)); }
    void drive(VehicleIndex v);
    void arrive(VehicleIndex v);
    void deliver(VehicleIndex v);
    void take_grants(VehicleIndex v, MoveNumber upto);
    void check_step();
    void check_bodies();
    void violate(const std::string& what);
    void settle();
    void describe() const;
    // judge_owner.cpp: what the fleet would do
    void make_orders();
    void assign();
    void admit(VehicleIndex v);
    void finish_orders();
    void grant();
    traffic::Task task_of(VehicleIndex v) const;
    std::vector<traffic::Sequence> ways_back(VehicleIndex v) const;
    bool all_done() const;
    // judge_faults.cpp
    void disturb();
    void end_disturbances();
    void found(VehicleIndex v);
    void close_some();
    void change_plan();
    void restart();

    JudgeOptions options_;
    std::mt19937_64 random_;
    Plant plant_;
    std::vector<traffic::MoveGraph> graphs_;
    traffic::Traffic traffic_;
    traffic::Monitor monitor_;
    std::vector<Body> bodies_;
    std::vector<Order> orders_;
    std::vector<Closed> closed_;
    Outcome outcome_;
    double now_s_ = 0;
    double fault_rate_ = 0;  // events per step
    bool disturbed_ = true;
};

Outcome judge_seed(std::uint64_t seed, const JudgeOptions& options);

}  // namespace pulseline::judge
