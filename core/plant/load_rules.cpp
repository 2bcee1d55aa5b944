#include "core/plant/load_rules.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/gravity.hpp"

namespace pulseline::plant {
namespace {

constexpr double kEmpty = 0.01;  // of the largest load: forces below it are noise
constexpr double kUsualRating = 1.5;

const Bracket* find_bracket(const VehicleType& type, const std::string& name) {
    const auto found = std::ranges::find(type.brackets, name, &Bracket::name);
    return found == type.brackets.end() ? nullptr : &*found;
}

double total_n(const std::vector<BracketForce>& forces) {
    double sum_n = 0;
    for (const BracketForce& one : forces) sum_n += one.force_n;
    return sum_n;
}

std::optional<Reason> overloaded_bracket(const VehicleType& type,
                                         const std::vector<BracketForce>& forces) {
    const auto most = std::ranges::max_element(forces, {}, &BracketForce::force_n);
    if (most == forces.end() || type.brackets.empty()) return std::nullopt;
    const double limit_n = bracket_rating_n(type);
    if (most->force_n <= limit_n) return std::nullopt;
    return Reason{"bracket_overloaded",
                  {{"bracket", most->bracket}, {"force_n", most->force_n}, {"limit_n", limit_n}}};
}

/// The wheels stand there; fewer than three hold no load by themselves, and nothing is asked.
bool inside_wheel_base(const VehicleType& type, Point2 centre) {
    const Polygon base = wheel_base(type);
    return base.size() < 3 || geometry::contains(base, centre);
}

}  // namespace

std::optional<LoadOnBrackets> load_on(const VehicleType& type,
                                      const std::vector<BracketForce>& forces) {
    LoadOnBrackets load{total_n(forces), {}};
    if (forces.empty() || load.force_n <= kEmpty * type.max_load_kg * kGravity_mps2) {
        return std::nullopt;
    }
    for (const BracketForce& one : forces) {
        const Bracket* bracket = find_bracket(type, one.bracket);
        if (bracket == nullptr) continue;
        load.centre = load.centre + (one.force_n / load.force_n) * bracket->position;
    }
    return load;
}

double bracket_rating_n(const VehicleType& type) {
    assert(!type.brackets.empty());
    const double stated_n = type.load_rules.bracket_rating_n;
    if (stated_n > 0) return stated_n;
    return kUsualRating * kGravity_mps2 * type.max_load_kg /
           static_cast<double>(type.brackets.size());
}

bool weighs_as_known(double measured_kg, double known_kg) {
    constexpr double kUnlike = 0.05;
    return known_kg == 0 || std::abs(measured_kg - known_kg) <= kUnlike * known_kg;
}

std::optional<BracketShare> worst_bracket(const VehicleType& type,
                                          const std::vector<BracketForce>& forces) {
    const auto load = load_on(type, forces);
    if (type.brackets.empty() || !load) return std::nullopt;
    double middle_m = 0;
    for (const Bracket& bracket : type.brackets) {
        middle_m += bracket.position.x_m / static_cast<double>(type.brackets.size());
    }
    std::map<bool, std::vector<BracketForce>> ends;  // whether in front of the middle
    for (const BracketForce& one : forces) {
        const Bracket* bracket = find_bracket(type, one.bracket);
        if (bracket != nullptr) ends[bracket->position.x_m > middle_m].push_back(one);
    }
    const double mean_n = load->force_n / static_cast<double>(forces.size());
    std::optional<BracketShare> worst;
    std::pair<double, double> most{-1, -1};
    for (const auto& [in_front, of_end] : ends) {
        const double end_n = total_n(of_end) / static_cast<double>(of_end.size());
        if (end_n <= 0) continue;  // it all hangs on the other end
        for (const BracketForce& one : of_end) {
            const double share = one.force_n / end_n - 1;
            const std::pair departs{std::round(1e6 * std::abs(share)),
                                    std::abs(one.force_n - mean_n)};
            if (departs <= most) continue;
            most = departs;
            worst = BracketShare{one.bracket, share, type.load_rules.most_unbalance};
        }
    }
    return worst;
}

std::optional<Reason> load_fault(const VehicleType& type, const std::vector<BracketForce>& forces) {
    const double load_kg = total_n(forces) / kGravity_mps2;
    if (load_kg > type.max_load_kg) {
        return Reason{"load_too_heavy", {{"load_kg", load_kg}, {"max_load_kg", type.max_load_kg}}};
    }
    if (auto overloaded = overloaded_bracket(type, forces)) return overloaded;
    const auto load = load_on(type, forces);
    if (!load) return std::nullopt;
    if (const auto worst = worst_bracket(type, forces);
        worst && std::abs(worst->share) > worst->limit) {
        return Reason{"load_unbalanced",
                      {{"bracket", worst->bracket},
                       {"unbalance", std::abs(worst->share)},
                       {"limit", worst->limit}}};
    }
    return centre_fault(type, load->centre);
}

std::optional<Reason> centre_fault(const VehicleType& type, Point2 centre) {
    const Params params{{"x_m", centre.x_m}, {"y_m", centre.y_m}};
    if (!inside_wheel_base(type, centre)) return Reason{"load_outside_wheel_base", params};
    const Polygon& allowed = type.load_rules.centre;
    if (!allowed.empty() && !geometry::contains(allowed, centre)) {
        return Reason{"load_outside_limits", params};
    }
    return std::nullopt;
}

Point2 bracket_middle(const VehicleType& type) {
    Point2 sum;
    for (const Bracket& bracket : type.brackets) sum = sum + bracket.position;
    const auto count = static_cast<double>(std::max<std::size_t>(type.brackets.size(), 1));
    return (1 / count) * sum;
}

}  // namespace pulseline::plant
