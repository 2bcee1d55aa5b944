#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>

#include "core/base/time.hpp"

namespace pulseline::api::access {

/// Slows guessing: so many attempts a minute for one account from one peer, then a wait. It never
/// locks an account, so nobody can keep a plant's people out. A success forgets the attempts.
/// Thread safety: none, the owner locks.
class SignInLimit {
public:
    explicit SignInLimit(int per_minute) : per_minute_(static_cast<std::size_t>(per_minute)) {}

    /// Counts an attempt, or says how long to wait before the next. Attempts count when they start,
    /// so that many at once gain nothing.
    std::optional<Duration> attempt(const std::string& account, const std::string& peer, Time now);
    void succeeded(const std::string& account, const std::string& peer);

private:
    void forget_old(Time now);

    std::size_t per_minute_;
    std::map<std::pair<std::string, std::string>, std::deque<Time>> attempts_;
};

}  // namespace pulseline::api::access
