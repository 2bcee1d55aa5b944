#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/key.hpp"
#include "core/geometry/polygon.hpp"
#include "core/geometry/pose2.hpp"
#include "core/plant/occupancy_grid.hpp"
#include "core/plant/vehicle_type.hpp"

/// The plant model: plain data as a plant file states it. validate.hpp says what must hold.
namespace pulseline::plant {

using HallId = Key<struct HallTag>;
using StationId = Key<struct StationTag>;
using MarkerId = Key<struct MarkerTag>;
using NodeId = Key<struct NodeTag>;
using EdgeId = Key<struct EdgeTag>;
using AreaId = Key<struct AreaTag>;
using VehicleId = Key<struct VehicleTag>;
using TransmitterId = Key<struct TransmitterTag>;
using ReflectorId = Key<struct ReflectorTag>;
using LoadId = Key<struct LoadTag>;

enum class LoadKind { kAirframe, kProduct, kInstrument };
enum class AreaKind { kZone, kLane, kNoGo, kObstacle };

struct Hall {
    HallId id;
    std::string name;
    Polygon outline;             // inner side of the walls, hall frame
    std::string occupancy_yaml;  // ROS map_server YAML beside the plant file; empty: outline +
                                 // obstacles only
    OccupancyGrid grid;          // loaded from it; empty without one
    Names names;
};

/// Where a stop must end up, in the hall frame: a box or an ellipse about the theoretical position.
struct Tolerance {
    enum class Shape { kBox, kEllipse };
    Shape shape = Shape::kBox;
    double dx_m = 0.025;  // half width; semi-axis of the ellipse. Tang 2020: +-25 mm, +-0.2 deg
    double dy_m = 0.025;
    double dheading_rad = 0.2 * 3.14159265358979323846 / 180.0;
};

/// Hoist or stands at a station, on which a load can hang or stand while no vehicle carries it
/// (Tang 2020, Fig. 4: station 0, preparation and hoisting).
struct Support {
    double height_m = 0.12;  // of the brackets of a vehicle below, at which they touch the load
    bool operator==(const Support&) const = default;
};

struct Station {
    StationId id;
    int number = 0;  // what people and codes say; unique in the plant
    std::string name;
    HallId hall;
    Pose2 pose;  // theoretical pose of the vehicle standing there
    Tolerance tolerance;
    std::vector<MarkerId> markers;  // codes below the cameras of a vehicle standing there
    NodeId node;                    // its roadmap node
    bool resting_place = false;     // vehicles may be sent there to wait
    bool charger = false;           // a vehicle standing there can charge; also a resting place
    std::optional<Support> support = {};  // none: loads come and go on vehicles only
    bool parks = false;  // who has feet stands on them there, where an order says nothing else
    std::vector<VehicleTypeId> vehicle_types;  // who may stop there; empty: everybody
    Names names;
};

struct Marker {
    MarkerId id;
    MarkerKind kind = MarkerKind::kQr;
    std::string payload;  // "ST01-F"; the number as text for AprilTag and landmark
    double size_m = 0.060;
    HallId hall;
    Pose2 pose;  // surveyed centre; heading: direction of the code's "up" edge
    double sigma_xy_m = 0.0001;
    double sigma_heading_rad = 0.0005;
};

/// A sheet of light that turns with a transmitter's head about its z axis. When the head gives the
/// pulse that counts its turns, the sheet lies at the points x of the transmitter's frame with
/// (a, b, 1) . x + offset_m = 0 (Wang, section 2).
struct LightPlane {
    double a = 0;
    double b = 0;
    double offset_m = 0;
    bool operator==(const LightPlane&) const = default;
};

/// A transmitter of iGPS as the bundle adjustment of its control network has it. Its first sheet
/// shines to the left of (a, b) and leans forward in the turn, its second one shines to the right
/// and leans backward, both by 30 degrees if nothing else is said, the second a quarter turn later.
struct Transmitter {
    TransmitterId id;
    HallId hall;
    Point2 position;  // of its head, hall frame
    double z_m = 2.5;
    /// Hall from transmitter: turned about x, then y, then z.
    double roll_rad = 0;
    double pitch_rad = 0;
    double heading_rad = 0;
    /// Turns a second. Each of a hall has its own: by it receivers tell them apart.
    double rate_hz = 40;
    LightPlane first{1.7320508075688772, 0, 0};
    LightPlane second{0, 1.7320508075688772, 0};
    double range_m = 40;
    double elevation_rad = 30 * 3.14159265358979323846 / 180;  // up and down from level, it shines
    // One sigma: of one sheet's passing, of its place per axis, of its turn about each axis.
    double sigma_rad = 1e-5;
    double sigma_place_m = 3e-5;
    double sigma_turn_rad = 3e-6;
};

/// An upright cylinder of reflecting sheet on a wall or a post. To a laser scanner it is far
/// brighter than anything else (Li 2022, section 5.1: "NAV350 with reflectors").
struct Reflector {
    ReflectorId id;
    HallId hall;
    Point2 position;         // of its axis, hall frame
    double sigma_m = 0.001;  // of its survey, per axis
};

struct Area {
    AreaId id;
    AreaKind kind = AreaKind::kZone;
    std::string name;
    HallId hall;
    Polygon outline;
    Names names;
};

struct Vehicle {
    VehicleId id;  // "TP-01", as people say it
    VehicleTypeId type;
    std::string manufacturer;   // VDA 5050 identity
    std::string serial_number;  // [A-Za-z0-9_.:-]+
    std::string name;
    StationId home;  // where the simulated one starts and where it rests
};

/// A thing that vehicles carry: an aircraft, a product, an instrument. Where it is changes as the
/// plant works and is the fleet's to know; here stands only where it is at first.
struct Load {
    LoadId id;
    std::string name;  // "A-101", as people say it
    LoadKind kind = LoadKind::kAirframe;
    std::string model;   // what it is one of; may be empty
    double mass_kg = 0;  // 0: nobody has weighed it
    Point2 centre;       // of gravity, from the middle of the brackets below it, along the body
    Polygon outline;     // body frame of the vehicle below it; empty: what its type usually carries
    std::vector<VehicleTypeId> vehicle_types;  // who may carry it; empty: whoever has brackets
    // At first; both empty: it is not in the plant yet.
    VehicleId vehicle;  // that carries it
    StationId station;  // on whose support it is
    Names names;
};

struct RoadmapNode {
    NodeId id;
    HallId hall;
    Point2 position;
};

/// Room beside a lane's line, seen along the way, in which a vehicle may leave the line to go round
/// something. All of it stays inside, load included (VDA 5050: corridorRefPoint CONTOUR).
struct Corridor {
    double left_m = 0;
    double right_m = 0;
    bool operator==(const Corridor&) const = default;
};

/// Directed edge; a two-way lane is two edges.
struct RoadmapEdge {
    EdgeId id;
    NodeId from;
    NodeId to;
    double max_speed_mps = 0;                  // 0: the vehicle's own limit
    std::vector<VehicleTypeId> vehicle_types;  // empty: everybody whose footprint fits
    std::optional<Corridor> corridor = {};     // none: vehicles keep to the line
};

/// Direction penalty (Li 2022 eq. 10 as corrected): cost = k_same x length +
/// (k_diff - k_same) x reference_step_m per change of direction of more than turn_threshold_rad.
struct RoutingCost {
    double k_same = 10;
    double k_diff = 20;
    double reference_step_m = 1.0;
    double turn_threshold_rad = 5.0 * 3.14159265358979323846 / 180.0;
    /// Per metre driven and metre of sigma that the body's place has there on an average (Passage);
    /// 0: how well a vehicle knows where it is costs nothing.
    double accuracy_k = 0;
};

struct Plant {
    std::string id;  // "pulse-line"
    std::string name;
    std::int64_t revision = 1;
    std::vector<Hall> halls;
    std::vector<Station> stations;
    std::vector<Marker> markers;
    std::vector<Transmitter> transmitters;
    std::vector<Reflector> reflectors;
    std::vector<Area> areas;
    std::vector<VehicleType> vehicle_types;
    std::vector<Vehicle> vehicles;
    std::vector<Load> loads;
    std::vector<RoadmapNode> nodes;
    std::vector<RoadmapEdge> edges;
    RoutingCost routing;
    Names names;
};

// Look-ups by key; nullptr when there is none. Pointers live as long as the plant is unchanged.
const Hall* find_hall(const Plant& plant, const HallId& id);
const Station* find_station(const Plant& plant, const StationId& id);
const Station* find_station(const Plant& plant, int number);
const Marker* find_marker(const Plant& plant, const MarkerId& id);
const Marker* find_marker_by_payload(const Plant& plant, const std::string& payload);
const VehicleType* find_vehicle_type(const Plant& plant, const VehicleTypeId& id);
const Vehicle* find_vehicle(const Plant& plant, const VehicleId& id);
const Vehicle* find_vehicle(const Plant& plant, const std::string& manufacturer,
                            const std::string& serial_number);
const RoadmapNode* find_node(const Plant& plant, const NodeId& id);
const Load* find_load(const Plant& plant, const LoadId& id);
/// What the vehicle carries at first; nullptr: nothing.
const Load* first_load(const Plant& plant, const VehicleId& vehicle);
/// The floor of a corridor along a straight way, `beyond_m` longer at both ends; convex. REQUIRES:
/// the ends differ.
Polygon corridor_band(Point2 from, Point2 to, const Corridor& corridor, double beyond_m);

const char* to_string(AreaKind kind);           // "zone", "lane", "no_go", "obstacle"
const char* to_string(Tolerance::Shape shape);  // "box", "ellipse"
const char* to_string(LoadKind kind);           // "airframe", "product", "instrument"

}  // namespace pulseline::plant
