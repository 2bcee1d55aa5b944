#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/base/time.hpp"

/// Who may do what: plain data and the port to where it is kept. Secrets are stored hashed only.
namespace pulseline::access {

enum class Role { kViewer, kOperator, kEngineer, kAdmin };  // each may all that the ones before may
const char* to_string(Role role);                           // "viewer"
std::optional<Role> parse_role(const std::string& text);

struct User {
    std::string name;
    Role role = Role::kViewer;
    std::string password_hash;  // libsodium's encoded Argon2id
    bool disabled = false;
    Time created;
};

/// A browser session; the cookie's value is never stored.
struct Session {
    std::string token_sha256;
    std::string csrf_token;
    std::string user;
    Time created;
    Time expires;
    Time used = {};  // newest use that was stored
};

/// A bearer token of a program (role) or of one vehicle.
struct Token {
    std::string id;  // short, public: shown in lists and logs
    std::string token_sha256;
    std::string note;
    std::optional<Role> role;          // API token
    std::string scope;                 // "api", later finer
    std::string vehicle_manufacturer;  // vehicle token
    std::string vehicle_serial;
    bool revoked = false;
    Time created;
};

/// Port, implemented by db::AccessStore. Writers throw db::Error when nothing was stored.
class Store {
public:
    virtual ~Store() = default;
    virtual std::vector<User> users() = 0;
    virtual std::vector<Session> sessions() = 0;
    virtual std::vector<Token> tokens() = 0;
    virtual void put(const User& user) = 0;
    virtual void put(const Session& session) = 0;
    /// Only of sessions that are still there.
    virtual void put_use(const std::string& token_sha256, Time used) = 0;
    /// In one transaction, however many they are.
    virtual void remove_sessions(const std::vector<std::string>& token_sha256s) = 0;
    virtual void put(const Token& token) = 0;
};

}  // namespace pulseline::access
