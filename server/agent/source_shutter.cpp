#include "server/agent/source_shutter.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

using Clock = PictureSource::Clock;
using std::chrono::duration_cast;

// Beside frames: what a busy computer keeps a camera's program from running.
constexpr double kLate_s = 0.5;

Clock::duration seconds(double time_s) {
    return duration_cast<Clock::duration>(std::chrono::duration<double>(time_s));
}

}  // namespace

SourceShutter::SourceShutter(const plant::VehicleType& type, PictureSources sources,
                             Shutter& machine, std::function<void()> meanwhile)
    : type_(type),
      sources_(std::move(sources)),
      machine_(machine),
      meanwhile_(std::move(meanwhile)) {
    sources_.resize(type.cameras.size());
}

Result<Shutter::Picture> SourceShutter::expose(std::size_t camera, Wish wish) {
    if (!sources_[camera]) return machine_.expose(camera, wish);
    auto picture = take(camera, wish);
    // That there is nothing newer since the last one says nothing of a camera.
    if (!picture && wish == Wish::kFromNow && silent_.insert(camera).second) {
        server::log::warn("camera.silent", {{"what", picture.error().what}});
    } else if (picture && silent_.erase(camera) > 0) {
        server::log::info("camera.back", {{"camera", type_.cameras[camera].name}});
    }
    return picture;
}

Result<Shutter::Picture> SourceShutter::take(std::size_t camera, Wish wish) {
    const plant::Camera& of = type_.cameras[camera];
    const double frame_s = 1 / of.frame_rate_hz;
    const auto begun = Clock::now();
    // Under way a picture that is older tells nothing: the vehicle remembers as much of its way.
    const auto from = wish == Wish::kFromNow ? begun : begun - seconds(kLate_s + frame_s);
    const auto until = wish == Wish::kFromNow ? begun + seconds(kLate_s + 2 * frame_s) : begun;
    if (wish == Wish::kFromNow && silent_.contains(camera)) {
        // Nothing else the vehicle does shall wait for a camera that is not there.
        auto alive = sources_[camera]->newest(begun - seconds(kLate_s + frame_s));
        if (!alive) return fail(alive.error());
        if (!*alive) return camera_silent(of, "there is none of late");
    }
    for (auto next = begun;;) {
        auto taken = sources_[camera]->newest(from);
        const auto now = Clock::now();
        if (taken && *taken) {
            const double age_s = std::chrono::duration<double>(now - (*taken)->exposed).count();
            return Picture{std::move((*taken)->grey), age_s, (*taken)->sigma_s};
        }
        if (now >= until) {
            if (!taken) return fail(taken.error());
            return camera_silent(of, "there is none of late");
        }
        meanwhile_();
        next += seconds(type_.control.cycle_s);
        std::this_thread::sleep_until(next);
    }
}

}  // namespace pulseline::agent
