#include "core/fleet/views/vehicle_views.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <unordered_map>

#include "core/fleet/floor/floor.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/views.hpp"
#include "core/fleet/tables/floor_graph.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/interlocks.hpp"
#include "core/fleet/vehicle/leg_markers.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/kinematics/motion.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

constexpr double kArcSample_rad = 6.0 * kPi / 180.0;

void update_areas(const LiveVehicle& live) {
    const Leg& leg = live.leg();
    auto& areas = live.areas;
    if (areas.leg == leg.id && areas.passed == leg.passed_nodes &&
        areas.released == leg.released_nodes) {
        return;
    }
    std::vector<geometry::Polygon> granted;
    std::vector<geometry::Polygon> horizon;
    const auto body = plant::outline_with_load(*live.type, is_loaded(live));
    for (std::size_t i = leg.passed_nodes - 1; i < leg.edges.size(); ++i) {
        auto floor = floor_along(body, leg.edges[i].segment, leg.edges[i].corridor,
                                 kinematics::kOutlineDetail);
        auto& area = i + 1 < leg.released_nodes ? granted : horizon;
        area.insert(area.end(), std::make_move_iterator(floor.begin()),
                    std::make_move_iterator(floor.end()));
    }
    areas.granted = geometry::union_outline(granted);
    areas.horizon = geometry::union_outline(horizon);
    areas.leg = leg.id;
    areas.passed = leg.passed_nodes;
    areas.released = leg.released_nodes;
}

LegView leg_view(const FleetState& fleet, const LiveVehicle& live, Time now) {
    const Leg& leg = live.leg();
    update_areas(live);
    LegView view;
    view.id = leg.id;
    view.station = leg.station;
    view.mode = leg.mode;
    view.duration_s = leg.duration_s / speed_share(live);
    view.granted_area = live.areas.granted;
    view.horizon_area = live.areas.horizon;
    view.path.push_back(leg.nodes.front().pose.position());
    double total_s = 0;
    double passed_s = 0;
    for (std::size_t i = 0; i < leg.edges.size(); ++i) {
        const auto& segment = leg.edges[i].segment;
        if (i + 1 == leg.released_nodes) view.granted_points = view.path.size();
        if (segment.kind != kinematics::Segment::Kind::kRotate) {
            const int samples = segment.kind == kinematics::Segment::Kind::kArc
                                    ? std::max(1, static_cast<int>(std::ceil(
                                                      std::abs(segment.turn_rad) / kArcSample_rad)))
                                    : 1;
            for (int k = 1; k <= samples; ++k) {
                view.path.push_back(
                    kinematics::pose_at(segment, static_cast<double>(k) / samples).position());
            }
        }
        total_s += segment.duration_s;
        if (i + 1 < leg.passed_nodes) passed_s += segment.duration_s;
    }
    if (leg.released_nodes >= leg.nodes.size()) view.granted_points = view.path.size();
    view.progress = total_s > 0 ? passed_s / total_s : 1.0;
    view.chain = leg_markers(fleet, live);
    view.started = live.delivery.started();
    if (view.started) {
        const Time left = now + from_seconds((total_s - passed_s) / speed_share(live));
        view.expected = std::max(*view.started + from_seconds(view.duration_s), left);
    }
    return view;
}

/// A report of before the pause, or of one that is still braking, does not count.
bool stands_paused(const LiveVehicle& live) {
    return live.record.paused && live.state.paused && !live.state.driving &&
           !is_asked(live, vda5050::kStartPause);
}

/// Beside its line it says why.
std::optional<Reason> detour(const LiveVehicle& live) {
    const bool goes_round =
        std::any_of(live.state.errors.begin(), live.state.errors.end(),
                    [](const vda5050::VehicleError& error) { return error.type == "going_round"; });
    return goes_round ? std::optional(Reason{"going_round", {}}) : std::nullopt;
}

/// Ready: it stands there and its last stop, measured here, was inside tolerance.
void show_standing(StationView& view, const LiveVehicle& live) {
    view.occupied_by = live.record.id;
    const bool measured_here = live.record.last_stop_station == view.id;
    view.ready = live.record.last_stop_inside && measured_here && !live.has_leg();
    if (measured_here) view.last_stop = live.record.last_stop;
}

Activity activity_of(Bar bar) {
    switch (bar) {
        case Bar::kFatalError:
        case Bar::kWheelFault:
        case Bar::kSafetyStop:
        case Bar::kNotAutomatic:
        case Bar::kFieldViolation:
            return Activity::kBlocked;
        case Bar::kPaused:
        case Bar::kPausesItself:
            return Activity::kPaused;
        case Bar::kPoseUnknown:
        case Bar::kSilent:
            return Activity::kUnknown;
        default:
            return Activity::kWaiting;
    }
}

struct Doing {
    Activity activity = Activity::kUnknown;
    std::optional<Reason> reason;
};

Doing doing(const FleetState& fleet, const LiveVehicle& live, Time now) {
    const JobOrder* order = fleet.orders.of(live.record.id);
    if (live.record.integration == Integration::kIgnore) {
        const auto barred = not_ready(fleet, live, now);
        return {Activity::kUnknown, barred ? std::optional(barred->reason) : std::nullopt};
    }
    if (live.link == Link::kNever) return {Activity::kUnknown, Reason{"never_heard", {}}};
    if (live.link == Link::kLost || live.link == Link::kGone) {
        return {Activity::kUnknown,
                Reason{"vehicle_silent", {{"silent_s", seconds(silence(fleet, live, now))}}}};
    }
    const bool moving = live.has_leg() && live.state.driving;
    if (moving && live.link == Link::kLive) return {Activity::kMoving, detour(live)};
    if (const auto barred = not_ready(fleet, live, now); barred && barred->by != Bar::kBusy) {
        return {activity_of(barred->by), barred->reason};
    }
    if (live.has_leg()) {
        const bool measuring = order && order->current_step < order->steps.size() &&
                               order->steps[order->current_step].state == StepState::kMeasuring;
        if (measuring) return {Activity::kMeasuring, std::nullopt};
        if (live.delivery.cancelling()) return {Activity::kWaiting, Reason{"cancelling", {}}};
        if (order && !order->reason.code.empty()) return {Activity::kWaiting, order->reason};
        if (!live.delivery.seen()) return {Activity::kWaiting, Reason{"order_on_its_way", {}}};
        if (live.leg().order.empty()) {
            if (auto wait = floor_wait(fleet, live); wait && !moving) {
                return {Activity::kWaiting, std::move(wait)};
            }
            const char* code = live.leg().charges ? "goes_charging" : "makes_way";
            return {Activity::kMoving, Reason{code, {{"station", live.leg().station.str()}}}};
        }
        return {Activity::kMoving, detour(live)};
    }
    if (order && !order->reason.code.empty()) return {Activity::kWaiting, order->reason};
    if (live.state.charging) return {Activity::kCharging, std::nullopt};
    if (live.charge_wait) return {Activity::kStanding, live.charge_wait};
    return {Activity::kStanding, Reason{"no_order", {}}};
}

}  // namespace

VehicleView view_of(const FleetState& fleet, const LiveVehicle& live, Time now, bool with_leg) {
    VehicleView view;
    view.id = live.record.id;
    view.link = live.link;
    Doing what = doing(fleet, live, now);
    view.activity = what.activity;
    view.reason = std::move(what.reason);
    view.last_heard = live.last_heard;
    view.pose_known = live.record.pose_known;
    if (live.record.pose_known) view.pose_basis = live.record.basis;
    if (live.record.claim) {
        view.claimed_pose = live.record.claim->pose;
        if (has_stood(live.record)) view.pose = live.record.pose;
    } else if (live.record.pose_known || live.state_at) {
        view.pose =
            live.record.pose_known ? std::optional<Pose2>(live.record.pose) : live.state.pose;
    }
    view.pose_at = live.state_at;
    view.hall = hall_of(fleet, live);
    view.at_station = live.record.at_station;
    if (const auto* order = fleet.orders.of(live.record.id)) {
        view.order = order->id;
    }
    if (with_leg && live.has_leg()) view.leg = leg_view(fleet, live, now);
    if (const auto* load = load_on(fleet, live.record.id)) {
        view.carries = CarriedLoad{load->id, load->name, load->mass_kg};
    }
    view.load = load_view(fleet, live);
    view.lift = live.lift;
    view.paused = live.record.paused;
    view.stands_paused = stands_paused(live);
    view.integration = live.record.integration;
    view.needs_resume = live.record.needs_resume;
    view.needs_resume_reason = live.record.needs_resume_reason;
    view.made_way = live.made_way;
    view.state = live.state;
    return view;
}

StationView station_view(const FleetState& fleet, const plant::Station& station) {
    StationView view{station.id, station.number, {}, {}, false, {}, {}};
    if (const auto* load = load_at(fleet, station.id)) view.holds = load->id;
    for (const auto& [id, live] : fleet.vehicles) {
        if (!live.record.at_station.empty() && live.record.at_station == station.id) {
            show_standing(view, live);
        }
        if (live.has_leg() && live.leg().station == station.id) view.reserved_by = id;
    }
    return view;
}

std::vector<StationView> station_views(const FleetState& fleet) {
    std::vector<StationView> views;
    std::unordered_map<std::string_view, std::size_t> index;
    for (const auto& station : fleet.plant.stations) {
        index.emplace(station.id.str(), views.size());
        views.push_back({station.id, station.number, {}, {}, false, {}, {}});
    }
    for (const auto& [id, record] : fleet.loads) {
        const auto at = index.find(record.station.str());
        if (at != index.end()) views[at->second].holds = id;
    }
    for (const auto& [id, live] : fleet.vehicles) {
        const auto at = index.find(live.record.at_station.str());
        if (at != index.end()) show_standing(views[at->second], live);
        if (!live.has_leg()) continue;
        const auto to = index.find(live.leg().station.str());
        if (to != index.end()) views[to->second].reserved_by = id;
    }
    return views;
}

}  // namespace pulseline::fleet
