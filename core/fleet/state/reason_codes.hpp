#pragma once

/// Codes of stored reasons by which the fleet decides later: who sets one and who asks for it use
/// the same name. After a restart nothing else is left of why an order waits or was interrupted.
namespace pulseline::fleet::reasons {

inline constexpr const char* kServerRestarted = "server_restarted";
inline constexpr const char* kVehicleLostOrder = "vehicle_lost_order";
inline constexpr const char* kVehicleWasLost = "vehicle_was_lost";
inline constexpr const char* kVehiclePaused = "vehicle_paused";
inline constexpr const char* kOrderNotAccepted = "order_not_accepted";
inline constexpr const char* kOrderRejected = "order_rejected";
inline constexpr const char* kForeignOrder = "foreign_order";
inline constexpr const char* kIdentityConflict = "identity_conflict";
inline constexpr const char* kVehicleWithdrawn = "vehicle_withdrawn";
inline constexpr const char* kLoadOnWithdrawnVehicle = "load_on_withdrawn_vehicle";
inline constexpr const char* kDrivenByHand = "driven_by_hand";
inline constexpr const char* kVehicleError = "vehicle_error";
inline constexpr const char* kPoseJumped = "pose_jumped";
inline constexpr const char* kPoseLost = "pose_lost";
inline constexpr const char* kCommandExpired = "command_expired";
inline constexpr const char* kFloorClosed = "floor_closed";
inline constexpr const char* kGoesFirst = "goes_first";
inline constexpr const char* kVehicleGone = "vehicle_gone";
inline constexpr const char* kNoVehicle = "no_vehicle";

}  // namespace pulseline::fleet::reasons
