#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "tests/tools/load/figures.hpp"
#include "tests/tools/load/peer.hpp"

namespace pulseline::load {

/// A vehicle that stands and reports. The count of its states travels in its velocity, so that a
/// dashboard's frame tells which of them it shows.
struct Vehicle {
    static constexpr int kCounts = 10'000;  // velocities are shown to 0.1 mm/s

    std::string id, maker, serial, token, node, hall;
    double x_m = 0, y_m = 0;
    std::unique_ptr<Peer> peer;
    std::uint64_t sent = 0;
    std::vector<Clock::time_point> sent_at = std::vector<Clock::time_point>(kCounts);

    std::string header(std::string_view now) const {
        return fmt::format(
            R"("headerId":{},"timestamp":"{}","version":"2.1.0","manufacturer":"{}","serialNumber":"{}")",
            sent & 0xffffffff, now, maker, serial);
    }
    void connect(std::uint16_t port) {
        peer = std::make_unique<Peer>(port);
        peer->ask_upgrade(
            "/vehicles/" + maker + "/" + serial,
            "Sec-WebSocket-Protocol: vda5050.v2.json\r\nAuthorization: Bearer " + token + "\r\n");
    }
    void report(std::string_view now) {
        ++sent;
        const auto count = sent % kCounts;
        sent_at[count] = Clock::now();
        peer->send_text(fmt::format(
            R"({{"topic":"state","retain":false,"payload":{{{},"orderId":"","orderUpdateId":0,"lastNodeId":"{}","lastNodeSequenceId":0,)"
            R"("driving":false,"paused":false,"newBaseRequest":false,"distanceSinceLastNode":0.0,"operatingMode":"AUTOMATIC","nodeStates":[],"edgeStates":[],)"
            R"("actionStates":[],"batteryState":{{"batteryCharge":81.5,"charging":false}},"errors":[],)"
            R"("safetyState":{{"eStop":"NONE","fieldViolation":false}},)"
            R"("agvPosition":{{"x":{:.4f},"y":{:.4f},"theta":0.0,"mapId":"{}","positionInitialized":true,"localizationScore":0.97,"deviationRange":0.003}},)"
            R"("velocity":{{"vx":{:.4f},"vy":0.0,"omega":0.0}},"loads":[],"information":[]}}}})",
            header(now), node, x_m, y_m, hall, static_cast<double>(count) / kCounts));
    }
};

}  // namespace pulseline::load
