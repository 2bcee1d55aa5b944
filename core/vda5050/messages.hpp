#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/geometry/pose2.hpp"
#include "core/kinematics/motion.hpp"
#include "core/vda5050/actions.hpp"

/// What fleet and vehicle say to each other, in the shape of VDA 5050 2.1 but as plain data.
/// api/vda5050 turns these into JSON and back; fleet, agent and simulation speak only these.
namespace pulseline::vda5050 {

using geometry::Pose2;

/// A code on the floor as the server's survey has it.
struct SurveyedMarker {
    std::string payload;
    std::string kind;  // "qr"
    double size_m = 0;
    Pose2 pose;  // heading: VDA-side name angle_rad
    double sigma_m = 0;
    double sigma_rad = 0;  // of its direction
};

/// What a stop must be measured against; the server owns the survey.
struct StopTarget {
    std::string station_id;
    int station_number = 0;
    Pose2 target;
    double tolerance_x_m = 0;
    double tolerance_y_m = 0;
    double tolerance_heading_rad = 0;
    std::vector<SurveyedMarker> markers;
};

struct InitPosition {
    Pose2 pose;
    std::string map_id;
    std::string last_node_id = {};
    // How well it is known; 0: as well as a person knows it who points there.
    double sigma_xy_m = 0;
    double sigma_heading_rad = 0;
    bool worked_out = false;  // from what its sensors see; else a person has said so
};

enum class BlockingType { kNone, kSoft, kHard };

/// An action of an order or an instant action.
struct Action {
    std::string type;  // "measureStop", "adjustToMarker", "cancelOrder", ...
    std::string id;
    BlockingType blocking = BlockingType::kHard;
    std::optional<StopTarget> stop_target;      // measureStop, adjustToMarker
    std::optional<InitPosition> init_position;  // initPosition
    Params params;                              // any further plain parameters
    std::vector<SurveyedMarker> markers = {};   // observeMarkers: codes that the cameras pass over
    std::vector<plant::Transmitter> transmitters = {};  // setTransmitters: all of its hall
    std::vector<plant::Reflector> reflectors = {};      // setReflectors: the same
    // observeMarkers: those of `markers`, by payload, that its way relies on, the boundary marker
    // among them, which is named again.
    std::vector<std::string> segment_markers = {};
    std::string boundary_marker = {};
};

struct OrderNode {
    std::string node_id;
    std::int64_t sequence_id = 0;  // even
    bool released = false;
    Pose2 pose;
    bool has_heading = true;  // heading must match before the node counts as reached
    double allowed_deviation_xy_m = 0.05;
    double allowed_deviation_theta_rad = 0.02;
    std::string map_id;
    std::vector<Action> actions;
};

/// Edge between nodes[i] and nodes[i+1]. On the wire: kRotate = rotation edge (same place, other
/// theta, rotationAllowed, no trajectory); kStraight = straight, orientation = direction_rad
/// TANGENTIAL measured between travel direction and heading; kArc = NURBS arc below pi.
struct OrderEdge {
    std::string edge_id;
    std::int64_t sequence_id = 0;  // odd
    bool released = false;
    kinematics::Segment segment;
    double max_speed_mps = 0;  // 0: vehicle's own limit
    /// Room to go round something, on straight edges; none: the vehicle keeps to its path.
    std::optional<plant::Corridor> corridor = {};
    /// From entering the edge to leaving it, at the latest. Our fleet asks for observeMarkers only,
    /// of the survey as it is when the order is sent; a stored leg has none.
    std::vector<Action> actions = {};
};

struct OrderMessage {
    std::string order_id;
    std::int64_t order_update_id = 0;
    std::vector<OrderNode> nodes;
    std::vector<OrderEdge> edges;
};

struct InstantActionsMessage {
    std::vector<Action> actions;
};

enum class ActionStatus { kWaiting, kInitializing, kRunning, kPaused, kFinished, kFailed };

/// What a measureStop found (hall frame); decoded from resultDescription.
struct StopMeasurement {
    Pose2 pose;
    double sigma_xy_m = 0;
    double sigma_heading_rad = 0;
    std::string method;                // "dual_camera", "single_camera", "igps"
    std::vector<std::string> markers;  // payloads used; transmitters, by iGPS
    /// Where the drive itself had ended: what was measured before the first small move.
    std::optional<Pose2> arrived = {};
};

struct ActionState {
    std::string id;
    std::string type;
    ActionStatus status = ActionStatus::kWaiting;
    std::string result_description;  // as sent; reason when it failed
    std::optional<StopMeasurement> measurement;
};

struct VehicleError {
    std::string type;
    bool fatal = false;
    std::string description;
    std::vector<std::pair<std::string, std::string>> references;
};

/// Of a mechanism that holds the load; those without a sensor leave its value out.
struct BracketStatus {
    std::string name;
    double force_a_n = 0;
    double force_b_n = 0;
    std::optional<double> height_m = {};  // above its lower end
};

struct WheelStatus {
    std::string name;
    double steering_rad = 0;
    double speed_mps = 0;
    double temperature_c = 0;
    std::string fault;  // empty: none
};

/// A code seen by a camera, in the body frame (x forward, y left).
struct CameraReading {
    std::string camera;  // "front"
    bool found = false;
    std::string payload;
    geometry::Point2 code;  // centre of the code in the body frame
    double angle_rad = 0;   // direction of the code's up edge in the body frame, ccw
    double sigma_m = 0;
    double rms_px = 0;
    std::string why_not;  // when not found
};

/// Where a receiver of iGPS is by the light of the transmitters, hall frame.
struct ReceiverReading {
    std::string receiver;  // "front left"
    bool found = false;
    geometry::Point2 place;
    double z_m = 0;
    double sigma_m = 0;                     // per axis of the floor's plane
    std::vector<std::string> transmitters;  // whose light falls on it
    std::string why_not;                    // when not found
};

/// A reflector as a navigation scanner sees it; which one it is, nobody has said.
struct ReflectorSight {
    geometry::Point2 place;  // of its axis, body frame
    double sigma_m = 0;      // per axis
};

/// That a state tells of: more make no pose better, and each costs whoever has to name them.
inline constexpr std::size_t kMostReflectorSights = 12;

/// By what the vehicle knew last where it is, by its own word.
struct NavigationStatus {
    std::string by;       // person, stop, codes, igps, reflectors, contours; empty: it has not said
    double driven_m = 0;  // since then, by its wheels
    /// Of what its laser scanners meet, the share that its map of the hall has; negative: no map.
    double explained = -1;
    std::string why_not;  // reason code, when the scanners do not fit the map
};

/// What a sense said of the vehicle's place, and what the vehicle made of it.
struct PoseFixReport {
    std::string by;      // as NavigationStatus::by
    std::string what;    // payload of a code, as it reads; empty: no code
    std::string result;  // taken, agreed (better known), refused, begun_anew (its wheels are not)
    std::string why;     // reason code of a refusal
    double moved_m = 0;  // by how much it moved the pose, or would have
    double turned_rad = 0;   // the same
    std::int64_t times = 1;  // alike
    double ago_s = 0;        // the newest of them, before the state message
};
inline constexpr std::size_t kMostPoseFixes = 10;

struct ParkingFoot {
    std::string name;
    double extension_m = 0;
    std::optional<double> force_n = {};  // by which it stands on the floor
};

struct NodeState {
    std::string node_id;
    std::int64_t sequence_id = 0;
    bool released = false;
};

struct StateMessage {
    std::int64_t header_id = 0;
    std::string timestamp;
    std::string order_id;
    std::int64_t order_update_id = 0;
    std::string last_node_id;
    std::int64_t last_node_sequence_id = 0;
    std::vector<NodeState> node_states;
    std::vector<NodeState> edge_states;
    bool driving = false;
    bool paused = false;
    bool new_base_request = false;
    double distance_since_last_node_m = 0;
    std::string operating_mode = "AUTOMATIC";
    /// In MANUAL: who has the hand-held control; empty: somebody beside the vehicle.
    std::optional<std::string> in_hand_of;
    std::optional<Pose2> pose;
    bool position_initialized = false;
    double localization_score = 0;
    double deviation_range_m = 0;
    std::string map_id;
    double velocity_mps = 0;
    double turn_rate_radps = 0;
    double battery_percent = 100;
    bool charging = false;
    std::string e_stop = "NONE";  // shown, never written
    bool field_violation = false;
    std::vector<ActionState> action_states;
    std::vector<VehicleError> errors;
    std::vector<BracketStatus> brackets;
    std::vector<WheelStatus> wheels;
    std::vector<CameraReading> cameras;
    std::vector<ReceiverReading> receivers;
    std::vector<ReflectorSight> reflectors;  // the nearest, kMostReflectorSights of them
    NavigationStatus navigation;
    std::vector<ParkingFoot> parking_feet;
    double load_kg = 0;
    std::vector<PoseFixReport> fixes;  // shown, never decided by; the newest first
};

struct VisualizationMessage {
    Pose2 pose;
    bool position_initialized = false;
    double velocity_mps = 0;
    double turn_rate_radps = 0;
};

enum class ConnectionState { kOnline, kOffline, kConnectionBroken };

/// The part of a factsheet the server uses; `json` is what is shown and kept as retained.
struct Factsheet {
    std::string series_name;
    double speed_max_mps = 0;
    double acceleration_max_mps2 = 0;
    double length_m = 0;
    double width_m = 0;
    std::vector<std::string> actions;
    std::vector<std::string> node_actions;  // those of them that a node of an order may ask for
    std::vector<std::string> instant_actions = {};  // those that are done outside one
    std::string json;
};

}  // namespace pulseline::vda5050
