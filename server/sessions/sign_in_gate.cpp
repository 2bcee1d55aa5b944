#include "server/sessions/sign_in_gate.hpp"

#include <algorithm>

namespace pulseline::server {
namespace {

constexpr Duration kLately = std::chrono::hours(7 * 24);
constexpr double kAttemptsPerMinute = 10;
constexpr double kBurst = 10;
constexpr std::size_t kMostBuckets = 4096;
constexpr std::size_t kMostRemembered = 4096;
// The last places of the known lane are for a person at the usual address only: an account's name
// is easily guessed, its owner's address is not.
constexpr double kForPairsOnly = 0.5;
// A new name at a known address goes along as long as hardly anybody waits.
constexpr double kForKnownPeers = 0.1;

std::string account_key(const std::string& account) { return "account " + account; }
std::string peer_key(const std::string& peer) { return "peer " + peer; }
std::string pair_key(const std::string& account, const std::string& peer) {
    return "both " + account + " " + peer;
}

}  // namespace

bool SignInGate::lately(const std::string& key, Time now) const {
    const auto found = succeeded_.find(key);
    return found != succeeded_.end() && now - found->second < kLately;
}

void SignInGate::note(const std::string& key, Time now) {
    if (succeeded_.size() >= kMostRemembered && !succeeded_.contains(key)) {
        succeeded_.erase(std::ranges::min_element(succeeded_, {},
                                                  [](const auto& entry) { return entry.second; }));
    }
    succeeded_[key] = now;
}

bool SignInGate::take(const std::string& whose, double burst, Time now) {
    const double per_second = kAttemptsPerMinute / 60;
    std::string key = whose;
    if (buckets_.size() >= kMostBuckets && !buckets_.contains(key)) {
        std::erase_if(buckets_, [&](const auto& entry) {
            return entry.second.tokens + seconds(now - entry.second.filled) * per_second >= burst;
        });
        // Somebody with thousands of addresses: those that come now share one.
        if (buckets_.size() >= kMostBuckets) key = "rest";
    }
    auto [at, fresh] = buckets_.emplace(key, Bucket{burst, now});
    Bucket& bucket = at->second;
    bucket.tokens =
        std::min(burst, bucket.tokens + std::max(0.0, seconds(now - bucket.filled)) * per_second);
    bucket.filled = now;
    if (bucket.tokens < 1) return false;
    bucket.tokens -= 1;
    return true;
}

SignInGate::Way SignInGate::admit(const std::string& account, const std::string& peer,
                                  double known_waiting, Time now) {
    const bool pair = lately(pair_key(account, peer), now);
    const bool known_account = pair || lately(account_key(account), now);
    // One for the account at this peer: others at the same address take nothing from it.
    const std::string whose = known_account ? pair_key(account, peer) : peer_key(peer);
    if (!take(whose, kBurst, now)) return Way::kLater;
    const bool known = pair || (known_account && known_waiting < kForPairsOnly) ||
                       (lately(peer_key(peer), now) && known_waiting < kForKnownPeers);
    return known ? Way::kKnown : Way::kStranger;
}

void SignInGate::succeeded(const std::string& account, const std::string& peer, Time now) {
    note(account_key(account), now);
    note(peer_key(peer), now);
    note(pair_key(account, peer), now);
}

void SignInGate::remember(const std::string& account, Time now) { note(account_key(account), now); }

}  // namespace pulseline::server
