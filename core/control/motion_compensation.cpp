#include "core/control/motion_compensation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

namespace pulseline::control {
namespace {

using Lines = Eigen::Matrix<double, 6, 1>;

constexpr std::size_t kPassesKept = 24;
constexpr int kMovesNeeded = 3;
constexpr int kIterations = 12;
// A new vehicle before anything is known of it, one sigma.
constexpr double kPriorGain = 0.05;
constexpr double kPriorOffset_m = 1e-3;
constexpr double kPriorOffset_rad = radians(0.05);
// Weight of a pass falls to a half where its error is three times the usual one.
constexpr double kDoubtful = 9;
constexpr double kMedianOfChi2 = 2.366;  // three degrees of freedom

Lines perfect() { return (Lines() << 1, 0, 1, 0, 1, 0).finished(); }

Lines prior_sigma() {
    return (Lines() << kPriorGain, kPriorOffset_m, kPriorGain, kPriorOffset_m, kPriorGain,
            kPriorOffset_rad)
        .finished();
}

Pose2 driven(std::span<const Move> moves, const Lines& lines) {
    Pose2 body;
    for (const Move& move : moves) {
        const auto k = 2 * static_cast<Eigen::Index>(move.kind);
        const double sign = move.size > 0 ? 1 : move.size < 0 ? -1 : 0;
        const double way = lines[k] * move.size + sign * lines[k + 1];
        switch (move.kind) {
            case MoveKind::kAdvance:
                body = body * Pose2{way, 0, 0};
                break;
            case MoveKind::kLateral:
                body = body * Pose2{0, way, 0};
                break;
            case MoveKind::kTurn:
                body.heading_rad += way;
                break;
        }
    }
    return body;
}

Eigen::Vector3d difference(const Pose2& a, const Pose2& b) {
    return {a.x_m - b.x_m, a.y_m - b.y_m, wrap(a.heading_rad - b.heading_rad)};
}

/// How the end of a pass changes with the lines.
Eigen::Matrix<double, 3, 6> sensitivity(std::span<const Move> moves, const Lines& lines) {
    constexpr double kStep = 1e-6;
    Eigen::Matrix<double, 3, 6> columns;
    for (Eigen::Index k = 0; k < 6; ++k) {
        Lines more = lines;
        Lines less = lines;
        more[k] += kStep;
        less[k] -= kStep;
        columns.col(k) = difference(driven(moves, more), driven(moves, less)) / (2 * kStep);
    }
    return columns;
}

/// Spread of a pass beyond what the lines say: each axis of the position, and the heading.
PoseError spread(std::span<const Move> moves) {
    double way_m = 0;
    double position2 = 0;
    double heading2 = 0;
    for (auto move = moves.rbegin(); move != moves.rend(); ++move) {
        if (move->kind == MoveKind::kTurn) {
            // A turn goes wrong about the body's centre, so the way still to come is askew.
            position2 += std::pow(way_m * kRepeatability_rad, 2);
            heading2 += std::pow(kRepeatability_rad, 2);
        } else {
            way_m += move->size;
            position2 += std::pow(kRepeatability_m, 2);
        }
    }
    return {std::sqrt(position2), std::sqrt(heading2)};
}

Eigen::Vector3d sigma_of(const DrivenPass& pass) {
    const PoseError repeats = spread(pass.moves);
    const double position = std::hypot(pass.sigma_m, repeats.position_m);
    return {position, position, std::hypot(pass.sigma_rad, repeats.heading_rad, 1e-6)};
}

bool is_usable(const DrivenPass& pass) {
    const auto finite = [](auto... values) { return (std::isfinite(values) && ...); };
    return !pass.moves.empty() && pass.sigma_m >= 0 && pass.sigma_rad >= 0 &&
           finite(pass.measured.x_m, pass.measured.y_m, pass.measured.heading_rad, pass.sigma_m,
                  pass.sigma_rad) &&
           std::ranges::all_of(pass.moves, [&](const Move& move) { return finite(move.size); });
}

Status check(const DrivenPass& pass, std::size_t index) {
    if (is_usable(pass)) return {};
    return fail(Errc::kInvalid, "bad_compensation",
                "Pass " + std::to_string(index) +
                    " of the motion compensation has no moves or a number that is not finite or "
                    "negative; forget the stored compensation, the vehicle learns it anew.",
                {}, {{"index", static_cast<std::int64_t>(index)}});
}

}  // namespace

MotionCompensation::MotionCompensation() { fit(); }

Result<MotionCompensation> MotionCompensation::restored(std::vector<DrivenPass> passes) {
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (const auto good = check(passes[i], i); !good) return fail(good.error());
    }
    MotionCompensation compensation;
    if (passes.size() > kPassesKept) passes.erase(passes.begin(), passes.end() - kPassesKept);
    compensation.passes_ = std::move(passes);
    compensation.fit();
    return compensation;
}

Status MotionCompensation::learn(DrivenPass pass) {
    if (auto good = check(pass, passes_.size()); !good) return good;
    if (passes_.size() == kPassesKept) passes_.erase(passes_.begin());
    passes_.push_back(std::move(pass));
    fit();
    return {};
}

/// Gauss-Newton with weights drawn anew in each round from the passes' errors, their usual size
/// being the median: up to half of the passes may be wrong.
void MotionCompensation::fit() {
    Lines lines = perfect();
    const Lines certainty = prior_sigma().cwiseAbs2().cwiseInverse();
    Eigen::Matrix<double, 6, 6> information;
    std::vector<double> chi2(passes_.size());
    double scale2 = 1;
    for (int round = 0; round < kIterations; ++round) {
        for (std::size_t i = 0; i < passes_.size(); ++i) {
            const DrivenPass& pass = passes_[i];
            chi2[i] = difference(pass.measured, driven(pass.moves, lines))
                          .cwiseQuotient(sigma_of(pass))
                          .squaredNorm();
        }
        std::vector<double> sorted = chi2;
        std::ranges::sort(sorted);
        scale2 = sorted.empty() ? 1 : std::max(1.0, sorted[sorted.size() / 2] / kMedianOfChi2);

        information = certainty.asDiagonal();
        Lines pull = certainty.cwiseProduct(perfect() - lines);
        for (std::size_t i = 0; i < passes_.size(); ++i) {
            const DrivenPass& pass = passes_[i];
            const Eigen::Vector3d sigma = sigma_of(pass);
            const Eigen::Matrix<double, 3, 6> rows =
                sigma.cwiseInverse().asDiagonal() * sensitivity(pass.moves, lines);
            const Eigen::Vector3d error =
                difference(pass.measured, driven(pass.moves, lines)).cwiseQuotient(sigma);
            // Far off, a pass says nothing at all: square of the usual weight of Cauchy.
            const double weight = std::pow(1 + chi2[i] / (kDoubtful * scale2), -2);
            information += weight / scale2 * rows.transpose() * rows;
            pull += weight / scale2 * rows.transpose() * error;
        }
        lines += information.ldlt().solve(pull);
    }
    covariance_ = information.inverse();

    for (Eigen::Index k = 0; k < 3; ++k) {
        int moves = 0;
        for (const DrivenPass& pass : passes_) {
            moves += static_cast<int>(std::ranges::count_if(pass.moves, [&](const Move& move) {
                return static_cast<Eigen::Index>(move.kind) == k && move.size != 0;
            }));
        }
        MoveLine& line = lines_[static_cast<std::size_t>(k)];
        line = {1, 0, std::sqrt(covariance_(2 * k, 2 * k)),
                std::sqrt(covariance_(2 * k + 1, 2 * k + 1))};
        const double most = k == 2 ? kMostOffset_rad : kMostOffset_m;
        if (moves >= kMovesNeeded) {
            line.gain = std::clamp(lines[2 * k], 1 / kMostGain, kMostGain);
            line.offset = std::clamp(lines[2 * k + 1], -most, most);
        } else {
            // Not compensated, so its error is still all that a new vehicle's is.
            line.sigma_gain = kPriorGain;
            line.sigma_offset = k == 2 ? kPriorOffset_rad : kPriorOffset_m;
            covariance_.middleRows<2>(2 * k).setZero();
            covariance_.middleCols<2>(2 * k).setZero();
            covariance_(2 * k, 2 * k) = std::pow(line.sigma_gain, 2);
            covariance_(2 * k + 1, 2 * k + 1) = std::pow(line.sigma_offset, 2);
        }
    }
}

double MotionCompensation::commanded(MoveKind kind, double wanted) const {
    const double size = (std::abs(wanted) - line(kind).offset) / line(kind).gain;
    return std::copysign(std::max(0.0, size), wanted);
}

PoseError MotionCompensation::expected_error(std::span<const Move> wanted) const {
    const auto rows = sensitivity(wanted, perfect());
    const Eigen::Matrix3d open = rows * covariance_ * rows.transpose();
    const PoseError repeats = spread(wanted);
    return {std::sqrt(open(0, 0) + open(1, 1) + 2 * std::pow(repeats.position_m, 2)),
            std::hypot(std::sqrt(open(2, 2)), repeats.heading_rad)};
}

}  // namespace pulseline::control
