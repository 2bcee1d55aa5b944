#include "server/agent/streamed_pictures.hpp"

#include <utility>

namespace pulseline::agent {

Result<std::unique_ptr<StreamedPictures>> StreamedPictures::open(Open open, Clock::duration again) {
    auto stream = open();
    if (!stream) return fail(stream.error());
    return std::unique_ptr<StreamedPictures>(
        new StreamedPictures(std::move(*stream), std::move(open), again));
}

StreamedPictures::StreamedPictures(std::unique_ptr<FrameStream> stream, Open open,
                                   Clock::duration again)
    : open_(std::move(open)),
      again_(again),
      reader_([this, stream = std::move(stream)](const std::stop_token& ended) mutable {
          run(ended, std::move(stream));
      }) {}

void StreamedPictures::run(const std::stop_token& ended, std::unique_ptr<FrameStream> stream) {
    while (!ended.stop_requested()) {
        auto taken = stream->next();
        if (!taken) stream.reset();
        keep(std::move(taken));
        while (!stream && !ended.stop_requested()) {
            std::unique_lock lock(mutex_);
            due_.wait_for(lock, ended, again_, [] { return false; });
            lock.unlock();
            if (ended.stop_requested()) return;
            auto opened = open_();
            if (opened) stream = std::move(*opened);
        }
    }
}

/// What was exposed before it was lost is no longer asked for.
void StreamedPictures::keep(Result<Taken> taken) {
    const std::lock_guard lock(mutex_);
    newest_.reset();
    lost_.reset();
    if (taken) {
        newest_ = std::move(*taken);
    } else {
        lost_ = std::move(taken.error());
    }
}

Result<std::optional<PictureSource::Taken>> StreamedPictures::newest(Clock::time_point from) {
    const std::lock_guard lock(mutex_);
    if (lost_) return fail(*lost_);
    if (!newest_ || newest_->exposed < from) return std::nullopt;
    return std::exchange(newest_, std::nullopt);
}

}  // namespace pulseline::agent
