#pragma once

#include <span>
#include <vector>

#include "core/kinematics/primitives.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/localisation/pose_filter.hpp"
#include "core/plant/plant.hpp"

/// Which codes the cameras of a vehicle pass, and how far it may drive from one to the next.
namespace pulseline::localisation {

/// Farthest from a camera's foot [m] that the middle of a code may lie to be seen whole, however it
/// is turned.
double view_radius_m(const plant::Camera& camera, double size_m);

/// Shares of the segment (0 to 1, rising) at which one of the cameras has the code in view, looked
/// at every few centimetres; none: it is not passed.
std::vector<double> seen_at(const plant::Marker& marker, std::span<const plant::Camera> cameras,
                            const kinematics::Segment& segment);
bool is_passed(const plant::Marker& marker, std::span<const plant::Camera> cameras,
               const kinematics::Segment& segment);

/// One sigma of where a drive begins.
struct KnownPose {
    double place_m = 0;
    double heading_rad = 0;
};

/// One sigma [m] across a way by odometry alone, of a point `arm_m` ahead in the body.
double across_sigma_m(const KnownPose& known, double way_m, double arm_m,
                      const OdometryNoise& noise);

/// s_m of Li 2022 eq. 4 [m]: what a way by odometry alone adds to the place of the body's middle,
/// both axes together, with a heading that was known by `heading_rad` where it began.
double motion_sigma_m(double heading_rad, double way_m, const OdometryNoise& noise);

/// One sigma of a pose by one code at the border of the picture: what the survey, the camera and
/// the code's own direction leave, the last one by the camera's arm; the root of Li 2022 eq. 4.
/// His s_T is 0 here: codes are surveyed in the hall's own frame.
KnownPose known_by_code(const plant::Camera& camera, const plant::Marker& marker,
                        const ErrorBudget& budget = {});

/// The longest way [m] by odometry alone after which three sigma across it, of a point `arm_m`
/// ahead in the body, stay within `within_m`. 0: they never do.
double sure_way_m(const KnownPose& known, double arm_m, double within_m,
                  const OdometryNoise& noise);

/// A turn on a way, and what is driven behind it.
struct TurnBehind {
    double turn_rad = 0;
    double rest_m = 0;
    bool brakes = true;  // before it turns on the spot, and stands behind that
};

/// One sigma [rad] that a turn adds to the heading.
double turn_sigma_rad(double turn_rad, bool brakes, const OdometryNoise& noise);

/// The straight way [m] after which three sigma across are what they are after `way_m` with these
/// turns on it: each leaves the heading less known for the rest of the way. Never less than
/// `way_m`.
double as_straight_m(const KnownPose& known, double way_m, double arm_m,
                     std::span<const TurnBehind> turns, const OdometryNoise& noise);

/// The longest way [m] without a code after which the camera still catches the next one: three
/// sigma across the way, and the view's radius. 0: it cannot see a code of that size whole. Li 2022
/// eq. 5 as corrected (second line), with errors that grow as OdometryNoise says instead of as
/// shares of the way alone, and with the error of the heading, which it leaves out and which is
/// most of it. What codes have shown of the machine is not counted: the first two codes of a way
/// lie as far apart as the last two. `off_m`: what the code lies beside the line of the camera's
/// foot.
double blind_way_m(const plant::Camera& camera, double size_m, const ErrorBudget& budget = {},
                   const OdometryNoise& noise = {}, double off_m = 0);

}  // namespace pulseline::localisation
