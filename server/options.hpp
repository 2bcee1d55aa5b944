#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pulseline::server {

/// Every limit on what a stranger can make the server hold or wait for.
struct Limits {
    std::size_t header_bytes = 8 * 1024;
    std::size_t header_fields = 64;
    std::size_t body_bytes = 256 * 1024;
    std::chrono::milliseconds header_time{10'000};
    std::chrono::milliseconds body_time{15'000};
    std::chrono::milliseconds write_time{30'000};
    std::chrono::milliseconds keep_alive{30'000};
    std::chrono::milliseconds tls_handshake{5'000};
    int requests_per_connection = 1000;
    std::size_t connections = 12'000;
    std::size_t connections_per_peer = 256;
    std::size_t streams_per_user = 64;  // dashboards and event readers
    std::size_t stream_message_bytes = 64 * 1024;
    int stream_messages_per_second = 20;
    std::chrono::seconds stream_dead{25};
    std::size_t vehicle_text_bytes = 64 * 1024;
    std::size_t vehicle_binary_bytes = 256 * 1024;
    std::size_t vehicle_outbox = 256;
    int vehicle_malformed_in_a_row = 20;
    std::size_t planners_waiting = 8;  // previews, seconds each
    std::size_t encoders_waiting = 256;
    std::size_t workers_waiting = 16;  // behind the two that hash passwords
};

struct Options {
    std::string database;
    std::string plant_file;
    std::string listen = "127.0.0.1:8080";
    std::string tls_cert;
    std::string tls_key;
    bool tls_self_signed = false;
    bool behind_proxy = false;
    std::vector<std::string> allow_origins;
    bool log_json = false;
    Limits limits;

    bool tls() const { return tls_self_signed || !tls_cert.empty(); }
};

}  // namespace pulseline::server
