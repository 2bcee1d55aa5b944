#include "core/simulation/world/receivers.hpp"

#include <algorithm>
#include <cmath>

namespace pulseline::simulation {
namespace {

using Eigen::Vector3d;
using geometry::Point2;

constexpr double kEvery_s = 0.04;
constexpr double kRemembered_s = 0.2;  // the slowest heads turn in less

/// Share of the way from a to b at which it meets the segment from c to d; nothing: it does not.
std::optional<double> meets(Point2 a, Point2 b, Point2 c, Point2 d) {
    const Point2 way = b - a;
    const Point2 side = d - c;
    const double turn = cross(way, side);
    if (turn == 0) return std::nullopt;
    const double share = cross(c - a, side) / turn;
    const double along = cross(c - a, way) / turn;
    if (share < 0 || share > 1 || along < 0 || along > 1) return std::nullopt;
    return share;
}

bool shades(const geometry::Polygon& body, const plant::Transmitter& from, const Vector3d& point) {
    for (std::size_t i = 0; i < body.size(); ++i) {
        const auto share =
            meets(from.position, {point.x(), point.y()}, body[i], body[(i + 1) % body.size()]);
        if (share && from.z_m + *share * (point.z() - from.z_m) < kVehiclesStand_m) return true;
    }
    return false;
}

}  // namespace

SimulatedReceivers::SimulatedReceivers(const World& world, const plant::HallId& hall,
                                       const plant::VehicleType& type, const Pose2& true_pose,
                                       std::uint64_t seed)
    : world_(world), hall_(hall), true_pose_(true_pose), actual_(type.receivers), random_(seed) {
    std::normal_distribution<double> off(0, world.errors.receiver.place_m);
    for (plant::Receiver& receiver : actual_) {
        receiver.position.x_m += off(random_);
        receiver.position.y_m += off(random_);
        receiver.z_m += off(random_);
    }
    for (const auto& transmitter : world.transmitters) {
        phases_s_.push_back(
            std::uniform_real_distribution<double>(0, 1 / transmitter.rate_hz)(random_));
    }
}

Vector3d SimulatedReceivers::place_at(const plant::Receiver& receiver, double age_s) const {
    const Point2 at = past_.at(age_s) * receiver.position;
    return {at.x_m, at.y_m, receiver.z_m};
}

bool SimulatedReceivers::is_lit(const plant::Transmitter& transmitter,
                                const Vector3d& point) const {
    if (transmitter.hall != hall_ || covered_.contains(transmitter.id)) return false;
    if (!localisation::in_sight(world_.plant, hall_, transmitter.position, {point.x(), point.y()}))
        return false;
    return std::ranges::none_of(
        bodies_, [&](const geometry::Polygon& body) { return shades(body, transmitter, point); });
}

/// Of the last turn that has ended. The sheets pass a receiver that drives where it is then.
std::optional<localisation::LightPulses> SimulatedReceivers::turn_of(
    const plant::Transmitter& transmitter, const plant::Receiver& receiver, double clock_s) {
    const auto place = static_cast<std::size_t>(&transmitter - world_.transmitters.data());
    const double turn_s = 1 / transmitter.rate_hz;
    const double ended_s = std::fmod(now_s_ + phases_s_[place], turn_s);  // ago
    const double began_s = ended_s + turn_s;
    if (!is_lit(transmitter, place_at(receiver, began_s))) return std::nullopt;
    std::normal_distribution<double> noise(0, transmitter.sigma_rad);
    const auto passing_s = [&](auto angle) -> std::optional<double> {
        double ago_s = began_s;
        double angle_rad = 0;
        for (int round = 0; round < 2; ++round) {
            const auto light = localisation::light_on(transmitter, place_at(receiver, ago_s));
            if (!light) return std::nullopt;
            angle_rad = (*light).*angle;
            ago_s = began_s - angle_rad / (2 * kPi) * turn_s;
        }
        return ago_s - noise(random_) / (2 * kPi) * turn_s;
    };
    const auto first_s = passing_s(&localisation::LightAngles::first_rad);
    const auto second_s = passing_s(&localisation::LightAngles::second_rad);
    if (!first_s || !second_s) return std::nullopt;
    return localisation::LightPulses{transmitter.id, clock_s - began_s, clock_s - ended_s,
                                     clock_s - *first_s, clock_s - *second_s};
}

std::vector<onboard::ReceiverPulses> SimulatedReceivers::take_pulses(double own_s) {
    now_s_ += own_s;
    past_.add(true_pose_, own_s, kRemembered_s);
    until_s_ -= own_s;
    std::vector<onboard::ReceiverPulses> seen;
    if (until_s_ > 0) return seen;
    until_s_ = kEvery_s;
    bodies_.clear();
    if (neighbours_) neighbours_(true_pose_.position(), bodies_);
    const double clock_s =
        std::normal_distribution<double>(0, world_.errors.receiver.clock_s)(random_);
    for (const plant::Receiver& receiver : actual_) {
        seen.push_back({receiver.name, {}});
        for (const auto& transmitter : world_.transmitters) {
            if (auto turn = turn_of(transmitter, receiver, clock_s)) {
                seen.back().turns.push_back(std::move(*turn));
            }
        }
    }
    return seen;
}

}  // namespace pulseline::simulation
