#include "core/planning/manoeuvre/reeds_shepp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pulseline::planning {
namespace {

using geometry::Pose2;

constexpr double kSign = 1e-12;     // rounding of a length that is zero
constexpr double kArrives = 1e-10;  // in turning radii and radians

/// Goal of one word, and the word's lengths t, u, v.
struct Goal {
    double x, y, phi, s, c;  // s, c: sine and cosine of phi
};
struct Lengths {
    double t = 0, u = 0, v = 0;
    bool exists = false;
};

Lengths tau_omega(double u, double v, double xi, double eta, double phi) {
    const double delta = wrap(u - v);
    const double a = std::sin(u) - std::sin(delta);
    const double b = std::cos(u) - std::cos(delta) - 1;
    const double t1 = std::atan2(eta * a - xi * b, xi * a + eta * b);
    const double t2 = 2 * (std::cos(delta) - std::cos(v) - std::cos(u)) + 3;
    const double tau = t2 < 0 ? wrap(t1 + kPi) : t1;
    return {tau, u, wrap(tau - u + v - phi), true};
}

// Names as in the paper: L, R, S with + forwards and - backwards.
Lengths lp_sp_lp(const Goal& g) {  // 8.1
    const double xi = g.x - g.s;
    const double eta = g.y - 1 + g.c;
    const double t = std::atan2(eta, xi);
    const double v = wrap(g.phi - t);
    return {t, std::sqrt(xi * xi + eta * eta), v, t >= -kSign && v >= -kSign};
}

Lengths lp_sp_rp(const Goal& g) {  // 8.2
    const double xi = g.x + g.s;
    const double eta = g.y - 1 - g.c;
    const double u2 = xi * xi + eta * eta - 4;
    if (u2 < 0) return {};
    const double u = std::sqrt(u2);
    const double t = wrap(std::atan2(eta, xi) + std::atan2(2, u));
    const double v = wrap(t - g.phi);
    return {t, u, v, t >= -kSign && v >= -kSign};
}

Lengths lp_rm_l(const Goal& g) {  // 8.3, 8.4
    const double xi = g.x - g.s;
    const double eta = g.y - 1 + g.c;
    const double u1 = std::sqrt(xi * xi + eta * eta);
    if (u1 > 4) return {};
    const double u = -2 * std::asin(u1 / 4);
    const double t = wrap(std::atan2(eta, xi) + u / 2 + kPi);
    return {t, u, wrap(g.phi - t + u), t >= -kSign};
}

Lengths lp_rup_lum_rm(const Goal& g) {  // 8.7
    const double xi = g.x + g.s;
    const double eta = g.y - 1 - g.c;
    const double rho = 0.25 * (2 + std::sqrt(xi * xi + eta * eta));
    if (rho > 1) return {};
    Lengths found = tau_omega(std::acos(rho), -std::acos(rho), xi, eta, g.phi);
    found.exists = found.t >= -kSign && found.v <= kSign;
    return found;
}

Lengths lp_rum_lum_rp(const Goal& g) {  // 8.8
    const double xi = g.x + g.s;
    const double eta = g.y - 1 - g.c;
    const double rho = (20 - xi * xi - eta * eta) / 16;
    if (rho < 0 || rho > 1) return {};
    const double u = -std::acos(rho);
    Lengths found = tau_omega(u, u, xi, eta, g.phi);
    found.exists = found.t >= -kSign && found.v >= -kSign;
    return found;
}

Lengths lp_rm_sm_lm(const Goal& g) {  // 8.9
    const double xi = g.x - g.s;
    const double eta = g.y - 1 + g.c;
    const double r2 = xi * xi + eta * eta - 4;
    if (r2 < 0) return {};
    const double r = std::sqrt(r2);
    const double t = wrap(std::atan2(eta, xi) + std::atan2(r, -2));
    const double v = wrap(g.phi - kPi / 2 - t);
    return {t, 2 - r, v, t >= -kSign && 2 - r <= kSign && v <= kSign};
}

Lengths lp_rm_sm_rm(const Goal& g) {  // 8.10
    const double xi = g.x + g.s;
    const double eta = g.y - 1 - g.c;
    const double rho = std::sqrt(xi * xi + eta * eta);
    if (rho < 2) return {};
    const double t = std::atan2(xi, -eta);
    const double v = wrap(t + kPi / 2 - g.phi);
    return {t, 2 - rho, v, t >= -kSign && v <= kSign};
}

Lengths lp_rm_s_lm_rp(const Goal& g) {  // 8.11
    const double xi = g.x + g.s;
    const double eta = g.y - 1 - g.c;
    const double r2 = xi * xi + eta * eta - 4;
    if (r2 < 0) return {};
    const double u = 4 - std::sqrt(r2);
    if (u > kSign) return {};
    const double t = wrap(std::atan2((4 - u) * xi - 2 * eta, -2 * xi + (u - 4) * eta));
    const double v = wrap(t - g.phi);
    return {t, u, v, t >= -kSign && v >= -kSign};
}

/// Left, straight, left, all forwards: always there, and without a root that could lose digits
/// where two circles touch.
RsPath forwards_round(const Pose2& goal) {
    const double xi = goal.x_m - std::sin(goal.heading_rad);
    const double eta = goal.y_m - 1 + std::cos(goal.heading_rad);
    const auto forwards = [](double angle) { return angle < 0 ? angle + 2 * kPi : angle; };
    const double t = forwards(std::atan2(eta, xi));
    const double u = std::sqrt(xi * xi + eta * eta);
    const double v = forwards(wrap(goal.heading_rad - t));
    return {{RsPiece{1, t}, RsPiece{0, u}, RsPiece{1, v}}, 3, t + u + v, 0};
}

/// Calls take(steers, lengths, count) for every word with the goal as it is, flipped in time
/// (everything driven the other way round) and mirrored (left for right).
template <class Take>
void all_words(const Pose2& goal, const Take& take) {
    const double s = std::sin(goal.heading_rad);
    const double c = std::cos(goal.heading_rad);
    const double back_x = goal.x_m * c + goal.y_m * s;  // the same path from its other end
    const double back_y = goal.x_m * s - goal.y_m * c;
    constexpr double kQuarter = kPi / 2;
    for (const int way : {1, -1}) {
        for (const int side : {1, -1}) {
            const int both = way * side;
            const Goal g{way * goal.x_m, side * goal.y_m, both * goal.heading_rad, both * s, c};
            const Goal b{way * back_x, side * back_y, both * goal.heading_rad, both * s, c};
            const auto word = [&](const Lengths& w, std::array<int, 5> steers,
                                  std::array<double, 5> lengths, int count) {
                if (!w.exists) return;
                for (int& steer : steers) steer *= side;
                for (double& length : lengths) length *= way;
                take(steers, lengths, count);
            };
            Lengths w = lp_sp_lp(g);
            word(w, {1, 0, 1}, {w.t, w.u, w.v}, 3);
            w = lp_sp_rp(g);
            word(w, {1, 0, -1}, {w.t, w.u, w.v}, 3);
            w = lp_rm_l(g);
            word(w, {1, -1, 1}, {w.t, w.u, w.v}, 3);
            w = lp_rm_l(b);
            word(w, {1, -1, 1}, {w.v, w.u, w.t}, 3);
            w = lp_rup_lum_rm(g);
            word(w, {1, -1, 1, -1}, {w.t, w.u, -w.u, w.v}, 4);
            w = lp_rum_lum_rp(g);
            word(w, {1, -1, 1, -1}, {w.t, w.u, w.u, w.v}, 4);
            w = lp_rm_sm_lm(g);
            word(w, {1, -1, 0, 1}, {w.t, -kQuarter, w.u, w.v}, 4);
            w = lp_rm_sm_rm(g);
            word(w, {1, -1, 0, -1}, {w.t, -kQuarter, w.u, w.v}, 4);
            w = lp_rm_sm_lm(b);
            word(w, {1, 0, -1, 1}, {w.v, w.u, -kQuarter, w.t}, 4);
            w = lp_rm_sm_rm(b);
            word(w, {-1, 0, -1, 1}, {w.v, w.u, -kQuarter, w.t}, 4);
            w = lp_rm_s_lm_rp(g);
            word(w, {1, -1, 0, 1, -1}, {w.t, -kQuarter, w.u, -kQuarter, w.v}, 5);
        }
    }
}

bool arrives(const RsPath& path, const Pose2& goal) {
    Pose2 at;
    for (int i = 0; i < path.count; ++i) {
        const RsPiece& piece = path.pieces[static_cast<std::size_t>(i)];
        at = at * rs_moved(piece, piece.length);
    }
    return std::abs(at.x_m - goal.x_m) < kArrives && std::abs(at.y_m - goal.y_m) < kArrives &&
           std::abs(wrap(at.heading_rad - goal.heading_rad)) < kArrives;
}

}  // namespace

Pose2 rs_moved(const RsPiece& piece, double length) {
    if (piece.steer == 0) return {length, 0, 0};
    return {std::sin(length), piece.steer * (1 - std::cos(length)), piece.steer * length};
}

void reeds_shepp_paths(const Pose2& goal, std::vector<RsPath>& paths) {
    paths.clear();
    all_words(goal, [&](const std::array<int, 5>& steers, const std::array<double, 5>& lengths,
                        int count) {
        RsPath path;
        for (int i = 0; i < count; ++i) {
            const double length = lengths[static_cast<std::size_t>(i)];
            if (std::abs(length) < kArrives) continue;
            auto& piece = path.pieces[static_cast<std::size_t>(path.count)];
            piece = {steers[static_cast<std::size_t>(i)], length};
            path.length += std::abs(length);
            if (path.count > 0) {
                const auto& before = path.pieces[static_cast<std::size_t>(path.count - 1)];
                path.reversals += (before.length > 0) != (length > 0) ? 1 : 0;
            }
            ++path.count;
        }
        if (arrives(path, goal)) paths.push_back(path);
    });
    if (paths.empty()) paths.push_back(forwards_round(goal));
    std::stable_sort(paths.begin(), paths.end(),
                     [](const RsPath& a, const RsPath& b) { return a.length < b.length; });
}

double reeds_shepp_length(const Pose2& goal) {
    double least = std::numeric_limits<double>::infinity();
    all_words(goal,
              [&](const std::array<int, 5>&, const std::array<double, 5>& lengths, int count) {
                  double length = 0;
                  for (int i = 0; i < count; ++i)
                      length += std::abs(lengths[static_cast<std::size_t>(i)]);
                  least = std::min(least, length);
              });
    return least;
}

}  // namespace pulseline::planning
