#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "server/agent/picture_source.hpp"

namespace pulseline::agent {

/// Port: a camera that gives one frame after the other, the oldest first.
class FrameStream {
public:
    virtual ~FrameStream() = default;
    /// Waits for the next one, a second or so. Errors: as PictureSource; whoever asked opens it
    /// anew.
    virtual Result<PictureSource::Taken> next() = 0;
};

/// The newest frame of a camera that keeps old ones in a queue: a thread of its own takes them out
/// as they come. A camera that is lost is opened anew until it is back.
class StreamedPictures final : public PictureSource {
public:
    using Open = std::function<Result<std::unique_ptr<FrameStream>>()>;

    /// `open` is called by its thread later on. Errors: those of `open`.
    static Result<std::unique_ptr<StreamedPictures>> open(
        Open open, Clock::duration again = std::chrono::seconds(1));

    Result<std::optional<Taken>> newest(Clock::time_point from) override;

private:
    StreamedPictures(std::unique_ptr<FrameStream> stream, Open open, Clock::duration again);
    void run(const std::stop_token& ended, std::unique_ptr<FrameStream> stream);
    void keep(Result<Taken> taken);

    Open open_;
    Clock::duration again_;
    std::mutex mutex_;  // guards what follows
    std::optional<Taken> newest_;
    std::optional<Error> lost_;
    std::condition_variable_any due_;
    std::jthread reader_;  // the last: it ends first
};

}  // namespace pulseline::agent
