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
    std::size_t stranger_body_bytes = 4 * 1024;    // who has not signed in sends a sign-in
    std::size_t bodies_of_one_bytes = 32U << 20U;  // read or worked on at once, for one account
    std::size_t bodies_bytes = 128U << 20U;        // of all
    std::chrono::milliseconds header_time{10'000};
    // From a request's first byte to its last. With what a close takes whoever is slow is gone in
    // 15 s.
    std::chrono::milliseconds request_time{12'000};
    std::size_t body_bytes_per_second = 1024;
    std::chrono::milliseconds write_time{12'000};
    int send_buffer_bytes = 256 * 1024;  // more in the kernel would hide who does not read
    std::chrono::milliseconds keep_alive{30'000};
    std::chrono::milliseconds tls_handshake{5'000};
    int requests_per_connection = 1000;
    std::size_t connections = 12'000;
    std::size_t connections_per_peer = 256;
    std::size_t streams_per_user = 64;  // dashboards and event readers
    std::size_t stream_message_bytes = 64 * 1024;
    int stream_messages_per_second = 20;
    std::size_t stream_bytes_per_second = 64 * 1024;  // frames without a byte count too
    std::chrono::seconds stream_dead{25};
    std::size_t vehicle_text_bytes = 64 * 1024;
    std::size_t vehicle_binary_bytes = 256 * 1024;
    std::size_t vehicle_outbox = 256;
    int vehicle_malformed_in_a_row = 20;
    double vehicle_malformed_per_minute = 20;
    double vehicle_messages_per_second = 100;
    std::size_t vehicle_bytes_per_second = 1U << 20U;
    double vehicle_pictures_per_second = 20;
    std::chrono::milliseconds vehicle_excess_time{30'000};  // until the link is closed
    std::size_t link_bytes_per_second = 8U << 20U;          // taken off a vehicle's socket
    std::size_t sign_ins_waiting = 16;                      // in each lane that hashes passwords
    std::chrono::milliseconds sign_in_refusal{1'000};  // how long a refused one is kept waiting
    std::size_t lists_waiting = 256;
    std::size_t lists_of_one = 64;
    std::size_t heavy_waiting = 32;  // marker sheets, images
    std::size_t heavy_of_one = 4;
    std::size_t planners_waiting = 8;  // previews, seconds each
    std::size_t encoders_waiting = 256;
};

struct Options {
    std::string database;
    std::string plant_file;
    std::string listen = "127.0.0.1:8080";
    std::string tls_cert;
    std::string tls_key;
    bool tls_self_signed = false;
    std::vector<std::string> behind_proxy;  // the proxies whose X-Forwarded headers are believed
    std::vector<std::string> allow_origins;
    bool log_json = false;
    std::int64_t events_kept = 1'000'000;
    int events_kept_days = 400;
    Limits limits;

    bool tls() const { return tls_self_signed || !tls_cert.empty(); }
};

}  // namespace pulseline::server
