#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "api/access/identity.hpp"
#include "core/base/result.hpp"

namespace pulseline::api::access {

struct RemoveSessions {
    std::vector<std::string> token_sha256s;
};
/// When sessions were used last, by their token_sha256.
struct SessionUses {
    std::vector<std::pair<std::string, Time>> uses;
};
/// One thing to write through access::Store.
using Change = std::variant<User, Session, Token, RemoveSessions, SessionUses>;
void apply(Store& store, const Change& change);  // call qualified: std::apply is near

struct Limits {
    Duration session_idle = std::chrono::minutes(30);
    Duration session_total = std::chrono::hours(12);
    int sign_ins_per_minute = 5;  // attempts for one account from one peer
};

/// How a new password is hashed (libsodium's Argon2id).
struct HashCost {
    unsigned long long operations = 2;
    std::size_t memory_bytes = 64U << 20U;  // libsodium's INTERACTIVE
};

struct SignedIn {
    Identity identity;
    std::string cookie_token;  // the secret of the session; goes into the cookie and nowhere else
};

/// Secret shown once, with the record that was stored.
struct NewToken {
    std::string secret;  // "pla_..." or "plv_..."
    Token token;
};

/// Users, sessions and tokens, held in memory over access::Store. Changes are stored by `save`,
/// which returns only when they are on disk and throws otherwise; memory changes after it. Thread
/// safety: full. Those who call `save` may block: call them on the worker pool.
class AccessControl {
public:
    using Save = std::function<void(const Change&)>;

    /// `last_stored`: the newest time the server is known to have lived at. When the clock was set
    /// back since then, sessions are judged by that time and go on by the clock of now, so that
    /// nobody at work is sent away and none that had ended lives again.
    AccessControl(Store& store, Save save, Time now, Time last_stored = {}, Limits limits = {},
                  HashCost cost = {});
    ~AccessControl();

    /// Who sends these headers (names in lower case). Never fails: who proves nothing is anonymous.
    /// A bearer token wins over a cookie. Counts as use of the session.
    Identity identify(const std::map<std::string, std::string>& headers, Time now);
    /// Whether an open stream may go on; does not count as use.
    bool still_valid(const Identity& identity, Time now) const;
    /// Counts as use: a person did something on an open stream.
    void touch(const Identity& identity, Time now);

    /// Blocks for the password hash (about 0.1 s). Errors: kForbidden `wrong_credentials`,
    /// kUnavailable `too_many_sign_ins` {retry_after_s}.
    Result<SignedIn> sign_in(const std::string& name, const std::string& password,
                             const std::string& peer, Time now);
    void sign_out(const Identity& identity);
    /// Stores when sessions were used, so that one left alone does not live again after a restart.
    /// A use within a minute of the stored one is not worth a write.
    void save_uses();
    /// Drops sessions that have ended, from the store as well: a clock that is set back while the
    /// server is down finds none that it could revive.
    void forget_ended(Time now);
    /// Accounts with a session that may still be used.
    std::vector<std::string> signed_in(Time now) const;

    /// Adds a user, or gives an existing one a new role and password; ends that user's sessions.
    Result<User> create_user(const std::string& name, Role role, const std::string& password,
                             Time now);
    Result<NewToken> create_api_token(Role role, const std::string& scope, const std::string& note,
                                      Time now);
    Result<NewToken> create_vehicle_token(const std::string& manufacturer,
                                          const std::string& serial, const std::string& note,
                                          Time now);
    Status revoke_token(const std::string& id);

    /// Identity of kind kVehicle when the Authorization header is a token bound to that very
    /// vehicle.
    std::optional<Identity> vehicle_for_token(const std::string& authorization,
                                              const std::string& manufacturer,
                                              const std::string& serial) const;

    const Limits& limits() const;
    std::vector<User> users() const;
    std::vector<Token> tokens() const;

private:
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace pulseline::api::access
