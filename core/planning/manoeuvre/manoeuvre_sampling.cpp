#include "core/planning/manoeuvre/manoeuvre_sampling.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSampler.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace pulseline::planning {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using geometry::Pose2;

constexpr double kRange_share = 0.15;  // of the hall's extent: longest branch grown at once

Pose2 pose_of(const ob::State* state) {
    const auto* at = state->as<ob::SE2StateSpace::StateType>();
    return {at->getX(), at->getY(), at->getYaw()};
}

void set(ob::State* state, const Pose2& pose) {
    auto* at = state->as<ob::SE2StateSpace::StateType>();
    at->setXY(pose.x_m, pose.y_m);
    at->setYaw(pose.heading_rad);
}

/// Draws from a generator of our own.
class Sampler : public ob::StateSampler {
public:
    Sampler(const ob::SE2StateSpace* space, std::uint64_t seed)
        : ob::StateSampler(space), bounds_(space->getBounds()), random_(seed) {}

    void sampleUniform(ob::State* state) override {
        set(state, {between(bounds_.low[0], bounds_.high[0]),
                    between(bounds_.low[1], bounds_.high[1]), between(-kPi, kPi)});
    }
    void sampleUniformNear(ob::State* state, const ob::State* near, double distance) override {
        const Pose2 at = pose_of(near);
        set(state, {at.x_m + between(-distance, distance), at.y_m + between(-distance, distance),
                    wrap(at.heading_rad + between(-distance, distance))});
        space_->enforceBounds(state);
    }
    void sampleGaussian(ob::State* state, const ob::State* mean, double deviation) override {
        sampleUniformNear(state, mean, 2 * deviation);  // no planner used here asks for it
    }

private:
    // std::uniform_real_distribution differs between standard libraries.
    double between(double from, double to) {
        return from + (to - from) * static_cast<double>(random_() >> 11) * 0x1p-53;
    }

    ob::RealVectorBounds bounds_;
    std::mt19937_64 random_;
};

/// SE(2) with the steering's least way between two poses as its straight line.
class SteeringSpace : public ob::SE2StateSpace {
public:
    SteeringSpace(const ManoeuvreTask& task, std::uint64_t seed)
        : task_(task), steering_(task.steering), seed_(seed) {}

    double distance(const ob::State* a, const ob::State* b) const override {
        task_.room.add_work(kWaysWork);
        return steering_.least_cost_m(pose_of(a), pose_of(b));
    }
    void interpolate(const ob::State* from, const ob::State* to, double share,
                     ob::State* state) const override {
        const Pose2 start = pose_of(from);
        steering_.ways(start, pose_of(to), ways_);
        task_.room.add_work(kWaysWork);
        const Way& way = ways_.front();
        double left = share * std::max(0.0, way.cost_m - Steering::kStop_m * (way.count - 1));
        Pose2 at = start;
        for (int i = 0; i < way.count; ++i) {
            const Move& move = way.moves[static_cast<std::size_t>(i)];
            const double cost = steering_.cost_m(move);
            at = moved(at, move, std::min(1.0, left / cost));
            if (left <= cost) break;
            left -= cost;
        }
        set(state, at);
    }
    bool isMetricSpace() const override { return false; }  // so that neighbours are found without
    double getMaximumExtent() const override {             // OMPL's own random choice of pivots
        const auto& b = getBounds();
        return std::hypot(b.high[0] - b.low[0], b.high[1] - b.low[1]) + kPi * steering_.radius_m();
    }
    ob::StateSamplerPtr allocDefaultStateSampler() const override {
        return std::make_shared<Sampler>(this, seed_++);
    }

private:
    const ManoeuvreTask& task_;
    const Steering& steering_;
    mutable std::uint64_t seed_;
    mutable std::vector<Way> ways_;
};

class RoomMotions : public ob::MotionValidator {
public:
    RoomMotions(const ob::SpaceInformationPtr& information, const ManoeuvreTask& task)
        : ob::MotionValidator(information), task_(task) {}

    bool checkMotion(const ob::State* a, const ob::State* b) const override {
        task_.steering.ways(pose_of(a), pose_of(b), ways_);
        task_.room.add_work(kWaysWork);
        return task_.room.is_free(pose_of(a), ways_.front());
    }
    bool checkMotion(const ob::State* a, const ob::State* b,
                     std::pair<ob::State*, double>& last_valid) const override {
        if (checkMotion(a, b)) return true;
        if (last_valid.first != nullptr) set(last_valid.first, pose_of(a));
        last_valid.second = 0;
        return false;
    }

private:
    const ManoeuvreTask& task_;
    mutable std::vector<Way> ways_;
};

/// A planner whose own generator starts from our seed.
template <class Planner>
class Seeded : public Planner {
public:
    Seeded(const ob::SpaceInformationPtr& information, std::uint64_t seed) : Planner(information) {
        this->rng_.setLocalSeed(static_cast<std::uint_fast32_t>(seed));
    }
};

ob::PlannerPtr planner_of(SamplingPlanner planner, const ob::SpaceInformationPtr& information,
                          std::uint64_t seed) {
    const double range_m = kRange_share * information->getMaximumExtent();
    if (planner == SamplingPlanner::kBiEst) {
        auto bi_est = std::make_shared<Seeded<og::BiEST>>(information, seed);
        bi_est->setRange(range_m);
        return bi_est;
    }
    auto connect = std::make_shared<Seeded<og::RRTConnect>>(information, seed);
    connect->setRange(range_m);
    return connect;
}

/// Appends the way that the planner found free between two states. It may have grown the edge from
/// its other end, where the least of several equal ways can be another one.
bool append_edge(const ManoeuvreTask& task, const Pose2& from, const Pose2& to, Moves& moves) {
    std::vector<Way> ways;
    task.steering.ways(from, to, ways);
    const auto there = std::find_if(ways.begin(), ways.end(),
                                    [&](const Way& way) { return task.room.is_free(from, way); });
    if (there != ways.end()) {
        for (int k = 0; k < there->count; ++k) {
            append(moves, there->moves[static_cast<std::size_t>(k)]);
        }
        return true;
    }
    task.steering.ways(to, from, ways);
    for (const Way& way : ways) {
        if (!task.room.is_free(to, way)) continue;
        for (int k = way.count - 1; k >= 0; --k) {
            Move back = way.moves[static_cast<std::size_t>(k)];
            back.amount = -back.amount;
            append(moves, back);
        }
        return true;
    }
    return false;
}

}  // namespace

Moves sampling_search(const ManoeuvreTask& task, SamplingPlanner planner, std::uint64_t seed,
                      long work_limit) {
    // OMPL would wait for another goal for ever, and do no work that ends it.
    if (!task.room.is_free(task.start) || !task.room.is_free(task.goal)) return {};
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    const auto space = std::make_shared<SteeringSpace>(task, seed);
    const geometry::Box box = task.room.field().box();
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0, box.min.x_m);
    bounds.setLow(1, box.min.y_m);
    bounds.setHigh(0, box.max.x_m);
    bounds.setHigh(1, box.max.y_m);
    space->setBounds(bounds);

    const auto information = std::make_shared<ob::SpaceInformation>(space);
    information->setStateValidityChecker(
        [&](const ob::State* state) { return task.room.is_free(pose_of(state)); });
    information->setMotionValidator(std::make_shared<RoomMotions>(information, task));
    information->setup();
    ob::ScopedState<ob::SE2StateSpace> start(space);
    ob::ScopedState<ob::SE2StateSpace> goal(space);
    set(start.get(), task.start);
    set(goal.get(), task.goal);
    const auto problem = std::make_shared<ob::ProblemDefinition>(information);
    problem->setStartAndGoalStates(start, goal);

    const auto search = planner_of(planner, information, seed);
    search->setProblemDefinition(problem);
    search->setup();
    const long last_work = task.room.work() + work_limit;
    const auto status = search->solve(
        ob::PlannerTerminationCondition([&] { return task.room.work() >= last_work; }));
    if (status != ob::PlannerStatus::EXACT_SOLUTION) return {};

    const auto* path = problem->getSolutionPath()->as<og::PathGeometric>();
    Moves moves;
    for (unsigned i = 1; i < path->getStateCount(); ++i) {
        if (!append_edge(task, pose_of(path->getState(i - 1)), pose_of(path->getState(i)), moves)) {
            return {};
        }
    }
    return moves;
}

}  // namespace pulseline::planning
