#pragma once

#include <ctime>
#include <string>

#include "server/agent/picture_source.hpp"

namespace pulseline::agent {

/// A file that a camera's own program keeps replacing (PNG, JPEG, BMP or PGM): written beside it
/// and renamed, so that it is whole, and dated with the moment of its exposure.
class PictureFile final : public PictureSource {
public:
    /// `camera` must outlive it.
    PictureFile(const plant::Camera& camera, std::string path)
        : camera_(camera), path_(std::move(path)) {}

    Result<std::optional<Taken>> newest(Clock::time_point from) override;

private:
    const plant::Camera& camera_;
    std::string path_;
    timespec given_{};  // date of the last one
};

}  // namespace pulseline::agent
