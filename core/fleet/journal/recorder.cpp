#include "core/fleet/journal/recorder.hpp"

#include <utility>

namespace pulseline::fleet::journal {

std::string Recorder::take() {
    finish_ticks();
    last_ = Time{};
    inputs_ = 0;
    return out_.take();
}

void Recorder::clear() {
    tick_.reset();
    run_ = {};
    static_cast<void>(take());
}

void Recorder::tick(Time now) {
    if (tick_) finish_ticks();
    tick_ = now;
}

bool Recorder::took_after_tick(Time now) {
    if (!tick_ || *tick_ != now) return false;
    tick_.reset();
    if (run_.count > 0 && now == run_.first + kTickEvery * run_.count) {
        ++run_.count;
    } else {
        finish_ticks();
        run_ = {now, 1};
    }
    return true;
}

void Recorder::finish_ticks() {
    if (run_.count > 0) {
        begin(kTickRun, run_.first);
        out_.number(run_.count);
        last_ = run_.first + kTickEvery * (run_.count - 1);
        run_ = {};
    }
    if (const auto alone = std::exchange(tick_, std::nullopt)) {
        begin(static_cast<std::uint8_t>(number_of<&Fleet::tick>()), *alone);
    }
}

void Recorder::begin(std::uint8_t number, Time now) {
    out_.byte(number);
    out_.difference(to_ns(now) - to_ns(last_));
    last_ = now;
}

}  // namespace pulseline::fleet::journal
