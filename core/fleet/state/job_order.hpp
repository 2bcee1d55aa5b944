#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/id.hpp"
#include "core/base/time.hpp"
#include "core/plant/plant.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::fleet {

using geometry::Pose2;

using JobOrderId = Id<struct JobOrderTag>;

using LegId = Id<struct LegTag>;  // also the VDA 5050 orderId of that drive

using StopRecordId = Id<struct StopRecordTag>;

using ScheduleId = Id<struct ScheduleTag>;

/// States of the ISA-95 Job Control machine (OPC 10031-4).
enum class JobState {
    kNotAllowedToStart,
    kAllowedToStart,
    kRunning,
    kInterrupted,
    kEnded,
    kAborted,
};

const char* to_string(JobState state);  // "NotAllowedToStart"
bool is_final(JobState state);

enum class StepState { kPending, kDriving, kMeasuring, kDone, kSkipped };

const char* to_string(StepState state);  // "pending"

/// Something the vehicle does standing, by a name that its factsheet announces for nodes.
struct StepAction {
    std::string type;  // "lowerParking"
    Params params;
    friend bool operator==(const StepAction&, const StepAction&) = default;
};

/// Where a step is: its actions before the drive, the drive with its stop, the actions after it.
enum class StepPhase { kBefore, kDrive, kAfter };

const char* to_string(StepPhase phase);  // "before"

struct Step {
    plant::StationId station;
    plant::MotionMode mode = plant::MotionMode::kAuto;
    std::vector<StepAction> before;  // done before it leaves, in this order
    std::vector<StepAction> after;   // done when its stop is inside the tolerance
    StepPhase phase = StepPhase::kBefore;
    std::size_t actions_done = 0;  // of the phase's actions
    StepState state = StepState::kPending;
    LegId leg;             // the drive under way or done
    StopRecordId stop;     // set when the stop was measured
    int attempts = 0;      // approaches made so far
    double planned_s = 0;  // drive as planned when the order came
};

/// An order that has to end before another may start. What became of it is noted, since the fleet
/// forgets ended orders after a while.
struct Dependency {
    JobOrderId order;
    std::int64_t number = 0;
    std::optional<JobState> outcome;  // Ended or Aborted, once it is
    friend bool operator==(const Dependency&, const Dependency&) = default;
};

struct JobOrder {
    JobOrderId id;
    std::int64_t number = 0;           // people say JO-<number>; gapless, ours
    std::string client_order_id;       // the MES's own name, unique when given
    plant::VehicleId wanted_vehicle;   // empty: any that can
    plant::VehicleTypeId wanted_type;  // empty: any that can
    plant::VehicleId assigned_vehicle;
    int priority = 0;                    // higher first
    std::optional<Time> earliest_start;  // not assigned before
    std::optional<Time> due;             // when it should have ended
    std::vector<Dependency> after;       // all of these Ended first
    std::string sequence;                // orders of one name: one vehicle, by number; empty: none
    plant::VehicleId sequence_vehicle;   // of the order that started the sequence
    std::string from_template;           // name of the template it was made from
    ScheduleId from_schedule;            // the schedule that made it
    std::vector<Step> steps;
    std::size_t current_step = 0;
    JobState state = JobState::kAllowedToStart;
    bool cancel_requested = false;
    bool stop_requested = false;  // as cancel_requested, but it shall be Ended
    bool pause_requested = false;
    bool removed = false;  // taken out by Cancel or Clear: history only
    Reason reason;         // why it waits, is interrupted or aborted; empty code: nothing
    std::string created_by;
    Time created;
    Time started;
    Time ended;
    std::optional<Time> expected;  // end of the last drive, while the order runs
    std::int64_t revision = 1;     // ETag
};

/// How far from its station a drive ended before small moves mended it, in the hall frame.
struct Arrival {
    double dx_m = 0;
    double dy_m = 0;
    double dheading_rad = 0;
    /// What a usual vehicle of its family would have missed it by after the same way (root mean
    /// square); 0: the drive did not begin where the vehicle had been measured, so nobody knows.
    double expected_m = 0;
    double expected_rad = 0;
    friend bool operator==(const Arrival&, const Arrival&) = default;
};

/// One measured stop. Deviation = measured - theoretical in the hall frame.
struct StopRecord {
    StopRecordId id;
    JobOrderId order;
    LegId leg;
    int step = 0;
    plant::VehicleId vehicle;
    plant::StationId station;
    int station_number = 0;
    plant::MotionMode mode = plant::MotionMode::kLinear;
    Pose2 theoretical;
    Pose2 measured;
    double dx_m = 0;
    double dy_m = 0;
    double dheading_rad = 0;
    double along_m = 0;  // in the station's frame
    double left_m = 0;
    double sigma_xy_m = 0;
    double sigma_heading_rad = 0;
    plant::Tolerance tolerance;
    bool inside = false;
    int attempt = 1;  // approaches of this step so far
    std::string method;
    std::vector<std::string> markers;
    double load_kg = 0;  // as its brackets say
    plant::LoadId load;  // that it carried; empty: none
    Time at;
    std::optional<Arrival> arrival;  // none: the vehicle did not tell
};

/// One entry of the gapless event sequence.
struct Event {
    std::int64_t seq = 0;
    Time at;
    std::string type;  // "job_order.created", "vehicle.lost", "stop.measured", ...
    JobOrderId order;
    LegId leg;
    plant::VehicleId vehicle;
    std::string actor;  // user or token that asked, empty: the fleet itself
    Params params;
};

/// The drive of one step as the vehicle was told it. nodes[0] is where it stood.
struct Leg {
    LegId id;
    JobOrderId order;
    int step = 0;
    plant::VehicleId vehicle;
    plant::StationId station;
    plant::MotionMode mode = plant::MotionMode::kLinear;
    std::string hall;
    std::int64_t update_id = 0;
    std::vector<vda5050::OrderNode> nodes;
    std::vector<vda5050::OrderEdge> edges;
    std::size_t released_nodes = 1;  // nodes[0..released_nodes) are the base
    std::size_t passed_nodes = 1;    // reported by the vehicle
    double duration_s = 0;
    int attempt = 1;
    bool actions_only = false;  // one node, where it stands: the actions before or after a step
    bool charges = false;       // to a charger, of the fleet's own accord: no order
};

/// How far a vehicle takes part. Ignored: not listened to. Noticed: shown where it says it is. Both
/// hold no floor, so they are out of the hall. Respected: holds its floor and is planned around.
/// Utilised: gets orders.
enum class Integration { kIgnore, kNotice, kRespect, kUtilise };

const char* to_string(Integration level);  // "utilise"

/// A pose in one of the halls.
struct Whereabouts {
    Pose2 pose;
    std::string hall;
    friend bool operator==(const Whereabouts&, const Whereabouts&) = default;
};

/// Where a person says that a vehicle stands, and how well that person knows it.
struct StatedPose {
    /// Of one who points there, 95 in 100 times; who measures knows it better.
    static constexpr double kPointedWithin_m = 0.1;
    static constexpr double kPointedWithin_rad = radians(5);

    Pose2 pose;
    double sigma_xy_m = kPointedWithin_m / 2;
    double sigma_heading_rad = kPointedWithin_rad / 2;
};

/// A person's wish that a vehicle stands.
struct Pause {
    std::string actor;  // empty: nobody is known any more
    Time at;
    bool with_fleet = false;  // the whole fleet was paused; else this vehicle alone
    friend bool operator==(const Pause&, const Pause&) = default;
};

/// What a pose that is known rests on.
struct PoseBasis {
    enum class Kind {
        kVehicle,    // the vehicle's own word and no more
        kCodes,      // surveyed codes that its cameras saw when it became known
        kStop,       // a stop that was measured at a station
        kStatement,  // a person's word
        kReceivers,  // iGPS, when it became known
        kReflectors  // those around its navigation scanner, the same
    };
    Kind kind = Kind::kVehicle;
    plant::StationId station;  // of the stop
    std::string actor;         // of the statement
    Time at;
    double driven_m = 0;  // since then, by the vehicle's own reckoning
};

/// Where a load is, and since when. It survives a restart.
struct LoadRecord {
    plant::LoadId id;
    plant::VehicleId vehicle;  // that carries it
    plant::StationId station;  // on whose support it is; both empty: it is not in the plant
    Time at;
    std::string actor;  // whoever has put it there; empty: the plant has it there at first
};

/// What is known of a load. It survives a restart, and what people have said of it stands before
/// what the plant's file says.
struct LoadSheet {
    plant::Load load;
    Time at;               // when it was said
    std::string actor;     // by whom; empty: the plant's file says it
    bool retired = false;  // it has left for ever, and its id is never given again
};

/// What survives a restart about a vehicle.
struct VehicleRecord {
    plant::VehicleId id;
    bool pose_known = false;
    Pose2 pose;        // last confirmed
    std::string hall;  // of it; empty: of its home
    /// Where it says that it stands, which cannot be true. Its floor is held beside that of `pose`
    /// until a person has said where it stands; `pose_known` is false as long.
    std::optional<Whereabouts> claim;
    plant::StationId at_station;  // empty while between stations
    LegId leg;                    // the drive it was last told, until finished or given up
    bool has_leg = false;
    Leg leg_data;
    bool needs_resume = false;  // a person must allow it to move again
    Reason needs_resume_reason;
    std::optional<Pause> paused;  // by a person, through the server
    Integration integration = Integration::kUtilise;
    StopRecordId last_stop;  // newest measured stop, empty before the first
    plant::StationId last_stop_station;
    bool last_stop_inside = false;
    std::optional<PoseBasis> basis;  // of the pose; none before it was known
};

}  // namespace pulseline::fleet
