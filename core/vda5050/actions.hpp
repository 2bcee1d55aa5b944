#pragma once

#include <string_view>

/// Names of the VDA 5050 actions that fleet and vehicles know, predefined ones and those that are
/// announced in a factsheet. A name lives here only: whoever decides by one includes this.
namespace pulseline::vda5050 {

// Instant actions of every vehicle.
inline constexpr const char* kCancelOrder = "cancelOrder";
inline constexpr const char* kStartPause = "startPause";
inline constexpr const char* kStopPause = "stopPause";
inline constexpr const char* kStateRequest = "stateRequest";
inline constexpr const char* kFactsheetRequest = "factsheetRequest";
inline constexpr const char* kLogReport = "logReport";
inline constexpr const char* kInitPosition = "initPosition";

// Of vehicles with receivers of iGPS: where the transmitters of their hall stand. It is the system
// layer of Wang, section 2, which all share; what a receiver measures by it is the task layer.
inline constexpr const char* kSetTransmitters = "setTransmitters";

// Of vehicles with a navigation scanner: where the reflectors of their hall stand.
inline constexpr const char* kSetReflectors = "setReflectors";

// Standing at a node.
inline constexpr const char* kMeasureStop = "measureStop";
inline constexpr const char* kAdjustToMarker = "adjustToMarker";
inline constexpr const char* kStartCharging = "startCharging";
inline constexpr const char* kStopCharging = "stopCharging";
inline constexpr const char* kRaiseParking = "raiseParking";
inline constexpr const char* kLowerParking = "lowerParking";
inline constexpr const char* kSetBracketHeight = "setBracketHeight";

// Whatever of brackets and feet moves stays where it is: an instant action of vehicles with lifts.
inline constexpr const char* kStopLifts = "stopLifts";

// Takes a load over from what holds it, and sets it down there (VDA 5050, 6.8.2: loadId, weight).
inline constexpr const char* kPick = "pick";
inline constexpr const char* kDrop = "drop";
/// Error of a vehicle: a transfer was broken off, and it stays where it is with a part of the load.
inline constexpr const char* kLoadHalfTaken = "loadHalfTaken";
inline constexpr const char* kLoadHalfTakenWords =
    "A part of the load still hangs or stands. Take it over or set it down first.";

inline bool is_transfer(std::string_view action_type) {
    return action_type == kPick || action_type == kDrop;
}

/// Moves brackets or parking feet: at a node of an order, or by itself as an instant action.
inline bool is_lift(std::string_view action_type) {
    return action_type == kRaiseParking || action_type == kLowerParking ||
           action_type == kSetBracketHeight || is_transfer(action_type);
}

// On an edge, while it is driven: look for these codes; go slowly enough to arrive precisely.
inline constexpr const char* kObserveMarkers = "observeMarkers";
inline constexpr const char* kFinePositioning = "finePositioning";

}  // namespace pulseline::vda5050
