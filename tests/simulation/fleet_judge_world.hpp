#pragma once

#include <deque>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "core/fleet/fleet.hpp"
#include "core/fleet/legs/leg_plan_answerer.hpp"
#include "core/fleet/views/order_preview.hpp"
#include "tests/core/fleet/fleet_world.hpp"
#include "tests/simulation/fleet_judge_journal.hpp"
#include "tests/simulation/fleet_judge_vehicle.hpp"

/// One seed: a plant, the real fleet over a store in memory, vehicles, lines that lose and delay,
/// a person, a client that orders, and what goes wrong; every law is checked at every step.
namespace pulseline::fleet_judge {

struct Outcome {
    std::vector<std::string> violations;
    std::vector<std::string> last_events;
    std::map<std::string, int> faults;
    int vehicles = 0;
    int classes = 0;  // of them; 0 without a platform
    int orders = 0;
    int ended = 0;
    double end_s = 0;
    std::uint64_t digest = 0;
    std::uint64_t inputs = 0;  // replayed from the journal, with Options::journal
    std::uint64_t input_bytes = 0;
    std::uint64_t snapshots = 0;
    std::uint64_t snapshot_bytes = 0;
};

struct Options {
    double hours = 1;
    bool trace = false;
    bool journal = false;  // a replay runs beside the fleet
};

Outcome judge_seed(std::uint64_t seed, const Options& options);

class World {
public:
    World(std::uint64_t seed, const Options& options);
    Outcome run();

private:
    template <class T>
    struct Mail {
        double at_s = 0;
        T content;
    };
    struct Line {
        std::vector<Mail<vda5050::StateMessage>> up;
        std::vector<Mail<fleet::VehicleMessage>> down;
        bool cut = false;
        bool server_knows = false;  // that it is connected
        double cut_until_s = 0;
        double next_state_s = 0;
    };
    /// What the world remembers of a vehicle besides what it is.
    struct Watch {
        double dead_until_s = 0;
        double manual_until_s = 0;
        double broken_until_s = 0;
        double person_at_s = 0;      // when the person has time for it
        double safety_until_s = 0;   // its safety stop is pulled
        bool needs_person = false;   // since a restart of the server or a pause
        std::size_t lifts_seen = 0;  // of those that it has begun
        double next_lift_s = 0;      // when somebody works at it where it stands
        /// What the server has been told of it, and of that what its present outputs know.
        struct Told {
            bool unfit = false;
            double at_s = 0;
            std::int64_t header = 0;
        };
        Told told;
        Told counted;
        double unheard_s = 0;                      // while the server listened
        bool told_since_stall = true;              // of the server
        bool restarted_on_leg = false;             // nobody has allowed it to move since
        std::map<std::string, std::int64_t> base;  // by leg: highest node released so far
    };
    struct Asked {
        fleet::NewOrder order;
        fleet::JobOrderId id;  // once acknowledged
        bool acknowledged = false;
        double again_s = 0;  // when it is asked again
    };
    /// What an order has had to put up with.
    struct Patience {
        double waits_since_s = 0;  // for others' floor
        double on_leg_s = 0;       // last seen on a drive of its own
        int overtaken = 0;         // since it has waited too long
        bool interrupted = false;
        std::map<plant::VehicleId, std::string> moved_aside;  // and where to
    };
    struct Closed {
        fleet::ClosureId id;
        double until_s = 0;
    };

    // fleet_judge_world.cpp
    void step(double dt_s);
    void move_vehicles(double dt_s);
    void carry_messages();
    void settle();
    bool commit(fleet::Outputs& out);
    void answer_plans();
    void send(const fleet::Outputs& out);
    fleet::Outputs take_outputs();
    void start_server();
    void retry_store();
    void fail_commit();
    void listen(double dt_s);
    Time now() const { return base_ + from_seconds(now_s_) + clock_step_; }

    // fleet_judge_faults.cpp: what goes wrong, and what ends it
    void disturb();
    void end_faults();
    void cut_line(const plant::VehicleId& id, Line& line);
    void crash(const char* how);
    void end_disturbances();
    void disturb_vehicle(const plant::VehicleId& id, Vehicle& vehicle);
    void pause(const plant::VehicleId& id);
    void push(const plant::VehicleId& id, Vehicle& vehicle);
    void misread();
    void disturb_orders();
    void close_some();
    double delay_s();
    int copies();

    // fleet_judge_people.cpp: the client and the person
    void order_some();
    void ask(Asked& asked);
    void let_person_act();
    void help_vehicle(const plant::VehicleId& id, Vehicle& vehicle);
    void help_orders();

    // fleet_judge_platforms.cpp: who works the platforms, their loads and the crane
    void transfer_at_times(const plant::VehicleId& id, std::vector<fleet::NewStep>& steps);
    void work_platform(const plant::VehicleId& id);
    std::optional<fleet::StepAction> mend_load(const plant::VehicleId& id,
                                               const fleet::VehicleView& view);
    const plant::Load* load_to_take(const plant::VehicleId& id);
    void work_crane();
    void move_by_crane(const plant::Load& load, const plant::StationId& from,
                       const plant::StationId& to);

    // fleet_judge_papers.cpp: what people say of loads, and that it is kept
    void keep_papers();
    void register_load();
    void weigh_load();
    void retire_load();
    void check_papers();

    // fleet_judge_laws.cpp
    void check_bodies();
    void note_told(const plant::VehicleId& id, const vda5050::StateMessage& state);
    void check_sent(const fleet::VehicleMessage& message);
    void check_movement();
    void check_lifts(const plant::VehicleId& id, const Vehicle& vehicle);
    void check_place_of_load();
    void check_load(const plant::VehicleId& id, const Vehicle& vehicle);
    const plant::Load* stored_load_on(const plant::VehicleId& id) const;
    void check_loads_apart(const plant::VehicleId& id, const Vehicle& vehicle);
    void check_records(const fleet::Records& records);
    void check_one_order_each(const fleet::Records& records);
    void check_link(const fleet::Event& event);
    void check_transition(const fleet::Event& event);
    void check_shown();
    void check_all();
    void check_end();
    bool all_over() const;
    std::optional<std::string> unknown_load() const;
    void violate(const std::string& what);
    void check_way(const fleet::VehicleMessage& message);
    void check_given_floor(const plant::VehicleId& id);
    void check_true_bodies(const fleet::VehicleMessage& message, std::int64_t base_before);
    void take_in(const fleet::Outputs& out);
    void take_in(const std::string& text);

    // fleet_judge_manners.cpp
    void check_making_way(const fleet::Event& event);
    void check_overtaking(const fleet::StopRecord& stop);
    void note_patience();
    void forget_patience();

    bool chance(double share) { return static_cast<double>(random_() >> 11) * 0x1.0p-53 < share; }
    int pick(int low, int high);
    Vehicle& any_vehicle(plant::VehicleId& id);

    std::mt19937_64 random_;
    Options options_;
    plant::Plant plant_;
    fleet::testing::MemoryStore store_;
    std::unique_ptr<fleet::Fleet> fleet_;
    std::optional<Shadow> shadow_;  // with options.journal; a restored fleet has all views, too
    bool has_dashboards_ = false;
    std::map<plant::StationId, fleet::StationView> shown_;  // what a dashboard has been told
    std::shared_ptr<simulation::Supports> supports_;
    std::map<plant::VehicleId, Vehicle> vehicles_;
    std::vector<plant::VehicleId> platforms_;
    std::map<plant::VehicleId, Line> lines_;
    std::map<plant::VehicleId, Watch> watch_;
    bool free_ = false;  // vehicles may leave the lanes: such ways are planned beside the fleet
    fleet::LegPlanAnswerer answerer_;
    fleet::OrderPreviewer previewer_;
    std::vector<Mail<fleet::LegPlanQuestion>> plans_;
    std::deque<Asked> asked_;
    std::vector<Closed> closed_;
    Time base_ = time_from_ns(1'800'000'000'000'000'000);
    Duration clock_step_{0};
    double now_s_ = 0;
    double end_s_ = 0;
    double fault_rate_ = 0;  // per second
    double bad_line_ = 0;    // share of messages that something happens to
    bool disturbed_ = true;
    bool server_crashes_ = false;  // at one of the next commits
    double stalled_until_s_ = 0;
    double listened_s_ = 0;                   // when the server listened last
    std::optional<fleet::Outputs> unstored_;  // read-only: the store refuses
    double store_back_s_ = 0;
    bool store_hangs_ = false;   // `unstored_` is under way and may still be stored
    bool long_command_ = false;  // the next thing the server does takes seconds
    double decided_s_ = 0;       // when the server last handled anything
    double retry_s_ = 0;
    double next_order_s_ = 0;
    double next_person_s_ = 0;
    double next_crane_s_ = 0;
    std::mt19937_64 foot_random_;    // of its own, so that the seeds stay what they were
    std::mt19937_64 papers_random_;  // likewise
    double next_papers_s_ = 0;       // when somebody says something of a load
    int registered_loads_ = 0;
    std::set<std::string> lifts_asked_;  // by a person, and not yet begun: ids of actions
    int wanted_orders_ = 0;
    std::uint64_t servers_ = 0;
    std::int64_t last_seq_ = 0;
    std::set<std::pair<fleet::JobOrderId, int>> good_stops_;
    std::set<fleet::JobOrderId> ended_;
    std::map<fleet::JobOrderId, Patience> patience_;
    std::set<std::pair<plant::VehicleId, plant::VehicleId>> meeting_;
    Outcome outcome_;
};

}  // namespace pulseline::fleet_judge
