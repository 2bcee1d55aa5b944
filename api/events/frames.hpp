#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "api/http/wire/contexts.hpp"
#include "core/fleet/fleet.hpp"
#include "core/plant/plant.hpp"

/// What the web hears: frames of /api/v1/stream (StreamFrame of openapi.yaml) and of
/// /api/v1/events.
namespace pulseline::events {

/// Everything a dashboard draws at its start.
struct Snapshot {
    Time now;
    fleet::FleetView fleet;
    std::vector<fleet::VehicleView> vehicles;
    std::vector<fleet::StationView> stations;
    std::vector<fleet::JobOrder> job_orders;      // open ones and the newest 50 others
    std::vector<fleet::StopRecord> stop_records;  // the newest 50
};
std::string snapshot_frame(const plant::Plant& plant, const api::CameraImages& images,
                           const Snapshot& snapshot);

struct PoseSample {
    plant::VehicleId vehicle;
    geometry::Pose2 pose;
    double speed_mps = 0;
    double age_s = 0;
};
std::string poses_frame(Time at, const std::vector<PoseSample>& poses);

std::string vehicle_frame(const plant::Plant& plant, const api::CameraImages& images,
                          const fleet::VehicleView& vehicle);
std::string station_frame(const fleet::StationView& station);
std::string job_order_frame(const plant::Plant& plant, const fleet::JobOrder& order);
std::string stop_record_frame(const fleet::StopRecord& stop);
std::string fleet_frame(const plant::Plant& plant, const fleet::FleetView& fleet);
std::string event_frame(const fleet::Event& event);
/// Several changes in one, in order: each is what one of the functions above from vehicle_frame on
/// gave.
std::string changes_frame(const std::vector<std::string_view>& frames);

/// One server-sent event: "id: 7\nevent: vehicle.lost\ndata: {...}\n\n".
std::string sse(const fleet::Event& event);
/// Says that the events from `from` on are not kept any more, and that `oldest` is the next to
/// come.
std::string sse_reset(std::int64_t from, std::int64_t oldest);
/// A comment that keeps the connection open.
std::string sse_keep_alive();

}  // namespace pulseline::events
