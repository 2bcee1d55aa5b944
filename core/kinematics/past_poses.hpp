#pragma once

#include <deque>

#include "core/geometry/pose2.hpp"

namespace pulseline::kinematics {

/// So much of an even way between two poses; 0 is `from`.
geometry::Pose2 part_way(const geometry::Pose2& from, const geometry::Pose2& to, double share);

/// Where a body was lately, for what is known only some time after it was seen.
class PastPoses {
public:
    /// It is here, `passed_s` after it was added last; older than `kept_s` is forgotten.
    void add(const geometry::Pose2& pose, double passed_s, double kept_s);
    void clear() { past_.clear(); }

    /// Not into the future either.
    bool reach_back(double age_s) const {
        return !past_.empty() && age_s >= 0 && age_s <= past_.back().age_s;
    }
    /// Between two of them as on an even way; the oldest where none is so old. REQUIRES: one was
    /// added.
    geometry::Pose2 at(double age_s) const;

private:
    struct Past {
        double age_s = 0;
        geometry::Pose2 pose;
    };
    std::deque<Past> past_;  // newest first
};

}  // namespace pulseline::kinematics
