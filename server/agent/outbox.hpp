#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace pulseline::agent {

/// What waits to be sent. Bounded by construction: a newer state, pose or picture takes the place
/// of one that has not left yet; each state is complete, so nothing is lost by it.
class Outbox {
public:
    struct Frame {
        std::string bytes;
        bool binary = false;
    };

    std::function<void()> wake = [] {};

    void put_event(std::string frame) {  // connection and factsheet
        if (events_.size() < kMostEvents) events_.push_back(std::move(frame));
        wake();
    }
    void put_state(std::string frame) {
        state_ = std::move(frame);
        wake();
    }
    void put_visualization(std::string frame) {
        visualization_ = std::move(frame);
        wake();
    }
    void put_picture(const std::string& camera, std::string frame) {
        pictures_[camera] = std::move(frame);
        wake();
    }

    /// The most urgent frame.
    std::optional<Frame> take();
    bool empty() const {
        return events_.empty() && !state_ && !visualization_ && pictures_.empty();
    }
    void clear();

private:
    static constexpr std::size_t kMostEvents = 64;
    std::deque<std::string> events_;
    std::optional<std::string> state_;
    std::optional<std::string> visualization_;
    std::map<std::string, std::string> pictures_;
};

}  // namespace pulseline::agent
