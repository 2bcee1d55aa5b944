#include "core/fleet/tables/hall_index.hpp"

namespace pulseline::fleet {

std::size_t hall_index(const plant::Plant& plant, const plant::HallId& hall) {
    for (std::size_t i = 0; i < plant.halls.size(); ++i) {
        if (plant.halls[i].id == hall) return i;
    }
    return 0;
}

}  // namespace pulseline::fleet
