#include "core/fleet/dispatch/park_idle.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/fleet/dispatch/charging.hpp"
#include "core/fleet/floor/admission.hpp"
#include "core/fleet/floor/grants.hpp"
#include "core/fleet/floor/holding.hpp"
#include "core/fleet/legs/legs.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"
#include "core/fleet/state/reason_codes.hpp"
#include "core/fleet/vehicle/body.hpp"
#include "core/fleet/vehicle/leg_build.hpp"
#include "core/fleet/vehicle/leg_request.hpp"
#include "core/fleet/vehicle/readiness.hpp"
#include "core/fleet/vehicle/whereabouts.hpp"

namespace pulseline::fleet {
namespace {

// An order that comes soon after a stop finds the vehicle still there.
constexpr Duration kParkAfter = std::chrono::seconds(10);
constexpr std::size_t kMostRestsTried = 6;  // a plan each
constexpr std::size_t kMostRestsTriedAfter = 2;
/// Straight ahead or back before the way to a resting place: where it stands, others' floor may
/// leave a vehicle no turn.
constexpr std::array kFirst_m{0.0, 1.0, -1.0, 2.0, -2.0, 4.0, -4.0, 8.0, -8.0};
constexpr std::size_t kAsidesKept = 3;
constexpr Duration kLeaveAgain = std::chrono::seconds(2);

struct WaitedFor {
    std::set<traffic::VehicleIndex> on_the_way;  // by those that drive
    std::set<traffic::VehicleIndex> named;       // by those that find no way
};

WaitedFor waited_for(const FleetState& fleet) {
    WaitedFor found;
    const auto add = [](std::set<traffic::VehicleIndex>& to, const traffic::Block& block) {
        if (block.cause == traffic::BlockCause::kVehicle) to.insert(block.vehicle);
    };
    for (const auto& [id, live] : fleet.vehicles) {
        if (live.has_leg()) {
            for (const auto& wait : fleet.floor.traffic.waits_of(live.floor.vehicle))
                add(found.on_the_way, wait.block);
        }
        // Those that try in vain, and those that gave way and find none back.
        const bool tries = tries_in_vain(fleet, live) || (live.has_leg() && live.floor.next_try);
        if (!tries && !fleet.floor.traffic.postponed(live.floor.vehicle)) continue;
        if (const auto block = fleet.floor.traffic.blocked_by(live.floor.vehicle))
            add(found.named, *block);
    }
    return found;
}

bool has_place(const FleetState& fleet, const LiveVehicle& live) {
    return fleet.floor.traffic.plan(live.floor.vehicle).place != traffic::kNoPlace;
}

/// For whom it leaves: who asked for it, else the first of those that wait behind it; none: of its
/// own accord.
const LiveVehicle* leaves_for(FleetState& fleet, const LiveVehicle& live) {
    const auto& traffic = fleet.floor.traffic;
    if (const auto asked = traffic.makes_way_for(live.floor.vehicle)) {
        return fleet.find(plant::VehicleId(traffic.name(*asked)));
    }
    for (const auto vehicle : traffic.waiting_behind(live.floor.vehicle)) {
        const LiveVehicle* other = fleet.find(plant::VehicleId(traffic.name(vehicle)));
        if (other && other->has_leg()) return other;
    }
    return nullptr;
}

/// Where the order still goes, in any vehicle's way of standing there.
std::vector<const traffic::TileSet*> goals_of(const FleetState& fleet, const JobOrder& order,
                                              const LiveVehicle& its) {
    std::vector<const traffic::TileSet*> goals;
    const FloorClass& of_class = fleet.floor.classes[its.floor.of_class];
    for (std::size_t i = order.current_step; i < order.steps.size(); ++i) {
        const auto place = of_class.motion.station_place(order.steps[i].station);
        if (place) goals.push_back(&of_class.stands[*place]);
    }
    return goals;
}

/// The way to rest that was planned behind its work knows nothing of the order that it leaves for:
/// better one that ends where it will not be in the way again.
void leave_work(FleetState& fleet, LiveVehicle& live, Time now) {
    if (!is_at_work(fleet, live)) return;
    const LiveVehicle* other = leaves_for(fleet, live);
    const JobOrder* order = other ? fleet.orders.of(other->record.id) : nullptr;
    if (order) {
        const auto goals = goals_of(fleet, *order, *other);
        const FloorClass& of_class = fleet.floor.classes[live.floor.of_class];
        traffic::Task task;
        for (const auto& station : fleet.plant.stations) {
            const auto place = of_class.motion.station_place(station.id);
            if (!station.resting_place || !place) continue;
            const auto& stand = of_class.stands[*place];
            const auto meets = [&](const auto* goal) { return traffic::overlap(stand, *goal); };
            if (std::ranges::none_of(goals, meets))
                task.resting.push_back(static_cast<traffic::PlaceIndex>(*place));
        }
        task.asks_to_leave = false;
        if (!task.resting.empty() && fleet.floor.traffic.admit(live.floor.vehicle, task, now))
            return;
    }
    end_work(fleet, live, now);
}

plant::StationId last_station(const FleetState& fleet, const LiveVehicle& live) {
    const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
    const auto place = plan.place_after(plan.last());
    if (place == traffic::kNoPlace) return {};
    return fleet.floor.classes[live.floor.of_class].motion.places[place].station;
}

void tell_leaving(FleetState& fleet, LiveVehicle& live, Time now) {
    fleet.store(live);
    Params params{{"station", live.leg().station.str()}};
    JobOrderId order;
    if (const LiveVehicle* other = leaves_for(fleet, live)) {
        params.push_back({"other", other->record.id.str()});
        if (live.made_way.size() == kAsidesKept) live.made_way.erase(live.made_way.begin());
        live.made_way.push_back(now);
        const JobOrder* its = fleet.orders.of(other->record.id);
        // One whose order waits may itself be on its way aside.
        order = other->has_leg() ? other->leg().order : its ? its->id : JobOrderId();
    }
    add_event(fleet, now, event::kVehicleMakesWay, order, live.leg().id, live.record.id, {},
              std::move(params));
    extend_base(fleet, live, now);
}

/// On the way that traffic has found for it.
void leave(FleetState& fleet, LiveVehicle& live, const plant::StationId& station, Time now) {
    Leg leg;
    leg.id = LegId(fleet.ids.next(now));
    leg.vehicle = live.record.id;
    leg.station = station;
    leg.mode = plant::MotionMode::kLinear;
    leg.hall = hall_of(fleet, live);
    leg.nodes.push_back(start_node(live.record.pose, leg.hall));
    const auto idle_since = live.floor.idle_since;
    take_leg(live, std::move(leg));
    live.floor.idle_since = idle_since;
    take_plan_as_leg(fleet, live);
    tell_leaving(fleet, live, now);
}

/// Resting places that the vehicle may have: those first on which nobody stands, nearest first.
std::vector<const plant::Station*> resting_places(const FleetState& fleet,
                                                  const LiveVehicle& live) {
    struct Rest {
        bool held;
        double away_m;
        const plant::Station* station;
    };
    std::vector<Rest> rests;
    const auto& of_class = fleet.floor.classes[live.floor.of_class];
    const auto at = live.record.pose.position();
    for (const auto& station : fleet.plant.stations) {
        const auto place = of_class.motion.station_place(station.id);
        if (!station.resting_place || !place) continue;
        const auto& stand = of_class.stands[*place];
        const bool held = std::any_of(stand.begin(), stand.end(), [&](traffic::TileId tile) {
            const auto holder = fleet.floor.traffic.holder(tile);
            return holder && *holder != live.floor.vehicle;
        });
        rests.push_back({held, geometry::distance(station.pose.position(), at), &station});
    }
    std::stable_sort(rests.begin(), rests.end(), [](const Rest& a, const Rest& b) {
        return std::tie(a.held, a.away_m) < std::tie(b.held, b.away_m);
    });
    std::vector<const plant::Station*> found;
    for (const Rest& rest : rests) found.push_back(rest.station);
    return found;
}

/// As a person would plan it: straight to a resting place where that is free, else by the roads.
bool leave_to_rest(FleetState& fleet, LiveVehicle& live, double first_m,
                   const std::vector<const plant::Station*>& rests, Time now) {
    for (const auto* station : rests) {
        const auto request =
            leg_request(fleet, live, live.record.pose, station->id, plant::MotionMode::kAuto);
        const auto plan = first_m == 0 ? fleet.planner.plan_primitive_leg(request)
                                       : fleet.planner.plan_leg_after(first_m, request);
        if (!plan) continue;
        Leg leg =
            build_leg(fleet, live, *plan, *station, live.record.pose, LegId(fleet.ids.next(now)));
        leg.nodes.back().actions = rest_actions(fleet, live, *station, leg);
        if (!try_leg(fleet, live, std::move(leg), now)) return true;
    }
    return false;
}

/// It stands beside the places that traffic knows, so traffic cannot send it off.
void leave_from_anywhere(FleetState& fleet, LiveVehicle& live, Time now) {
    auto rests = resting_places(fleet, live);
    for (const double first_m : kFirst_m) {
        rests.resize(std::min(rests.size(), first_m == 0 ? kMostRestsTried : kMostRestsTriedAfter));
        if (leave_to_rest(fleet, live, first_m, rests, now)) return tell_leaving(fleet, live, now);
    }
    live.floor.next_leave = now + kLeaveAgain;
}

/// It stands on a road or where vehicles only stop: traffic finds the way to a resting place.
void leave_place(FleetState& fleet, LiveVehicle& live, Time now) {
    if (fleet.floor.traffic.admit(live.floor.vehicle, {}, now)) {
        leave(fleet, live, last_station(fleet, live), now);
    } else {
        live.floor.next_leave = now + kLeaveAgain;
    }
}

/// It is wanted away and has just found no way.
bool leaves_in_vain(const LiveVehicle& live, Time now) {
    return live.floor.next_leave && now < *live.floor.next_leave + kLeaveAgain;
}

}  // namespace

void park_idle(FleetState& fleet, Time now) {
    const auto in_vain = std::ranges::count_if(
        fleet.vehicles, [&](const auto& entry) { return leaves_in_vain(entry.second, now); });
    std::optional<WaitedFor> found;
    const auto wanted = [&]() -> const WaitedFor& {
        if (!found) found = waited_for(fleet);
        return *found;
    };
    const auto is_wanted_away = [&](const LiveVehicle& live) {
        // Traffic moves who stands at a place aside when that helps; a load stays when it does not.
        const bool asked = !is_loaded(live) || !has_place(fleet, live);
        return wanted().on_the_way.contains(live.floor.vehicle) ||
               (asked && wanted().named.contains(live.floor.vehicle)) ||
               leaves_for(fleet, live) != nullptr;
    };
    for (auto& [id, live] : fleet.vehicles) {
        const auto& plan = fleet.floor.traffic.plan(live.floor.vehicle);
        // An order whose own way is barred does not keep its vehicle from making way meanwhile.
        const JobOrder* order = fleet.orders.of(id);
        const bool waits =
            !order || tries_in_vain(fleet, live) || order->reason.code == reasons::kGoesFirst;
        const bool has_way = plan.last() > plan.passed;
        const bool astray = !has_way && !fleet.floor.traffic.is_resting(live.floor.vehicle);
        const bool idle = !live.has_leg() && waits && (has_way || astray);
        if (!idle || cannot_move(fleet, live) || not_ready(fleet, live, now)) {
            if (!idle) live.floor.idle_since.reset();
            continue;
        }
        if (!live.floor.idle_since) live.floor.idle_since = now;
        const bool long_idle = now - *live.floor.idle_since >= kParkAfter;
        if (astray) {
            // Its own order's way from here may be barred for ever where the roads' is not.
            const bool stuck = long_idle && order;
            const bool soon = live.floor.next_leave && now < *live.floor.next_leave;
            // What bars another's way is said to be who rests at its end. It may be this one, who
            // stands on that way, or on the way out of the one at rest.
            const bool others_in_vain = in_vain > (leaves_in_vain(live, now) ? 1 : 0);
            const bool clears = long_idle && (others_in_vain || !wanted().named.empty());
            // A load stays where it was brought, and not where its way was cut off.
            const bool may_go = !is_loaded(live) || live.record.at_station.empty();
            const bool by_itself = (stuck || clears) && may_go;
            if (soon || (!by_itself && !is_wanted_away(live))) continue;
            if (ends_charging(fleet, live, now)) continue;
            if (plan.place == traffic::kNoPlace) {
                leave_from_anywhere(fleet, live, now);
            } else {
                leave_place(fleet, live, now);
            }
            continue;
        }
        // A load is worked on where it was brought, until somebody needs the floor.
        const bool parks = long_idle && !is_loaded(live);
        if (!parks && !is_wanted_away(live)) continue;
        leave_work(fleet, live, now);
        const bool drives = plan.at(plan.passed + 1).visit == traffic::kNoVisit;
        if (!drives || !goes_by_places(fleet, live)) {
            hold_where_it_stands(fleet, live, now,
                                 true);  // the rest of a task or way that was given up
            continue;
        }
        const auto station = last_station(fleet, live);
        if (station.empty() || ends_charging(fleet, live, now)) continue;
        leave(fleet, live, station, now);
    }
}

}  // namespace pulseline::fleet
