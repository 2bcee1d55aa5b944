#include "api/access/access_control.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <unordered_map>

#include "api/access/credentials.hpp"
#include "api/access/new_user.hpp"
#include "api/access/secrets.hpp"
#include "api/access/sign_in_limit.hpp"

namespace pulseline::api::access {
namespace {

constexpr std::size_t kSecretBytes = 32;
constexpr std::size_t kTokenIdLength = 12;
constexpr const char* kTokenActor = "token:";
constexpr Duration kClockTolerance = std::chrono::minutes(5);
constexpr Duration kStoreUse = std::chrono::minutes(1);
// A hall without vehicles stores nothing else for an hour; uses tell of later times until then.
constexpr Duration kNothingStored = std::chrono::minutes(65);

tl::unexpected<Error> wrong_credentials() {
    return fail(Errc::kUnauthenticated, "wrong_credentials",
                "Name or password is wrong; check both and try again.");
}

}  // namespace

void apply(Store& store, const Change& change) {
    struct Writer {
        Store& store;
        void operator()(const User& user) const { store.put(user); }
        void operator()(const Session& session) const { store.put(session); }
        void operator()(const Token& token) const { store.put(token); }
        void operator()(const RemoveSessions& gone) const {
            store.remove_sessions(gone.token_sha256s);
        }
        void operator()(const SessionUses& all) const {
            for (const auto& [token_sha256, used] : all.uses) store.put_use(token_sha256, used);
        }
    };
    std::visit(Writer{store}, change);
}

class AccessControl::Impl {
public:
    struct LiveSession {
        Session stored;
        Time used;
    };

    Impl(Save save_change, Limits limits_in, HashCost cost_in)
        : save(std::move(save_change)),
          limits(limits_in),
          cost(cost_in),
          sign_ins(limits_in.sign_ins_per_minute) {}

    /// Those that had not ended when the server was last known to live, by the clock of now.
    void take_sessions(Store& store, Time now, Time last_stored) {
        const auto stored = store.sessions();
        Time lived = std::max(now, last_stored);
        for (const auto& session : stored) {
            if (session.used - last_stored <= kNothingStored) lived = std::max(lived, session.used);
        }
        const Duration set_back = lived - now;
        std::vector<std::string> ended;
        for (Session session : stored) {
            // One of a time that has not come yet was made by a clock that was ahead.
            const bool possible = session.used <= lived + kClockTolerance;
            if (!possible || lived >= ends({session, session.used})) {
                ended.push_back(session.token_sha256);
                continue;
            }
            if (set_back > Duration::zero()) {
                session.created -= set_back;
                session.expires -= set_back;
                session.used -= set_back;
                store.put(session);
            }
            sessions.emplace(session.token_sha256, LiveSession{session, session.used});
        }
        if (!ended.empty()) store.remove_sessions(ended);
    }
    Time ends(const LiveSession& session) const {
        return std::min(session.stored.expires, session.used + limits.session_idle);
    }
    /// The session when it may still be used, with its user.
    LiveSession* live(const std::string& sha256, Time now) {
        const auto it = sessions.find(sha256);
        if (it == sessions.end() || now >= ends(it->second)) return nullptr;
        const auto user = users.find(it->second.stored.user);
        if (user == users.end() || user->second.disabled) return nullptr;
        return &it->second;
    }
    Identity of(const LiveSession& session) const {
        Identity identity;
        identity.kind = Identity::Kind::kUser;
        identity.name = session.stored.user;
        identity.role = users.at(session.stored.user).role;
        identity.expires = ends(session);
        identity.session_sha256 = session.stored.token_sha256;
        identity.csrf_token = session.stored.csrf_token;
        return identity;
    }
    const Token* usable_token(const std::string& secret) const {
        const auto it = tokens.find(sha256_hex(secret));
        return it == tokens.end() || it->second.revoked ? nullptr : &it->second;
    }
    static Identity of(const Token& token) {
        Identity identity;
        identity.name = kTokenActor + token.id;
        identity.token_sha256 = token.token_sha256;
        if (token.role) {
            identity.kind = Identity::Kind::kToken;
            identity.role = token.role;
        } else {
            identity.kind = Identity::Kind::kVehicle;
            identity.vehicle_manufacturer = token.vehicle_manufacturer;
            identity.vehicle_serial = token.vehicle_serial;
        }
        return identity;
    }
    NewToken add_token(const std::string& prefix, Token token) {
        NewToken made;
        made.secret = prefix + random_text(kSecretBytes);
        token.token_sha256 = sha256_hex(made.secret);
        token.id = token.token_sha256.substr(0, kTokenIdLength);  // says nothing of the secret
        save(token);
        const std::lock_guard lock(mutex);
        tokens.emplace(token.token_sha256, token);
        made.token = std::move(token);
        return made;
    }

    Save save;
    Limits limits;
    HashCost cost;
    mutable std::mutex mutex;
    std::map<std::string, User> users;
    std::unordered_map<std::string, LiveSession> sessions;  // by sha256 of the cookie
    std::unordered_map<std::string, Token> tokens;          // by sha256 of the secret
    SignInLimit sign_ins;
};

AccessControl::AccessControl(Store& store, Save save, Time now, Time last_stored, Limits limits,
                             HashCost cost)
    : impl_(std::make_unique<Impl>(std::move(save), limits, cost)) {
    for (auto& user : store.users()) impl_->users.emplace(user.name, user);
    for (auto& token : store.tokens()) impl_->tokens.emplace(token.token_sha256, token);
    impl_->take_sessions(store, now, last_stored);
}

AccessControl::~AccessControl() = default;

Identity AccessControl::identify(const std::map<std::string, std::string>& headers, Time now) {
    const Credentials sent = credentials(headers);
    if (!sent.has_bearer && sent.session.empty()) return {};
    const std::lock_guard lock(impl_->mutex);
    if (sent.has_bearer) {
        const Token* token = impl_->usable_token(sent.bearer);
        return token != nullptr ? Impl::of(*token) : Identity{};
    }
    auto* session = impl_->live(sha256_hex(sent.session), now);
    if (session == nullptr) return {};
    session->used = std::max(session->used, now);
    return impl_->of(*session);
}

bool AccessControl::still_valid(const Identity& identity, Time now) const {
    const std::lock_guard lock(impl_->mutex);
    if (identity.kind == Identity::Kind::kAnonymous) return true;
    if (identity.kind == Identity::Kind::kUser) {
        const auto* session = impl_->live(identity.session_sha256, now);
        return session != nullptr && impl_->of(*session).role == identity.role;
    }
    const auto token = impl_->tokens.find(identity.token_sha256);
    return token != impl_->tokens.end() && !token->second.revoked;
}

void AccessControl::touch(const Identity& identity, Time now) {
    const std::lock_guard lock(impl_->mutex);
    if (auto* session = impl_->live(identity.session_sha256, now)) {
        session->used = std::max(session->used, now);
    }
}

Result<SignedIn> AccessControl::sign_in(const std::string& name, const std::string& password,
                                        const std::string& peer, Time now) {
    std::optional<User> user;
    {
        const std::lock_guard lock(impl_->mutex);
        if (const auto wait = impl_->sign_ins.attempt(name, peer, now)) {
            const auto wait_s = static_cast<std::int64_t>(std::ceil(seconds(*wait)));
            return fail(Errc::kTooMany, "too_many_sign_ins",
                        "Too many attempts to sign in; wait and try again.", {},
                        {{"retry_after_s", std::max<std::int64_t>(1, wait_s)}});
        }
        if (const auto it = impl_->users.find(name); it != impl_->users.end()) user = it->second;
    }
    // Unknown and disabled users cost the same work, so that the time tells nothing.
    bool right = false;
    if (user) {
        right = verify_password(user->password_hash, password) && !user->disabled;
    } else {
        (void)hash_password(password, impl_->cost);
    }
    if (!right) return wrong_credentials();

    SignedIn signed_in;
    signed_in.cookie_token = random_text(kSecretBytes);
    Session session;
    session.token_sha256 = sha256_hex(signed_in.cookie_token);
    session.csrf_token = random_text(kSecretBytes);
    session.user = name;
    session.created = session.used = now;
    session.expires = now + impl_->limits.session_total;
    impl_->save(session);

    std::unique_lock lock(impl_->mutex);
    if (impl_->users.at(name).password_hash != user->password_hash) {
        // The password was changed while this one was being checked: its sessions have ended.
        lock.unlock();
        impl_->save(RemoveSessions{{session.token_sha256}});
        return wrong_credentials();
    }
    impl_->sign_ins.succeeded(name, peer);
    const auto& live = impl_->sessions[session.token_sha256] = Impl::LiveSession{session, now};
    signed_in.identity = impl_->of(live);
    return signed_in;
}

void AccessControl::sign_out(const Identity& identity) {
    if (identity.session_sha256.empty()) return;
    impl_->save(RemoveSessions{{identity.session_sha256}});
    const std::lock_guard lock(impl_->mutex);
    impl_->sessions.erase(identity.session_sha256);
}

void AccessControl::forget_ended(Time now) {
    RemoveSessions ended;
    {
        const std::lock_guard lock(impl_->mutex);
        for (const auto& [sha256, session] : impl_->sessions) {
            if (now >= impl_->ends(session)) ended.token_sha256s.push_back(sha256);
        }
    }
    if (ended.token_sha256s.empty()) return;
    impl_->save(ended);
    const std::lock_guard lock(impl_->mutex);
    for (const auto& sha256 : ended.token_sha256s) impl_->sessions.erase(sha256);
}

void AccessControl::save_uses() {
    SessionUses changed;
    {
        const std::lock_guard lock(impl_->mutex);
        for (const auto& [sha256, session] : impl_->sessions) {
            if (session.used - session.stored.used < kStoreUse) continue;
            changed.uses.emplace_back(sha256, session.used);
        }
    }
    if (changed.uses.empty()) return;
    impl_->save(changed);
    const std::lock_guard lock(impl_->mutex);
    for (const auto& [sha256, used] : changed.uses) {
        const auto session = impl_->sessions.find(sha256);
        if (session != impl_->sessions.end()) session->second.stored.used = used;
    }
}

std::vector<std::string> AccessControl::signed_in(Time now) const {
    const std::lock_guard lock(impl_->mutex);
    std::vector<std::string> names;
    for (const auto& [sha256, session] : impl_->sessions) {
        if (now < impl_->ends(session)) names.push_back(session.stored.user);
    }
    return names;
}

Result<User> AccessControl::create_user(const std::string& name, Role role,
                                        const std::string& password, Time now) {
    if (const Status ok = check_new_user(name, password); !ok) return fail(ok.error());
    User user;
    user.name = name;
    user.role = role;
    user.password_hash = hash_password(password, impl_->cost);
    user.created = now;
    std::vector<std::string> ended;
    {
        const std::lock_guard lock(impl_->mutex);
        if (const auto it = impl_->users.find(name); it != impl_->users.end()) {
            user.created = it->second.created;
        }
        for (const auto& [sha256, session] : impl_->sessions) {
            if (session.stored.user == name) ended.push_back(sha256);
        }
    }
    impl_->save(user);
    if (!ended.empty()) impl_->save(RemoveSessions{ended});

    const std::lock_guard lock(impl_->mutex);
    impl_->users[name] = user;
    for (const auto& sha256 : ended) impl_->sessions.erase(sha256);
    return user;
}

Result<NewToken> AccessControl::create_api_token(Role role, const std::string& scope,
                                                 const std::string& note, Time now) {
    Token token;
    token.role = role;
    token.scope = scope;
    token.note = note;
    token.created = now;
    return impl_->add_token("pla_", std::move(token));
}

Result<NewToken> AccessControl::create_vehicle_token(const std::string& manufacturer,
                                                     const std::string& serial,
                                                     const std::string& note, Time now) {
    if (manufacturer.empty() || serial.empty()) {
        return fail(Errc::kInvalid, "bad_vehicle_identity",
                    "A vehicle token needs manufacturer and serial number: MAKER/SERIAL.");
    }
    Token token;
    token.vehicle_manufacturer = manufacturer;
    token.vehicle_serial = serial;
    token.scope = "vehicle";
    token.note = note;
    token.created = now;
    return impl_->add_token("plv_", std::move(token));
}

Status AccessControl::revoke_token(const std::string& id) {
    std::optional<Token> token;
    {
        const std::lock_guard lock(impl_->mutex);
        for (const auto& entry : impl_->tokens) {
            if (entry.second.id == id) token = entry.second;
        }
    }
    if (!token) {
        return fail(Errc::kNotFound, "unknown_token",
                    "There is no token of that id; the list of tokens names them.", {},
                    {{"id", id}});
    }
    token->revoked = true;
    impl_->save(*token);
    const std::lock_guard lock(impl_->mutex);
    impl_->tokens[token->token_sha256] = *token;
    return {};
}

std::optional<Identity> AccessControl::vehicle_for_token(const std::string& authorization,
                                                         const std::string& manufacturer,
                                                         const std::string& serial) const {
    const std::string secret = bearer_token(authorization);
    const std::lock_guard lock(impl_->mutex);
    const Token* token = impl_->usable_token(secret);
    if (token == nullptr || token->role || token->vehicle_manufacturer != manufacturer ||
        token->vehicle_serial != serial) {
        return std::nullopt;
    }
    return Impl::of(*token);
}

const Limits& AccessControl::limits() const { return impl_->limits; }

std::vector<User> AccessControl::users() const {
    const std::lock_guard lock(impl_->mutex);
    std::vector<User> all;
    for (const auto& [name, user] : impl_->users) all.push_back(user);
    return all;
}

std::vector<Token> AccessControl::tokens() const {
    const std::lock_guard lock(impl_->mutex);
    std::vector<Token> all;
    for (const auto& [sha256, token] : impl_->tokens) all.push_back(token);
    std::sort(all.begin(), all.end(),
              [](const Token& a, const Token& b) { return a.created < b.created; });
    return all;
}

}  // namespace pulseline::api::access
