#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/localisation/dual_camera.hpp"
#include "core/simulation/machine/simulated_drive.hpp"
#include "core/simulation/world/stop_sensor.hpp"
#include "core/simulation/world/world.hpp"
#include "core/vda5050/messages.hpp"
#include "server/agent/machine.hpp"

namespace pulseline::agent {

/// The simulated cameras of one vehicle: what they see of the true codes, and the pose computed
/// from it with the survey that an order brings.
class CameraSensing final : public Cameras {
public:
    /// `motion` is asked for the true pose at every look.
    /// `loaded`: the vehicle carries its load.
    CameraSensing(const simulation::World& world, const plant::HallId& hall,
                  const simulation::SimulatedDrive& motion, bool rendered, std::uint64_t seed,
                  bool loaded = false);

    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override;
    std::vector<onboard::WayReading> look_below(std::span<const vda5050::SurveyedMarker> expected,
                                                const geometry::Pose2& hall_from_body,
                                                double own_s) override;
    void look() override;
    const std::vector<vda5050::CameraReading>& readings() const override { return readings_; }
    std::optional<localisation::PoseFix> take_fix() override {
        return std::exchange(fix_, std::nullopt);
    }
    bool take_fresh() override;
    /// None in analytic mode.
    std::vector<Picture> pictures() const override;
    void forget() override { readings_.clear(); }
    /// Somebody covers the codes.
    void cover() { covered_ = true; }
    /// The lights below the vehicle fail: its cameras see black.
    void darken() { dark_ = true; }

private:
    std::vector<simulation::FloorCode> codes_below() const;
    void look_expecting(std::optional<simulation::KnownFloor> known);
    /// When a picture is taken between two steps of the vehicle.
    struct Exposure {
        double ago_s = 0;
        geometry::Pose2 true_pose;
        geometry::Pose2 believed;
    };
    /// The nearest of the expected codes, if it is in view as far as the vehicle knows.
    void expose(std::size_t camera, std::span<const vda5050::SurveyedMarker> expected,
                const Exposure& at);

    const simulation::World& world_;
    plant::HallId hall_;
    const simulation::SimulatedDrive& motion_;
    simulation::SensingOptions options_;
    std::mt19937_64 random_;
    std::vector<plant::Camera> actual_;
    std::vector<vda5050::CameraReading> readings_;
    std::vector<cv::Mat> images_;
    std::optional<localisation::PoseFix> fix_;
    struct OnTheWay {
        onboard::WayReading reading;
        double ready_s = 0;  // age at which the vehicle's program gets it
    };
    std::vector<OnTheWay> on_the_way_;   // exposed, not yet read
    std::vector<double> since_frame_s_;  // of each camera
    geometry::Pose2 true_at_look_;       // when it was last asked for what is below
    bool fresh_ = false;
    bool covered_ = false;
    bool dark_ = false;
};

}  // namespace pulseline::agent
