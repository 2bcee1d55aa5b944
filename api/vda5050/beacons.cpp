#include "api/vda5050/beacons.hpp"

#include "api/vda5050/header.hpp"
#include "api/vda5050/limits.hpp"

namespace pulseline::vda5050 {
namespace {

constexpr json::CountLimits kTransmitters{0, 64};
constexpr json::CountLimits kReflectors{0, 200};
constexpr json::NumberLimits kLean{-1e3, 1e3};
constexpr json::NumberLimits kRate_hz{0.1, 1e4};

Json sheet_json(const plant::LightPlane& sheet) {
    return {{"a", finite(sheet.a)}, {"b", finite(sheet.b)}, {"offset_m", finite(sheet.offset_m)}};
}

plant::LightPlane read_sheet(json::ObjectReader in) {
    return {in.number("a", kLean), in.number("b", kLean), in.number("offset_m", limits::kPlace_m)};
}

}  // namespace

Json transmitters_json(const std::vector<plant::Transmitter>& transmitters) {
    Json list = Json::array();
    for (const auto& t : transmitters) {
        list.push_back({{"id", t.id.str()},
                        {"mapId", t.hall.str()},
                        {"x_m", finite(t.position.x_m)},
                        {"y_m", finite(t.position.y_m)},
                        {"z_m", finite(t.z_m)},
                        {"roll_rad", finite(t.roll_rad)},
                        {"pitch_rad", finite(t.pitch_rad)},
                        {"heading_rad", finite(t.heading_rad)},
                        {"rate_hz", finite(t.rate_hz)},
                        {"first", sheet_json(t.first)},
                        {"second", sheet_json(t.second)},
                        {"range_m", finite(t.range_m)},
                        {"elevation_rad", finite(t.elevation_rad)},
                        {"sigma_rad", finite(t.sigma_rad)},
                        {"sigma_place_m", finite(t.sigma_place_m)},
                        {"sigma_turn_rad", finite(t.sigma_turn_rad)}});
    }
    return list;
}

std::vector<plant::Transmitter> read_transmitters(json::ObjectReader& in) {
    std::vector<plant::Transmitter> transmitters;
    in.items("transmitters", kTransmitters, [&](const Json& item, const std::string& pointer) {
        json::ObjectReader read(item, pointer, in.errors());
        plant::Transmitter t;
        t.id = plant::TransmitterId(read.text("id", {1, 200}));
        t.hall = plant::HallId(read.text("mapId", {1, 200}));
        t.position = {read.number("x_m", limits::kPlace_m), read.number("y_m", limits::kPlace_m)};
        t.z_m = read.number("z_m", limits::kPlace_m);
        t.roll_rad = read.number("roll_rad", limits::kAngle_rad);
        t.pitch_rad = read.number("pitch_rad", limits::kAngle_rad);
        t.heading_rad = read.number("heading_rad", limits::kAngle_rad);
        t.rate_hz = read.number("rate_hz", kRate_hz);
        t.first = read_sheet(read.object("first"));
        t.second = read_sheet(read.object("second"));
        t.range_m = read.number("range_m", limits::kDeviation_m);
        t.elevation_rad = read.number("elevation_rad", limits::kAngle_rad);
        t.sigma_rad = read.number("sigma_rad", limits::kSigma_rad);
        t.sigma_place_m = read.number("sigma_place_m", limits::kSigma_m);
        t.sigma_turn_rad = read.number("sigma_turn_rad", limits::kSigma_rad);
        transmitters.push_back(std::move(t));
    });
    return transmitters;
}

Json reflectors_json(const std::vector<plant::Reflector>& reflectors) {
    Json list = Json::array();
    for (const auto& r : reflectors) {
        list.push_back({{"id", r.id.str()},
                        {"mapId", r.hall.str()},
                        {"x_m", finite(r.position.x_m)},
                        {"y_m", finite(r.position.y_m)},
                        {"sigma_m", finite(r.sigma_m)}});
    }
    return list;
}

std::vector<plant::Reflector> read_reflectors(json::ObjectReader& in) {
    std::vector<plant::Reflector> reflectors;
    in.items("reflectors", kReflectors, [&](const Json& item, const std::string& pointer) {
        json::ObjectReader read(item, pointer, in.errors());
        plant::Reflector r;
        r.id = plant::ReflectorId(read.text("id", {1, 200}));
        r.hall = plant::HallId(read.text("mapId", {1, 200}));
        r.position = {read.number("x_m", limits::kPlace_m), read.number("y_m", limits::kPlace_m)};
        r.sigma_m = read.number("sigma_m", limits::kSigma_m);
        reflectors.push_back(std::move(r));
    });
    return reflectors;
}

}  // namespace pulseline::vda5050
