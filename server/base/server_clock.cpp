#include "server/base/server_clock.hpp"

#include <algorithm>
#include <cstdlib>

namespace pulseline::server {
namespace {

constexpr Duration kExact = std::chrono::milliseconds(50);
constexpr int kFaster = 1100;
constexpr int kSlower = 900;

Time system_utc() {
    return Time{
        std::chrono::duration_cast<Duration>(std::chrono::system_clock::now().time_since_epoch())};
}
Time system_steady() {
    return Time{
        std::chrono::duration_cast<Duration>(std::chrono::steady_clock::now().time_since_epoch())};
}

Time start(Time utc, Time last_stored) {
    const bool far_ahead = last_stored - utc > ServerClock::kTolerated;
    return far_ahead && utc >= ServerClock::built() ? utc : std::max(utc, last_stored);
}

}  // namespace

ServerClock::ServerClock(Time last_stored) : ServerClock(last_stored, system_utc, system_steady) {}

ServerClock::ServerClock(Time last_stored, Source utc, Source steady)
    : utc_(std::move(utc)),
      steady_(std::move(steady)),
      begin_(start(utc_(), last_stored)),
      begin_steady_(steady_()) {
    follow();
}

Time ServerClock::built() { return time_from_ns(PULSELINE_BUILT_S * 1'000'000'000LL); }

Time ServerClock::now_at(Time steady) const {
    return begin_ + (steady - begin_steady_) / 1000 * per_mille_;
}

Time ServerClock::now() const {
    const std::lock_guard lock(mutex_);
    return now_at(steady_());
}

void ServerClock::follow() {
    const std::lock_guard lock(mutex_);
    const Time steady = steady_();
    begin_ = now_at(steady);
    begin_steady_ = steady;
    const Time utc = utc_();
    ahead_ = begin_ - utc;
    per_mille_ = 1000;
    if (utc < built()) return;  // 1970: to wait for it would only make a minute longer
    if (ahead_ > kExact) per_mille_ = kSlower;
    if (ahead_ < -kExact) per_mille_ = kFaster;
}

Duration ServerClock::ahead() const {
    const std::lock_guard lock(mutex_);
    return ahead_;
}

ClockWatch::News ClockWatch::look(Duration ahead) {
    if (std::chrono::abs(ahead) <= ServerClock::kWorthTelling) {
        if (told_ == Duration::zero()) return News::kNone;
        told_ = Duration::zero();
        return News::kAgrees;
    }
    if (told_) {
        // One that has grown or shrunk by half is worth a second word.
        const Duration half = std::chrono::abs(*told_) / 2;
        if (std::chrono::abs(ahead - *told_) < std::max(ServerClock::kWorthTelling, half)) {
            return News::kNone;
        }
    }
    told_ = ahead;
    return News::kDiffers;
}

}  // namespace pulseline::server
