#include "server/agent/stop_senses.hpp"

namespace pulseline::agent {

Result<vda5050::StopMeasurement> StopSenses::measure(const vda5050::StopTarget& target) {
    fix_.reset();
    const auto light = light_ != nullptr ? light_->mean() : std::nullopt;
    const bool by_codes = light_ == nullptr || !target.markers.empty();
    if (by_codes) {
        auto measured = cameras_.measure(target);
        if (measured && !(light && light->fix.sigma_xy_m < measured->sigma_xy_m)) {
            fix_ = cameras_.take_fix();
            return measured;
        }
        if (!measured && !light) return measured;
        (void)cameras_.take_fix();
    }
    if (!light) {
        if (light_->why_not()) return fail(*light_->why_not());
        return fail(Errc::kConflict, "no_light",
                    "The vehicle was not told yet where the transmitters stand; wait until it has "
                    "connected.");
    }
    fix_ = light->fix;
    return vda5050::StopMeasurement{fix_->pose, fix_->sigma_xy_m, fix_->sigma_heading_rad,
                                    localisation::to_string(fix_->method), fix_->payloads};
}

}  // namespace pulseline::agent
