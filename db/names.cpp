#include "db/names.hpp"

#include <array>
#include <utility>

#include "db/error.hpp"

namespace pulseline::db {
namespace {

using fleet::JobState;
using fleet::StepState;

constexpr std::array kJobStates = {std::pair{JobState::kNotAllowedToStart, "NotAllowedToStart"},
                                   std::pair{JobState::kAllowedToStart, "AllowedToStart"},
                                   std::pair{JobState::kRunning, "Running"},
                                   std::pair{JobState::kInterrupted, "Interrupted"},
                                   std::pair{JobState::kEnded, "Ended"},
                                   std::pair{JobState::kAborted, "Aborted"}};
constexpr std::array kStepStates = {
    std::pair{StepState::kPending, "pending"}, std::pair{StepState::kDriving, "driving"},
    std::pair{StepState::kMeasuring, "measuring"}, std::pair{StepState::kDone, "done"},
    std::pair{StepState::kSkipped, "skipped"}};
constexpr std::array kStepPhases = {std::pair{fleet::StepPhase::kBefore, "before"},
                                    std::pair{fleet::StepPhase::kDrive, "drive"},
                                    std::pair{fleet::StepPhase::kAfter, "after"}};
constexpr std::array kIntegrations = {std::pair{fleet::Integration::kIgnore, "ignore"},
                                      std::pair{fleet::Integration::kNotice, "notice"},
                                      std::pair{fleet::Integration::kRespect, "respect"},
                                      std::pair{fleet::Integration::kUtilise, "utilise"}};
constexpr std::array kBases = {std::pair{fleet::PoseBasis::Kind::kVehicle, "vehicle"},
                               std::pair{fleet::PoseBasis::Kind::kCodes, "codes"},
                               std::pair{fleet::PoseBasis::Kind::kStop, "stop"},
                               std::pair{fleet::PoseBasis::Kind::kStatement, "statement"},
                               std::pair{fleet::PoseBasis::Kind::kReceivers, "receivers"},
                               std::pair{fleet::PoseBasis::Kind::kReflectors, "reflectors"}};

[[noreturn]] void unknown(const std::string& name) {
    throw Error(Error::Kind::kBadValue,
                "The database holds an unknown name \"" + name + "\"; restore a backup.");
}

template <class Table, class T>
void find(const Table& table, const std::string& name, T& to) {
    for (const auto& [value, text] : table) {
        if (name == text) {
            to = value;
            return;
        }
    }
    unknown(name);
}

template <class Table, class T>
const char* name_of(const Table& table, T value) {
    for (const auto& [candidate, text] : table) {
        if (candidate == value) return text;
    }
    throw Error(Error::Kind::kBadValue, "An enumerator without a stored name.");
}

template <class T>
void find_plain(std::initializer_list<T> values, const std::string& name, T& to) {
    for (const T value : values) {
        if (name == plant::to_string(value)) {
            to = value;
            return;
        }
    }
    unknown(name);
}

}  // namespace

const char* stored(JobState state) { return name_of(kJobStates, state); }
const char* stored(StepState state) { return name_of(kStepStates, state); }
const char* stored(fleet::StepPhase phase) { return name_of(kStepPhases, phase); }
const char* stored(fleet::Integration level) { return name_of(kIntegrations, level); }
const char* stored(fleet::PoseBasis::Kind kind) { return name_of(kBases, kind); }
const char* stored(plant::Tolerance::Shape shape) { return plant::to_string(shape); }

void read(const std::string& name, JobState& to) { find(kJobStates, name, to); }
void read(const std::string& name, StepState& to) { find(kStepStates, name, to); }
void read(const std::string& name, fleet::StepPhase& to) { find(kStepPhases, name, to); }
void read(const std::string& name, fleet::Integration& to) { find(kIntegrations, name, to); }
void read(const std::string& name, fleet::PoseBasis::Kind& to) { find(kBases, name, to); }
void read(const std::string& name, plant::Tolerance::Shape& to) {
    find_plain({plant::Tolerance::Shape::kBox, plant::Tolerance::Shape::kEllipse}, name, to);
}
void read(const std::string& name, plant::MotionMode& to) {
    const auto mode = plant::parse_motion_mode(name);
    if (!mode) unknown(name);
    to = *mode;
}
void read(const std::string& name, plant::Kinematics& to) {
    find_plain({plant::Kinematics::kSteeredPlatform, plant::Kinematics::kMecanum,
                plant::Kinematics::kDifferential},
               name, to);
}
void read(const std::string& name, plant::MarkerKind& to) {
    find_plain({plant::MarkerKind::kQr, plant::MarkerKind::kAprilTag, plant::MarkerKind::kLandmark},
               name, to);
}
void read(const std::string& name, plant::AreaKind& to) {
    find_plain({plant::AreaKind::kZone, plant::AreaKind::kLane, plant::AreaKind::kNoGo,
                plant::AreaKind::kObstacle},
               name, to);
}

void read(const std::string& name, plant::LoadKind& to) {
    find_plain(
        {plant::LoadKind::kAirframe, plant::LoadKind::kProduct, plant::LoadKind::kInstrument}, name,
        to);
}

std::int64_t count(std::int64_t value) {
    constexpr std::int64_t kMost = std::int64_t{1} << 53;  // JSON's readers hold no more
    if (value >= 0 && value <= kMost) return value;
    throw Error(Error::Kind::kBadValue, "The database holds a count that cannot be: " +
                                            std::to_string(value) + "; restore a backup.");
}

void bad_id(const std::string& text) {
    throw Error(Error::Kind::kBadValue,
                "The database holds a damaged id \"" + text + "\"; restore a backup.");
}

}  // namespace pulseline::db
