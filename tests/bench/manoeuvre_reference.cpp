#include "tests/bench/manoeuvre_reference.hpp"

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <time.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/planning/room/footprint_check.hpp"

namespace pulseline::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using geometry::Pose2;
using nlohmann::json;

constexpr double kRadius_m = 5;
constexpr double kCheckEvery_m = 0.25;
constexpr double kMostWait = 10;  // by the clock, in times of what a query may take
constexpr double kFirst_s = 3;    // for RRTConnect to show that there is a way at all

/// Of this thread: a machine that does other work meanwhile makes the search longer, not worse.
double processor_s() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Reference {
public:
    explicit Reference(const ManoeuvreScene& scene)
        : field_(scene.plant, scene.hall(), 3.0),
          check_({scene.platform().footprint}, scene.platform().clearance_m, field_) {
        for (const auto& other : scene.parked) field_.add(other.outline);
    }

    /// Length of the path found; 0: none.
    double solve(const ManoeuvreQuery& query, bool optimal, double seconds) const {
        auto space = std::make_shared<ob::ReedsSheppStateSpace>(kRadius_m);
        ob::RealVectorBounds bounds(2);
        bounds.setLow(0);
        bounds.setHigh(0, 120);
        bounds.setHigh(1, 60);
        space->setBounds(bounds);
        og::SimpleSetup setup(space);
        const auto& information = setup.getSpaceInformation();
        setup.setStateValidityChecker([this](const ob::State* state) {
            const auto* at = state->as<ob::SE2StateSpace::StateType>();
            return check_.is_free(field_, {at->getX(), at->getY(), at->getYaw()});
        });
        information->setMotionValidator(
            std::make_shared<ob::ReedsSheppMotionValidator>(information));
        setup.setStartAndGoalStates(state_of(space, query.start), state_of(space, query.goal));
        setup.setOptimizationObjective(
            std::make_shared<ob::PathLengthOptimizationObjective>(information));
        space->setup();
        space->setLongestValidSegmentFraction(kCheckEvery_m / space->getMaximumExtent());
        if (optimal) {
            setup.setPlanner(std::make_shared<og::RRTstar>(information));
        } else {
            setup.setPlanner(std::make_shared<og::RRTConnect>(information));
        }
        // A planner that waits for a goal it can reach takes no processor time, and for ever.
        const double until_s = processor_s() + seconds;
        const auto in_vain = ob::timedPlannerTerminationCondition(kMostWait * seconds);
        setup.solve(
            ob::PlannerTerminationCondition([&] { return processor_s() >= until_s || in_vain(); }));
        return setup.haveExactSolutionPath() ? setup.getSolutionPath().length() : 0;
    }

private:
    static ob::ScopedState<ob::SE2StateSpace> state_of(const ob::StateSpacePtr& space,
                                                       const Pose2& pose) {
        ob::ScopedState<ob::SE2StateSpace> state(space);
        state->setXY(pose.x_m, pose.y_m);
        state->setYaw(pose.heading_rad);
        return state;
    }

    planning::FloorField field_;
    planning::FootprintCheck check_;
};

json pose_json(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.heading_rad}; }
Pose2 pose_of(const json& from) { return {from.at(0), from.at(1), from.at(2)}; }

json read(const std::string& path) {
    std::ifstream in(path);
    return in ? json::parse(in) : json::object();
}

/// One query a line, so that the file stays short and its changes can be read.
void write(const std::string& path, json file) {
    const json queries = std::move(file["queries"]);
    file.erase("queries");
    std::string text = file.dump();
    text.back() = ',';
    text += "\"queries\":[";
    for (std::size_t i = 0; i < queries.size(); ++i) {
        text += (i == 0 ? "\n" : ",\n") + queries[i].dump();
    }
    std::ofstream(path) << text << "\n]}\n";
}

}  // namespace

void make_reference(const std::string& path, int count, double seconds, std::uint64_t seed,
                    const std::string& date) {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::RNG::setSeed(static_cast<std::uint_fast32_t>(seed));
    const ManoeuvreScene scene;
    const Reference reference(scene);
    json file = read(path);
    if (file.empty()) {
        file = {{"planner", "OMPL 1.5.2 RRTstar"},
                {"processor_seconds_per_query", seconds},
                {"seed", seed},
                {"date", date},
                {"queries", json::array()}};
    }
    std::uint64_t draw = seed + (file["queries"].empty() ? 0 : 1'000'000 * file["queries"].size());
    while (file["queries"].size() < static_cast<std::size_t>(count)) {
        const bool near = file["queries"].size() % 4 == 3;
        ManoeuvreQuery query = draw_query(scene, near, ++draw);
        const double first_m = reference.solve(query, false, kFirst_s);
        if (first_m <= 0) continue;
        query.best_m = reference.solve(query, true, seconds);
        file["queries"].push_back({{"start", pose_json(query.start)},
                                   {"goal", pose_json(query.goal)},
                                   {"near", near},
                                   {"rrt_star_m", query.best_m},
                                   {"rrt_connect_m", first_m}});
        write(path, file);
        std::printf("%zu of %d: RRT* %.1f m, RRTConnect %.1f m\n", file["queries"].size(), count,
                    query.best_m, first_m);
        std::fflush(stdout);
    }
}

std::vector<ManoeuvreQuery> read_reference(const std::string& path) {
    std::vector<ManoeuvreQuery> queries;
    const json file = read(path);
    if (file.empty()) return queries;
    for (const json& query : file.at("queries")) {
        // What one of them did not find in time the other one may have found.
        double best_m = query.at("rrt_star_m");
        const double first_m = query.at("rrt_connect_m");
        if (best_m <= 0 || first_m < best_m) best_m = first_m;
        queries.push_back(
            {pose_of(query.at("start")), pose_of(query.at("goal")), best_m, query.at("near")});
    }
    return queries;
}

}  // namespace pulseline::bench
