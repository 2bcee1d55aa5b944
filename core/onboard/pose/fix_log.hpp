#pragma once

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/geometry/pose2.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// What put the vehicle's pose right.
enum class PoseSource { kPerson, kStop, kCodes, kLight, kReflectors, kContours };
/// As NavigationStatus::by has it.
const char* to_string(PoseSource source);

/// The last fixes of a vehicle's pose and what became of them, for people: why it stands where it
/// says. Codes have an entry each. Beacons and contours tell many times a second, so that alike
/// ones share one, which counts them. Thread safety: none. No clock: time passes by step().
class FixLog {
public:
    void step(double dt_s);

    /// Each moves the pose, or would have, by `off`, in any frame. `what`: payload of a code, as it
    /// reads.
    void took(PoseSource by, const std::string& what, const geometry::Pose2& off);
    /// It agrees with what is known better.
    void agreed(PoseSource by, const geometry::Pose2& off);
    /// It contradicts the way driven and is believed all the same.
    void began_anew(PoseSource by, const std::string& what, const geometry::Pose2& off);
    void refused(PoseSource by, const std::string& what, const std::string& why,
                 const geometry::Pose2& off = {});

    /// The newest first, vda5050::kMostPoseFixes of them at most.
    const std::vector<vda5050::PoseFixReport>& newest() const { return newest_; }

private:
    void add(vda5050::PoseFixReport fix, const geometry::Pose2& off);

    std::vector<vda5050::PoseFixReport> newest_;
};

}  // namespace pulseline::onboard
