#include "core/simulation/world/navigation_scanner.hpp"

#include <algorithm>
#include <cmath>

#include "core/localisation/line_of_sight.hpp"

namespace pulseline::simulation {
namespace {

using geometry::Point2;
using localisation::BrightEcho;

constexpr double kLate_s = 0.1;  // a turn is taken some time after it ended, at most

}  // namespace

SimulatedNavigationScanner::SimulatedNavigationScanner(const World& world,
                                                       const plant::HallId& hall,
                                                       const plant::VehicleType& type,
                                                       const Pose2& true_pose, std::uint64_t seed)
    : world_(world),
      hall_(hall),
      true_pose_(true_pose),
      actual_(*type.navigation_scanner),
      random_(seed) {
    std::normal_distribution<double> normal;
    const auto& errors = world.errors.reflector;
    actual_.body_from_scanner.x_m += errors.mounting_m * normal(random_);
    actual_.body_from_scanner.y_m += errors.mounting_m * normal(random_);
    actual_.body_from_scanner.heading_rad += errors.mounting_rad * normal(random_);
    for (const auto& reflector : world.reflectors) {
        if (reflector.hall == hall) shining_.push_back(reflector.position);
    }
    for (const auto& thing : world.shining_things) {
        if (thing.hall == hall) shining_.push_back(thing.position);
    }
    until_s_ = std::uniform_real_distribution<double>(0, 1 / actual_.rate_hz)(random_);
}

std::optional<std::vector<BrightEcho>> SimulatedNavigationScanner::take_turn(double own_s) {
    const double turn_s = 1 / actual_.rate_hz;
    past_.add(true_pose_, own_s, turn_s + kLate_s);
    until_s_ -= own_s;
    if (until_s_ > 0) return std::nullopt;
    const double ended_s = std::min(-until_s_, kLate_s);  // ago
    until_s_ += turn_s;
    if (until_s_ <= 0) until_s_ = turn_s;  // turns that nobody took are lost
    bodies_.clear();
    if (neighbours_ && actual_.z_m < kVehiclesStand_m) neighbours_(true_pose_.position(), bodies_);
    std::vector<BrightEcho> echoes;
    if (covered_) return echoes;
    Turn turn;
    const double clock_s =
        world_.errors.reflector.clock_s * std::normal_distribution<double>()(random_);
    for (const Point2 shining : shining_) add_rays(shining, ended_s, clock_s, turn);
    for (const auto& [ray, echo] : turn) echoes.push_back(echo);
    return echoes;
}

/// A turn begins looking back and goes round counter-clockwise.
void SimulatedNavigationScanner::add_rays(Point2 shining, double ended_s, double clock_s,
                                          Turn& turn) {
    const double turn_s = 1 / actual_.rate_hz;
    const auto age_at = [&](double angle_rad) {
        return ended_s + (kPi - angle_rad) / (2 * kPi) * turn_s;
    };
    double bearing_rad = 0;
    for (int round = 0; round < 3; ++round) {
        const Point2 seen = inverse(scanner_at(age_at(bearing_rad))) * shining;
        bearing_rad = std::atan2(seen.y_m, seen.x_m);
    }
    const Point2 from = scanner_at(age_at(bearing_rad)).position();
    const double away_m = distance(from, shining);
    if (away_m > actual_.range_m || away_m < 2 * actual_.reflector_radius_m) return;
    if (is_hidden(from, shining)) return;

    std::normal_distribution<double> normal;
    const double reach_rad =
        (actual_.reflector_radius_m + localisation::beam_radius_m(away_m)) / away_m;
    const auto first = static_cast<int>(std::floor((bearing_rad - reach_rad) / actual_.step_rad));
    const auto last = static_cast<int>(std::ceil((bearing_rad + reach_rad) / actual_.step_rad));
    for (int ray = first; ray <= last; ++ray) {
        const double angle_rad = wrap(ray * actual_.step_rad);
        const double age_s = age_at(angle_rad);
        const Point2 seen = inverse(scanner_at(age_s)) * shining;
        const double beside_m = seen.y_m * std::cos(angle_rad) - seen.x_m * std::sin(angle_rad);
        const double along_m = seen.x_m * std::cos(angle_rad) + seen.y_m * std::sin(angle_rad);
        const double full = localisation::remission_at(actual_, along_m, beside_m);
        const double remission = full * (1 + world_.errors.reflector.remission * normal(random_));
        if (remission < localisation::kLeastRemission) continue;
        const double range_m = along_m - kPi / 4 * actual_.reflector_radius_m +
                               actual_.sigma_range_m / std::sqrt(full) * normal(random_);
        const BrightEcho echo{wrap(angle_rad + actual_.sigma_bearing_rad * normal(random_)),
                              range_m, remission, age_s - clock_s};
        const auto [known, added] =
            turn.try_emplace(std::lround(angle_rad / actual_.step_rad), echo);
        if (!added && echo.range_m < known->second.range_m) known->second = echo;
    }
}

bool SimulatedNavigationScanner::is_hidden(Point2 from, Point2 shining) const {
    return !localisation::in_sight(world_.plant, hall_, from, shining) ||
           std::ranges::any_of(bodies_, [&](const geometry::Polygon& body) {
               return geometry::crosses(body, from, shining);
           });
}

}  // namespace pulseline::simulation
