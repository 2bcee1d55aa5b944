#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/plant/plant.hpp"

namespace pulseline::simulation {

/// A load as it truly is, which its papers only nearly say.
struct TrueLoad {
    plant::LoadId id;
    double mass_kg = 0;
    geometry::Point2 centre;  // of gravity, from the middle of the brackets below it
};

/// The hoists and stands of a plant with what truly is on them. All vehicles of a process share
/// them: what one sets down another can take over.
class Supports {
public:
    struct Place {
        plant::HallId hall;
        geometry::Pose2 pose;  // of a vehicle below it
        double height_m = 0;   // of its brackets, at which they touch the load
        std::optional<TrueLoad> load;
    };

    Supports(const plant::Plant& plant, std::uint64_t seed);

    /// The one above a vehicle that truly stands there; nullptr: none. Lives as long as this.
    Place* above(const plant::HallId& hall, const geometry::Pose2& true_pose);

private:
    std::vector<Place> places_;
};

/// As it truly is, drawn from the seed and its name: weighed to within half a per cent.
TrueLoad true_load(const plant::Load& load, std::uint64_t seed);

}  // namespace pulseline::simulation
