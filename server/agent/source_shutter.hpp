#pragma once

#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "server/agent/picture_cameras.hpp"
#include "server/agent/picture_source.hpp"

namespace pulseline::agent {

/// By camera of the type; null where the machine takes the pictures. None at all: it takes them of
/// all cameras.
using PictureSources = std::vector<std::unique_ptr<PictureSource>>;

/// Takes the pictures of some cameras from sources of their own, of the others by the machine.
class SourceShutter final : public Shutter {
public:
    /// `meanwhile`: is done every cycle of the machine's set points while a picture is waited for.
    /// `type` and `machine` must outlive it.
    SourceShutter(const plant::VehicleType& type, PictureSources sources, Shutter& machine,
                  std::function<void()> meanwhile);

    /// Errors: those of the machine and of PictureSource.
    Result<Picture> expose(std::size_t camera, Wish wish) override;

private:
    Result<Picture> take(std::size_t camera, Wish wish);

    const plant::VehicleType& type_;
    PictureSources sources_;
    Shutter& machine_;
    std::function<void()> meanwhile_;
    std::set<std::size_t> silent_;  // cameras, and it is told
};

}  // namespace pulseline::agent
