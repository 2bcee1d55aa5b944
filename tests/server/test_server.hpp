#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <thread>

#include "server/server.hpp"
#include "tests/server/memory_stores.hpp"

namespace pulseline::server::testing {

/// Two stations and one small vehicle "V1" of ACME, serial 0001, with one camera "front".
plant::Plant small_plant();

/// A real server on a free port of the loopback, over stores in memory.
class TestServer {
public:
    /// `store`: one that holds something already, outlives the server; null: an empty one.
    explicit TestServer(Options options = {}, MemoryStore* store = nullptr);
    ~TestServer();

    std::uint16_t port() const { return server_->port(); }
    std::map<std::string, std::string> operator_token();
    std::map<std::string, std::string> viewer_token();
    std::string vehicle_token(const std::string& serial = "0001");
    MemoryStore& store() { return *store_; }
    Server& server() { return *server_; }
    /// Ends it as SIGTERM does.
    void stop();

private:
    std::map<std::string, std::string> token(access::Role role);

    plant::Plant plant_ = small_plant();
    MemoryStore own_store_;
    MemoryStore* store_;
    MemoryAccess access_;
    std::unique_ptr<Server> server_;
    std::thread thread_;
};

}  // namespace pulseline::server::testing
