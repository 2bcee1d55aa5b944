#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "core/traffic/traffic.hpp"

/// Floors, orders and the three ways of running them for the fleet benchmark. All runs drive the
/// same moves in the same whole steps and get the same orders, so the numbers of orders compare.
namespace pulseline::bench {

using traffic::GraphIndex;
using traffic::PlaceIndex;

constexpr double kHandOver_s = 120;
constexpr double kStuck_s = 600;  // of the baselines

struct World {
    struct Vehicle {
        GraphIndex graph = 0;
        PlaceIndex start = 0;  // a resting place of that graph
        std::size_t zone = 0;  // whose orders it gets: its hall
        bool loaded = false;   // does not leave its rest for others while it has no order
        bool busy = true;      // gets orders; the others stay where they rest
    };
    std::string name;
    std::vector<traffic::MoveGraph> graphs;
    std::vector<Vehicle> vehicles;
    std::vector<std::vector<PlaceIndex>> goals;  // per zone
    double step_s = 3;                           // moves last a whole number of steps
    double dwell_s = 9;
    double retry_s = 30;  // after a refused admission
    bool well_formed = false;
    /// Its layout is as it is: an order that a vehicle cannot begin for kHandOver_s goes to another
    /// of its zone. Not sooner, or short orders would be picked and long ones put off.
    bool real_plant = false;

    int steps_of(double duration_s) const;
};

/// 5 halls, each with 40 stations, 200 resting places and 200 vehicles of 1.2 m x 0.8 m.
World halls_world();
/// 1,000 one-cell vehicles between shelves; they start and rest on cells in the shelves' fronts.
World warehouse_world();
/// The vehicles of a plant file, each class of them on its own orders.
World plant_world(const std::string& path);

/// For each vehicle an endless list of goals in its zone, the same for all runs.
class Orders {
public:
    explicit Orders(const World& world);
    PlaceIndex next(std::size_t vehicle);

private:
    const World& world_;
    std::vector<std::mt19937_64> random_;
};

struct Run {
    std::vector<double> admission_us;
    std::vector<double> release_us;
    std::vector<double> improve_us;
    std::uint64_t orders = 0;
    std::map<std::string, std::uint64_t> refused;  // admissions, by reason; each is tried again
    std::uint64_t releases = 0;
    std::uint64_t violations = 0;  // found by the independent monitor
    double simulated_s = 0;
    double drained_s = 0;  // until the last order was done and the last vehicle at rest
    double bytes_per_vehicle = 0;
    double record_ms = 0;
    double rebuild_ms = 0;
    bool rebuilt_same = false;
    int stuck = 0;
    /// From an order's coming to its end or, if it was not served at all, to the end of the run.
    double longest_order_s = 0;
    double sum_order_s = 0;  // of those that were done
    double orders_per_hour() const {
        return simulated_s > 0 ? static_cast<double>(orders) * 3600 / simulated_s : 0;
    }
};

double quantile(std::vector<double>& values, double share);

/// At least `seconds` of simulated time, longer until `releases` grants are made. Then no new
/// orders come; stuck are vehicles that have not ended theirs and come to rest within six hours.
Run run_traffic(const World& world, double seconds, std::uint64_t releases);
/// No more can be done: each vehicle on a floor of its own, the same orders one after the other.
Run run_alone(const World& world, double seconds);
/// Orders an hour that the floor lets through at most, whoever controls it: no piece of floor has
/// two holders at a time. A true bound for orders between random goals; it holds in the long run.
double floor_capacity(const World& world);
/// A leg gets all its tiles at once. Stuck: no move in the last ten minutes.
Run run_exclusive_legs(const World& world, double seconds);
/// Only for vehicles of one class on moves of one step. Stuck: no order done in ten minutes.
/// `one_holder`: a place is entered when it was free before, not while another leaves it.
std::optional<Run> run_pibt(const World& world, double seconds, bool one_holder);

}  // namespace pulseline::bench
