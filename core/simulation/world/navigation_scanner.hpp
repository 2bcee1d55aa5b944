#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "core/kinematics/past_poses.hpp"
#include "core/onboard/navigation_scanner.hpp"
#include "core/simulation/world/world.hpp"

namespace pulseline::simulation {

/// The navigation scanner of a vehicle among the true reflectors and whatever else shines: ray by
/// ray, each from where the vehicle was then. Walls and obstacles of the plant hide them, and other
/// vehicles where it looks out lower than they are high.
class SimulatedNavigationScanner : public onboard::NavigationScanner {
public:
    /// `true_pose`: where the vehicle truly stands; must outlive it, like the world. REQUIRES: the
    /// type has a navigation scanner.
    SimulatedNavigationScanner(const World& world, const plant::HallId& hall,
                               const plant::VehicleType& type, const Pose2& true_pose,
                               std::uint64_t seed);

    std::optional<std::vector<localisation::BrightEcho>> take_turn(double own_s) override;

    /// Somebody hung a cloth over it.
    void cover() { covered_ = true; }
    /// The bodies of the vehicles near a place, as they truly stand now.
    using Neighbours = std::function<void(geometry::Point2, std::vector<geometry::Polygon>&)>;
    void see(Neighbours neighbours) { neighbours_ = std::move(neighbours); }

private:
    Pose2 scanner_at(double age_s) const { return past_.at(age_s) * actual_.body_from_scanner; }
    /// By ray of the turn; where two shine the nearer one is seen.
    using Turn = std::map<long, localisation::BrightEcho>;
    void add_rays(geometry::Point2 shining, double ended_s, double clock_s, Turn& turn);
    bool is_hidden(geometry::Point2 from, geometry::Point2 shining) const;

    const World& world_;
    const plant::HallId hall_;
    const Pose2& true_pose_;
    plant::NavigationScanner actual_;  // as it truly sits
    std::vector<geometry::Point2> shining_;
    Neighbours neighbours_;
    std::vector<geometry::Polygon> bodies_;  // around, now
    kinematics::PastPoses past_;
    std::mt19937_64 random_;
    double until_s_ = 0;
    bool covered_ = false;
};

}  // namespace pulseline::simulation
