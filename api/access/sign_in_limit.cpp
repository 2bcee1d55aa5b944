#include "api/access/sign_in_limit.hpp"

namespace pulseline::api::access {
namespace {

constexpr Duration kWindow = std::chrono::minutes(1);
constexpr std::size_t kSweepAbove = 4096;  // accounts x peers; hashing is far too slow to fill more

}  // namespace

std::optional<Duration> SignInLimit::attempt(const std::string& account, const std::string& peer,
                                             Time now) {
    if (attempts_.size() > kSweepAbove) forget_old(now);
    auto& times = attempts_[{account, peer}];
    while (!times.empty() && now - times.front() >= kWindow) times.pop_front();
    if (times.size() >= per_minute_) return kWindow - (now - times.front());
    times.push_back(now);
    return std::nullopt;
}

void SignInLimit::succeeded(const std::string& account, const std::string& peer) {
    attempts_.erase({account, peer});
}

void SignInLimit::forget_old(Time now) {
    std::erase_if(attempts_, [now](const auto& entry) {
        return entry.second.empty() || now - entry.second.back() >= kWindow;
    });
}

}  // namespace pulseline::api::access
