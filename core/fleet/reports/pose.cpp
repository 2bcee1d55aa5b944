#include "core/fleet/reports/pose.hpp"

#include <algorithm>
#include <cmath>

#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/seen_pose.hpp"
#include "core/fleet/vehicle/sending.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"
#include "core/vda5050/actions.hpp"

// Where a vehicle says that it stands, and what becomes of it when that cannot be true.
namespace pulseline::fleet {
namespace {

// What people push a standing vehicle between two of its reports, what a code under its cameras
// takes away of its odometry, and how far beside its line it may drive. A misread code is off by
// the distance of two codes, which is more.
constexpr double kPush_m = 0.3;
constexpr double kPush_rad = radians(15);
// Speed is judged over a second at least: reports come at odd times, and several at once after a
// stall.
constexpr Duration kJudgedOver = std::chrono::seconds(1);
constexpr Duration kAtOnce = std::chrono::milliseconds(500);
// A report may be so much longer under way than the next one, by what is sent again on a bad line:
// a vehicle at full speed then seems to have driven faster.
constexpr Duration kLater = std::chrono::milliseconds(500);
// A silence in which a whole drive may go unseen; reports come every 2 s at least.
constexpr Duration kHidesADrive = std::chrono::seconds(3);
// What a person said where it stands is for the report that follows, not for one of another day.
constexpr Duration kStatementLasts = std::chrono::seconds(60);
constexpr double kStill_mps = 0.02;  // noise of a speed that is none
constexpr double kSample_m = 0.25;   // of a path
constexpr double kSample_rad = radians(10);

bool is_near(const Pose2& a, const Pose2& b, double room_m = 0) {
    return geometry::distance(a.position(), b.position()) <= kPush_m + room_m &&
           (room_m > 0 || std::abs(wrap(a.heading_rad - b.heading_rad)) <= kPush_rad);
}

bool is_near(const vda5050::OrderNode& node, const Pose2& pose) {
    // Through a wide node it may go round something, in any direction.
    const double room_m = node.allowed_deviation_xy_m > kPush_m ? node.allowed_deviation_xy_m : 0.0;
    return is_near(node.pose, pose, room_m);
}

bool is_near(const vda5050::OrderEdge& edge, const Pose2& pose) {
    const auto& way = edge.segment;
    const double room_m =
        edge.corridor ? std::max(edge.corridor->left_m, edge.corridor->right_m) : 0;
    const int samples = static_cast<int>(std::ceil(std::abs(way.length_m) / kSample_m) +
                                         std::ceil(std::abs(way.turn_rad) / kSample_rad)) +
                        1;
    for (int i = 0; i <= samples; ++i) {
        if (is_near(kinematics::pose_at(way, static_cast<double>(i) / samples), pose, room_m)) {
            return true;
        }
    }
    return false;
}

/// On the base of its leg, behind the node that it says it has passed: what lies before that is
/// freed on its word.
bool is_on_leg(const LiveVehicle& live, const Pose2& pose) {
    const Leg& leg = live.leg();
    const bool has_it = live.state.order_id == leg.id.str() && !live.state.last_node_id.empty();
    const auto last = static_cast<std::int64_t>(leg.nodes.size()) - 1;
    const auto passed = static_cast<std::int64_t>(leg.passed_nodes) - 1;
    const auto from = static_cast<std::size_t>(
        std::clamp(has_it ? live.state.last_node_sequence_id / 2 : passed, std::int64_t{0}, last));
    if (is_near(leg.nodes[from], pose)) return true;
    for (std::size_t i = from; i + 1 < leg.released_nodes; ++i) {
        if (is_near(leg.edges[i], pose)) return true;
    }
    return false;
}

/// Nobody but those who push it moves a vehicle that says that it stands, in nobody's hands.
bool moves(const vda5050::StateMessage& state) {
    return state.driving || std::abs(state.velocity_mps) > kStill_mps ||
           state.operating_mode != "AUTOMATIC";
}

/// Whether it can have come there from where it was believed to be.
bool is_within_reach(const LiveVehicle& live, const Pose2& pose, Time now) {
    if (is_near(live.record.pose, pose)) return true;
    // The server was down while it drove; without a leg it did not.
    if (!live.seen) return live.has_leg();
    const auto& newest = *live.seen;
    const auto& from =
        now - newest.at >= kJudgedOver || !live.seen_before ? newest : *live.seen_before;
    const bool unseen = live.has_leg() && now - newest.at > kHidesADrive;
    if (!(unseen || moves(live.state) || newest.moving || from.moving)) return false;
    // On its leg, where the pose has to lie on the base in any case, a vehicle that is too fast is
    // believed. Elsewhere a pose that jumps often brings the speed of its jump along.
    const double told_mps =
        live.has_leg()
            ? std::max({std::abs(live.state.velocity_mps), newest.speed_mps, from.speed_mps})
            : 0;
    const double top_mps = live.type->max_speed_mps * std::max(1.0, speed_share(live));
    const double speed_mps = std::max(top_mps, told_mps);
    return geometry::distance(from.pose.position(), pose.position()) <=
           kPush_m + speed_mps * seconds(now - from.at + kLater);
}

bool can_be_at(const FleetState& fleet, const LiveVehicle& live, const Whereabouts& told,
               Time now) {
    if (live.record.integration < Integration::kRespect) return true;  // it holds no floor
    if (!is_in_hall(fleet, told)) return false;
    if (!has_stood(live.record) && !live.has_leg()) return true;
    if (told.hall != hall_of(fleet, live)) return false;
    if (live.has_leg() && is_automatic(live) && !is_on_leg(live, told.pose)) return false;
    return is_within_reach(live, told.pose, now);
}

void note_seen(LiveVehicle& live, Time now) {
    const double speed_mps = std::abs(live.state.velocity_mps);
    if (!live.seen || now - live.seen->at >= kJudgedOver) {
        live.seen_before = live.seen;
        live.seen = LiveVehicle::Seen{live.record.pose, now, moves(live.state), speed_mps};
        return;
    }
    // Of those that come at once after a stall the last one says where it is.
    if (now - live.seen->at < kAtOnce) live.seen->pose = live.record.pose;
    live.seen->moving |= moves(live.state);
    live.seen->speed_mps = std::max(live.seen->speed_mps, speed_mps);
}

/// Of a pose that was not known before: what it can rest on, seen from here.
PoseBasis basis_of(const FleetState& fleet, const LiveVehicle& live, const Pose2& told, Time now) {
    const auto seen = seen_pose(fleet, live, Reach::kNearIt);
    const bool agrees = seen && is_near(seen->pose, told);
    return {agrees ? seen->basis : PoseBasis::Kind::kVehicle, {}, {}, now, 0};
}

void believe(FleetState& fleet, LiveVehicle& live, const Whereabouts& told, Time now) {
    const bool was_known = live.record.pose_known;
    if (!was_known || !live.record.basis) {
        live.record.basis = basis_of(fleet, live, told.pose, now);
    } else if (moves(live.state)) {
        live.record.basis->driven_m +=
            geometry::distance(live.record.pose.position(), told.pose.position());
    }
    live.record.pose = told.pose;
    live.record.pose_known = true;
    note_seen(live, now);
    if (live.record.hall != told.hall && is_in_hall(fleet, told)) {
        live.record.hall = told.hall;
        fleet.store(live);
    }
    if (was_known) return;
    add_event(
        fleet, now, event::kVehiclePoseConfirmed, {}, {}, live.record.id, {},
        {{"x_m", told.pose.x_m}, {"y_m", told.pose.y_m}, {"heading_rad", told.pose.heading_rad}});
    fleet.store(live);
}

/// What it still has to drive led on from where it believed to be: it is told to give that up, so
/// that a person can say where it stands and let its order go on from there.
void lose_pose(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!live.record.pose_known) return;
    live.record.pose_known = false;
    add_event(fleet, now, event::kVehiclePoseLost, {}, {}, live.record.id, {});
    fleet.store(live);
    const bool has_way = live.has_leg() && live.state.order_id == live.leg().id.str() &&
                         !has_nothing_left(live.state);
    if (!has_way) return;
    require_person(fleet, live, {reasons::kPoseLost, {{"vehicle", live.record.id.str()}}}, now);
    cancel_leg(fleet, live, now);
}

/// It may be where it was or where it says: both floors are its own, it is told to give up what it
/// does, and the rest is for a person.
void doubt(FleetState& fleet, LiveVehicle& live, const Whereabouts& told, Time now) {
    const std::string& name = live.record.id.str();
    const Pose2& known = live.record.pose;
    const double distance_m = geometry::distance(known.position(), told.pose.position());
    Params params{{"x_m", told.pose.x_m},
                  {"y_m", told.pose.y_m},
                  {"heading_rad", told.pose.heading_rad},
                  {"hall", told.hall}};
    if (has_stood(live.record)) {
        params.push_back({"distance_m", distance_m});
        params.push_back({"known_x_m", known.x_m});
        params.push_back({"known_y_m", known.y_m});
        params.push_back({"known_heading_rad", known.heading_rad});
    }
    add_event(fleet, now, event::kVehiclePoseJumped, {}, live.record.leg, live.record.id, {},
              std::move(params));
    live.record.claim = told;
    live.claim_told = now;
    live.claim_left = false;
    live.record.pose_known = false;
    live.stated.reset();
    const Reason jumped{reasons::kPoseJumped, {{"vehicle", name}, {"distance_m", distance_m}}};
    require_person(fleet, live, jumped, now);
    live.record.needs_resume_reason = jumped;  // whatever was asked before, this comes first
    fleet.store(live);
    keep_doubt(fleet, live, now);
}

/// Whether a vehicle that is where it claims can say this next. What it said before the server
/// was restarted is not known, and a wrong code goes along with a vehicle that drives.
bool can_follow_claim(const LiveVehicle& live, const Whereabouts& told, Time now) {
    const Whereabouts& claim = *live.record.claim;
    if (claim.hall != told.hall) return false;
    if (live.claim_left) return is_near(claim.pose, told.pose);
    if (!live.claim_told) return true;
    const double way_m = live.type->max_speed_mps * std::max(1.0, speed_share(live)) *
                         seconds(std::max(kHidesADrive, now - *live.claim_told));
    return geometry::distance(claim.pose.position(), told.pose.position()) <= kPush_m + way_m;
}

/// In doubt: the claim goes where the vehicle says to go.
void follow_claim(FleetState& fleet, LiveVehicle& live, const Whereabouts& told, Time now) {
    Whereabouts& claim = *live.record.claim;
    live.claim_left = !can_follow_claim(live, told, now);
    if (stands_where_known(fleet, live, now)) return;
    live.claim_left = false;
    live.claim_told = now;
    if (claim.hall == told.hall && is_near(claim.pose, told.pose)) return;
    claim = told;
    fleet.store(live);
    hold_both_floors(fleet, live, now);
}

bool is_as_stated(const LiveVehicle& live, const Whereabouts& told, Time now) {
    return live.stated && now - live.stated->at <= kStatementLasts &&
           live.stated->where.hall == told.hall && is_near(live.stated->where.pose, told.pose);
}

Whereabouts told_by(const FleetState& fleet, const LiveVehicle& live) {
    const vda5050::StateMessage& state = live.state;
    return {*state.pose, state.map_id.empty() ? hall_of(fleet, live) : state.map_id};
}

bool tells_pose(const LiveVehicle& live) {
    return live.state.position_initialized && live.state.pose.has_value();
}

}  // namespace

bool stands_where_known(const FleetState& fleet, const LiveVehicle& live, Time) {
    if (!tells_pose(live) || !live.reconciled) return false;
    const Whereabouts told = told_by(fleet, live);
    if (told.hall != hall_of(fleet, live) || !is_in_hall(fleet, told)) return false;
    const bool has_returned = is_near(live.record.pose, told.pose);
    if (!live.has_leg()) return has_returned;
    return (has_returned || live.claim_left) && is_on_leg(live, told.pose);
}

void end_doubt(FleetState& fleet, LiveVehicle& live, Time now) {
    live.record.claim.reset();
    live.claim_told.reset();
    live.claim_left = false;
    live.stated.reset();
    live.seen.reset();
    live.seen_before.reset();
    // Both floors are left for the one where it stands, unless it was sent away from there already.
    if (!live.floor.leg_planned) live.floor.pose.reset();
    fleet.store(live);
    believe(fleet, live, told_by(fleet, live), now);
    if (!live.state.driving) hold_where_it_stands(fleet, live, now);
}

void keep_doubt(FleetState& fleet, LiveVehicle& live, Time now) {
    hold_both_floors(fleet, live, now);
    if (live.has_leg() && !live.delivery.lost()) cancel_leg(fleet, live, now);
}

namespace {

/// What has moved stands as it was measured no more, even where it stops at once, its leg given up:
/// its station is not ready, and off its stop it need not see the codes there to drive on.
void leave_stop(FleetState& fleet, LiveVehicle& live) {
    VehicleRecord& record = live.record;
    const bool at_stop = live.has_leg() && stands_at_stop(fleet, live);
    if (!record.last_stop_inside && (at_stop || record.last_stop_station.empty())) return;
    record.last_stop_inside = false;
    if (!at_stop) record.last_stop_station = {};
    fleet.store(live);
}

}  // namespace

void handle_pose(FleetState& fleet, LiveVehicle& live, const vda5050::StateMessage& before,
                 Time now) {
    vda5050::StateMessage& state = live.state;
    const bool finite = state.pose && std::isfinite(state.pose->x_m) &&
                        std::isfinite(state.pose->y_m) && std::isfinite(state.pose->heading_rad);
    if (!finite) state.pose.reset();
    if (moves(before) && live.seen) live.seen->moving = true;
    const bool told = tells_pose(live);
    if (!told) {
        lose_pose(fleet, live, now);
    } else {
        state.pose->heading_rad = wrap(state.pose->heading_rad);
        const Whereabouts where = told_by(fleet, live);
        if (is_as_stated(live, where, now)) {
            const std::string actor = live.stated->actor;
            end_doubt(fleet, live, now);
            live.record.basis = PoseBasis{PoseBasis::Kind::kStatement, {}, actor, now, 0};
        } else if (is_in_doubt(live)) {
            follow_claim(fleet, live, where, now);
        } else if (can_be_at(fleet, live, where, now)) {
            believe(fleet, live, where, now);
        } else {
            doubt(fleet, live, where, now);
        }
    }
    if (state.driving) leave_stop(fleet, live);
    if (is_in_doubt(live) || !(told || state.driving)) return;
    const plant::StationId station =
        told && !state.driving && live.record.integration >= Integration::kRespect
            ? station_at(fleet, live, live.record.pose)
            : plant::StationId{};
    if (station == live.record.at_station) return;
    live.record.at_station = station;
    fleet.store(live);
}

void offer_seen_pose(FleetState& fleet, LiveVehicle& live, std::optional<Time> before, Time now) {
    const vda5050::StateMessage& state = live.state;
    if (state.position_initialized || state.driving || is_in_doubt(live)) return;
    if (live.record.integration < Integration::kRespect) return;
    if (is_asked(live, vda5050::kInitPosition)) return;
    const auto second_of = [](Time t) {
        return std::chrono::floor<std::chrono::seconds>(t.time_since_epoch());
    };
    const bool next_second = !before || second_of(*before) != second_of(now);
    const auto seen = seen_pose(fleet, live, next_second ? Reach::kWholeHall : Reach::kNearIt);
    if (!seen) return;
    vda5050::Action action;
    action.type = vda5050::kInitPosition;
    action.blocking = vda5050::BlockingType::kHard;
    action.init_position = vda5050::InitPosition{seen->pose,       hall_of(fleet, live),    {},
                                                 seen->sigma_xy_m, seen->sigma_heading_rad, true};
    send_action(fleet, live, std::move(action), now);
}

}  // namespace pulseline::fleet
