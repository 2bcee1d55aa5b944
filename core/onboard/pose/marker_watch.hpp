#pragma once

#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "core/onboard/drive.hpp"
#include "core/onboard/pose/odometry_trail.hpp"
#include "core/onboard/pose/pose_estimate.hpp"
#include "core/onboard/pose/segment_watch.hpp"
#include "core/onboard/way_sensing.hpp"
#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Codes seen under way (edge action observeMarkers) correct the pose that the vehicle steers by:
/// rough navigation of Li 2022, section 3. A code that contradicts the way driven is refused: it
/// was moved, or exchanged. What is corrected comes into the drive little by little, so that it
/// never jerks. Thread safety: none. No clock: time passes by step().
class MarkerWatch {
public:
    /// All must outlive it.
    MarkerWatch(WaySensing& sensing, Drive& drive, PoseEstimate& estimate);

    /// After each step of the drive and of the estimate. `ahead`: the edges of the order that are
    /// not passed, the one being driven first; none while it does something else than drive them.
    void step(double dt_s, const std::deque<vda5050::OrderEdge>& ahead);

    /// Where it stands with nothing to do, what is known better by now is taken on, too, so that it
    /// tells the pose that it knows; no more than a person errs by. After each such step.
    void lead_at_rest(double dt_s);
    /// Whether it would, and is not done.
    bool has_to_lead() const;

    /// A code comes into view soon, so that longer steps would pass it unseen: of the vehicle's own
    /// time, at most. A frame of its cameras.
    static constexpr double kFineStep_s = 1.0 / 60;
    bool expects_soon() const { return !expected_.empty(); }

    /// Payloads of the codes taken since the last call.
    std::vector<std::string> take_taken() { return std::exchange(taken_, {}); }
    /// Payload of a code that was refused, as it reads, until another one is taken; empty: none.
    const std::string& refused() const { return refused_; }
    /// Payload of a code whose picture was stamped in the future, or longer ago than any camera
    /// takes, until another one is taken; empty: none. Nothing is corrected by it: a clock is
    /// wrong.
    const std::string& mistimed() const { return mistimed_; }
    /// By which numbers (PoseFilter::correct); none when it read as another code than expected.
    const Params& refused_by() const { return refused_by_; }
    const OdometryTrail& trail() const { return trail_; }
    /// What its way relies on, and whether it was read.
    const SegmentWatch& segments() const { return segments_; }

private:
    void expect(const std::deque<vda5050::OrderEdge>& ahead);
    void take(const WayReading& reading);
    void lead_drive(double own_s);

    WaySensing& sensing_;
    Drive& drive_;
    PoseEstimate& estimate_;
    OdometryTrail trail_;
    SegmentWatch segments_;
    std::vector<vda5050::SurveyedMarker> expected_;
    std::vector<std::string> read_;  // of the codes near a camera
    std::vector<std::string> taken_;
    std::string refused_;
    std::string mistimed_;
    Params refused_by_;
};

}  // namespace pulseline::onboard
