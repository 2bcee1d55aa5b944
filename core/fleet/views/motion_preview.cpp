#include "core/fleet/views/motion_preview.hpp"

#include <algorithm>

#include "core/fleet/fleet.hpp"
#include "core/fleet/floor/closures.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

using planning::ModeOption;

using plant::MotionMode;

template <class T>
bool has(const std::vector<T>& all, const T& one) {
    return std::find(all.begin(), all.end(), one) != all.end();
}

ModeOption not_of_type(const plant::VehicleType& type, MotionMode mode) {
    return {mode,
            fail(Errc::kUnreachable, "mode_not_supported",
                 type.name + " cannot drive this motion mode. Choose one of its own.", {},
                 {{"mode", std::string(plant::to_string(mode))}, {"vehicle_type", type.id.str()}}),
            false};
}

Status check_inside(const plant::Hall& hall, const Pose2& pose, const char* field) {
    if (geometry::contains(hall.outline, pose.position())) return {};
    return fail(Errc::kUnreachable, "outside_hall",
                "That position lies outside hall " + hall.name + ". Choose one inside.", field,
                {{"x_m", pose.x_m}, {"y_m", pose.y_m}});
}

/// The hall of the move, with what is said of it being so.
Result<const plant::Hall*> hall_for(const MotionQuestion& question, const FleetState& fleet,
                                    const LiveVehicle& live) {
    const std::string present = hall_of(fleet, live);
    const plant::HallId wanted = question.hall.empty() ? plant::HallId(present) : question.hall;
    const auto* hall = plant::find_hall(fleet.plant, wanted);
    if (!hall) {
        return fail(Errc::kUnreachable, "unknown_hall",
                    "There is no hall " + wanted.str() + ". GET /api/v1/plant lists the halls.",
                    "/hall", {{"hall", wanted.str()}});
    }
    if (!question.start && hall->id.str() != present) {
        return fail(Errc::kUnreachable, "other_hall",
                    "The vehicle stands in hall " + present +
                        ". Leave the hall out, or say where in the other the vehicle starts.",
                    "/hall", {{"from", present}, {"to", hall->id.str()}});
    }
    return hall;
}

}  // namespace

Result<MotionTask> Fleet::motion_task(const MotionQuestion& question) const {
    const FleetState& fleet = *state_;
    const LiveVehicle* live = fleet.find(question.vehicle);
    if (!live) {
        return fail(Errc::kUnreachable, "unknown_vehicle",
                    "There is no vehicle " + question.vehicle.str() +
                        ". GET /api/v1/vehicles lists the vehicles.",
                    "/vehicle", {{"vehicle", question.vehicle.str()}});
    }
    const auto* station =
        question.station ? plant::find_station(fleet.plant, *question.station) : nullptr;
    if (question.station && !station) {
        return fail(Errc::kUnreachable, "unknown_station",
                    "There is no station " + std::to_string(*question.station) +
                        ". GET /api/v1/stations lists the stations.",
                    "/station", {{"station", std::int64_t{*question.station}}});
    }
    const auto hall = hall_for(question, fleet, *live);
    if (!hall) return fail(hall.error());
    if (!question.start && !live->record.pose_known) {
        return fail(Errc::kConflict, "pose_unknown",
                    "The vehicle does not know where it stands. Say where it starts.", "/start",
                    {{"vehicle", question.vehicle.str()}});
    }
    const Pose2 start = question.start.value_or(live->record.pose);
    if (question.start) {
        if (const auto ok = check_inside(**hall, start, "/start"); !ok) return fail(ok.error());
    }
    if (question.target) {
        const auto ok = check_inside(**hall, *question.target, "/target");
        if (!ok) return fail(ok.error());
    }
    MotionTask task;
    task.request = leg_request(fleet, *live, start, station ? station->id : plant::StationId{},
                               MotionMode::kAuto);
    if (task.request.hall != (*hall)->id) {
        task.request.hall = (*hall)->id;
        task.request.from_station = {};
    }
    task.request.loaded = question.loaded.value_or(task.request.loaded);
    task.request.target_pose = question.target;
    task.target = station ? station->pose : question.target.value_or(start);
    task.modes = question.modes;
    task.standing = standing_bodies(fleet, (*hall)->id, live->record.id);
    task.closures = closed_floors();
    task.tables = fleet.tables;
    return task;
}

std::vector<ModeOption> MotionPreviewer::preview(const MotionTask& task) {
    if (tables_ != task.tables) {
        tables_ = task.tables;
        planner_ = tables_->planner.again();
    }
    planner_->set_closures(task.closures);
    auto options = planner_->assess_modes(task.request, task.standing);
    if (task.modes.empty()) return options;
    std::vector<ModeOption> asked;
    for (const MotionMode mode : plant::kMotionModes) {
        if (!has(task.modes, mode)) continue;
        const auto own = std::ranges::find(options, mode, &ModeOption::mode);
        asked.push_back(own != options.end() ? std::move(*own)
                                             : not_of_type(*task.request.type, mode));
    }
    return asked;
}

}  // namespace pulseline::fleet
