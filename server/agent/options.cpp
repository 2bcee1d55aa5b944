#include "server/agent/options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <utility>

namespace pulseline::agent {
namespace {

Result<Identity> parse_identity(const std::string& text) {
    const auto slash = text.find('/');
    if (slash == 0 || slash == std::string::npos || slash + 1 == text.size() ||
        text.find('/', slash + 1) != std::string::npos) {
        return fail(Errc::kInvalid, "bad_identity",
                    "vehicle \"" + text + "\" must be MANUFACTURER/SERIAL");
    }
    return Identity{text.substr(0, slash), text.substr(slash + 1), {}};
}

Result<std::string> read_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) return fail(Errc::kNotFound, "no_file", "cannot read " + path);
    return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string trimmed(std::string text) {
    const auto is_space = [](unsigned char c) { return std::isspace(c) != 0; };
    while (!text.empty() && is_space(static_cast<unsigned char>(text.back()))) text.pop_back();
    return text;
}

constexpr double kMostOff_m = 0.1;  // of a bracket: its stroke is not much longer

struct Raw {
    std::string server;
    std::string vehicle;
    std::string vehicle_list;
    std::string token;
    std::string token_file;
    std::string sensing = "rendered";
    std::string drive;  // empty: as fits the sensing
    int count = 0;
    std::vector<std::string> faults;
    std::vector<std::string> cameras;
};

Result<std::vector<Identity>> identities(const Raw& raw) {
    if (!raw.vehicle_list.empty()) {
        auto text = read_file(raw.vehicle_list);
        if (!text) return fail(text.error());
        auto list = parse_vehicle_list(*text);
        if (!list) return list;
        const auto wanted = static_cast<std::size_t>(raw.count);
        if (wanted > list->size()) {
            return fail(Errc::kInvalid, "too_few_vehicles",
                        "--count asks for " + std::to_string(wanted) + " vehicles, " +
                            raw.vehicle_list + " has " + std::to_string(list->size()));
        }
        if (wanted > 0) list->resize(wanted);
        return list;
    }
    if (raw.count > 1) {
        return fail(Errc::kInvalid, "no_vehicle_list", "--count needs a list: give --vehicles");
    }
    auto identity = parse_identity(raw.vehicle);
    if (!identity) return fail(identity.error());
    identity->token = raw.token;
    if (!raw.token_file.empty()) {
        auto text = read_file(raw.token_file);
        if (!text) return fail(text.error());
        identity->token = trimmed(*text);
    }
    if (identity->token.empty()) {
        return fail(Errc::kInvalid, "no_token",
                    "the vehicle has no token; give --token or --token-file (`pulseline token "
                    "create --vehicle " +
                        raw.vehicle + "` makes one)");
    }
    return std::vector<Identity>{std::move(*identity)};
}

/// What only a vehicle with a machine behind a controller has.
Status with_machine(const Raw& raw, Options& options) {
    const auto alone = [](const std::string& option, const std::string& instead) {
        return fail(Errc::kInvalid, "no_machine",
                    option + " needs --machine tcp://HOST:PORT; " + instead);
    };
    for (const auto& text : raw.cameras) {
        if (options.machine.empty()) {
            return alone("--camera " + text, "a simulated vehicle's cameras are simulated with it");
        }
        auto camera = parse_camera(text);
        if (!camera) return fail(camera.error());
        if (std::ranges::find(options.cameras, camera->camera, &CameraSource::camera) !=
            options.cameras.end()) {
            return fail(Errc::kInvalid, "camera_twice",
                        "--camera " + text + ": camera " + camera->camera +
                            " has a source already; name one for each camera");
        }
        options.cameras.push_back(std::move(*camera));
    }
    if (options.machine.empty() && !options.belief_log.empty()) {
        return alone("--belief-log", "a simulated vehicle's --truth-log has what it believes");
    }
    return {};
}

Status complete(const Raw& raw, Options& options) {
    auto server = parse_server(raw.server);
    if (!server) return fail(server.error());
    options.server = std::move(*server);
    auto vehicles = identities(raw);
    if (!vehicles) return fail(vehicles.error());
    options.vehicles = std::move(*vehicles);
    options.rendered = raw.sensing == "rendered";
    options.servo_drive = raw.drive.empty() ? options.rendered : raw.drive == "servo";
    for (const auto& text : raw.faults) {
        auto fault = parse_fault(text);
        if (!fault) return fail(fault.error());
        const bool needs_wheels =
            fault->kind == Fault::Kind::kSlip || fault->kind == Fault::Kind::kEncoder;
        if (needs_wheels && !options.servo_drive) {
            return fail(Errc::kInvalid, "no_wheels",
                        "--fault " + text + " needs the wheels of --drive servo");
        }
        options.faults.push_back(std::move(*fault));
    }
    return with_machine(raw, options);
}

/// "1,-2.5,90": as many numbers as asked for; none of them where the text is something else.
std::vector<double> read_numbers(const std::string& text, std::size_t count) {
    std::vector<double> numbers;
    const char* at = text.data();
    const char* end = at + text.size();
    while (numbers.size() < count) {
        double number = 0;
        const auto [rest, error] = std::from_chars(at, end, number);
        if (error != std::errc{} || !std::isfinite(number)) return {};
        numbers.push_back(number);
        const bool last = numbers.size() == count;
        if (last ? rest != end : rest == end || *rest != ',') return {};
        at = rest + 1;
    }
    return numbers;
}

}  // namespace

Result<ServerAddress> parse_server(const std::string& url) {
    ServerAddress address;
    std::string rest;
    if (url.rfind("ws://", 0) == 0) {
        rest = url.substr(5);
    } else if (url.rfind("wss://", 0) == 0) {
        address.tls = true;
        rest = url.substr(6);
    } else {
        return fail(Errc::kInvalid, "bad_server",
                    "server \"" + url + "\" must begin with ws:// or wss://");
    }
    while (!rest.empty() && rest.back() == '/') rest.pop_back();
    const auto colon = rest.rfind(':');
    const bool has_port = colon != std::string::npos && rest.find(']', colon) == std::string::npos;
    address.host = has_port ? rest.substr(0, colon) : rest;
    address.port = has_port ? rest.substr(colon + 1) : (address.tls ? "443" : "80");
    if (address.host.size() > 2 && address.host.front() == '[') {
        address.host = address.host.substr(1, address.host.size() - 2);  // IPv6
    }
    const bool numeric = !address.port.empty() && address.port.size() <= 5 &&
                         address.port.find_first_not_of("0123456789") == std::string::npos;
    if (address.host.empty() || address.host.find('/') != std::string::npos || !numeric) {
        return fail(Errc::kInvalid, "bad_server",
                    "server \"" + url + "\" must be ws://HOST:PORT without a path");
    }
    return address;
}

Result<Fault> parse_fault(const std::string& text) {
    const auto bad = [&] {
        return fail(Errc::kInvalid, "bad_fault",
                    "fault \"" + text + "\" must be one of " + kFaultForms);
    };
    Fault fault;
    std::string what = text;
    if (const auto at = text.rfind('@'); at != std::string::npos) {
        what.resize(at);
        const auto [end, error] =
            std::from_chars(text.data() + at + 1, text.data() + text.size(), fault.after_s);
        if (error != std::errc{} || end != text.data() + text.size() || !(fault.after_s >= 0)) {
            return bad();
        }
    }
    constexpr std::string_view kDriving = "driving:";
    fault.driving = what.starts_with(kDriving);
    if (fault.driving) what.erase(0, kDriving.size());
    for (const auto& [name, kind] : {std::pair{"marker-lost", Fault::Kind::kMarkerLost},
                                     std::pair{"camera-dark", Fault::Kind::kDark},
                                     std::pair{"scanner-covered", Fault::Kind::kScannerCovered},
                                     std::pair{"look-out-covered", Fault::Kind::kLookOutCovered},
                                     std::pair{"way-free", Fault::Kind::kWayFree}}) {
        if (what != name) continue;
        fault.kind = kind;
        return fault;
    }
    const auto equals = what.find('=');
    if (equals == std::string::npos || equals + 1 == what.size()) return bad();
    const std::string kind = what.substr(0, equals);
    fault.part = what.substr(equals + 1);
    if (kind == "wheel") {
        fault.kind = Fault::Kind::kWheel;
    } else if (kind == "bearing") {
        fault.kind = Fault::Kind::kBearing;
    } else if (kind == "encoder") {
        fault.kind = Fault::Kind::kEncoder;
    } else if (kind == "transmitter-dark") {
        fault.kind = Fault::Kind::kTransmitterDark;
    } else if (kind == "obstacle") {
        fault.kind = Fault::Kind::kObstacle;
        const auto place = read_numbers(std::exchange(fault.part, {}), 2);
        if (place.empty()) return bad();
        fault.place = {place[0], place[1]};
    } else if (kind == "carried") {
        fault.kind = Fault::Kind::kCarried;
        const auto by = read_numbers(std::exchange(fault.part, {}), 3);
        if (by.empty()) return bad();
        fault.carried = {by[0], by[1], wrap(radians(by[2]))};
    } else if (kind == "pit") {
        fault.kind = Fault::Kind::kPit;
    } else if (kind == "slip" || kind == "bracket-off") {
        const bool slips = kind == "slip";
        fault.kind = slips ? Fault::Kind::kSlip : Fault::Kind::kBracketOff;
        const auto colon = fault.part.rfind(':');
        if (colon == std::string::npos || colon == 0) return bad();
        const auto number = read_numbers(fault.part.substr(colon + 1), 1);
        if (number.empty()) return bad();
        if (slips && !(number[0] > 0 && number[0] <= 1)) return bad();
        if (!slips && !(std::abs(number[0]) <= kMostOff_m)) return bad();
        (slips ? fault.share : fault.by_m) = number[0];
        fault.part.resize(colon);
    } else {
        return bad();
    }
    return fault;
}

Result<CameraSource> parse_camera(const std::string& text) {
    // A path may have both signs in it, and a camera's name has none.
    const auto equals = text.find('=');
    const auto colon = text.find(':', equals == std::string::npos ? 0 : equals);
    const std::string kind = colon == std::string::npos || equals == std::string::npos
                                 ? std::string()
                                 : text.substr(equals + 1, colon - equals - 1);
    const bool whole = (kind == "v4l2" || kind == "file") && equals > 0 && colon + 1 < text.size();
    if (!whole) {
        return fail(Errc::kInvalid, "bad_camera",
                    "--camera " + text + " must be NAME=v4l2:/dev/video0 or NAME=file:PATH");
    }
    return CameraSource{text.substr(0, equals),
                        kind == "v4l2" ? CameraSource::Kind::kV4l2 : CameraSource::Kind::kFile,
                        text.substr(colon + 1)};
}

Result<std::vector<Identity>> parse_vehicle_list(const std::string& text) {
    std::vector<Identity> list;
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number) {
        std::istringstream words(line);
        std::string name;
        std::string token;
        std::string more;
        if (!(words >> name) || name.front() == '#') continue;
        if (!(words >> token) || words >> more) {
            return fail(Errc::kInvalid, "bad_vehicle_list",
                        "line " + std::to_string(number) +
                            " of the vehicle list must be \"MANUFACTURER/SERIAL TOKEN\"");
        }
        auto identity = parse_identity(name);
        if (!identity) return fail(identity.error());
        identity->token = token;
        list.push_back(std::move(*identity));
    }
    if (list.empty()) {
        return fail(Errc::kInvalid, "empty_vehicle_list", "the vehicle list names no vehicle");
    }
    return list;
}

std::optional<Options> read_options(int argc, char** argv, int& exit_code) {
    CLI::App app{"The program on a vehicle: a simulated one that obeys a Pulseline server."};
    app.name("pulseline-agent");
    Options options;
    Raw raw;
    app.add_option("--server", raw.server, "ws://HOST:PORT or wss://HOST:PORT")->required();
    auto* vehicle = app.add_option("--vehicle", raw.vehicle, "MANUFACTURER/SERIAL");
    auto* list = app.add_option("--vehicles", raw.vehicle_list,
                                "file of lines \"MANUFACTURER/SERIAL TOKEN\"");
    vehicle->excludes(list);
    app.add_option("--token", raw.token, "the vehicle's token")->excludes(list);
    app.add_option("--token-file", raw.token_file, "file with the vehicle's token")->excludes(list);
    app.add_option("--count", raw.count, "only the first N vehicles of the list")
        ->check(CLI::Range(1, 10000));
    app.add_option("--world", options.world_file, "plant file of the simulated world")->required();
    app.add_option("--seed", options.seed, "of all simulated errors");
    app.add_option("--errors", options.errors,
                   "how well the simulated machines and floor are kept: nominal, kind, harsh")
        ->check(CLI::IsMember({"nominal", "kind", "harsh"}));
    app.add_option("--truth-log", options.truth_log, "file for the true poses (JSON lines)");
    app.add_option("--time-factor", options.time_factor, "speeds times it, accelerations squared")
        ->check(CLI::Range(1.0, 20.0));
    app.add_option("--sensing", raw.sensing, "rendered: real images; analytic: their error model")
        ->check(CLI::IsMember({"rendered", "analytic"}));
    app.add_option("--drive", raw.drive,
                   "servo: wheel by wheel (default with rendered sensing); statistical: a pose "
                   "with seeded errors, for many vehicles (default with analytic sensing)")
        ->check(CLI::IsMember({"servo", "statistical"}));
    app.add_option("--battery", options.battery_percent, "charge of every vehicle at start")
        ->check(CLI::Range(0.0, 100.0));
    app.add_option("--hand-held", options.hand_held,
                   "socket for a hand-held control beside the vehicle (Unix, JSON lines)");
    app.add_option("--machine", options.machine,
                   "tcp://HOST:PORT of the controller of the vehicle's machine, which is not "
                   "simulated here then")
        ->excludes(list);
    app.add_option("--machine-watchdog-s", options.machine_watchdog_s,
                   "how long its controller may hear nothing before it brakes, and be silent "
                   "before it counts as lost")
        ->check(CLI::Range(0.02, 5.0));
    app.add_option("--camera", raw.cameras,
                   "NAME=v4l2:/dev/video0, or NAME=file:PATH of an image that a camera's own "
                   "program keeps replacing: where the pictures of one of the vehicle's cameras "
                   "come from; those of the others its controller takes");
    app.add_option("--belief-log", options.belief_log,
                   "file for what a vehicle with --machine knows of itself (JSON lines)");
    app.add_option("--maps", options.maps,
                   "folder with maps of the halls (HALL.yaml, as `pulseline-agent map` makes "
                   "them), by which vehicles know from walls and things where they are");
    app.add_option("--learned", options.learned,
                   "folder in which vehicles keep what they learn of their small moves");
    app.add_flag("--insecure", options.insecure, "accept any TLS certificate");
    app.add_option("--ca", options.ca_file, "PEM file of the authority to trust");
    app.add_option("--fault", raw.faults, std::string("for tests: ") + kFaultForms);
    try {
        app.parse(argc, argv);
        if (raw.vehicle.empty() && raw.vehicle_list.empty()) {
            throw CLI::RequiredError("--vehicle or --vehicles");
        }
    } catch (const CLI::ParseError& error) {
        exit_code = app.exit(error) == 0 ? 0 : 2;
        return std::nullopt;
    }
    if (const auto status = complete(raw, options); !status) {
        std::fprintf(stderr, "pulseline-agent: %s\n", status.error().what.c_str());
        exit_code = 2;
        return std::nullopt;
    }
    return options;
}

}  // namespace pulseline::agent
