#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/localisation/beacon_fix.hpp"
#include "core/localisation/pose_filter.hpp"
#include "core/onboard/pose/fix_log.hpp"

namespace pulseline::onboard {

/// How well the vehicle knows where it stands: its odometry and its measured stops, fused. Sigmas
/// and score go into the state message.
class PoseEstimate {
public:
    explicit PoseEstimate(const geometry::Pose2& start,
                          const localisation::OdometryNoise& noise = {});

    /// The wheels say that it drove on to here.
    void drive_to(const geometry::Pose2& believed);
    /// It has come to rest from this share of its full speed.
    void rest(double speed_share);
    /// A code seen under way, from where the vehicle is now. Fails with innovation_gate, and leaves
    /// the pose alone, when it contradicts the way driven. One that wheels which err twice as much
    /// as is stated could explain fails, too, but is half believed: the vehicle goes between both
    /// ways, so that the next code comes into view by either, and knows its place as badly. When it
    /// agrees with another one that was refused just before, and the way from there, the vehicle is
    /// where both put it: its wheels have slipped.
    Status see(const localisation::CodeObservation& seen, const localisation::SurveyedCode& code);
    /// A pose by beacons, of where the vehicle is now; seen some centimetres ago, which the wheels
    /// have told since with errors of `since`. The filter's own way has the same errors, so that
    /// this fix cannot take them away. One that codes have told better than beacons ever could is
    /// only checked by it. Fails as the other one.
    Status see(const localisation::BeaconFix& seen,
               const Eigen::Matrix3d& since = Eigen::Matrix3d::Zero());
    /// Whether a pose by beacons agrees; nothing changes. Fails as the others.
    Status check(const localisation::BeaconFix& seen);
    /// It is where beacons put it, whatever its odometry says.
    void restart_at(const localisation::BeaconFix& seen);
    /// Without a motion, the drive believes to be here from now on.
    void led_to(const geometry::Pose2& believed);
    /// A stop was measured. One that contradicts the way driven is taken all the same, for it was
    /// seen, but as a new beginning: the vehicle was moved by hand, or its wheels slipped. However
    /// often it is measured by the same codes, it is known no better than they tell it once: where
    /// they lie and how the cameras are mounted is wrong alike each time.
    void take(const localisation::PoseFix& fix);
    /// It was told where it stands. Without sigmas: by a person who pointed there.
    void start_at(const geometry::Pose2& pose, double sigma_xy_m = 0, double sigma_heading_rad = 0,
                  PoseSource by = PoseSource::kPerson);

    /// What put the pose right last.
    PoseSource source() const { return source_; }
    /// What was said of the pose, and what became of it. Whoever owns the estimate lets time pass
    /// in it, and writes down what never comes as far as here.
    FixLog& fixes() { return fixes_; }
    const FixLog& fixes() const { return fixes_; }
    /// How often codes have told where it is.
    int by_codes() const { return by_codes_; }
    /// By the wheels, since that.
    double driven_since_m() const;
    /// How often it has begun anew, whatever its odometry said.
    int begun() const { return begun_; }
    const localisation::OdometryNoise& noise() const { return noise_; }
    /// Where it is now; the drive may believe something else until it was led there.
    geometry::Pose2 pose() const { return filter_.pose() * (inverse(driven_) * now_); }
    /// From where the drive believes to be to there, seen from the body: it is led slowly.
    geometry::Pose2 to_lead() const { return inverse(now_) * pose(); }
    /// Of x_m, y_m, heading_rad in the hall frame.
    Eigen::Matrix3d covariance() const;
    double sigma_xy_m() const;  // the worse direction
    double sigma_heading_rad() const;
    /// VDA 5050 localizationScore, against the tolerance of a usual station.
    double score() const;

private:
    void catch_up();
    geometry::Pose2 off_of(const geometry::Pose2& pose) const;
    void note(PoseSource source);
    void note_begun(PoseSource by, const std::string& what, const geometry::Pose2& off);
    void note_unused(const localisation::BeaconFix& seen, const Status& agrees);
    localisation::PoseFilter against_codes() const;
    bool knows_better_than(const Eigen::Matrix3d& lasting) const;
    bool told_again(std::span<const std::string> by) const;
    bool doubt(const localisation::CodeObservation& seen, const localisation::SurveyedCode& code);
    bool begins_by(const localisation::CodeObservation& seen,
                   const localisation::SurveyedCode& code);

    /// Where it would be if a code that was refused were right.
    struct Other {
        localisation::PoseFilter filter;
        std::string by;
        bool doubted = false;  // half believed
    };

    localisation::OdometryNoise noise_;
    localisation::PoseFilter filter_;
    std::optional<Other> other_;
    /// Of the last pose by beacons: what all of them have in common, the filter does not count.
    Eigen::Matrix3d lasting_ = Eigen::Matrix3d::Zero();
    geometry::Pose2 driven_;            // by the drive's belief, as far as the filter has followed
    geometry::Pose2 now_;               // by the drive's belief
    std::vector<std::string> told_by_;  // codes, or transmitters, of the last stop or code
    int begun_ = 0;
    PoseSource source_ = PoseSource::kPerson;
    FixLog fixes_;
    int by_codes_ = 0;
    double since_m_ = 0;  // as far as the filter has followed
};

}  // namespace pulseline::onboard
