#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include "core/kinematics/past_poses.hpp"
#include "core/onboard/receivers.hpp"
#include "core/simulation/world/world.hpp"

namespace pulseline::simulation {

/// The receivers of a vehicle in the light of the true transmitters: 25 times a second they tell
/// when the sheets passed them in the last turn of each. Walls and obstacles of the plant stand in
/// the light's way, and other vehicles where it comes in low enough.
class SimulatedReceivers : public onboard::Receivers {
public:
    /// `true_pose`: where the vehicle truly stands; must outlive it, like the world.
    SimulatedReceivers(const World& world, const plant::HallId& hall,
                       const plant::VehicleType& type, const Pose2& true_pose, std::uint64_t seed);

    std::vector<onboard::ReceiverPulses> take_pulses(double own_s) override;

    /// Somebody stands in front of a transmitter, or it has no power.
    void cover(const plant::TransmitterId& transmitter) { covered_.insert(transmitter); }
    void uncover() { covered_.clear(); }
    /// The bodies of the vehicles near a place, as they truly stand now.
    using Neighbours = std::function<void(geometry::Point2, std::vector<geometry::Polygon>&)>;
    void see(Neighbours neighbours) { neighbours_ = std::move(neighbours); }

private:
    Eigen::Vector3d place_at(const plant::Receiver& receiver, double age_s) const;
    bool is_lit(const plant::Transmitter& transmitter, const Eigen::Vector3d& point) const;
    std::optional<localisation::LightPulses> turn_of(const plant::Transmitter& transmitter,
                                                     const plant::Receiver& receiver,
                                                     double clock_s);

    const World& world_;
    const plant::HallId hall_;
    const Pose2& true_pose_;
    std::vector<plant::Receiver> actual_;
    std::vector<double> phases_s_;  // of each transmitter of the world, when time began
    std::set<plant::TransmitterId> covered_;
    Neighbours neighbours_;
    std::vector<geometry::Polygon> bodies_;  // around, now
    kinematics::PastPoses past_;
    std::mt19937_64 random_;
    double now_s_ = 0;
    double until_s_ = 0;
};

}  // namespace pulseline::simulation
