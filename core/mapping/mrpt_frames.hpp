#pragma once

#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose2D.h>

#include <Eigen/Core>
#include <vector>

#include "core/control/scan.hpp"

/// What vehicles tell, as MRPT takes it.
namespace pulseline::mapping {

mrpt::poses::CPose2D in_mrpt(const geometry::Pose2& pose);
/// Covariance of (ahead_m, left_m, turn_rad).
mrpt::obs::CActionCollection movement(const geometry::Pose2& moved,
                                      const Eigen::Matrix3d& covariance);
/// One turn of each of a vehicle's scanners, to be matched.
mrpt::obs::CSensoryFrame frame_of(const std::vector<control::Scan>& scans);
/// To be drawn: there MRPT divides the field by the number of rays, not of the steps between them,
/// so that half a step was missing on average, 5 cm at a wall 25 m away.
mrpt::obs::CSensoryFrame frame_to_draw(const std::vector<control::Scan>& scans);

}  // namespace pulseline::mapping
