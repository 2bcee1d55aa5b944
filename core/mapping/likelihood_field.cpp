#include "core/mapping/likelihood_field.hpp"

#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

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

void LikelihoodField::prepare() const {
    columns_ = getSizeX();
    rows_ = getSizeY();
    logs_.assign(std::size_t{columns_} * rows_, std::numeric_limits<float>::quiet_NaN());
    outside_ = worked_out(getXMin() - 1e4F, getYMin() - 1e4F);
}

inline double LikelihoodField::log_at(double column, double row) const {
    if (!(column >= 0 && column < columns_ && row >= 0 && row < rows_)) return outside_;
    const auto c = static_cast<unsigned>(column);
    const auto r = static_cast<unsigned>(row);
    float& known = logs_[std::size_t{r} * columns_ + c];
    if (std::isnan(known)) {
        known = static_cast<float>(worked_out(idx2x(c), idx2y(r)));
    }
    return static_cast<double>(known);
}

double LikelihoodField::worked_out(float x_m, float y_m) const {
    mrpt::maps::CSimplePointsMap one;
    one.insertPoint(x_m, y_m);
    return computeLikelihoodField_Thrun(&one);
}

}  // namespace pulseline::mapping
