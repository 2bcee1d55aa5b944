#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "core/access/access.hpp"

namespace pulseline::api::access {

/// access::Store in memory: what a restart would find.
class MemoryStore : public Store {
public:
    std::vector<User> users() override { return values(users_); }
    std::vector<Session> sessions() override { return values(sessions_); }
    std::vector<Token> tokens() override { return values(tokens_); }
    void put(const User& user) override { users_[user.name] = user; }
    void put(const Session& session) override { sessions_[session.token_sha256] = session; }
    void put_use(const std::string& sha256, Time used) override {
        const auto session = sessions_.find(sha256);
        if (session != sessions_.end()) session->second.used = used;
    }
    void remove_sessions(const std::vector<std::string>& all) override {
        for (const auto& sha256 : all) sessions_.erase(sha256);
    }
    void put(const Token& token) override { tokens_[token.id] = token; }

private:
    template <class T>
    static std::vector<T> values(const std::map<std::string, T>& map) {
        std::vector<T> all;
        for (const auto& [key, value] : map) all.push_back(value);
        return all;
    }

    std::map<std::string, User> users_;
    std::map<std::string, Session> sessions_;
    std::map<std::string, Token> tokens_;
};

}  // namespace pulseline::api::access
