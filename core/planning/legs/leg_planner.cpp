#include "core/planning/legs/leg_planner.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include "core/kinematics/primitives.hpp"
#include "core/planning/legs/blind_way.hpp"
#include "core/planning/legs/grid_leg.hpp"
#include "core/planning/legs/leg_assessment.hpp"
#include "core/planning/legs/leg_chain.hpp"
#include "core/planning/legs/leg_memo.hpp"
#include "core/planning/legs/mode_choice.hpp"
#include "core/planning/legs/road_leg.hpp"
#include "core/planning/roads/roadmap_index.hpp"

namespace pulseline::planning {
namespace {

using geometry::Polygon;
using kinematics::Segment;
using plant::MotionMode;

/// A direct motion may go along lanes without knowing it.
bool same_way(const LegPlan& a, const LegPlan& b) {
    constexpr double kSame_m = 1e-6;
    return a.turns == b.turns && std::abs(a.length_m - b.length_m) < kSame_m;
}

std::vector<MotionMode> modes_of(const plant::VehicleType& type) {
    std::vector<MotionMode> modes;
    for (const MotionMode mode : plant::kMotionModes) {
        if (mode == MotionMode::kAuto) continue;  // a choice among the others
        const auto& own = type.motion_modes;
        if (std::find(own.begin(), own.end(), mode) != own.end()) modes.push_back(mode);
    }
    return modes;
}

Error unknown_hall(const plant::HallId& hall) {
    return {Errc::kNotFound,
            {"unknown_hall", {{"hall", hall.str()}}},
            "There is no hall " + hall.str() + " in the plant.",
            {}};
}

/// The station of a request, when the vehicle may go there at all.
Result<plant::Station> target_of(const plant::Plant& plant, const LegRequest& request) {
    if (request.target_pose) {
        plant::Station place;
        place.hall = request.hall;
        place.pose = *request.target_pose;
        return place;
    }
    const plant::Station* station = plant::find_station(plant, request.target);
    if (!station) {
        return fail(Errc::kNotFound, "unknown_station",
                    "There is no station " + request.target.str() + ". Choose one of the plant's.",
                    {}, {{"station", request.target.str()}});
    }
    const auto& types = station->vehicle_types;
    if (!types.empty() && std::find(types.begin(), types.end(), request.type->id) == types.end()) {
        return fail(
            Errc::kUnreachable, "station_not_for_type",
            "Station " + std::to_string(station->number) + " is not for vehicles of type " +
                request.type->name + ". Choose another station or vehicle.",
            {}, {{"station", std::int64_t{station->number}}, {"vehicle_type", request.type->name}});
    }
    if (station->hall != request.hall) {
        return fail(Errc::kUnreachable, "other_hall",
                    "Station " + std::to_string(station->number) +
                        " stands in another hall than the vehicle. Choose one in its hall.",
                    {}, {{"from", request.hall.str()}, {"to", station->hall.str()}});
    }
    return *station;
}

}  // namespace

struct LegPlanner::Tables {
    using Key = std::pair<plant::VehicleTypeId, bool>;
    /// What legs of one body need to know of the roadmap.
    struct Prepared {
        Prepared(const Tables& of, bool is_loaded, std::shared_ptr<const Passage> shared_passage,
                 CodeReach known)
            : loaded(is_loaded),
              shared(std::move(shared_passage)),
              passage(*shared),
              reach(std::move(known)),
              lanes(of.roads, passage, of.plant.routing) {
            lanes.set_closures(of.closed_to(loaded).floors);
        }
        bool loaded;
        std::shared_ptr<const Passage> shared;
        const Passage& passage;
        CodeReach reach;
        LegRoads lanes;
    };

    explicit Tables(const plant::Plant& p)
        : plant(p), shared(std::make_shared<const RoadmapIndex>(p)), roads(*shared), free(p) {
        for (const plant::VehicleType& type : plant.vehicle_types) {
            prepare(type, false);
            if (!type.load_footprint.empty() || !type.brackets.empty()) prepare(type, true);
        }
    }

    Tables(const Tables& other)
        : plant(other.plant),
          shared(other.shared),
          roads(*shared),
          free(other.plant),
          grid(free, other.grid),
          memo(other.memo) {
        for (const auto& [key, known] : other.prepared) {
            prepared.emplace(
                key, std::make_unique<Prepared>(*this, known->loaded, known->shared, known->reach));
        }
    }

    std::unique_ptr<Prepared> prepare_for(const plant::VehicleType& type, bool loaded) const {
        return std::make_unique<Prepared>(
            *this, loaded, std::make_shared<const Passage>(roads.passage(type, loaded)),
            CodeReach(type, loaded));
    }

    void prepare(const plant::VehicleType& type, bool loaded) {
        prepared.emplace(Key{type.id, loaded}, prepare_for(type, loaded));
    }

    /// What is prepared for a type; worked out anew for one that is not the plant's (`fresh` keeps
    /// it), such as the type that a vehicle's own factsheet states.
    Prepared& of(const plant::VehicleType& type, bool loaded,
                 std::unique_ptr<Prepared>& fresh) const {
        const Body body = body_of(type, loaded);
        for (const bool with_load : {loaded, false}) {
            const auto found = prepared.find({type.id, with_load});
            if (found != prepared.end() && found->second->passage.body == body) {
                return *found->second;
            }
        }
        fresh = prepare_for(type, loaded);
        return *fresh;
    }

    /// The task of a request with everything looked up.
    Result<LegTask> task_of(const LegRequest& request, Prepared& by) const {
        const auto station = target_of(plant, request);
        if (!station) return fail(station.error());
        const Obstacles* obstacles = roads.obstacles(request.hall);
        if (!obstacles) return fail(unknown_hall(request.hall));
        std::vector<Polygon> body;
        for (const Polygon& piece : by.passage.body.pieces) {
            body.push_back(geometry::transformed(request.start, piece));
        }
        return LegTask{plant,
                       request,
                       *station,
                       plant.routing,
                       roads,
                       by.passage,
                       by.reach,
                       by.lanes,
                       closed_to(by.loaded).floors,
                       *obstacles,
                       obstacles->limits_from(body, by.passage.body.clearance_m)};
    }

    /// Options of the given modes, without what only people want to know. A free manoeuvre is
    /// suggested only where nothing else is feasible, and planned only then unless it is `wanted`
    /// anyway: it takes milliseconds.
    std::vector<ModeOption> assess(const LegRequest& request, Prepared& by,
                                   std::vector<MotionMode> modes, bool wants_free,
                                   const std::vector<StandingBody>& standing) {
        const bool may_be_free = std::erase(modes, MotionMode::kFree) > 0;
        std::vector<ModeOption> options;
        const auto task = task_of(request, by);
        for (const MotionMode mode : modes) {
            options.push_back(
                {mode, task.and_then([&](const LegTask& t) { return assess_mode(t, mode); }),
                 false});
        }
        if (task) {
            suggest(*task, options);
            add_way_over_floor(*task, grid, wants_free, options);
        }
        const bool none = std::ranges::none_of(options, &ModeOption::suggested);
        if (may_be_free && (wants_free || none)) {
            auto plan =
                task.and_then([&](const LegTask& t) { return assess_free(t, free, standing); });
            const bool suggested = none && plan;
            options.push_back({MotionMode::kFree, std::move(plan), suggested});
        }
        return options;
    }

    Result<LegPlan> plan(const LegRequest& request, bool with_free,
                         const std::vector<StandingBody>& standing = {}) {
        auto modes = modes_of(*request.type);
        if (!with_free) std::erase(modes, MotionMode::kFree);
        if (request.mode != MotionMode::kAuto) {
            std::erase_if(modes, [&](MotionMode mode) { return mode != request.mode; });
        }
        if (modes.empty()) {
            return fail(
                Errc::kUnreachable, "mode_not_supported",
                request.type->name + " cannot drive this motion mode. Choose one of its own.", {},
                {{"mode", std::string(plant::to_string(request.mode))},
                 {"vehicle_type", request.type->id.str()}});
        }
        std::unique_ptr<Tables::Prepared> fresh;
        auto options = assess(request, of(*request.type, request.loaded, fresh), modes,
                              request.mode == MotionMode::kFree, standing);
        for (ModeOption& option : options) {
            if (option.suggested) return std::move(option.plan);
        }
        // Nothing feasible: the first mode, linear, has the widest choice of ways.
        return std::move(options.front().plan);
    }

    const plant::Plant& plant;
    std::shared_ptr<const RoadmapIndex> shared;
    const RoadmapIndex& roads;
    struct Closed {
        std::vector<ClosedFloor> floors;
        LegMemo::Closures named = std::make_shared<const std::string>();
    };
    const Closed& closed_to(bool loaded) const { return loaded ? closed_to_loads : closed; }
    Closed& closed_to(bool loaded) { return loaded ? closed_to_loads : closed; }
    Closed closed;           // to who carries nothing
    Closed closed_to_loads;  // to who carries something: those, and more
    std::map<Key, std::unique_ptr<Prepared>> prepared;
    FreeLegs free;
    GridLegs grid{free};
    std::shared_ptr<LegMemo> memo = std::make_shared<LegMemo>();  // of all planners of the plant
};

namespace {

/// No closure is called so: theirs are random.
std::string id_of(const StandingBody& body) { return "stands " + body.vehicle.str(); }

}  // namespace

/// As long as it lives, floor under who stands there counts as closed for one body.
class LegPlanner::GoingRound {
public:
    GoingRound(Tables& tables, Tables::Prepared& by, const plant::HallId& hall,
               const std::vector<StandingBody>& standing)
        : closures_(tables.closed_to(by.loaded).floors), by_(by), closed_(closures_.size()) {
        for (const StandingBody& body : standing) {
            closures_.push_back({id_of(body), body.vehicle.str(), hall, body.outline, 0, true});
        }
        changed_ = !standing.empty();
        if (changed_) by.lanes.set_closures(closures_);
    }
    ~GoingRound() {
        if (!changed_) return;
        closures_.resize(closed_);
        by_.lanes.set_closures(closures_);
    }
    GoingRound(const GoingRound&) = delete;
    GoingRound& operator=(const GoingRound&) = delete;

private:
    std::vector<ClosedFloor>& closures_;
    Tables::Prepared& by_;
    std::size_t closed_;
    bool changed_;
};

bool may_need_free_manoeuvre(const LegRequest& request) {
    if (request.mode != MotionMode::kFree && request.mode != MotionMode::kAuto) return false;
    const auto& modes = request.type->motion_modes;
    return std::ranges::find(modes, MotionMode::kFree) != modes.end();
}

LegPlanner::LegPlanner(const plant::Plant& plant) : tables_(std::make_unique<Tables>(plant)) {}
LegPlanner::LegPlanner(std::unique_ptr<Tables> tables) : tables_(std::move(tables)) {}
LegPlanner LegPlanner::again() const { return LegPlanner(std::make_unique<Tables>(*tables_)); }
LegPlanner::~LegPlanner() = default;
LegPlanner::LegPlanner(LegPlanner&&) noexcept = default;
LegPlanner& LegPlanner::operator=(LegPlanner&&) noexcept = default;

std::vector<ModeOption> LegPlanner::assess_modes(const LegRequest& request,
                                                 const std::vector<StandingBody>& standing) const {
    assert(request.type);
    std::unique_ptr<Tables::Prepared> fresh;
    Tables::Prepared& by = tables_->of(*request.type, request.loaded, fresh);
    const GoingRound round(*tables_, by, request.hall, standing);
    auto options = tables_->assess(request, by, modes_of(*request.type), true, standing);
    for (ModeOption& option : options) {
        if (option.plan) {
            for (const StandingBody& body : standing) {
                std::erase(option.plan->closures, id_of(body));
            }
            describe(*request.type, by.passage.body, *tables_->roads.obstacles(request.hall),
                     standing, *option.plan);
            option.plan->chain = leg_chain(tables_->plant, request.hall, by.reach,
                                           plant::find_station(tables_->plant, request.target),
                                           option.plan->segments);
        }
    }
    return options;
}

Result<LegPlan> LegPlanner::plan_known(const LegRequest& request, bool with_free) const {
    assert(request.type);
    const auto* from = plant::find_station(tables_->plant, request.from_station);
    // A type that is not the plant's own may be another one the next time it has this address.
    const bool own = plant::find_vehicle_type(tables_->plant, request.type->id) == request.type;
    if (!own || !from || !(from->pose == request.start) || request.target_pose)
        return tables_->plan(request, with_free);
    const auto& closed = std::as_const(*tables_).closed_to(request.loaded).named;
    if (auto known = tables_->memo->find(request, with_free, closed)) return std::move(*known);
    auto plan = tables_->plan(request, with_free);
    tables_->memo->keep(request, with_free, closed, plan);
    return plan;
}

Result<LegPlan> LegPlanner::plan_primitive_leg(const LegRequest& request) const {
    return plan_known(request, false);
}

Result<LegPlan> LegPlanner::plan_leg(const LegRequest& request,
                                     const std::vector<StandingBody>& standing) const {
    if (request.mode != MotionMode::kFree) {
        auto plan = plan_known(request, false);
        if (plan || !may_need_free_manoeuvre(request)) return plan;
    }
    if (!standing.empty()) {
        auto round = tables_->plan(request, true, standing);
        if (round && round->closures.empty() && round->loads.empty()) return round;
    }
    return plan_known(request, true);
}

Result<LegPlan> LegPlanner::plan_leg_after(double first_m, LegRequest request) const {
    assert(request.type);
    std::unique_ptr<Tables::Prepared> fresh;
    const auto task = tables_->task_of(request, tables_->of(*request.type, request.loaded, fresh));
    if (!task) return fail(task.error());
    const geometry::Point2 ahead{std::cos(request.start.heading_rad),
                                 std::sin(request.start.heading_rad)};
    std::vector<Segment> segments;
    kinematics::append_straight(segments, request.start,
                                request.start.position() + first_m * ahead);
    kinematics::set_durations(*request.type, segments);
    LegDraft draft;
    draft.segments = std::move(segments);
    draft.cost = edge_cost(task->cost, std::abs(first_m), false);
    const auto first = finish(*task, MotionMode::kLinear, std::move(draft));
    if (!first) return first;
    request.start = first->segments.back().end;
    request.from_station = {};
    return plan_primitive_leg(request).map(
        [&](const LegPlan& rest) { return joined(*request.type, *first, rest); });
}

std::vector<LegAlternative> LegPlanner::alternatives(
    const LegRequest& request, const LegPlan& plan, int count,
    const std::vector<StandingBody>& standing) const {
    assert(request.type);
    std::unique_ptr<Tables::Prepared> fresh;
    Tables::Prepared& by = tables_->of(*request.type, request.loaded, fresh);
    const GoingRound round(*tables_, by, request.hall, standing);
    const auto task = tables_->task_of(request, by);
    if (!task) return {};
    std::vector<LegAlternative> found;
    for (LegDraft& draft :
         draft_other_road_legs(*task, plan.route, count + (plan.route.empty() ? 1 : 0))) {
        auto other = finish(*task, MotionMode::kLinear, std::move(draft));
        if (!other) continue;  // too narrow where it leaves its start or reaches the station
        if (plan.route.empty() && same_way(*other, plan)) continue;
        if (static_cast<int>(found.size()) == count) break;
        found.push_back(compared(task->cost, plan, std::move(*other)));
    }
    return found;
}

void LegPlanner::set_closures(const std::vector<ClosedFloor>& closures) {
    for (const bool loaded : {false, true}) {
        auto& [floors, named] = tables_->closed_to(loaded);
        floors = closed_to(loaded, closures);
        std::string names;
        for (const auto& floor : floors) names += key_of(floor);
        named = std::make_shared<const std::string>(std::move(names));
    }
    for (auto& [key, prepared] : tables_->prepared) {
        prepared->lanes.set_closures(tables_->closed_to(prepared->loaded).floors);
    }
}

MotionGraph LegPlanner::motion_graph(const plant::VehicleType& type, bool loaded) const {
    std::unique_ptr<Tables::Prepared> fresh;
    const Passage& passage = tables_->of(type, loaded, fresh).passage;
    return planning::motion_graph(tables_->plant, tables_->roads, passage, type);
}

}  // namespace pulseline::planning
