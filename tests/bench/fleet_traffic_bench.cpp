// Traffic with 1,000 vehicles: time of an admission and of a release decision, memory, and orders
// per simulated hour against two baselines on the same floor with the same orders: one vehicle per
// resource (a leg holds all its tiles, as openTCS users secure theirs) and a joint plan after PIBT.
// Admissions are measured in CPU time of the thread, release decisions by the wall clock.
//   bench_traffic [--hours H] [--releases N] [--only halls|warehouse] [--out FILE]     JSON to
//   build/bench/traffic.json
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/bench/traffic_world.hpp"

namespace pulseline::bench {
namespace {

std::string quantiles(const char* name, std::vector<double>& times_us) {
    char text[256];
    std::snprintf(text, sizeof text,
                  "\"%s\": {\"count\": %zu, \"p50_us\": %.1f, \"p99_us\": %.1f, \"max_us\": %.1f}",
                  name, times_us.size(), quantile(times_us, 0.5), quantile(times_us, 0.99),
                  quantile(times_us, 1.0));
    return text;
}

std::string measure(const World& world, double hours, std::uint64_t releases) {
    std::printf("%s: %zu places, %zu vehicles, layout %s\n", world.name.c_str(),
                world.graph.places.size(), world.starts.size(),
                world.well_formed ? "well-formed" : "NOT well-formed");
    std::fflush(stdout);
    Run ours = run_traffic(world, hours * 3600, releases);
    const Run exclusive = run_exclusive_legs(world, hours * 3600);
    const Run pibt = run_pibt(world, hours * 3600);
    const auto line = [&](const char* name, const Run& run) {
        std::printf("  %-28s %8.0f orders/h  (%llu done, %d vehicles stuck at the end)\n", name,
                    run.orders_per_hour(), static_cast<unsigned long long>(run.orders), run.stuck);
    };
    line("joint plan (this library)", ours);
    line("one vehicle per resource", exclusive);
    line("PIBT", pibt);
    std::printf(
        "  admission p50 %.0f us, p99 %.0f us (%zu, refused %llu); release decision p50 %.2f us, "
        "p99 %.2f us (%zu)\n  %llu releases, %llu violations; %.1f KB a vehicle\n",
        quantile(ours.admission_us, 0.5), quantile(ours.admission_us, 0.99),
        ours.admission_us.size(), static_cast<unsigned long long>(ours.refused),
        quantile(ours.release_us, 0.5), quantile(ours.release_us, 0.99), ours.release_us.size(),
        static_cast<unsigned long long>(ours.releases),
        static_cast<unsigned long long>(ours.violations), ours.bytes_per_vehicle / 1024);
    std::printf("  improvement step p50 %.0f us, p99 %.0f us\n", quantile(ours.improve_us, 0.5),
                quantile(ours.improve_us, 0.99));
    std::fflush(stdout);
    char text[512];
    std::snprintf(
        text, sizeof text,
        "\"orders_per_hour\": {\"joint_plan\": %.0f, \"one_vehicle_per_resource\": %.0f, "
        "\"pibt\": %.0f}, \"stuck\": {\"joint_plan\": %d, \"one_vehicle_per_resource\": %d, "
        "\"pibt\": %d}, \"releases\": %llu, \"violations\": %llu, \"bytes_per_vehicle\": %.0f",
        ours.orders_per_hour(), exclusive.orders_per_hour(), pibt.orders_per_hour(), ours.stuck,
        exclusive.stuck, pibt.stuck, static_cast<unsigned long long>(ours.releases),
        static_cast<unsigned long long>(ours.violations), ours.bytes_per_vehicle);
    return "  \"" + world.name + "\": {\"vehicles\": " + std::to_string(world.starts.size()) +
           ", \"well_formed\": " + (world.well_formed ? "true" : "false") + ",\n    " +
           quantiles("admission", ours.admission_us) + ",\n    " +
           quantiles("release_decision", ours.release_us) + ",\n    " +
           quantiles("improvement_step", ours.improve_us) + ",\n    " + text + "}";
}

}  // namespace
}  // namespace pulseline::bench

int main(int argc, char** argv) {
    using namespace pulseline::bench;
    double hours = 0.5;
    std::uint64_t releases = 0;
    std::string only;
    std::string out = "build/bench/traffic.json";
    for (int i = 1; i + 1 < argc; i += 2) {
        if (std::strcmp(argv[i], "--hours") == 0) hours = std::strtod(argv[i + 1], nullptr);
        if (std::strcmp(argv[i], "--releases") == 0) {
            releases = std::strtoull(argv[i + 1], nullptr, 10);
        }
        if (std::strcmp(argv[i], "--only") == 0) only = argv[i + 1];
        if (std::strcmp(argv[i], "--out") == 0) out = argv[i + 1];
    }
    std::string json = "{\n";
    if (only != "warehouse") json += measure(halls_world(), hours, 0);
    if (only.empty()) json += ",\n";
    if (only != "halls") json += measure(warehouse_world(), hours, releases);
    json += "\n}\n";
    const std::filesystem::path path(out);
    if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << json;
    std::printf("written to %s\n", out.c_str());
    return 0;
}
