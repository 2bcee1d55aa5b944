#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "core/localisation/beacon_fix.hpp"
#include "core/localisation/error_budget.hpp"
#include "core/localisation/reflector_sights.hpp"

/// Pose of a vehicle by the reflectors that its navigation scanner sees (Li 2022, section 5.1, the
/// third method of its Table 1). Sights carry no name: which reflector each is, follows from where
/// the vehicle believes to be, or from how they stand to each other.
namespace pulseline::localisation {

/// A reflector in the body frame as of now.
struct SeenReflector {
    Point2 in_body;
    Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  // body frame
};

/// `now_from_then`: the body when the rays met it, seen from the body now.
SeenReflector seen_reflector(const ReflectorSight& sight, const plant::NavigationScanner& scanner,
                             const Pose2& now_from_then = {});

/// Where the vehicle believes to be.
struct BelievedPose {
    Pose2 pose;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Of each sight the reflector that it is, an index of `reflectors`; nothing: none is where it is
/// seen, or more than one may be.
std::vector<std::optional<std::size_t>> name_reflectors(
    std::span<const SeenReflector> seen, std::span<const plant::Reflector> reflectors,
    const BelievedPose& near);

/// The pose that puts the named sights onto their reflectors, each weighted by its own covariance.
/// Left out is reflector_moved, if only one does not stand where the survey says. Fails with
/// - too_few_reflectors {seen, needed}: fewer than two are known
/// - reflectors_disagree {residual_m}
Result<BeaconFix> locate_by_reflectors(std::span<const SeenReflector> seen,
                                       std::span<const plant::Reflector> reflectors,
                                       const plant::NavigationScanner& scanner,
                                       const BelievedPose& near,
                                       const ReflectorErrors& errors = {});

/// Where it stands, knowing nothing: the only place from where four reflectors at least look as
/// seen. Fails with too_few_reflectors {seen, needed}, and reflectors_ambiguous {places}: from more
/// than one place it might look so.
Result<BeaconFix> find_by_reflectors(std::span<const SeenReflector> seen,
                                     std::span<const plant::Reflector> reflectors,
                                     const plant::NavigationScanner& scanner,
                                     const ReflectorErrors& errors = {});

/// Reflectors of the hall that a scanner sees from a pose, as drawn.
std::vector<plant::Reflector> reflectors_in_view(const plant::Plant& plant,
                                                 const plant::HallId& hall,
                                                 const plant::NavigationScanner& scanner,
                                                 const Pose2& pose);

}  // namespace pulseline::localisation
