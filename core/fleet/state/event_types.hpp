#pragma once

/// Types of the fleet's events, as the event sequence stores and tells them.
namespace pulseline::fleet::event {

inline constexpr const char* kClockAgrees = "clock.agrees";
inline constexpr const char* kClockDiffers = "clock.differs";
inline constexpr const char* kClockWasAhead = "clock.was_ahead";
inline constexpr const char* kFleetPaused = "fleet.paused";
inline constexpr const char* kFloorClosed = "floor.closed";
inline constexpr const char* kFloorReopened = "floor.reopened";
inline constexpr const char* kJobOrderCancelRequested = "job_order.cancel_requested";
inline constexpr const char* kJobOrderCreated = "job_order.created";
inline constexpr const char* kJobOrderRemoved = "job_order.removed";
inline constexpr const char* kJobOrderState = "job_order.state";
inline constexpr const char* kJobOrderStopRequested = "job_order.stop_requested";
inline constexpr const char* kJobOrderUpdated = "job_order.updated";
inline constexpr const char* kJobOrderWaits = "job_order.waits";
inline constexpr const char* kJobOrderScheduleCreated = "job_order_schedule.created";
inline constexpr const char* kJobOrderScheduleDeleted = "job_order_schedule.deleted";
inline constexpr const char* kJobOrderScheduleMade = "job_order_schedule.made";
inline constexpr const char* kJobOrderScheduleOver = "job_order_schedule.over";
inline constexpr const char* kJobOrderSchedulePaused = "job_order_schedule.paused";
inline constexpr const char* kJobOrderScheduleResumed = "job_order_schedule.resumed";
inline constexpr const char* kJobOrderScheduleSkipped = "job_order_schedule.skipped";
inline constexpr const char* kJobOrderTemplateCreated = "job_order_template.created";
inline constexpr const char* kJobOrderTemplateDeleted = "job_order_template.deleted";
inline constexpr const char* kLegAccepted = "leg.accepted";
inline constexpr const char* kLegCancelRequested = "leg.cancel_requested";
inline constexpr const char* kLegEnded = "leg.ended";
inline constexpr const char* kLegReleased = "leg.released";
inline constexpr const char* kLegRerouted = "leg.rerouted";
inline constexpr const char* kLoadChanged = "load.changed";
inline constexpr const char* kLoadMoved = "load.moved";
inline constexpr const char* kLoadRegistered = "load.registered";
inline constexpr const char* kLoadRetired = "load.retired";
inline constexpr const char* kServerStoodStill = "server.stood_still";
inline constexpr const char* kStepActionDone = "step.action_done";
inline constexpr const char* kStepActionFailed = "step.action_failed";
inline constexpr const char* kStepActions = "step.actions";
inline constexpr const char* kStepStarted = "step.started";
inline constexpr const char* kStopMeasured = "stop.measured";
inline constexpr const char* kStopNotMeasured = "stop.not_measured";
inline constexpr const char* kStoreFailed = "store.failed";
inline constexpr const char* kStoreRecovered = "store.recovered";
inline constexpr const char* kTrafficViolation = "traffic.violation";
inline constexpr const char* kVehicleAction = "vehicle.action";
inline constexpr const char* kVehicleActionUnconfirmed = "vehicle.action_unconfirmed";
inline constexpr const char* kVehicleChargeFailed = "vehicle.charge_failed";
inline constexpr const char* kVehicleConnected = "vehicle.connected";
inline constexpr const char* kVehicleDisconnected = "vehicle.disconnected";
inline constexpr const char* kVehicleError = "vehicle.error";
inline constexpr const char* kVehicleErrorsWithheld = "vehicle.errors_withheld";
inline constexpr const char* kVehicleFloorCleared = "vehicle.floor_cleared";
inline constexpr const char* kVehicleFloorConflict = "vehicle.floor_conflict";
inline constexpr const char* kVehicleForeignOrderCancelled = "vehicle.foreign_order_cancelled";
inline constexpr const char* kVehicleGoesCharging = "vehicle.goes_charging";
inline constexpr const char* kVehicleInitPosition = "vehicle.init_position";
inline constexpr const char* kVehicleIntegration = "vehicle.integration";
inline constexpr const char* kVehicleLifts = "vehicle.lifts";
inline constexpr const char* kVehicleLiftsStopped = "vehicle.lifts_stopped";
inline constexpr const char* kVehicleLink = "vehicle.link";
inline constexpr const char* kVehicleMakesWay = "vehicle.makes_way";
inline constexpr const char* kVehicleMessageMalformed = "vehicle.message_malformed";
inline constexpr const char* kVehicleNeedsResume = "vehicle.needs_resume";
inline constexpr const char* kVehicleOperatingMode = "vehicle.operating_mode";
inline constexpr const char* kVehiclePaused = "vehicle.paused";
inline constexpr const char* kVehiclePoseConfirmed = "vehicle.pose_confirmed";
inline constexpr const char* kVehiclePoseJumped = "vehicle.pose_jumped";
inline constexpr const char* kVehiclePoseLost = "vehicle.pose_lost";
inline constexpr const char* kVehicleResumed = "vehicle.resumed";

}  // namespace pulseline::fleet::event
