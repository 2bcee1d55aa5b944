#include "core/localisation/error_budget.hpp"

#include <cmath>

namespace pulseline::localisation {

double code_sigma_m(const ErrorBudget& budget, double height_m, double offset_m, double image_m) {
    const double tilt = height_m * std::tan(budget.tilt_rad);
    const double scale = budget.relative_scale * offset_m;
    const double height = budget.height_change_m / height_m * offset_m;
    double sum = 0;
    for (const double part :
         {budget.survey_m, budget.mounting_m, tilt, scale, height, budget.print_m, image_m})
        sum += part * part;
    return std::sqrt(sum);
}

}  // namespace pulseline::localisation
