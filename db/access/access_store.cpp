#include "db/access/access_store.hpp"

#include "db/sql_text.hpp"
#include "db/statement.hpp"

namespace pulseline::db {
namespace {

struct UserRow {
    static constexpr const char* kColumns = "name, role, password_hash, disabled, created_ns";
    std::string name, role, password_hash;
    int disabled = 0;
    std::int64_t created_ns = 0;
    auto fields() { return std::tie(name, role, password_hash, disabled, created_ns); }
};

struct SessionRow {
    static constexpr const char* kColumns =
        "token_sha256, csrf_token, user, created_ns, expires_ns, used_ns";
    std::string token_sha256, csrf_token, user;
    std::int64_t created_ns = 0, expires_ns = 0, used_ns = 0;
    auto fields() {
        return std::tie(token_sha256, csrf_token, user, created_ns, expires_ns, used_ns);
    }
};

struct TokenRow {
    static constexpr const char* kColumns =
        "id, token_sha256, note, role, scope, vehicle_manufacturer, vehicle_serial, revoked, "
        "created_ns";
    std::string id, token_sha256, note, role, scope, vehicle_manufacturer, vehicle_serial;
    int revoked = 0;
    std::int64_t created_ns = 0;
    auto fields() {
        return std::tie(id, token_sha256, note, role, scope, vehicle_manufacturer, vehicle_serial,
                        revoked, created_ns);
    }
};

template <class Row>
void upsert(Database& database, const char* table, const char* key, Row row) {
    database.transaction([&] {
        Statement(database.sql(), upsert_into(table, Row::kColumns, key), row.fields()).run();
    });
}

template <class Row, class Visit>
void read_all(Database& database, const std::string& table_and_rest, Visit visit) {
    reading(database.path(), [&] {
        Row row;
        Statement select(database.sql(),
                         std::string("SELECT ") + Row::kColumns + " FROM " + table_and_rest,
                         std::tuple<>(), row.fields());
        for (select.start(); select.fetch();) visit(row);
    });
}

access::Role role_of(const std::string& name) {
    const auto role = access::parse_role(name);
    if (!role) {
        throw Error(Error::Kind::kBadValue,
                    "The database holds an unknown role \"" + name + "\"; restore a backup.");
    }
    return *role;
}

}  // namespace

std::vector<access::User> AccessStore::users() {
    std::vector<access::User> users;
    read_all<UserRow>(database_, "users ORDER BY name", [&](const UserRow& row) {
        users.push_back({row.name, role_of(row.role), row.password_hash, row.disabled != 0,
                         time_from_ns(row.created_ns)});
    });
    return users;
}

std::vector<access::Session> AccessStore::sessions() {
    std::vector<access::Session> sessions;
    read_all<SessionRow>(database_, "sessions ORDER BY created_ns", [&](const SessionRow& row) {
        sessions.push_back({row.token_sha256, row.csrf_token, row.user,
                            time_from_ns(row.created_ns), time_from_ns(row.expires_ns),
                            time_from_ns(row.used_ns)});
    });
    return sessions;
}

std::vector<access::Token> AccessStore::tokens() {
    std::vector<access::Token> tokens;
    read_all<TokenRow>(database_, "tokens ORDER BY created_ns, id", [&](const TokenRow& row) {
        access::Token token;
        token.id = row.id;
        token.token_sha256 = row.token_sha256;
        token.note = row.note;
        if (!row.role.empty()) token.role = role_of(row.role);
        token.scope = row.scope;
        token.vehicle_manufacturer = row.vehicle_manufacturer;
        token.vehicle_serial = row.vehicle_serial;
        token.revoked = row.revoked != 0;
        token.created = time_from_ns(row.created_ns);
        tokens.push_back(std::move(token));
    });
    return tokens;
}

void AccessStore::put(const access::User& user) {
    UserRow row;
    row.name = user.name;
    row.role = access::to_string(user.role);
    row.password_hash = user.password_hash;
    row.disabled = user.disabled;
    row.created_ns = to_ns(user.created);
    upsert(database_, "users", "name", row);
}

void AccessStore::put(const access::Session& session) {
    SessionRow row;
    row.token_sha256 = session.token_sha256;
    row.csrf_token = session.csrf_token;
    row.user = session.user;
    row.created_ns = to_ns(session.created);
    row.expires_ns = to_ns(session.expires);
    row.used_ns = to_ns(session.used);
    upsert(database_, "sessions", "token_sha256", row);
}

void AccessStore::put_use(const std::string& token_sha256, Time used) {
    std::string key = token_sha256;
    std::int64_t used_ns = to_ns(used);
    database_.transaction([&] {
        Statement(database_.sql(), "UPDATE sessions SET used_ns = :used WHERE token_sha256 = :key",
                  std::tie(used_ns, key))
            .run();
    });
}

void AccessStore::remove_sessions(const std::vector<std::string>& token_sha256s) {
    database_.transaction([&] {
        for (std::string key : token_sha256s) {
            Statement(database_.sql(), "DELETE FROM sessions WHERE token_sha256 = :key",
                      std::tie(key))
                .run();
        }
    });
}

void AccessStore::put(const access::Token& token) {
    TokenRow row;
    row.id = token.id;
    row.token_sha256 = token.token_sha256;
    row.note = token.note;
    if (token.role) row.role = access::to_string(*token.role);
    row.scope = token.scope;
    row.vehicle_manufacturer = token.vehicle_manufacturer;
    row.vehicle_serial = token.vehicle_serial;
    row.revoked = token.revoked;
    row.created_ns = to_ns(token.created);
    upsert(database_, "tokens", "id", row);
}

}  // namespace pulseline::db
