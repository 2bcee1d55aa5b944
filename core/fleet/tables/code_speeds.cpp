#include "core/fleet/tables/code_speeds.hpp"

#include <algorithm>

#include "core/localisation/reading_speed.hpp"

namespace pulseline::fleet {

std::vector<Reason> check_code_speeds(const plant::Plant& plant,
                                      const std::vector<FloorClass>& classes) {
    std::vector<Reason> reasons;
    for (const auto& of_class : classes) {
        double best_mps = 0;
        for (const auto& camera : plant::cameras_of(*of_class.type, of_class.loaded)) {
            for (const auto& marker : plant.markers) {
                best_mps =
                    std::max(best_mps, localisation::reading_speed_mps(camera, marker.size_m));
            }
        }
        // Without cameras, or codes that they see whole, there is nothing to read.
        if (best_mps == 0 || best_mps >= of_class.type->max_speed_mps) continue;
        const std::string name = of_class.type->id.str() + (of_class.loaded ? " with load" : "");
        reasons.push_back({kCodesTooFast,
                           {{"class", name},
                            {"speed_mps", best_mps},
                            {"max_speed_mps", of_class.type->max_speed_mps}}});
    }
    return reasons;
}

}  // namespace pulseline::fleet
