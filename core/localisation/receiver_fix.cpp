#include "core/localisation/receiver_fix.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/localisation/rigid_fit.hpp"

namespace pulseline::localisation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Of a place in any direction, one sigma: a receiver that knows its place no better navigates by
// nothing.
constexpr double kWorst_m = 0.005;
// The weights need the distances to 1 %; the first solution is nearer.
constexpr int kRounds = 3;

/// A transmitter and what was seen of it.
struct Beam {
    std::size_t transmitter = 0;
    const plant::Transmitter* from = nullptr;
    const LightAngles* light = nullptr;
};

struct Solution {
    ReceiverFix fix;
    double chi2 = 0;
    bool agrees() const { return chi2 <= chi2_limit(static_cast<int>(fix.rows.size()) - 3); }
    double sigma_m() const {
        const Eigen::SelfAdjointEigenSolver<Matrix3d> axes(fix.covariance, Eigen::EigenvaluesOnly);
        return std::sqrt(std::max(0.0, axes.eigenvalues()[2]));
    }
};

Vector3d head_of(const plant::Transmitter& transmitter) {
    return {transmitter.position.x_m, transmitter.position.y_m, transmitter.z_m};
}

LightRow row_of(const Beam& beam, const Matrix3d& turn, const plant::LightPlane& sheet,
                double angle_rad, Point2 way) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    const Vector3d in_head(c * sheet.a - s * sheet.b, s * sheet.a + c * sheet.b, 1);
    const double length = in_head.norm();
    LightRow row;
    row.transmitter = beam.transmitter;
    row.normal = turn * in_head / length;
    row.constant_m = sheet.offset_m / length -
                     row.normal.dot(head_of(*beam.from) + Vector3d(way.x_m, way.y_m, 0));
    return row;
}

std::vector<LightRow> rows_of(std::span<const Beam> beams) {
    std::vector<LightRow> rows;
    rows.reserve(2 * beams.size());
    for (const Beam& beam : beams) {
        const Matrix3d turn = hall_from_head(*beam.from);
        rows.push_back(
            row_of(beam, turn, beam.from->first, beam.light->first_rad, beam.light->way_first));
        rows.push_back(
            row_of(beam, turn, beam.from->second, beam.light->second_rad, beam.light->way_second));
    }
    return rows;
}

/// What each row is known to, from where the receiver nearly is.
void weigh(std::vector<LightRow>& rows, std::span<const Beam> beams, const Vector3d& near) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const plant::Transmitter& from = *beams[i / 2].from;
        const Vector3d seen = near - head_of(from);
        const Vector3d axis = hall_from_head(from).col(2);
        rows[i].per_rad_m = axis.cross(rows[i].normal).dot(seen);
        rows[i].per_turn_m = rows[i].normal.cross(seen);
        rows[i].sigma_m = std::sqrt(square(from.sigma_rad * rows[i].per_rad_m) +
                                    square(from.sigma_turn_rad) * rows[i].per_turn_m.squaredNorm() +
                                    square(from.sigma_place_m));
    }
}

/// Nothing where the sheets do not meet in one point.
std::optional<Solution> solve(std::span<const Beam> beams) {
    Solution solution;
    auto& [position, covariance, rows, refused] = solution.fix;
    rows = rows_of(beams);
    for (LightRow& row : rows) row.sigma_m = 1;
    for (int round = 0; round < kRounds; ++round) {
        Matrix3d normal_matrix = Matrix3d::Zero();
        Vector3d right = Vector3d::Zero();
        for (const LightRow& row : rows) {
            const double weight = 1 / square(row.sigma_m);
            normal_matrix += weight * row.normal * row.normal.transpose();
            right -= weight * row.constant_m * row.normal;
        }
        const Eigen::FullPivLU<Matrix3d> solver(normal_matrix);
        if (!solver.isInvertible()) return std::nullopt;
        covariance = solver.inverse();
        position = covariance * right;
        if (!position.allFinite()) return std::nullopt;
        if (round + 1 < kRounds) weigh(rows, beams, position);
    }
    for (LightRow& row : rows) {
        row.gain = -covariance * row.normal / square(row.sigma_m);
        solution.chi2 += square((row.normal.dot(position) + row.constant_m) / row.sigma_m);
    }
    return solution;
}

/// Without the one transmitter whose absence makes the others agree, if there is only one such.
std::optional<Solution> solve_without_one(std::span<const Beam> beams) {
    std::optional<Solution> found;
    for (std::size_t left_out = 0; left_out < beams.size(); ++left_out) {
        std::vector<Beam> others(beams.begin(), beams.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
        auto solution = solve(others);
        if (!solution || !solution->agrees()) continue;
        if (found) return std::nullopt;
        found = std::move(solution);
        found->fix.refused = beams[left_out].from->id;
    }
    return found;
}

}  // namespace

Result<ReceiverFix> locate_receiver(std::span<const LightAngles> light,
                                    std::span<const plant::Transmitter> transmitters) {
    std::vector<Beam> beams;
    for (const LightAngles& seen : light) {
        const auto from =
            std::ranges::find(transmitters, seen.transmitter, &plant::Transmitter::id);
        if (from == transmitters.end()) continue;
        beams.push_back({static_cast<std::size_t>(from - transmitters.begin()), &*from, &seen});
    }
    const auto seen = static_cast<std::int64_t>(beams.size());
    if (seen < 2) {
        return fail(Errc::kConflict, "too_few_transmitters",
                    "The receiver sees " + std::to_string(seen) +
                        " transmitters; it needs two. Clear what stands in the light's way, or set "
                        "up another one.",
                    {}, {{"seen", seen}});
    }
    auto solution = solve(beams);
    if (solution && !solution->agrees()) {
        solution = seen > 2 ? solve_without_one(beams) : std::nullopt;
        if (!solution) {
            return fail(Errc::kConflict, "transmitters_disagree",
                        "The light of the transmitters does not meet in one point: one was moved, "
                        "or is seen in a mirror. Measure the control network again.",
                        {}, {{"seen", seen}});
        }
    }
    if (!solution || !(solution->sigma_m() <= kWorst_m)) {
        const double sigma_m = solution ? solution->sigma_m() : 1e9;
        return fail(Errc::kConflict, "poor_geometry",
                    "The transmitters in view stand nearly in one line with the receiver; set up "
                    "one at its side.",
                    {}, {{"sigma_m", sigma_m}, {"limit_m", kWorst_m}});
    }
    return std::move(solution->fix);
}

}  // namespace pulseline::localisation
