#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/mapping/monte_carlo.hpp"
#include "core/onboard/drive.hpp"
#include "core/onboard/pose/beacon_correction.hpp"
#include "core/onboard/pose/odometry_trail.hpp"
#include "core/onboard/pose/pose_estimate.hpp"
#include "core/onboard/scanners.hpp"

namespace pulseline::onboard {

/// Of (ahead_m, left_m, turn_rad), for a short way that the wheels have told.
Eigen::Matrix3d way_covariance(const geometry::Pose2& way,
                               const localisation::OdometryNoise& noise);

/// What its scanners see of walls and things, against the map of the hall, corrects the pose that
/// the vehicle steers by (natural features; Li 2022's second method), as BeaconCorrection says.
/// Where a person said that it stands, 0.1 m and 5 deg off, it finds the place. Thread safety:
/// none. No clock: time passes by step().
class ContourWatch {
public:
    /// Driving it looks 20 times a second, where the steps are that short. Standing it looks as
    /// often as this until it has seen all that there is to see.
    static constexpr double kStanding_s = 0.3;

    /// All must outlive it.
    ContourWatch(Scanners& scanners, const Drive& drive, PoseEstimate& estimate,
                 const OdometryTrail& trail, std::shared_ptr<const mapping::MatchedMap> map,
                 std::uint64_t seed);

    /// After each step of the trail. Without a pose (`located`) it does nothing.
    void step(double dt_s, bool located);

    /// The newest pose by contours; nothing: the last look gave none.
    const std::optional<localisation::BeaconFix>& newest() const { return newest_; }
    /// Of the rays that met something, the share that the map explains; nothing: it has not looked.
    const std::optional<double>& explained() const { return explained_; }
    /// Error contours_lost {through}: it sees through what the map has there.
    const std::optional<Error>& why_not() const { return why_not_; }
    /// What the last look lacked to tell the whole pose: something near, or features: walls look
    /// alike all along them.
    enum class Lacks { kNothing, kThingsNear, kFeatures };
    Lacks lacks() const { return lacks_; }
    /// The map has been wrong for some looks: it slows down, and stops the sooner when it is lost.
    bool doubts() const { return doubts_; }
    /// It has looked around again and again, and no code has told since the map was right last, or
    /// some metres back: it is not where it believes to be.
    bool lost() const { return lost_; }

private:
    bool is_due(double dt_s);
    void begin();
    void look();
    void contradict();
    void correct(const mapping::MonteCarlo::Look& look);

    Scanners& scanners_;
    const Drive& drive_;
    PoseEstimate& estimate_;
    const OdometryTrail& trail_;
    BeaconCorrection correction_;
    mapping::MonteCarlo particles_;
    std::vector<control::Scan> scans_;
    std::optional<int> begun_;     // of the estimate; nothing: it has no pose
    geometry::Pose2 looked_from_;  // by the trail
    double news_share_ = 1;        // of what the newest look saw, against one farther away
    double since_look_s_ = 0;      // own time, as the next
    double stood_s_ = 0;           // since the last look
    int looks_standing_ = 0;
    int contradicted_ = 0;               // looks in a row
    geometry::Pose2 contradicted_from_;  // where the newest of them was counted, by the trail
    int by_codes_ = 0;                   // of the estimate, when the map was right last
    bool doubts_ = false;
    bool lost_ = false;
    std::optional<localisation::BeaconFix> newest_;
    std::optional<double> explained_;
    std::optional<Error> why_not_;
    Lacks lacks_ = Lacks::kNothing;
};

}  // namespace pulseline::onboard
