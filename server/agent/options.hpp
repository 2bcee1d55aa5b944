#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "core/geometry/pose2.hpp"

namespace pulseline::agent {

struct Identity {
    std::string manufacturer;
    std::string serial_number;
    std::string token;
};

struct ServerAddress {
    bool tls = false;
    std::string host;
    std::string port;
};

struct Fault {
    enum class Kind {
        kWheel,
        kBearing,
        kMarkerLost,
        kSlip,
        kEncoder,
        kDark,
        kObstacle,
        kWayFree,
        kTransmitterDark,
        kScannerCovered,
        kLookOutCovered,
        kCarried,
        kBracketOff,
        kPit
    };
    Kind kind = Kind::kWheel;
    std::string part;        // the wheel, the transmitter, the bracket or the foot
    double share = 0;        // of the rim's speed that slips
    geometry::Point2 place;  // of the obstacle's centre, hall frame; it is 0.5 m wide and long
    double after_s = 0;
    bool driving = false;          // after that, the next time it drives fast
    geometry::Pose2 carried = {};  // to where, seen from where it was
    double by_m = 0;               // that the bracket is higher than it tells
};

/// Where the pictures of one of a vehicle's cameras come from.
struct CameraSource {
    enum class Kind { kV4l2, kFile };
    std::string camera;
    Kind kind = Kind::kFile;
    std::string where;  // device or path
};

struct Options {
    ServerAddress server;
    std::vector<Identity> vehicles;
    std::string world_file;
    std::string truth_log;  // empty: none
    std::string maps;       // folder with maps of halls; empty: scanners only look out
    std::string learned;    // folder for what the vehicles learn; empty: none
    std::string hand_held;  // socket of a hand-held control; empty: none
    std::string machine;    // tcp://HOST:PORT of its controller; empty: simulated
    double machine_watchdog_s = 0.1;
    std::vector<CameraSource> cameras;  // of which its controller takes no pictures
    std::string belief_log;             // what a program with a controller knows; empty: none
    std::uint64_t seed = 1;
    std::string errors = "nominal";  // how well machines and floor are kept: nominal, kind, harsh
    double time_factor = 1;
    bool rendered = true;
    bool servo_drive = true;
    std::optional<double> battery_percent;  // of every vehicle at start; absent: by the seed
    bool insecure = false;
    std::string ca_file;
    std::vector<Fault> faults;
};

/// Reads the command line. nullopt with `exit_code` set: help was shown or an error told.
std::optional<Options> read_options(int argc, char** argv, int& exit_code);

/// "ws://host:port" or "wss://host:port"; a port is optional.
[[nodiscard]] Result<ServerAddress> parse_server(const std::string& url);
/// All that parse_fault() reads, for people.
inline constexpr const char* kFaultForms =
    "wheel=NAME, bearing=NAME, encoder=NAME, slip=NAME:SHARE, marker-lost, camera-dark, "
    "transmitter-dark=NAME, scanner-covered, look-out-covered, obstacle=X,Y, way-free, "
    "carried=AHEAD,LEFT,DEGREES, bracket-off=NAME:METRES and pit=FOOT, each with @SECONDS or "
    "without, and behind driving: (it waits until the vehicle drives fast) or not";
/// "wheel=FL@20", "slip=FL:0.2@20", "encoder=FL@20" or "marker-lost@5"; "@SECONDS" is optional.
[[nodiscard]] Result<Fault> parse_fault(const std::string& text);
/// "NAME=v4l2:DEVICE" or "NAME=file:PATH".
[[nodiscard]] Result<CameraSource> parse_camera(const std::string& text);
/// Lines "MAKER/SERIAL TOKEN"; empty ones and # comments are skipped.
[[nodiscard]] Result<std::vector<Identity>> parse_vehicle_list(const std::string& text);

}  // namespace pulseline::agent
