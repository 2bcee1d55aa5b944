#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.hpp"

/// The frames between a vehicle's program and the controller of its machine (Tang 2020, section
/// 2.1: industrial computer and PLC over TCP/IP); server/agent/MACHINE.md is their page. Little
/// endian; numbers in SI units, in the order of the members here; texts behind their length.
namespace pulseline::machine {

constexpr std::uint16_t kVersion = 3;
/// Of one frame behind its length: a picture of one camera and what is around it.
constexpr std::size_t kLargestFrame = 4U << 20U;
constexpr std::size_t kMostParts =
    64;  // wheels, axes, brackets, feet, cameras or scanners of one machine
constexpr std::size_t kMostRays = 4096;  // of one turn of a laser scanner

/// From the program, first of all. Before it nothing else is taken.
struct Hello {
    struct Axis {
        std::string name;  // "front drive/steering"
        double position_gain_per_s = 0;
        bool operator==(const Axis&) const = default;
    };
    std::uint16_t version = kVersion;
    double cycle_s = 0.01;    // between two set points
    double watchdog_s = 0.1;  // without one for so long the brakes fall in
    std::vector<Axis> axes;   // what the plant has of the position loops that it closes
    bool operator==(const Hello&) const = default;
};

/// From the machine, the answer to Hello.
struct Description {
    std::uint16_t version = kVersion;
    std::string maker;
    std::uint16_t dead_cycles = 0;  // between a set point and what the drives do with it
    std::vector<std::string> wheels;
    std::vector<std::string> brackets;
    std::vector<std::string> feet;
    std::vector<std::string> cameras;
    std::vector<std::string> scanners;
    bool operator==(const Description&) const = default;
};

enum class Mode : std::uint8_t { kBraked, kSteer, kRoll };

/// From the program, once a cycle; the machine answers with Feedback.
struct SetPoints {
    struct Wheel {
        double speed_mps = 0;  // of its rim
        double angle_rad = 0;  // of its rolling direction, body frame
        bool operator==(const Wheel&) const = default;
    };
    std::uint32_t cycle = 0;
    Mode mode = Mode::kBraked;
    std::vector<Wheel> wheels;  // all of them, in the order of the description
    bool operator==(const SetPoints&) const = default;
};

struct Feedback {
    struct Wheel {
        double speed_mps = 0;  // as its encoder tells
        double angle_rad = 0;
        double steered_to_rad = 0;  // what its drive is on the way to
        double temperature_c = 0;
        std::string fault;  // its drive is off, or it does not follow: "drive_fault"; empty: none
        bool lagging = false;  // so far behind that its encoder is to blame
        bool operator==(const Wheel&) const = default;
    };
    struct Bracket {
        double height_m = 0;
        double force_a_n = 0;
        double force_b_n = 0;
        bool operator==(const Bracket&) const = default;
    };
    struct Foot {
        double extension_m = 0;
        double force_n = 0;
        bool operator==(const Foot&) const = default;
    };
    std::uint32_t cycle = 0;  // of the set points that it answers
    bool settled = false;     // stands, and the position loops have come to rest
    bool moving_lifts = false;
    bool charging = false;
    bool stopped = false;              // by its own safety circuit
    std::optional<double> slip_share;  // by measuring wheels; none, or too slow to say
    double battery_percent = 0;
    std::vector<Wheel> wheels;
    std::vector<Bracket> brackets;
    std::vector<Foot> feet;
    bool operator==(const Feedback&) const = default;
};

/// From the program, at any time: what it does standing. One at a time.
struct Lift {
    enum class What : std::uint8_t {
        kBracketHeight,
        kLowerFeet,
        kRaiseFeet,
        kStartCharging,
        kStopCharging
    };
    std::uint32_t id = 0;
    What what = What::kBracketHeight;
    std::optional<std::uint8_t> one;  // of brackets or feet; none: all
    double height_m = 0;              // of brackets
    std::optional<double> speed_mps;  // of brackets; none: as fast as they can
    bool operator==(const Lift&) const = default;
};

/// From the machine: refused or failed says why, as "code: name value, name value".
struct LiftEnded {
    enum class Outcome : std::uint8_t { kDone, kFailed, kRefused };
    std::uint32_t id = 0;
    Outcome outcome = Outcome::kDone;
    std::string why;
    bool operator==(const LiftEnded&) const = default;
};

/// From the program: what lifts stays where it is.
struct StopLifts {
    bool operator==(const StopLifts&) const = default;
};

/// From the program: that wheel's motor off until the brakes have fallen in.
struct SwitchOff {
    std::uint8_t wheel = 0;
    bool operator==(const SwitchOff&) const = default;
};

/// From the program: a picture, now.
struct Expose {
    std::uint32_t id = 0;
    std::uint8_t camera = 0;
    bool operator==(const Expose&) const = default;
};

/// From the machine: what a camera saw, 8 bit grey, row by row.
struct Picture {
    std::uint32_t id = 0;
    std::uint8_t camera = 0;
    double age_s = 0;  // since it was exposed
    std::uint16_t width_px = 0;
    std::uint16_t height_px = 0;
    std::string grey;
    bool operator==(const Picture&) const = default;
};

/// From the program: what all laser scanners see, now.
struct Look {
    std::uint32_t id = 0;
    bool operator==(const Look&) const = default;
};

/// From the machine: the newest turn of each scanner, in the order of the description.
struct Scans {
    struct Scan {
        double first_rad = 0;  // of the first ray, in the scanner's own frame
        double step_rad = 0;
        bool blind = false;           // its window is dirty or covered, as it says itself
        std::vector<float> ranges_m;  // 0: nothing came back
        bool operator==(const Scan&) const = default;
    };
    std::uint32_t id = 0;
    std::vector<Scan> scans;
    bool operator==(const Scans&) const = default;
};

/// From the machine, and then it closes: why it does not talk to this program.
struct Refused {
    std::string why;
    bool operator==(const Refused&) const = default;
};

using Frame = std::variant<Hello, Description, SetPoints, Feedback, Lift, LiftEnded, StopLifts,
                           SwitchOff, Expose, Picture, Refused, Look, Scans>;

/// Length and all. REQUIRES: no more parts or bytes than a frame may have.
std::string encode(const Frame& frame);

/// How long the frame is that begins with these bytes, length and all; nothing: too few to say.
/// Errors: machine_frame_too_long {bytes}.
Result<std::optional<std::size_t>> frame_size(std::string_view bytes);

/// A whole frame. Errors: machine_frame_broken {why}: an unknown type, too short or too long, a
/// number that is none, a count above kMostParts, a picture that is not of its size.
Result<Frame> decode(std::string_view frame);

}  // namespace pulseline::machine
