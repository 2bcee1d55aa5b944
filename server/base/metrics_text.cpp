#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

#include "server/base/log.hpp"
#include "server/base/metrics.hpp"

// What Metrics has counted, in Prometheus' text format.
namespace pulseline::server {
namespace {

void header(std::string& out, std::string_view name, std::string_view type, std::string_view help) {
    fmt::format_to(std::back_inserter(out), "# HELP {} {}\n# TYPE {} {}\n", name, help, name, type);
}

template <class T>
void single(std::string& out, std::string_view name, std::string_view type, std::string_view help,
            T value) {
    header(out, name, type, help);
    fmt::format_to(std::back_inserter(out), "{} {}\n", name, value);
}

std::int64_t resident_bytes() {
    std::ifstream statm("/proc/self/statm");
    std::int64_t total = 0;
    std::int64_t resident = 0;
    statm >> total >> resident;
    return resident * sysconf(_SC_PAGESIZE);
}

}  // namespace

void Histogram::write(std::string& out, std::string_view name, std::string_view labels) const {
    const std::string_view comma = labels.empty() ? "" : ",";
    const std::string braced = labels.empty() ? "" : fmt::format("{{{}}}", labels);
    std::uint64_t below = 0;
    auto to = std::back_inserter(out);
    for (std::size_t i = 0; i < kBounds_s.size(); ++i) {
        below += counts_[i];
        fmt::format_to(to, "{}_bucket{{{}{}le=\"{}\"}} {}\n", name, labels, comma, kBounds_s[i],
                       below);
    }
    fmt::format_to(to, "{}_bucket{{{}{}le=\"+Inf\"}} {}\n", name, labels, comma, count_);
    fmt::format_to(to, "{}_sum{} {}\n{}_count{} {}\n", name, braced, sum_s_, name, braced, count_);
}

void Metrics::write_timings(std::string& out) const {
    const std::lock_guard lock(mutex_);
    auto to = std::back_inserter(out);
    header(out, "pulseline_http_requests_total", "counter", "Requests by route and status.");
    for (const auto& [key, count] : requests_) {
        fmt::format_to(to, "pulseline_http_requests_total{{route=\"{}\",status=\"{}\"}} {}\n",
                       key.first, key.second, count);
    }
    header(out, "pulseline_http_request_duration_seconds", "histogram",
           "From the last byte of the request to the first of the response.");
    for (const auto& [route, histogram] : request_latency_) {
        histogram.write(out, "pulseline_http_request_duration_seconds",
                        fmt::format("route=\"{}\"", route));
    }
    header(out, "pulseline_fleet_batch_seconds", "histogram",
           "How long the fleet's thread was busy with one batch.");
    fleet_batch_.write(out, "pulseline_fleet_batch_seconds", "");
    single(out, "pulseline_commits_total", "counter", "Database commits.", commits_);
    single(out, "pulseline_commit_batches_total", "counter", "Fleet batches committed.", batches_);
    header(out, "pulseline_commit_duration_seconds", "histogram", "Duration of a commit.");
    commit_latency_.write(out, "pulseline_commit_duration_seconds", "");
    header(out, "pulseline_release_seconds", "histogram",
           "From what makes a release of floor possible (a message, a command, a tick) to the "
           "decision, and to its commit, behind which the vehicle is told.");
    release_decided_.write(out, "pulseline_release_seconds", "until=\"decided\"");
    release_stored_.write(out, "pulseline_release_seconds", "until=\"stored\"");
    header(out, "pulseline_snapshot_pause_seconds", "histogram",
           "How long the fleet waited for a snapshot of its state.");
    snapshot_pause_.write(out, "pulseline_snapshot_pause_seconds", "");
    header(out, "pulseline_snapshot_write_seconds", "histogram", "Storing a snapshot.");
    snapshot_latency_.write(out, "pulseline_snapshot_write_seconds", "");
    single(out, "pulseline_snapshot_bytes", "gauge", "Size of the newest snapshot.",
           snapshot_bytes_);
}

void Metrics::write_store(std::string& out) const {
    single(out, "pulseline_fleet_faults_total", "counter",
           "Exceptions of the fleet, after which it was built anew.", fleet_faults.load());
    single(out, "pulseline_commits_failed_total", "counter", "Commits that stored nothing.",
           commits_failed_.load());
    single(out, "pulseline_fleet_rebuilds_total", "counter", "Fleet built anew from the store.",
           fleet_rebuilds.load());
    single(out, "pulseline_read_only", "gauge",
           "1 while the database takes no writes and commands are refused.", read_only.load());
    single(out, "pulseline_heap_bytes", "gauge",
           "What the program has allocated; the process keeps more, in reserve.", heap_bytes());
    single(out, "pulseline_log_lines_dropped_total", "counter",
           "Lines of the log that nobody read in time.", log::dropped());
}

void Metrics::write_links(std::string& out) const {
    single(out, "pulseline_connections", "gauge", "Open connections.", connections.load());
    single(out, "pulseline_connections_refused_total", "counter", "Connections over a limit.",
           connections_refused.load());
    single(out, "pulseline_stream_clients", "gauge", "Dashboards on /api/v1/stream.",
           stream_clients.load());
    single(out, "pulseline_event_clients", "gauge", "Readers of /api/v1/events.",
           event_clients.load());
    single(out, "pulseline_slow_readers_closed_total", "counter",
           "Dashboards closed because they fell behind.", slow_readers_closed.load());
    single(out, "pulseline_pose_frames_skipped_total", "counter",
           "Pose frames a slow reader never saw.", poses_skipped.load());
    single(out, "pulseline_vehicle_sockets", "gauge", "Vehicles with an open socket.",
           vehicle_sockets.load());
    single(out, "pulseline_vehicle_messages_received_total", "counter", "Messages of vehicles.",
           vehicle_messages_in.load());
    single(out, "pulseline_vehicle_messages_sent_total", "counter", "Messages to vehicles.",
           vehicle_messages_out.load());
    single(out, "pulseline_vehicle_messages_malformed_total", "counter",
           "Messages of vehicles that were refused.", vehicle_messages_malformed.load());
    single(out, "pulseline_vehicle_messages_withheld_total", "counter",
           "Messages and pictures beyond what a vehicle's link may say.",
           vehicle_messages_withheld.load());
    single(out, "pulseline_vehicle_takeovers_total", "counter",
           "Sockets replaced by a newer one of the same identity.", vehicle_takeovers.load());
    single(out, "pulseline_event_seq", "gauge", "Newest event of the gapless sequence.",
           event_seq.load());
    single(out, "pulseline_clock_ahead_milliseconds", "gauge",
           "How far the server's time is ahead of the system's.", clock_ahead_ms.load());
}

std::string Metrics::text(const std::map<std::string, int>& orders_by_state,
                          const std::map<std::string, int>& vehicles_by_link,
                          const QueueLengths& queues) const {
    std::string out;
    auto to = std::back_inserter(out);
    header(out, "pulseline_job_orders", "gauge", "Job orders held by the fleet, by state.");
    for (const auto& [state, count] : orders_by_state) {
        fmt::format_to(to, "pulseline_job_orders{{state=\"{}\"}} {}\n", state, count);
    }
    header(out, "pulseline_vehicles", "gauge", "Vehicles by silence of their link.");
    for (const auto& [link, count] : vehicles_by_link) {
        fmt::format_to(to, "pulseline_vehicles{{link=\"{}\"}} {}\n", link, count);
    }
    write_timings(out);
    single(out, "pulseline_fleet_tick_age_seconds", "gauge", "Since the fleet's newest tick.",
           queues.tick_age_s);
    header(out, "pulseline_fleet_queue_length", "gauge", "What waits for the fleet and the store.");
    for (const auto& [queue, length] :
         {std::pair("commands", queues.commands), std::pair("reads", queues.reads),
          std::pair("commits", queues.commits)}) {
        fmt::format_to(to, "pulseline_fleet_queue_length{{queue=\"{}\"}} {}\n", queue, length);
    }
    write_store(out);
    write_links(out);
    single(out, "process_resident_memory_bytes", "gauge", "Resident memory.", resident_bytes());
    return out;
}

}  // namespace pulseline::server
