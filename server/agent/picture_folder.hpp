#pragma once

#include <chrono>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/base/result.hpp"
#include "core/base/time.hpp"
#include "core/plant/vehicle_type.hpp"

namespace pulseline::agent {

/// Pictures of simulated cameras as files NAME.pgm, each written beside its name, dated with its
/// exposure and renamed, as PictureFile wants them of a camera's own program. Thread safety: none.
class PictureFolder {
public:
    using Steady = std::chrono::steady_clock;

    /// Makes the folder where it is missing. Errors: pictures_unwritable.
    static Result<PictureFolder> open(const std::string& path,
                                      const std::vector<plant::Camera>& cameras);

    /// The camera whose picture is longest due; nothing: none is. Drawing takes a processor, so one
    /// that stands is drawn less often.
    std::optional<std::size_t> due(Steady::time_point now, bool moving);
    /// One that cannot be written is left out, and that is logged once.
    void write(std::size_t camera, const cv::Mat& grey, Time exposed);

private:
    struct File {
        std::filesystem::path path;
        Steady::duration frame;
        Steady::time_point drawn{};
        bool failing = false;
    };

    std::vector<File> files_;  // by camera
};

}  // namespace pulseline::agent
