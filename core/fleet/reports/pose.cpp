#include "core/fleet/reports/pose.hpp"

#include <algorithm>
#include <cmath>

#include "core/fleet/floor/holding.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/attention.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/code_pose.hpp"
#include "core/fleet/vehicle/readiness.hpp"
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
bool is_on_leg(const VehicleRun& run, const Pose2& pose) {
    const Leg& leg = run.leg();
    const bool has_it = run.state.order_id == leg.id.str() && !run.state.last_node_id.empty();
    const auto last = static_cast<std::int64_t>(leg.nodes.size()) - 1;
    const auto passed = static_cast<std::int64_t>(leg.passed_nodes) - 1;
    const auto from = static_cast<std::size_t>(
        std::clamp(has_it ? run.state.last_node_sequence_id / 2 : passed, std::int64_t{0}, last));
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
bool is_within_reach(const VehicleRun& run, const Pose2& pose, Time now) {
    if (is_near(run.record.pose, pose)) return true;
    // The server was down while it drove; without a leg it did not.
    if (!run.seen) return run.has_leg();
    const auto& newest = *run.seen;
    const auto& from =
        now - newest.at >= kJudgedOver || !run.seen_before ? newest : *run.seen_before;
    const bool unseen = run.has_leg() && now - newest.at > kHidesADrive;
    if (!(unseen || moves(run.state) || newest.moving || from.moving)) return false;
    // On its leg, where the pose has to lie on the base in any case, a vehicle that is too fast is
    // believed. Elsewhere a pose that jumps often brings the speed of its jump along.
    const double told_mps =
        run.has_leg()
            ? std::max({std::abs(run.state.velocity_mps), newest.speed_mps, from.speed_mps})
            : 0;
    const double top_mps = run.type->max_speed_mps * std::max(1.0, speed_share(run));
    const double speed_mps = std::max(top_mps, told_mps);
    return geometry::distance(from.pose.position(), pose.position()) <=
           kPush_m + speed_mps * seconds(now - from.at);
}

bool can_be_at(const FleetState& fleet, const VehicleRun& run, const Whereabouts& told, Time now) {
    if (run.record.integration < Integration::kRespect) return true;  // it holds no floor
    if (!is_in_hall(fleet, told)) return false;
    if (!has_stood(run.record) && !run.has_leg()) return true;
    if (told.hall != hall_of(fleet, run)) return false;
    if (run.has_leg() && is_automatic(run) && !is_on_leg(run, told.pose)) return false;
    return is_within_reach(run, told.pose, now);
}

void note_seen(VehicleRun& run, Time now) {
    const double speed_mps = std::abs(run.state.velocity_mps);
    if (!run.seen || now - run.seen->at >= kJudgedOver) {
        run.seen_before = run.seen;
        run.seen = VehicleRun::Seen{run.record.pose, now, moves(run.state), speed_mps};
        return;
    }
    // Of those that come at once after a stall the last one says where it is.
    if (now - run.seen->at < kAtOnce) run.seen->pose = run.record.pose;
    run.seen->moving |= moves(run.state);
    run.seen->speed_mps = std::max(run.seen->speed_mps, speed_mps);
}

/// Of a pose that was not known before: what it can rest on, seen from here.
PoseBasis basis_of(const FleetState& fleet, const VehicleRun& run, const Pose2& told, Time now) {
    const auto by_codes = pose_from_codes(fleet, run, run.state.cameras);
    const bool seen = by_codes && is_near(*by_codes, told);
    return {seen ? PoseBasis::Kind::kCodes : PoseBasis::Kind::kVehicle, {}, {}, now, 0};
}

void believe(FleetState& fleet, VehicleRun& run, const Whereabouts& told, Time now) {
    const bool was_known = run.record.pose_known;
    if (!was_known || !run.record.basis) {
        run.record.basis = basis_of(fleet, run, told.pose, now);
    } else if (moves(run.state)) {
        run.record.basis->driven_m +=
            geometry::distance(run.record.pose.position(), told.pose.position());
    }
    run.record.pose = told.pose;
    run.record.pose_known = true;
    note_seen(run, now);
    if (run.record.hall != told.hall && is_in_hall(fleet, told)) {
        run.record.hall = told.hall;
        fleet.store(run);
    }
    if (was_known) return;
    add_event(
        fleet, now, event::kVehiclePoseConfirmed, {}, {}, run.record.id, {},
        {{"x_m", told.pose.x_m}, {"y_m", told.pose.y_m}, {"heading_rad", told.pose.heading_rad}});
    fleet.store(run);
}

void lose_pose(FleetState& fleet, VehicleRun& run, Time now) {
    if (!run.record.pose_known) return;
    run.record.pose_known = false;
    add_event(fleet, now, event::kVehiclePoseLost, {}, {}, run.record.id, {});
    fleet.store(run);
}

/// It may be where it was or where it says: both floors are its own, it is told to give up what it
/// does, and the rest is for a person.
void doubt(FleetState& fleet, VehicleRun& run, const Whereabouts& told, Time now) {
    const std::string& name = run.record.id.str();
    const Pose2& known = run.record.pose;
    const double distance_m = geometry::distance(known.position(), told.pose.position());
    Params params{{"x_m", told.pose.x_m},
                  {"y_m", told.pose.y_m},
                  {"heading_rad", told.pose.heading_rad},
                  {"hall", told.hall}};
    if (has_stood(run.record)) {
        params.push_back({"distance_m", distance_m});
        params.push_back({"known_x_m", known.x_m});
        params.push_back({"known_y_m", known.y_m});
        params.push_back({"known_heading_rad", known.heading_rad});
    }
    add_event(fleet, now, event::kVehiclePoseJumped, {}, run.record.leg, run.record.id, {},
              std::move(params));
    run.record.claim = told;
    run.claim_told = now;
    run.claim_left = false;
    run.record.pose_known = false;
    run.stated.reset();
    const Reason jumped{reasons::kPoseJumped, {{"vehicle", name}, {"distance_m", distance_m}}};
    require_person(fleet, run, jumped, now);
    run.record.needs_resume_reason = jumped;  // whatever was asked before, this comes first
    fleet.store(run);
    keep_doubt(fleet, run, now);
}

/// Whether a vehicle that is where it claims can say this next. What it said before the server
/// was restarted is not known, and a wrong code goes along with a vehicle that drives.
bool can_follow_claim(const VehicleRun& run, const Whereabouts& told, Time now) {
    const Whereabouts& claim = *run.record.claim;
    if (claim.hall != told.hall) return false;
    if (run.claim_left) return is_near(claim.pose, told.pose);
    if (!run.claim_told) return true;
    const double way_m = run.type->max_speed_mps * std::max(1.0, speed_share(run)) *
                         seconds(std::max(kHidesADrive, now - *run.claim_told));
    return geometry::distance(claim.pose.position(), told.pose.position()) <= kPush_m + way_m;
}

/// In doubt: the claim goes where the vehicle says to go.
void follow_claim(FleetState& fleet, VehicleRun& run, const Whereabouts& told, Time now) {
    Whereabouts& claim = *run.record.claim;
    run.claim_left = !can_follow_claim(run, told, now);
    if (stands_where_known(fleet, run, now)) return;
    run.claim_left = false;
    run.claim_told = now;
    if (claim.hall == told.hall && is_near(claim.pose, told.pose)) return;
    claim = told;
    fleet.store(run);
    hold_both_floors(fleet, run, now);
}

bool is_as_stated(const VehicleRun& run, const Whereabouts& told, Time now) {
    return run.stated && now - run.stated->at <= kStatementLasts &&
           run.stated->where.hall == told.hall && is_near(run.stated->where.pose, told.pose);
}

Whereabouts told_by(const FleetState& fleet, const VehicleRun& run) {
    const vda5050::StateMessage& state = run.state;
    return {*state.pose, state.map_id.empty() ? hall_of(fleet, run) : state.map_id};
}

bool tells_pose(const VehicleRun& run) {
    return run.state.position_initialized && run.state.pose.has_value();
}

}  // namespace

bool stands_where_known(const FleetState& fleet, const VehicleRun& run, Time) {
    if (!tells_pose(run) || !run.reconciled) return false;
    const Whereabouts told = told_by(fleet, run);
    if (told.hall != hall_of(fleet, run) || !is_in_hall(fleet, told)) return false;
    const bool has_returned = is_near(run.record.pose, told.pose);
    if (!run.has_leg()) return has_returned;
    return (has_returned || run.claim_left) && is_on_leg(run, told.pose);
}

void end_doubt(FleetState& fleet, VehicleRun& run, Time now) {
    run.record.claim.reset();
    run.claim_told.reset();
    run.claim_left = false;
    run.stated.reset();
    run.seen.reset();
    run.seen_before.reset();
    run.floor.pose.reset();  // both floors are left for the one where it stands
    fleet.store(run);
    believe(fleet, run, told_by(fleet, run), now);
    if (!run.state.driving) settle(fleet, run, now);
}

void keep_doubt(FleetState& fleet, VehicleRun& run, Time now) {
    hold_both_floors(fleet, run, now);
    if (run.has_leg() && !run.delivery.lost()) cancel_leg(fleet, run, now);
}

void take_pose(FleetState& fleet, VehicleRun& run, const vda5050::StateMessage& before, Time now) {
    vda5050::StateMessage& state = run.state;
    const bool finite = state.pose && std::isfinite(state.pose->x_m) &&
                        std::isfinite(state.pose->y_m) && std::isfinite(state.pose->heading_rad);
    if (!finite) state.pose.reset();
    if (moves(before) && run.seen) run.seen->moving = true;
    const bool told = tells_pose(run);
    if (!told) {
        lose_pose(fleet, run, now);
    } else {
        state.pose->heading_rad = wrap(state.pose->heading_rad);
        const Whereabouts where = told_by(fleet, run);
        if (is_as_stated(run, where, now)) {
            const std::string actor = run.stated->actor;
            end_doubt(fleet, run, now);
            run.record.basis = PoseBasis{PoseBasis::Kind::kStatement, {}, actor, now, 0};
        } else if (is_in_doubt(run)) {
            follow_claim(fleet, run, where, now);
        } else if (can_be_at(fleet, run, where, now)) {
            believe(fleet, run, where, now);
        } else {
            doubt(fleet, run, where, now);
        }
    }
    if (is_in_doubt(run) || !(told || state.driving)) return;
    const plant::StationId station =
        told && !state.driving && run.record.integration >= Integration::kRespect
            ? station_at(fleet, run, run.record.pose)
            : plant::StationId{};
    if (station == run.record.at_station) return;
    run.record.at_station = station;
    fleet.store(run);
}

void offer_pose_from_codes(FleetState& fleet, VehicleRun& run, Time now) {
    const vda5050::StateMessage& state = run.state;
    if (state.position_initialized || state.driving || is_in_doubt(run)) return;
    if (run.record.integration < Integration::kRespect) return;
    if (is_asked(run, vda5050::kInitPosition)) return;
    const auto pose = pose_from_codes(fleet, run, state.cameras);
    if (!pose) return;
    vda5050::Action action;
    action.type = vda5050::kInitPosition;
    action.blocking = vda5050::BlockingType::kHard;
    action.init_position = vda5050::InitPosition{*pose, hall_of(fleet, run), {}};
    send_action(fleet, run, std::move(action), now);
}

}  // namespace pulseline::fleet
