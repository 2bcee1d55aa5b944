#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/localisation/error_budget.hpp"
#include "server/agent/machine.hpp"

namespace pulseline::agent {

/// Port: what takes pictures of the floor below a vehicle.
class Shutter {
public:
    /// How new a picture has to be.
    enum class Wish {
        kFromNow,  // exposed since it was asked for, so that it shows where the vehicle stands
        kNewest,   // not given before, at once: whoever drives knows by its age where it was
    };
    struct Picture {
        cv::Mat grey;           // 8 bit
        double age_s = 0;       // since it was exposed
        double sigma_s = 5e-4;  // of its age: of the camera's stamps against the wheels' clock
    };

    virtual ~Shutter() = default;
    /// A picture of one of the type's cameras. `kFromNow` may wait for it, a second at most.
    /// Errors: whatever keeps it from taking one.
    virtual Result<Picture> expose(std::size_t camera, Wish wish) = 0;
};

/// Cameras whose pictures somebody else takes: the codes in them, standing and under way.
class PictureCameras final : public Cameras {
public:
    /// `type`: with its cameras as they hang under its load. `drive` says where codes are to be
    /// expected. What it is made of must outlive it.
    PictureCameras(const plant::VehicleType& type, const onboard::Drive& drive, Shutter& shutter,
                   const localisation::ErrorBudget& errors, bool loaded);

    Result<vda5050::StopMeasurement> measure(const vda5050::StopTarget& target) override;
    std::vector<onboard::WayReading> look_below(std::span<const vda5050::SurveyedMarker> expected,
                                                const geometry::Pose2& hall_from_body,
                                                double own_s) override;
    void look() override { (void)look_expecting({}); }
    const std::vector<vda5050::CameraReading>& readings() const override { return readings_; }
    std::optional<localisation::PoseFix> take_fix() override {
        return std::exchange(fix_, std::nullopt);
    }
    bool take_fresh() override { return std::exchange(fresh_, false); }
    std::vector<Picture> pictures() const override;
    void forget() override { readings_.clear(); }

private:
    /// Why a camera gave no picture, the last of those that gave none.
    std::optional<Error> look_expecting(std::span<const vda5050::SurveyedMarker> expected);

    const plant::VehicleType& type_;
    const onboard::Drive& drive_;
    Shutter& shutter_;
    localisation::ErrorBudget errors_;
    bool loaded_;
    std::vector<vda5050::CameraReading> readings_;
    std::vector<cv::Mat> images_;        // empty where none could be taken
    std::vector<double> since_frame_s_;  // of each camera
    std::optional<localisation::PoseFix> fix_;
    bool fresh_ = false;
};

}  // namespace pulseline::agent
