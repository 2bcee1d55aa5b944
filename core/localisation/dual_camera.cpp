#include "core/localisation/dual_camera.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::localisation {
namespace {

constexpr double kResidualSigmas = 4;
// Below it two codes tell less about the heading than one code's own edges do.
constexpr double kShortestBaseline_m = 0.05;
// No camera and survey are better than this; keeps weights finite when a sigma is given as 0.
constexpr double kSmallestSigma_m = 1e-9;
// Of a code's own angle against the heading of all: what no careful gluing exceeds.
constexpr double kLeastAngleLimit_rad = 0.01;

struct Pair {
    Point2 body;
    Point2 hall;
    double variance_m2;
};

struct DistanceCheck {
    double residual_m = 0;
    double limit_m = 0;
};

DistanceCheck check(const Pair& a, const Pair& b) {
    return {distance(a.body, b.body) - distance(a.hall, b.hall),
            kResidualSigmas * std::sqrt(a.variance_m2 + b.variance_m2)};
}

/// The pair of codes that disagrees most, in units of its own limit.
DistanceCheck worst_distance(const std::vector<Pair>& pairs) {
    DistanceCheck worst{0, 1};
    bool first = true;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        for (std::size_t j = i + 1; j < pairs.size(); ++j) {
            const DistanceCheck c = check(pairs[i], pairs[j]);
            if (first ||
                std::abs(c.residual_m) / c.limit_m > std::abs(worst.residual_m) / worst.limit_m)
                worst = c;
            first = false;
        }
    }
    return worst;
}

double longest_baseline(const std::vector<Pair>& pairs) {
    double longest = 0;
    for (const Pair& a : pairs)
        for (const Pair& b : pairs) longest = std::max(longest, distance(a.hall, b.hall));
    return longest;
}

/// Sets pose = W - R(heading) P and its covariance, when `about` (body frame) is measured with
/// `variance_m2` per axis, independently of the heading.
void set_pose(PoseFix& fix, Point2 about, Point2 hall, double heading_rad, double variance_m2,
              double heading_variance) {
    const Point2 arm = Pose2{0, 0, heading_rad} * about;
    fix.pose = {hall.x_m - arm.x_m, hall.y_m - arm.y_m, wrap(heading_rad)};
    // d(position)/d(heading) = (arm.y, -arm.x)
    const std::array<double, 3> lever{arm.y_m, -arm.x_m, 1};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            fix.covariance[i][j] =
                lever[i] * lever[j] * heading_variance + (i == j && i < 2 ? variance_m2 : 0);
    fix.sigma_xy_m = std::sqrt(variance_m2 + dot(about, about) * heading_variance);
    fix.sigma_heading_rad = std::sqrt(heading_variance);
}

void fit_rigid(PoseFix& fix, const std::vector<Pair>& pairs) {
    double total = 0;
    Point2 body;
    Point2 hall;
    for (const Pair& p : pairs) {
        const double w = 1 / p.variance_m2;
        total += w;
        body = body + w * p.body;
        hall = hall + w * p.hall;
    }
    body = (1 / total) * body;
    hall = (1 / total) * hall;
    double sum_cross = 0;
    double sum_dot = 0;
    double information = 0;
    for (const Pair& p : pairs) {
        const Point2 b = p.body - body;
        const Point2 h = p.hall - hall;
        sum_cross += cross(b, h) / p.variance_m2;
        sum_dot += dot(b, h) / p.variance_m2;
        information += dot(b, b) / p.variance_m2;
    }
    set_pose(fix, body, hall, std::atan2(sum_cross, sum_dot), 1 / total, 1 / information);
}

const SurveyedCode* find(std::span<const SurveyedCode> survey, const std::string& payload) {
    const auto it = std::ranges::find(survey, payload, &SurveyedCode::payload);
    return it == survey.end() ? nullptr : &*it;
}

/// Each code's own angle has to tell the heading that all of them tell by their places.
Status check_angles(const PoseFix& fix, std::span<const CodeObservation> observations,
                    std::span<const SurveyedCode> survey) {
    for (const CodeObservation& seen : observations) {
        const SurveyedCode& code = *find(survey, seen.payload);
        const double residual_rad =
            wrap(code.pose.heading_rad - seen.up_rad - fix.pose.heading_rad);
        const double sigma_rad =
            std::hypot(seen.sigma_up_rad, code.sigma_heading_rad, fix.sigma_heading_rad);
        const double limit_rad = std::max(kResidualSigmas * sigma_rad, kLeastAngleLimit_rad);
        if (std::abs(residual_rad) <= limit_rad) continue;
        return fail(
            Errc::kConflict, "code_angle_mismatch",
            "The code \"" + seen.payload +
                "\" lies turned against what its place tells. Codes or cameras were "
                "exchanged for each other, or the code was turned.",
            {},
            {{"payload", seen.payload}, {"residual_rad", residual_rad}, {"limit_rad", limit_rad}});
    }
    return {};
}

/// No camera of a vehicle sees that far; beyond it sums and products lose the code's place.
constexpr double kFarthestCode_m = 1e3;

bool can_be_seen(const CodeObservation& seen) {
    // Comparisons with what is no number are false.
    return std::abs(seen.centre.x_m) <= kFarthestCode_m &&
           std::abs(seen.centre.y_m) <= kFarthestCode_m && std::isfinite(seen.up_rad) &&
           seen.sigma_m >= 0 && std::isfinite(seen.sigma_m) && seen.sigma_up_rad >= 0 &&
           std::isfinite(seen.sigma_up_rad);
}

bool is_finite(const PoseFix& fix) {
    return std::isfinite(fix.pose.x_m) && std::isfinite(fix.pose.y_m) &&
           std::isfinite(fix.pose.heading_rad) && std::isfinite(fix.sigma_xy_m) &&
           std::isfinite(fix.sigma_heading_rad);
}

Result<PoseFix> finite(PoseFix fix) {
    if (is_finite(fix)) return fix;
    return fail(Errc::kConflict, "pose_not_finite",
                "The codes give no place that can be told. Check the survey and the cameras.");
}

}  // namespace

Result<PoseFix> locate(std::span<const CodeObservation> observations,
                       std::span<const SurveyedCode> survey) {
    if (observations.empty())
        return fail(
            Errc::kNotFound, "no_marker_in_view",
            "No camera sees a code. Drive the vehicle over the station's codes or check light "
            "and lenses.");
    PoseFix fix;
    std::vector<Pair> pairs;
    for (const CodeObservation& seen : observations) {
        const SurveyedCode* code = find(survey, seen.payload);
        if (code == nullptr)
            return fail(Errc::kNotFound, "unknown_code",
                        "The code \"" + seen.payload +
                            "\" is not among the surveyed codes of this stop. Check the station or "
                            "survey the code.",
                        {}, {{"payload", seen.payload}});
        if (!can_be_seen(seen))
            return fail(Errc::kInvalid, "code_out_of_view",
                        "The code \"" + seen.payload +
                            "\" cannot lie where the camera says it sees it. Check the camera.",
                        {}, {{"payload", seen.payload}});
        const double sigma = std::max(std::hypot(seen.sigma_m, code->sigma_m), kSmallestSigma_m);
        pairs.push_back({seen.centre, code->pose.position(), sigma * sigma});
        fix.payloads.push_back(seen.payload);
    }

    if (pairs.size() >= 2) {
        const DistanceCheck worst = worst_distance(pairs);
        if (!(std::abs(worst.residual_m) <= worst.limit_m))
            return fail(
                Errc::kConflict, "code_distance_mismatch",
                "The measured distance between the codes does not fit the survey. A code was "
                "moved or exchanged, or a camera needs calibration.",
                {}, {{"residual_m", worst.residual_m}, {"limit_m", worst.limit_m}});
        fix.residual_m = worst.residual_m;
        fix.residual_limit_m = worst.limit_m;
        if (longest_baseline(pairs) >= kShortestBaseline_m) {
            fix.method = Method::kDualCamera;
            fit_rigid(fix, pairs);
            if (const auto ok = check_angles(fix, observations, survey); !ok) {
                return fail(ok.error());
            }
            return finite(std::move(fix));
        }
    }

    const auto best = std::ranges::min_element(pairs, {}, &Pair::variance_m2);
    const CodeObservation& seen = observations[static_cast<std::size_t>(best - pairs.begin())];
    const SurveyedCode& code = *find(survey, seen.payload);
    const double sigma_heading = std::hypot(seen.sigma_up_rad, code.sigma_heading_rad);
    set_pose(fix, best->body, best->hall, code.pose.heading_rad - seen.up_rad, best->variance_m2,
             sigma_heading * sigma_heading);
    return finite(std::move(fix));
}

void set_covariance(PoseFix& fix, const Eigen::Matrix3d& covariance) {
    fix.covariance = rows(covariance);
    fix.sigma_xy_m = worse_axis_m(covariance);
    fix.sigma_heading_rad = std::sqrt(covariance(2, 2));
}

const char* to_string(Method method) {
    switch (method) {
        case Method::kSingleCamera:
            return "single_camera";
        case Method::kDualCamera:
            return "dual_camera";
        case Method::kIgps:
            return "igps";
        case Method::kReflectors:
            return "reflectors";
        case Method::kContours:
            return "contours";
    }
    return "";
}

}  // namespace pulseline::localisation
