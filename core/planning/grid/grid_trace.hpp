#pragma once

#include <algorithm>

#include "core/planning/grid/grid_search.hpp"

namespace pulseline::planning {

/// Builds a route from its goal backwards, step by step, into corners, length and turns.
class RouteTrace {
public:
    RouteTrace(const GridRequest& request, GridRoute& route) : request_(request), route_(route) {
        route_.length = 0;
        route_.turns = 0;
        route_.corners.clear();
        route_.corners.push_back(at_ = request.goal);
    }

    /// The step along `direction` that led to the cell reached so far.
    void step_back(int direction) {
        if (next_ >= 0 && next_ != direction) {
            route_.corners.push_back(at_);
            ++route_.turns;
        }
        next_ = direction;
        const Cell step = kStep[static_cast<std::size_t>(direction)];
        at_ = {at_.col - step.col, at_.row - step.row};
        ++route_.length;
    }

    void finish() {
        if (next_ >= 0) route_.corners.push_back(at_);
        if (next_ >= 0 && request_.start_heading &&
            static_cast<int>(*request_.start_heading) != next_) {
            ++route_.turns;
        }
        std::reverse(route_.corners.begin(), route_.corners.end());
    }

private:
    const GridRequest& request_;
    GridRoute& route_;
    Cell at_;
    int next_ = -1;  // direction of the step that follows
};

}  // namespace pulseline::planning
