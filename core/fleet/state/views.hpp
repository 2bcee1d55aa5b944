#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fleet/state/closure.hpp"
#include "core/fleet/state/job_order.hpp"
#include "core/planning/legs/leg_planner.hpp"
#include "core/plant/load_rules.hpp"

/// What the fleet shows of itself: plain copies, safe to hand to another thread.
namespace pulseline::fleet {

/// What the brackets say of the load on them.
struct LoadView {
    double force_n = 0;
    std::optional<geometry::Point2> centre;    // of gravity, body frame; there while it carries one
    std::optional<plant::BracketShare> worst;  // there while it carries one
    std::optional<Reason> fault;               // the rule of its type that the load breaks
};

/// Brackets or parking feet that a person has moved outside an order.
struct LiftMove {
    enum class State { kUnderWay, kDone, kFailed };
    StepAction what;
    std::string action_id;
    std::string actor;
    Time at;
    State state = State::kUnderWay;
    std::string why;  // of a failed one: as the vehicle says, or link_lost
};
const char* to_string(LiftMove::State state);  // "under_way"

/// How long the vehicle has been silent (no frame, no pong).
enum class Link { kNever, kLive, kLate, kLost, kGone };
const char* to_string(Link link);  // "live"

enum class Activity {
    kStanding,
    kMoving,
    kMeasuring,
    kWaiting,
    kPaused,
    kBlocked,
    kCharging,
    kUnknown,
};

const char* to_string(Activity activity);

struct LegView {
    LegId id;
    plant::StationId station;
    plant::MotionMode mode = plant::MotionMode::kLinear;
    std::vector<geometry::Point2> path;
    std::size_t granted_points = 0;
    std::vector<geometry::Polygon> granted_area;
    std::vector<geometry::Polygon> horizon_area;
    double duration_s = 0;
    double progress = 0;
    std::optional<Time> started;
    std::optional<Time> expected;
    /// By which codes it finds its way, or why not; none when there is nothing to say.
    std::optional<Result<planning::LegChain>> chain;
};

const char* to_string(PoseBasis::Kind kind);  // "stop"

/// Codes on the way of a drive, by the vehicle's own word: edges with codes that it has passed, on
/// how many of them it read one, and the payloads read last.
struct CodesUnderWay {
    int passed = 0;
    int read = 0;
    std::string last;
};
CodesUnderWay codes_under_way(const vda5050::StateMessage& state);

struct CarriedLoad {
    plant::LoadId id;
    std::string name;
    double mass_kg = 0;  // as its papers say
};

struct VehicleView {
    plant::VehicleId id;
    Link link = Link::kNever;
    Activity activity = Activity::kUnknown;
    std::optional<Reason> reason;  // why it stands or waits
    std::optional<Time> last_heard;
    bool pose_known = false;
    std::optional<PoseBasis> pose_basis;  // there while it is known
    std::optional<Pose2> pose;
    std::optional<Pose2> claimed_pose;  // where it says to be and cannot be; `pose`: where it was
    std::optional<Time> pose_at;
    std::string hall;
    plant::StationId at_station;
    std::optional<CarriedLoad> carries;
    JobOrderId order;  // empty: none
    std::optional<LegView> leg;
    std::optional<Pause> paused;
    bool stands_paused =
        false;  // it has itself reported, since it was told, to be paused and at rest
    Integration integration = Integration::kUtilise;
    bool needs_resume = false;
    Reason needs_resume_reason;
    std::vector<Time> made_way;  // newest last; see LiveVehicle
    LoadView load;               // of a vehicle with brackets
    std::optional<LiftMove> lift;
    vda5050::StateMessage state;  // as last reported; all defaults before the first
};

struct StationView {
    plant::StationId id;
    int number = 0;
    plant::VehicleId occupied_by;
    plant::VehicleId reserved_by;
    bool ready = false;
    StopRecordId last_stop;
    plant::LoadId holds;  // on its support; empty: nothing
};

/// A load with all that is known of it.
struct KnownLoad {
    LoadSheet sheet;
    LoadRecord place;
};

/// Where a person says that a load is; both empty: not in the plant.
struct LoadPlace {
    plant::VehicleId vehicle;
    plant::StationId station;
};

/// The store takes no writes: commands are refused and vehicles get no further base meanwhile.
struct StoreFault {
    std::string cause;  // "disk_full", "write_protected", "disk_error"
    Time since;
};

/// The server's time and its machine's: people are told while they differ.
struct ClockDifference {
    Duration ahead{};  // of the server's time
    Time since;
};

struct FleetView {
    bool paused = false;         // every vehicle is
    std::optional<Pause> pause;  // of the whole fleet, the newest that holds a vehicle
    std::int64_t last_event_seq = 0;
    int vehicles_live = 0;
    int vehicles_total = 0;
    std::vector<plant::VehicleId> needs_resume;
    Time started;
    std::optional<StoreFault> store_fault;
    std::optional<ClockDifference> clock_difference;
};

/// The live wait-for graph of traffic and the closed floor.
struct TrafficView {
    struct Wait {
        plant::VehicleId vehicle;
        plant::VehicleId waits_for;  // empty: it waits for something else, as the reason says
        Reason reason;
        std::optional<Time> until;  // predicted; absent: nothing known ends it
    };
    std::optional<Reason> stopped;  // the monitor found a violation: nothing is granted
    std::vector<Wait> waits;
    std::vector<Closure> closures;
};

struct Check {
    enum class Result { kPass, kNote, kFail };
    std::string code;  // link pose load parking_feet codes_in_view station clearance wheels battery
                       // safety mode
    Result result = Result::kPass;
    Params params;
    std::optional<double> age_s;
};

struct StepPreview {
    plant::StationId station;
    int number = 0;
    Pose2 start;
    std::optional<plant::MotionMode> chosen;
    std::vector<planning::ModeOption> options;
    std::vector<planning::LegAlternative> alternatives;  // to the way of the chosen mode
};

struct Preview {
    plant::VehicleId vehicle;
    bool accepted = false;
    std::optional<Error> problem;
    std::vector<Check> checks;
    std::vector<StepPreview> steps;
};

}  // namespace pulseline::fleet
