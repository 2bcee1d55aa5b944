#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "core/base/time.hpp"

namespace pulseline::server {

/// Who may have a password hashed. Hashing is dear on purpose, so a stranger who floods it must not
/// keep a plant's people out: attempts are counted for each peer before they wait anywhere, and who
/// signed in lately waits in a lane of its own.
/// Thread safety: none, the network thread owns it.
class SignInGate {
public:
    enum class Way {
        kKnown,     // the lane of those who signed in lately
        kStranger,  // the lane of everybody else
        kLater,     // not now
    };
    /// Counts the attempt. `peer` is a neighbourhood(); `known_waiting` the part of the known lane
    /// that is taken, from 0 to 1.
    Way admit(const std::string& account, const std::string& peer, double known_waiting, Time now);
    void succeeded(const std::string& account, const std::string& peer, Time now);
    /// An account whose session is still good at start.
    void remember(const std::string& account, Time now);

private:
    struct Bucket {
        double tokens = 0;
        Time filled;
    };
    bool take(const std::string& whose, double burst, Time now);
    bool lately(const std::string& key, Time now) const;
    void note(const std::string& key, Time now);

    std::map<std::string, Bucket> buckets_;
    std::map<std::string, Time> succeeded_;
};

}  // namespace pulseline::server
