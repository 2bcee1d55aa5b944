#include "core/localisation/reflector_pose.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/angle.hpp"
#include "core/base/square.hpp"
#include "core/localisation/line_of_sight.hpp"
#include "core/localisation/rigid_fit.hpp"

namespace pulseline::localisation {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector2d;
using Jacobian = Eigen::Matrix<double, 2, 3>;

constexpr double kNamedGate = 16;  // chi-square of two degrees of freedom: one in 3,000 by chance
constexpr std::size_t kFewest = 2;
constexpr std::size_t kFewestToFind = 4;
constexpr std::size_t kMargin = 2;  // by how many more the right place is matched
constexpr int kFitRounds = 4;       // of Gauss-Newton: quadratic, and near from the beginning
constexpr double kFindSigmas = 4;
constexpr double kBase_m = 2;      // between two sights that a place is tried by
constexpr std::size_t kTried = 6;  // the nearest, two of which are known in any case
// Places tried: an odd layout of 200 reflectors suggests some 2,000, one of equal distances all.
constexpr int kMostPlaces = 4000;
constexpr double kSamePlace_m = 0.5;
constexpr double kSameTurn_rad = 0.1;

/// A sight and the reflector that it is.
struct Match {
    SeenReflector seen;
    const plant::Reflector* reflector = nullptr;
};

Matrix2d turn(double heading_rad) {
    const double c = std::cos(heading_rad);
    const double s = std::sin(heading_rad);
    return (Matrix2d() << c, -s, s, c).finished();
}

/// How the hall place of a point of the body moves with (x_m, y_m, heading_rad).
Jacobian moves(const Pose2& pose, Point2 in_body) {
    const Point2 arm = Pose2{0, 0, pose.heading_rad} * in_body;
    return (Jacobian() << 1, 0, -arm.y_m, 0, 1, arm.x_m).finished();
}

Matrix2d in_hall(const SeenReflector& seen, const Pose2& pose) {
    const Matrix2d turned = turn(pose.heading_rad);
    return turned * seen.covariance * turned.transpose();
}

Vector2d off(const Match& pair, const Pose2& pose) {
    const Point2 gap = pair.reflector->position - pose * pair.seen.in_body;
    return {gap.x_m, gap.y_m};
}

struct Fit {
    Pose2 pose;
    Matrix3d passing = Matrix3d::Zero();
    Matrix3d lasting = Matrix3d::Zero();  // of where the reflectors stand
    double chi2 = 0;
    double worst_m = 0;
    bool agrees(std::size_t pairs) const {
        return chi2 <= chi2_limit(2 * static_cast<int>(pairs) - 3);
    }
};

/// Weighted least squares over the pose, from `start` on.
Fit fit_of(std::span<const Match> pairs, const Pose2& start) {
    Fit fit;
    fit.pose = start;
    Matrix3d normal;
    const auto weight = [&](const Match& pair) -> Matrix2d {
        const Matrix2d noise =
            in_hall(pair.seen, fit.pose) + square(pair.reflector->sigma_m) * Matrix2d::Identity();
        return noise.inverse();
    };
    for (int round = 0; round < kFitRounds; ++round) {
        normal.setZero();
        Eigen::Vector3d pull = Eigen::Vector3d::Zero();
        for (const Match& pair : pairs) {
            const Jacobian j = moves(fit.pose, pair.seen.in_body);
            normal += j.transpose() * weight(pair) * j;
            pull += j.transpose() * weight(pair) * off(pair, fit.pose);
        }
        const Eigen::Vector3d step = Eigen::LDLT<Matrix3d>(normal).solve(pull);
        fit.pose = {fit.pose.x_m + step[0], fit.pose.y_m + step[1],
                    wrap(fit.pose.heading_rad + step[2])};
    }
    const Matrix3d known = normal.inverse();
    for (const Match& pair : pairs) {
        const Matrix2d w = weight(pair);
        const Eigen::Matrix<double, 3, 2> gain =
            known * moves(fit.pose, pair.seen.in_body).transpose() * w;
        fit.passing += gain * in_hall(pair.seen, fit.pose) * gain.transpose();
        fit.lasting += square(pair.reflector->sigma_m) * gain * gain.transpose();
        const Vector2d gap = off(pair, fit.pose);
        fit.chi2 += gap.dot(w * gap);
        fit.worst_m = std::max(fit.worst_m, gap.norm());
    }
    return fit;
}

/// The scanner sits a little elsewhere in the body than was calibrated, and is turned.
Matrix3d by_mounting(const Pose2& pose, const plant::NavigationScanner& scanner,
                     const ReflectorErrors& errors) {
    const Point2 at = Pose2{0, 0, pose.heading_rad} * scanner.body_from_scanner.position();
    Matrix3d sum = Matrix3d::Zero();
    sum(0, 0) = sum(1, 1) = square(errors.mounting_m);
    const Eigen::Vector3d turned(-at.y_m, at.x_m, -1);
    return sum + square(errors.mounting_rad) * turned * turned.transpose();
}

/// The one pair whose absence makes the others agree, if there is only one such.
std::optional<std::size_t> the_moved_one(std::span<const Match> pairs, const Pose2& start) {
    std::optional<std::size_t> moved;
    if (pairs.size() <= kFewest + 1) return moved;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        std::vector<Match> others(pairs.begin(), pairs.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        if (!fit_of(others, start).agrees(others.size())) continue;
        if (moved) return std::nullopt;
        moved = i;
    }
    return moved;
}

Status enough(std::size_t seen, std::size_t needed) {
    if (seen >= needed) return {};
    return fail(
        Errc::kConflict, "too_few_reflectors",
        "Of the reflectors of the hall only " + std::to_string(seen) +
            " are known to be in view, and " + std::to_string(needed) + " are needed.",
        {},
        {{"seen", static_cast<std::int64_t>(seen)}, {"needed", static_cast<std::int64_t>(needed)}});
}

Result<BeaconFix> fix_of(std::vector<Match> pairs, const Pose2& start,
                         const plant::NavigationScanner& scanner, const ReflectorErrors& errors) {
    BeaconFix found;
    Fit fit = fit_of(pairs, start);
    if (!fit.agrees(pairs.size())) {
        const auto moved = the_moved_one(pairs, start);
        if (!moved) {
            return fail(Errc::kConflict, "reflectors_disagree",
                        "The reflectors do not stand to each other as they were surveyed; survey "
                        "them again.",
                        {}, {{"residual_m", fit.worst_m}});
        }
        found.left_out.push_back({pairs[*moved].reflector->id.str(), "reflector_moved"});
        pairs.erase(pairs.begin() + static_cast<std::ptrdiff_t>(*moved));
        fit = fit_of(pairs, start);
    }
    const Matrix3d lasting = fit.lasting + by_mounting(fit.pose, scanner, errors);
    found.fix.pose = fit.pose;
    set_covariance(found.fix, fit.passing + lasting);
    found.fix.method = Method::kReflectors;
    found.fix.residual_m = fit.worst_m;
    found.lasting = rows(lasting);
    for (const Match& pair : pairs) found.fix.payloads.push_back(pair.reflector->id.str());
    std::ranges::sort(found.fix.payloads);
    return found;
}

double sigma_of(const SeenReflector& seen) { return std::sqrt(seen.covariance.trace()); }

/// A place that two sights suggest, and what else is then where it is seen.
struct Place {
    Pose2 pose;
    std::vector<Match> pairs;
};

/// How far off a sight may then be: as the two are, the more the farther it is from their middle.
double tolerance_m(std::span<const SeenReflector> seen, std::size_t a, std::size_t b,
                   std::size_t k) {
    const Point2 middle = 0.5 * (seen[a].in_body + seen[b].in_body);
    const double base_m = distance(seen[a].in_body, seen[b].in_body);
    const double lever = 1 + distance(seen[k].in_body, middle) / (base_m / 2);
    const double by_two_m = std::hypot(sigma_of(seen[a]), sigma_of(seen[b]));
    return kFindSigmas * std::hypot(sigma_of(seen[k]), lever * by_two_m);
}

double distance_squared(Point2 a, Point2 b) { return dot(a - b, a - b); }

bool is_taken(const Place& place, const plant::Reflector* reflector) {
    return std::ranges::find(place.pairs, reflector, &Match::reflector) != place.pairs.end();
}

Place place_by(std::span<const SeenReflector> seen, std::span<const plant::Reflector> reflectors,
               std::size_t a, std::size_t b, const Pose2& pose) {
    Place place{pose, {}};
    for (std::size_t k = 0; k < seen.size(); ++k) {
        const Point2 at = pose * seen[k].in_body;
        const double within_m = tolerance_m(seen, a, b, k);
        const auto near = std::ranges::min_element(reflectors, {}, [&](const plant::Reflector& r) {
            return distance_squared(r.position, at);
        });
        const double off_m = distance(near->position, at);
        if (off_m > within_m + kFindSigmas * near->sigma_m || is_taken(place, &*near)) continue;
        place.pairs.push_back({seen[k], &*near});
    }
    return place;
}

bool same(const Pose2& a, const Pose2& b) {
    return distance(a.position(), b.position()) <= kSamePlace_m &&
           std::abs(wrap(a.heading_rad - b.heading_rad)) <= kSameTurn_rad;
}

/// Of places that are the same the one with most pairs.
void keep(std::vector<Place>& places, Place place) {
    if (place.pairs.size() <= kMargin) return;
    const auto known = std::ranges::find_if(
        places, [&](const Place& other) { return same(other.pose, place.pose); });
    if (known == places.end()) {
        places.push_back(std::move(place));
    } else if (known->pairs.size() < place.pairs.size()) {
        *known = std::move(place);
    }
}

/// All of them, most pairs first; nothing: reflectors at equal distances suggest too many.
std::optional<std::vector<Place>> places_of(std::span<const SeenReflector> seen,
                                            std::span<const plant::Reflector> reflectors) {
    std::vector<Place> places;
    int tried = 0;
    const std::size_t nearest = std::min(kTried, seen.size());
    for (std::size_t a = 0; a < nearest; ++a) {
        for (std::size_t b = a + 1; b < nearest; ++b) {
            const double base_m = distance(seen[a].in_body, seen[b].in_body);
            if (base_m < kBase_m) continue;
            const double within_m = kFindSigmas * std::hypot(sigma_of(seen[a]), sigma_of(seen[b]));
            for (const auto& first : reflectors) {
                for (const auto& second : reflectors) {
                    const double apart_m = distance(first.position, second.position);
                    const double survey_m = kFindSigmas * std::hypot(first.sigma_m, second.sigma_m);
                    if (std::abs(apart_m - base_m) > within_m + survey_m) continue;
                    if (++tried > kMostPlaces) return std::nullopt;
                    const Pose2 pose = pose_by_two({seen[a].in_body, first.position},
                                                   {seen[b].in_body, second.position});
                    keep(places, place_by(seen, reflectors, a, b, pose));
                }
            }
        }
    }
    std::ranges::sort(places, std::greater{},
                      [](const Place& place) { return place.pairs.size(); });
    return places;
}

tl::unexpected<Error> ambiguous(std::int64_t places) {
    return fail(Errc::kConflict, "reflectors_ambiguous",
                "From " + std::to_string(places) +
                    " places of the hall the reflectors may look so; say where the vehicle "
                    "stands, or add reflectors at odd places.",
                {}, {{"places", places}});
}

}  // namespace

SeenReflector seen_reflector(const ReflectorSight& sight, const plant::NavigationScanner& scanner,
                             const Pose2& now_from_then) {
    const Pose2 from = now_from_then * scanner.body_from_scanner;
    const double bearing_rad = sight.bearing_rad;
    const Point2 ray{sight.range_m * std::cos(bearing_rad), sight.range_m * std::sin(bearing_rad)};
    const Matrix2d turned = turn(from.heading_rad + bearing_rad);
    const Vector2d variance(square(sight.sigma_range_m),
                            square(sight.range_m * sight.sigma_bearing_rad));
    return {from * ray, turned * variance.asDiagonal() * turned.transpose()};
}

std::vector<std::optional<std::size_t>> name_reflectors(
    std::span<const SeenReflector> seen, std::span<const plant::Reflector> reflectors,
    const BelievedPose& near) {
    std::vector<std::optional<std::size_t>> named(seen.size());
    std::vector<int> taken(reflectors.size(), 0);
    for (std::size_t i = 0; i < seen.size(); ++i) {
        const Jacobian j = moves(near.pose, seen[i].in_body);
        const Matrix2d sure = j * near.covariance * j.transpose() + in_hall(seen[i], near.pose);
        int may_be = 0;
        for (std::size_t r = 0; r < reflectors.size(); ++r) {
            const Vector2d gap = off({seen[i], &reflectors[r]}, near.pose);
            const Matrix2d noise = sure + square(reflectors[r].sigma_m) * Matrix2d::Identity();
            if (gap.dot(noise.ldlt().solve(gap)) > kNamedGate) continue;
            named[i] = r;
            ++may_be;
        }
        if (may_be != 1) named[i].reset();
        if (named[i]) ++taken[*named[i]];
    }
    for (auto& name : named) {
        if (name && taken[*name] > 1) name.reset();
    }
    return named;
}

Result<BeaconFix> locate_by_reflectors(std::span<const SeenReflector> seen,
                                       std::span<const plant::Reflector> reflectors,
                                       const plant::NavigationScanner& scanner,
                                       const BelievedPose& near, const ReflectorErrors& errors) {
    const auto named = name_reflectors(seen, reflectors, near);
    std::vector<Match> pairs;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        if (named[i]) pairs.push_back({seen[i], &reflectors[*named[i]]});
    }
    if (auto status = enough(pairs.size(), kFewest); !status) return fail(status.error());
    return fix_of(std::move(pairs), near.pose, scanner, errors);
}

Result<BeaconFix> find_by_reflectors(std::span<const SeenReflector> seen,
                                     std::span<const plant::Reflector> reflectors,
                                     const plant::NavigationScanner& scanner,
                                     const ReflectorErrors& errors) {
    std::vector<SeenReflector> nearest(seen.begin(), seen.end());
    std::ranges::sort(nearest, {},
                      [](const SeenReflector& one) { return dot(one.in_body, one.in_body); });
    auto places = places_of(nearest, reflectors);
    if (!places) return ambiguous(kMostPlaces);
    const std::size_t best = places->empty() ? 0 : places->front().pairs.size();
    if (auto status = enough(best, kFewestToFind); !status) return fail(status.error());
    const auto alike = std::ranges::count_if(
        *places, [&](const Place& place) { return place.pairs.size() + kMargin > best; });
    if (alike > 1) return ambiguous(alike);
    return fix_of(std::move(places->front().pairs), places->front().pose, scanner, errors);
}

std::vector<plant::Reflector> reflectors_in_view(const plant::Plant& plant,
                                                 const plant::HallId& hall,
                                                 const plant::NavigationScanner& scanner,
                                                 const Pose2& pose) {
    const Point2 from = (pose * scanner.body_from_scanner).position();
    std::vector<plant::Reflector> seen;
    for (const auto& reflector : plant.reflectors) {
        if (reflector.hall != hall || distance(reflector.position, from) > scanner.range_m)
            continue;
        if (in_sight(plant, hall, from, reflector.position)) seen.push_back(reflector);
    }
    return seen;
}

}  // namespace pulseline::localisation
