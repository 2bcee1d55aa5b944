#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>

#include "server/base/options.hpp"

namespace pulseline::server {

/// Fills at a rate up to its size; what is not in it cannot be taken.
class Bucket {
public:
    using Steady = std::chrono::steady_clock;
    Bucket(double per_second, double size) : per_second_(per_second), size_(size), in_(size) {}

    bool take(double amount, Steady::time_point now) {
        const double passed_s = std::chrono::duration<double>(now - filled_).count();
        if (filled_ != Steady::time_point{}) in_ = std::min(size_, in_ + passed_s * per_second_);
        filled_ = now;
        if (in_ < amount) return false;
        in_ -= amount;
        return true;
    }

private:
    double per_second_;
    double size_;
    double in_;
    Steady::time_point filled_{};
};

/// How much one vehicle may say. A vehicle that says more is not the fleet's to serve: it would
/// take the time and the disk of all others.
class LinkBudget {
public:
    using Steady = Bucket::Steady;
    enum class Verdict {
        kTake,
        kWithhold,  // too much just now: only the newest one counts, later
        kClose,     // and so for too long
    };
    explicit LinkBudget(const Limits& limits)
        : messages_(limits.vehicle_messages_per_second, 2.0 * limits.vehicle_messages_per_second),
          bytes_(static_cast<double>(limits.vehicle_bytes_per_second),
                 2.0 * static_cast<double>(limits.vehicle_bytes_per_second)),
          pictures_(limits.vehicle_pictures_per_second, 2.0 * limits.vehicle_pictures_per_second),
          malformed_(limits.vehicle_malformed_per_minute / 60.0,
                     limits.vehicle_malformed_per_minute),
          patience_(limits.vehicle_excess_time) {}

    Verdict message(std::size_t bytes, Steady::time_point now) {
        if (messages_.take(1, now) && bytes_.take(static_cast<double>(bytes), now)) {
            return Verdict::kTake;
        }
        if (now - last_excess_ > kCalm) excess_since_ = now;
        last_excess_ = now;
        return now - excess_since_ >= patience_ ? Verdict::kClose : Verdict::kWithhold;
    }
    /// Whether a message that was withheld may be taken now.
    bool again(std::size_t bytes, Steady::time_point now) {
        return messages_.take(1, now) && bytes_.take(static_cast<double>(bytes), now);
    }
    bool picture(Steady::time_point now) { return pictures_.take(1, now); }
    bool malformed(Steady::time_point now) { return malformed_.take(1, now); }
    /// True for the first of a time of excess.
    bool excess_begins() const { return excess_since_ == last_excess_; }

private:
    static constexpr auto kCalm = std::chrono::seconds(2);

    Bucket messages_;
    Bucket bytes_;
    Bucket pictures_;
    Bucket malformed_;
    std::chrono::milliseconds patience_;
    Steady::time_point excess_since_{};
    Steady::time_point last_excess_{};
};

}  // namespace pulseline::server
