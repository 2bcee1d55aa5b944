#pragma once

#include <mrpt/maps/COccupancyGridMap2D.h>

#include <vector>

namespace pulseline::mapping {

/// MRPT's likelihood field (Thrun, Burgard, Fox: Probabilistic Robotics, section 6.4) of a grid
/// map, with each cell's logarithm worked out by MRPT beforehand and kept. MRPT itself takes a
/// sine, a cosine and a logarithm for each ray of each particle, 62 % of a program of vehicles.
/// The cells may not change any more after the first look. Thread safety: none.
class LikelihoodField : public mrpt::maps::COccupancyGridMap2D {
public:
    using COccupancyGridMap2D::COccupancyGridMap2D;

private:
    double internal_computeObservationLikelihood(const mrpt::obs::CObservation& seen,
                                                 const mrpt::poses::CPose3D& from) const override;
    void prepare() const;
    double log_at(double column, double row) const;
    double worked_out(float x_m, float y_m) const;

    mutable std::vector<float> logs_;  // by cell
    mutable double outside_ = 0;
    mutable unsigned columns_ = 0;
    mutable unsigned rows_ = 0;
};

}  // namespace pulseline::mapping
