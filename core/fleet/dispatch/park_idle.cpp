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
    for (const auto& [id, run] : fleet.vehicles) {
        if (run.has_leg()) {
            for (const auto& wait : fleet.floor.traffic.waits_of(run.floor.vehicle))
                add(found.on_the_way, wait.block);
        }
        // Those that try in vain, and those that gave way and find none back.
        const bool tries = tries_in_vain(fleet, run) || (run.has_leg() && run.floor.next_try);
        if (!tries && !fleet.floor.traffic.postponed(run.floor.vehicle)) continue;
        if (const auto block = fleet.floor.traffic.blocked_by(run.floor.vehicle))
            add(found.named, *block);
    }
    return found;
}

bool has_place(const FleetState& fleet, const VehicleRun& run) {
    return fleet.floor.traffic.plan(run.floor.vehicle).place != traffic::kNoPlace;
}

/// For whom it leaves: who asked for it, else the first of those that wait behind it; none: of its
/// own accord.
const VehicleRun* leaves_for(FleetState& fleet, const VehicleRun& run) {
    const auto& traffic = fleet.floor.traffic;
    if (const auto asked = traffic.makes_way_for(run.floor.vehicle)) {
        return fleet.find(plant::VehicleId(traffic.name(*asked)));
    }
    for (const auto vehicle : traffic.waiting_behind(run.floor.vehicle)) {
        const VehicleRun* other = fleet.find(plant::VehicleId(traffic.name(vehicle)));
        if (other && other->has_leg()) return other;
    }
    return nullptr;
}

/// Where the order still goes, in any vehicle's way of standing there.
std::vector<const traffic::TileSet*> goals_of(const FleetState& fleet, const JobOrder& order,
                                              const VehicleRun& its) {
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
void leave_work(FleetState& fleet, VehicleRun& run, Time now) {
    if (!is_at_work(fleet, run)) return;
    const VehicleRun* other = leaves_for(fleet, run);
    const JobOrder* order = other ? fleet.orders.of(other->record.id) : nullptr;
    if (order) {
        const auto goals = goals_of(fleet, *order, *other);
        const FloorClass& of_class = fleet.floor.classes[run.floor.of_class];
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
        if (!task.resting.empty() && fleet.floor.traffic.admit(run.floor.vehicle, task, now))
            return;
    }
    end_work(fleet, run, now);
}

plant::StationId last_station(const FleetState& fleet, const VehicleRun& run) {
    const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
    const auto place = plan.place_after(plan.last());
    if (place == traffic::kNoPlace) return {};
    return fleet.floor.classes[run.floor.of_class].motion.places[place].station;
}

void tell_leaving(FleetState& fleet, VehicleRun& run, Time now) {
    fleet.store(run);
    Params params{{"station", run.leg().station.str()}};
    JobOrderId order;
    if (const VehicleRun* other = leaves_for(fleet, run)) {
        params.push_back({"other", other->record.id.str()});
        if (run.made_way.size() == kAsidesKept) run.made_way.erase(run.made_way.begin());
        run.made_way.push_back(now);
        const JobOrder* its = fleet.orders.of(other->record.id);
        // One whose order waits may itself be on its way aside.
        order = other->has_leg() ? other->leg().order : its ? its->id : JobOrderId();
    }
    add_event(fleet, now, event::kVehicleMakesWay, order, run.leg().id, run.record.id, {},
              std::move(params));
    extend_base(fleet, run, now);
}

/// On the way that traffic has found for it.
void leave(FleetState& fleet, VehicleRun& run, const plant::StationId& station, Time now) {
    Leg leg;
    leg.id = LegId(fleet.ids.next(now));
    leg.vehicle = run.record.id;
    leg.station = station;
    leg.mode = plant::MotionMode::kLinear;
    leg.hall = hall_of(fleet, run);
    leg.nodes.push_back(start_node(run.record.pose, leg.hall));
    const auto idle_since = run.floor.idle_since;
    take_leg(run, std::move(leg));
    run.floor.idle_since = idle_since;
    take_plan_as_leg(fleet, run);
    tell_leaving(fleet, run, now);
}

/// Resting places that the vehicle may have: those first on which nobody stands, nearest first.
std::vector<const plant::Station*> resting_places(const FleetState& fleet, const VehicleRun& run) {
    struct Rest {
        bool held;
        double away_m;
        const plant::Station* station;
    };
    std::vector<Rest> rests;
    const auto& of_class = fleet.floor.classes[run.floor.of_class];
    const auto at = run.record.pose.position();
    for (const auto& station : fleet.plant.stations) {
        const auto place = of_class.motion.station_place(station.id);
        if (!station.resting_place || !place) continue;
        const auto& stand = of_class.stands[*place];
        const bool held = std::any_of(stand.begin(), stand.end(), [&](traffic::TileId tile) {
            const auto holder = fleet.floor.traffic.holder(tile);
            return holder && *holder != run.floor.vehicle;
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
bool leave_to_rest(FleetState& fleet, VehicleRun& run, double first_m,
                   const std::vector<const plant::Station*>& rests, Time now) {
    for (const auto* station : rests) {
        const auto request =
            leg_request(fleet, run, run.record.pose, station->id, plant::MotionMode::kAuto);
        const auto plan = first_m == 0 ? fleet.planner.plan_primitive_leg(request)
                                       : fleet.planner.plan_leg_after(first_m, request);
        if (!plan) continue;
        Leg leg =
            build_leg(fleet, run, *plan, *station, run.record.pose, LegId(fleet.ids.next(now)));
        leg.nodes.back().actions = rest_actions(fleet, run, *station, leg);
        if (!try_leg(fleet, run, std::move(leg), now)) return true;
    }
    return false;
}

/// It stands beside the places that traffic knows, so traffic cannot send it off.
void leave_from_anywhere(FleetState& fleet, VehicleRun& run, Time now) {
    auto rests = resting_places(fleet, run);
    for (const double first_m : kFirst_m) {
        rests.resize(std::min(rests.size(), first_m == 0 ? kMostRestsTried : kMostRestsTriedAfter));
        if (leave_to_rest(fleet, run, first_m, rests, now)) return tell_leaving(fleet, run, now);
    }
    run.floor.next_leave = now + kLeaveAgain;
}

/// It stands on a road or where vehicles only stop: traffic finds the way to a resting place.
void leave_place(FleetState& fleet, VehicleRun& run, Time now) {
    if (fleet.floor.traffic.admit(run.floor.vehicle, {}, now)) {
        leave(fleet, run, last_station(fleet, run), now);
    } else {
        run.floor.next_leave = now + kLeaveAgain;
    }
}

/// It is wanted away and has just found no way.
bool leaves_in_vain(const VehicleRun& run, Time now) {
    return run.floor.next_leave && now < *run.floor.next_leave + kLeaveAgain;
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
    const auto is_wanted_away = [&](const VehicleRun& run) {
        // Traffic moves who stands at a place aside when that helps; a load stays when it does not.
        const bool asked = !is_loaded(run) || !has_place(fleet, run);
        return wanted().on_the_way.contains(run.floor.vehicle) ||
               (asked && wanted().named.contains(run.floor.vehicle)) ||
               leaves_for(fleet, run) != nullptr;
    };
    for (auto& [id, run] : fleet.vehicles) {
        const auto& plan = fleet.floor.traffic.plan(run.floor.vehicle);
        // An order whose own way is barred does not keep its vehicle from making way meanwhile.
        const JobOrder* order = fleet.orders.of(id);
        const bool waits =
            !order || tries_in_vain(fleet, run) || order->reason.code == reasons::kGoesFirst;
        const bool has_way = plan.last() > plan.passed;
        const bool astray = !has_way && !fleet.floor.traffic.is_resting(run.floor.vehicle);
        const bool idle = !run.has_leg() && waits && (has_way || astray);
        if (!idle || cannot_move(fleet, run) || not_ready(fleet, run, now)) {
            if (!idle) run.floor.idle_since.reset();
            continue;
        }
        if (!run.floor.idle_since) run.floor.idle_since = now;
        const bool long_idle = now - *run.floor.idle_since >= kParkAfter;
        if (astray) {
            // Its own order's way from here may be barred for ever where the roads' is not.
            const bool stuck = long_idle && order;
            const bool soon = run.floor.next_leave && now < *run.floor.next_leave;
            // What bars another's way is said to be who rests at its end. It may be this one, who
            // stands on that way, or on the way out of the one at rest.
            const bool others_in_vain = in_vain > (leaves_in_vain(run, now) ? 1 : 0);
            const bool clears = long_idle && (others_in_vain || !wanted().named.empty());
            const bool by_itself = (stuck || clears) && !is_loaded(run);
            if (soon || (!by_itself && !is_wanted_away(run))) continue;
            if (ends_charging(fleet, run, now)) continue;
            if (plan.place == traffic::kNoPlace) {
                leave_from_anywhere(fleet, run, now);
            } else {
                leave_place(fleet, run, now);
            }
            continue;
        }
        // A load is worked on where it was brought, until somebody needs the floor.
        const bool parks = long_idle && !is_loaded(run);
        if (!parks && !is_wanted_away(run)) continue;
        leave_work(fleet, run, now);
        const bool drives = plan.at(plan.passed + 1).visit == traffic::kNoVisit;
        if (!drives || !goes_by_places(fleet, run)) {
            settle(fleet, run, now, true);  // the rest of a task or way that was given up
            continue;
        }
        const auto station = last_station(fleet, run);
        if (station.empty() || ends_charging(fleet, run, now)) continue;
        leave(fleet, run, station, now);
    }
}

}  // namespace pulseline::fleet
