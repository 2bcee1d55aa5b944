#pragma once

#include <gtest/gtest.h>

#include <deque>
#include <utility>
#include <vector>

#include "core/onboard/pose/marker_watch.hpp"
#include "core/simulation/machine/servo_drive.hpp"
#include "core/simulation/world/world.hpp"
#include "tests/core/simulation/platform.hpp"

namespace pulseline::onboard::testing {

/// A vehicle that sees no code and drives along x, from where it believes to stand at the origin.
/// What it finds itself by, `look` steps.
class StraightDrive {
public:
    static constexpr double kStep_s = 0.02;

    StraightDrive(const plant::VehicleType& of, plant::Plant plant,
                  const geometry::Pose2& true_pose, std::uint64_t seed)
        : type(of),
          world(simulation::make_world(std::move(plant), seed)),
          drive(type, true_pose, seed),
          estimate(geometry::Pose2{}, localisation::odometry_noise({}, type)),
          watch(cameras, drive, estimate) {
        drive.set_believed({});
        estimate.start_at(geometry::Pose2{});
    }
    virtual ~StraightDrive() = default;
    StraightDrive(const StraightDrive&) = delete;
    StraightDrive& operator=(const StraightDrive&) = delete;

    virtual void look(bool located) = 0;

    void step(bool located = true) {
        drive.step(kStep_s);
        estimate.drive_to(drive.believed_pose());
        watch.step(kStep_s, ahead);
        look(located);
    }
    void stand(double time_s) {
        for (double at_s = 0; at_s < time_s; at_s += kStep_s) step();
    }
    template <class Each>
    void run(double length_m, Each each) {
        for (double at_m = 0; at_m < length_m; at_m += 2.5) {
            vda5050::OrderEdge edge;
            edge.segment = simulation::testing::straight({at_m, 0, 0}, 2.5);
            drive.append(edge.segment);
            ahead.push_back(edge);
        }
        for (int i = 0; i < 10'000 && !drive.idle(); ++i) {
            step();
            each();
        }
        ASSERT_TRUE(drive.idle());
    }
    double off_m() const {
        return distance(estimate.pose().position(), drive.true_pose().position());
    }
    /// Codes have told it to a tenth of a millimetre where it stands.
    void knows_exactly() {
        localisation::PoseFix sure;
        sure.covariance = {{{1e-8, 0, 0}, {0, 1e-8, 0}, {0, 0, 1e-8}}};
        estimate.take(sure);
    }

    struct Blind : WaySensing {
        std::vector<WayReading> look_below(std::span<const vda5050::SurveyedMarker>,
                                           const geometry::Pose2&, double) override {
            return {};
        }
    };

    plant::VehicleType type;
    simulation::World world;
    simulation::ServoDrive drive;
    Blind cameras;
    PoseEstimate estimate;
    MarkerWatch watch;
    std::deque<vda5050::OrderEdge> ahead;
};

}  // namespace pulseline::onboard::testing
