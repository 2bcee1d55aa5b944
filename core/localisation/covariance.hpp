#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

namespace pulseline::localisation {

/// Of (x_m, y_m, heading_rad), row by row, where plain data crosses a border.
using CovarianceRows = std::array<std::array<double, 3>, 3>;

inline Eigen::Matrix3d matrix(const CovarianceRows& rows) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            m(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    return m;
}

inline CovarianceRows rows(const Eigen::Matrix3d& m) {
    CovarianceRows rows{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = m(i, j);
    return rows;
}

/// Sigma of the place along its worse axis [m].
inline double worse_axis_m(const Eigen::Matrix3d& covariance) {
    const double middle = (covariance(0, 0) + covariance(1, 1)) / 2;
    const double apart = std::hypot((covariance(0, 0) - covariance(1, 1)) / 2, covariance(0, 1));
    return std::sqrt(std::max(0.0, middle + apart));
}

}  // namespace pulseline::localisation
