#include "core/localisation/igps_pose.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/base/square.hpp"
#include "core/localisation/rigid_fit.hpp"

namespace pulseline::localisation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

struct Located {
    const plant::Receiver* receiver = nullptr;
    ReceiverFix fix;
    double sigma_m = 0;  // of its place in the floor's plane, per axis
};

RigidFit fit_of(std::span<const Located> located) {
    std::vector<PlacedPoint> points;
    for (const Located& one : located) {
        const Point2 at{one.fix.position.x(), one.fix.position.y()};
        points.push_back({one.receiver->position, at, one.sigma_m});
    }
    return rigid_fit(points);
}

/// The one receiver whose absence makes the others agree, if there is only one such.
std::optional<std::size_t> the_moved_one(std::span<const Located> located) {
    std::optional<std::size_t> moved;
    for (std::size_t i = 0; i < located.size(); ++i) {
        std::vector<Located> others(located.begin(), located.end());
        others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
        if (others.size() < 2 || !fit_of(others).agrees()) continue;
        if (moved) return std::nullopt;
        moved = i;
    }
    return moved;
}

struct Covariances {
    Matrix3d lasting = Matrix3d::Zero();
    Matrix3d passing = Matrix3d::Zero();
};

/// Every cause of error is carried to the pose on its own: a transmitter that stands a little
/// elsewhere moves all receivers together.
Covariances covariances(std::span<const Located> located, const RigidFit& fit,
                        std::span<const plant::Transmitter> transmitters,
                        const ReceiverErrors& errors) {
    Covariances sum;
    std::vector<Matrix3d> by_place(transmitters.size(), Matrix3d::Zero());
    std::vector<Matrix3d> by_turn(transmitters.size(), Matrix3d::Zero());
    for (std::size_t r = 0; r < located.size(); ++r) {
        const auto& by_receiver = fit.by_place[r];
        for (const LightRow& row : located[r].fix.rows) {
            const Vector3d moves = by_receiver * row.gain.head<2>();
            const double noise_m = transmitters[row.transmitter].sigma_rad * row.per_rad_m;
            sum.passing += square(noise_m) * moves * moves.transpose();
            by_place[row.transmitter] += moves * row.normal.transpose();
            by_turn[row.transmitter] += moves * row.per_turn_m.transpose();
        }
        sum.lasting += square(errors.place_m) * by_receiver * by_receiver.transpose();
    }
    for (std::size_t t = 0; t < transmitters.size(); ++t) {
        sum.lasting +=
            square(transmitters[t].sigma_place_m) * by_place[t] * by_place[t].transpose();
        sum.lasting += square(transmitters[t].sigma_turn_rad) * by_turn[t] * by_turn[t].transpose();
    }
    return sum;
}

/// What may separate a receiver's place from where the others put it. They need not see the same
/// transmitters, so that those's errors count, too.
double sigma_of(const ReceiverFix& fix, const ReceiverErrors& errors) {
    return std::sqrt(fix.covariance.topLeftCorner<2, 2>().trace() / 2 + square(errors.place_m));
}

void note(IgpsFix& fix, const std::string& name, const char* code) {
    const bool known = std::ranges::any_of(
        fix.left_out, [&](const LeftOut& out) { return out.name == name && out.code == code; });
    if (!known) fix.left_out.push_back({name, code});
}

}  // namespace

std::vector<ReceiverResult> locate_receivers(std::span<const ReceiverLight> light,
                                             std::span<const plant::Transmitter> transmitters) {
    std::vector<ReceiverResult> results;
    for (const ReceiverLight& seen : light) {
        results.push_back({seen.receiver, locate_receiver(seen.light, transmitters)});
    }
    return results;
}

Result<IgpsFix> locate_by_light(std::span<const ReceiverLight> light,
                                std::span<const plant::Transmitter> transmitters,
                                std::span<const plant::Receiver> receivers,
                                const ReceiverErrors& errors) {
    return fit_receivers(locate_receivers(light, transmitters), transmitters, receivers, errors);
}

Result<IgpsFix> fit_receivers(std::vector<ReceiverResult> results,
                              std::span<const plant::Transmitter> transmitters,
                              std::span<const plant::Receiver> receivers,
                              const ReceiverErrors& errors) {
    IgpsFix found;
    std::vector<Located> located;
    std::optional<Error> lacking;
    for (ReceiverResult& result : results) {
        const auto receiver = std::ranges::find(receivers, result.receiver, &plant::Receiver::name);
        if (receiver == receivers.end()) continue;
        if (!result.fix) {
            found.left_out.push_back({result.receiver, result.fix.error().reason.code});
            lacking = result.fix.error();
            continue;
        }
        if (result.fix->refused) note(found, result.fix->refused->str(), "transmitter_moved");
        const double sigma_m = sigma_of(*result.fix, errors);
        located.push_back({&*receiver, std::move(*result.fix), sigma_m});
    }
    const auto seen = static_cast<std::int64_t>(located.size());
    if (seen < 2) {
        return fail(Errc::kConflict, "too_few_receivers",
                    "Only " + std::to_string(seen) +
                        " receivers know their place, and two are needed for a direction." +
                        (lacking ? " " + lacking->what : ""),
                    {},
                    {{"seen", seen}, {"lacking", lacking ? lacking->reason.code : std::string()}});
    }
    RigidFit fit = fit_of(located);
    if (!fit.agrees()) {
        const auto moved = the_moved_one(located);
        if (!moved) {
            return fail(Errc::kConflict, "receivers_disagree",
                        "The receivers do not stand to each other as they were calibrated; "
                        "calibrate their places again.",
                        {}, {{"residual_m", fit.worst_m}});
        }
        note(found, located[*moved].receiver->name, "receiver_moved");
        located.erase(located.begin() + static_cast<std::ptrdiff_t>(*moved));
        fit = fit_of(located);
    }
    const Covariances sums = covariances(located, fit, transmitters, errors);
    const Matrix3d covariance = sums.lasting + sums.passing;
    PoseFix& pose = found.fix;
    pose.pose = fit.pose;
    set_covariance(pose, covariance);
    pose.method = Method::kIgps;
    pose.residual_m = fit.worst_m;
    found.lasting = rows(sums.lasting);
    for (const Located& one : located) {
        found.floor_m +=
            (one.fix.position.z() - one.receiver->z_m) / static_cast<double>(located.size());
        for (const LightRow& row : one.fix.rows) {
            const std::string& name = transmitters[row.transmitter].id.str();
            if (std::ranges::find(pose.payloads, name) == pose.payloads.end()) {
                pose.payloads.push_back(name);
            }
        }
    }
    std::ranges::sort(pose.payloads);
    return found;
}

Result<IgpsFix> expected_fix(const plant::Plant& plant, const plant::HallId& hall,
                             const plant::VehicleType& type, const Pose2& pose) {
    std::vector<ReceiverLight> light;
    for (const auto& receiver : type.receivers) {
        const Point2 at = pose * receiver.position;
        const Vector3d place(at.x_m, at.y_m, receiver.z_m);
        ReceiverLight seen{receiver.name, {}};
        for (const auto& from : transmitters_in_view(plant, hall, place)) {
            seen.light.push_back(*light_on(from, place));
        }
        light.push_back(std::move(seen));
    }
    return locate_by_light(light, plant.transmitters, type.receivers);
}

}  // namespace pulseline::localisation
