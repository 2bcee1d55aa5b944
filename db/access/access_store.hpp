#pragma once

#include "core/access/access.hpp"
#include "db/database.hpp"

namespace pulseline::db {

/// Users, sessions and tokens. `database` must outlive it. Thread safety: none, as Database.
class AccessStore : public access::Store {
public:
    explicit AccessStore(Database& database) : database_(database) {}

    std::vector<access::User> users() override;
    /// Those that have ended, too: by which clock, the caller knows.
    std::vector<access::Session> sessions() override;
    std::vector<access::Token> tokens() override;
    void put(const access::User& user) override;
    void put(const access::Session& session) override;
    void put_use(const std::string& token_sha256, Time used) override;
    void remove_sessions(const std::vector<std::string>& token_sha256s) override;
    void put(const access::Token& token) override;

private:
    Database& database_;
};

}  // namespace pulseline::db
