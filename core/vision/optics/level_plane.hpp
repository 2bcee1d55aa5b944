#pragma once

#include <cmath>
#include <opencv2/core/matx.hpp>
#include <vector>

namespace pulseline::vision {

/// Grey level of one material (paper, ink) over a marker: light falls off about linearly there.
/// Nearly least absolute values, so that a third of the points may be dirt.
class LevelPlane {
public:
    void add(double x, double y, double level) { points_.emplace_back(x, y, level); }
    std::size_t size() const { return points_.size(); }
    void fit() {
        for (int pass = 0; pass < 5; ++pass) {
            cv::Matx33d normal = cv::Matx33d::zeros();
            cv::Vec3d right;
            for (const cv::Vec3d& p : points_) {
                const double off = std::abs(p[2] - at(p[0], p[1]));
                const double w = pass == 0 ? 1 : 1 / (3 + off);
                const cv::Vec3d j(1, p[0], p[1]);
                normal += w * j * j.t();
                right += w * p[2] * j;
            }
            plane_ = normal.solve(right, cv::DECOMP_CHOLESKY);
        }
    }
    double at(double x, double y) const { return plane_[0] + plane_[1] * x + plane_[2] * y; }

private:
    std::vector<cv::Vec3d> points_;
    cv::Vec3d plane_;
};

}  // namespace pulseline::vision
