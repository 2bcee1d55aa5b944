#include "core/mapping/likelihood_field.hpp"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulseline::mapping {

double LikelihoodField::internal_computeObservationLikelihood(
    const mrpt::obs::CObservation& seen, const mrpt::poses::CPose3D& from) const {
    const auto& scan = dynamic_cast<const mrpt::obs::CObservation2DRangeScan&>(seen);
    // As MRPT thins them; the observation keeps them for all particles.
    mrpt::maps::CPointsMap::TInsertionOptions options;
    options.minDistBetweenLaserPoints = getResolution() * 0.5F;
    options.isPlanarMap = true;
    const auto* ends = scan.buildAuxPointsMap<mrpt::maps::CPointsMap>(&options);
    const auto& ahead_m = ends->getPointsBufferRef_x();
    const auto& left_m = ends->getPointsBufferRef_y();
    if (logs_.empty()) prepare();
    // In cells, from the map's corner.
    const double scale = 1 / static_cast<double>(getResolution());
    const double c = scale * std::cos(from.yaw());
    const double s = scale * std::sin(from.yaw());
    const double x = scale * (from.x() - static_cast<double>(getXMin()));
    const double y = scale * (from.y() - static_cast<double>(getYMin()));
    double sum = 0;
    for (std::size_t i = 0; i < ahead_m.size(); ++i) {
        const auto a = static_cast<double>(ahead_m[i]);
        const auto l = static_cast<double>(left_m[i]);
        sum += log_at(x + c * a - s * l, y + s * a + c * l);
    }
    return sum;
}

/// What MRPT works out for a cell depends on how far the nearest occupied one is and on nothing
/// else, so that it is asked once for each distance.
void LikelihoodField::prepare() const {
    columns_ = getSizeX();
    rows_ = getSizeY();
    const int reach = static_cast<int>(
        std::ceil(static_cast<double>(likelihoodOptions.LF_maxCorrsDistance / getResolution())));
    const int far = 2 * reach * reach + 1;
    std::vector<int> nearest2(std::size_t{columns_} * rows_, far);  // in cells, squared
    const auto at = [&](int column, int row) {
        return static_cast<std::size_t>(row) * columns_ + static_cast<std::size_t>(column);
    };
    const int columns = static_cast<int>(columns_);
    const int rows = static_cast<int>(rows_);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            if (getCell(column, row) >= 0.5F) continue;
            for (int r = std::max(0, row - reach); r <= std::min(rows - 1, row + reach); ++r) {
                for (int c = std::max(0, column - reach);
                     c <= std::min(columns - 1, column + reach); ++c) {
                    int& known = nearest2[at(c, r)];
                    known = std::min(known, (c - column) * (c - column) + (r - row) * (r - row));
                }
            }
        }
    }
    constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> by_distance(static_cast<std::size_t>(far) + 1, kUnknown);
    logs_.resize(nearest2.size());
    for (std::size_t i = 0; i < nearest2.size(); ++i) {
        float& known = by_distance[static_cast<std::size_t>(nearest2[i])];
        if (std::isnan(known)) {
            known = static_cast<float>(worked_out(idx2x(i % columns_), idx2y(i / columns_)));
        }
        logs_[i] = known;
    }
    outside_ = worked_out(getXMin() - 1e4F, getYMin() - 1e4F);
}

inline double LikelihoodField::log_at(double column, double row) const {
    if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return outside_;
    return static_cast<double>(
        logs_[std::size_t{static_cast<unsigned>(row)} * columns_ + static_cast<unsigned>(column)]);
}

double LikelihoodField::worked_out(float x_m, float y_m) const {
    mrpt::maps::CSimplePointsMap one;
    one.insertPoint(x_m, y_m);
    return computeLikelihoodField_Thrun(&one);
}

}  // namespace pulseline::mapping
