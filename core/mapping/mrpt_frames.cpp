#include "core/mapping/mrpt_frames.hpp"

#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPosePDFGaussian.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pulseline::mapping {
namespace {

constexpr float kFarther_m = 1000;  // than any of them reaches

/// `steps`: between its rays, as MRPT counts them.
mrpt::obs::CObservation2DRangeScan::Ptr range_scan(const control::Scan& scan, std::size_t number,
                                                   std::size_t steps) {
    auto seen = mrpt::obs::CObservation2DRangeScan::Create();
    const std::size_t rays = scan.ranges_m.size();
    const double field_rad = scan.step_rad * static_cast<double>(steps);
    seen->sensorLabel = "scanner" + std::to_string(number);
    seen->aperture = static_cast<float>(field_rad);
    seen->rightToLeft = true;
    seen->maxRange = kFarther_m;
    // MRPT's rays lie on both sides of the sensor's middle alike.
    const geometry::Pose2& sensor = scan.body_from_sensor;
    seen->sensorPose = mrpt::poses::CPose3D(sensor.x_m, sensor.y_m, 0,
                                            sensor.heading_rad + scan.first_rad + field_rad / 2);
    seen->resizeScan(rays);
    for (std::size_t i = 0; i < rays; ++i) {
        const bool met = std::isfinite(scan.ranges_m[i]) && scan.ranges_m[i] > 0;
        seen->setScanRange(i, met ? scan.ranges_m[i] : 0);
        seen->setScanRangeValidity(i, met);
    }
    return seen;
}

}  // namespace

mrpt::poses::CPose2D in_mrpt(const geometry::Pose2& pose) {
    return {pose.x_m, pose.y_m, pose.heading_rad};
}

mrpt::obs::CActionCollection movement(const geometry::Pose2& moved,
                                      const Eigen::Matrix3d& covariance) {
    mrpt::obs::CActionRobotMovement2D movement;
    // So that MRPT takes this covariance and makes none of its own.
    movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
    movement.poseChange = mrpt::poses::CPosePDFGaussian::Create(
        in_mrpt(moved), mrpt::math::CMatrixDouble33(covariance));
    // What maps are built with takes it from here.
    auto& model = movement.motionModelConfiguration.gaussianModel;
    model = {0,
             0,
             0,
             0,
             std::sqrt(std::max(covariance(0, 0), covariance(1, 1))),
             std::sqrt(covariance(2, 2))};
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    return actions;
}

mrpt::obs::CSensoryFrame frame_of(const std::vector<control::Scan>& scans) {
    mrpt::obs::CSensoryFrame frame;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        frame.insert(range_scan(scans[i], i, scans[i].ranges_m.size() - 1));
    }
    return frame;
}

mrpt::obs::CSensoryFrame frame_to_draw(const std::vector<control::Scan>& scans) {
    mrpt::obs::CSensoryFrame frame;
    for (std::size_t i = 0; i < scans.size(); ++i) {
        frame.insert(range_scan(scans[i], i, scans[i].ranges_m.size()));
    }
    return frame;
}

}  // namespace pulseline::mapping
