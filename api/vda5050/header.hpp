#pragma once

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "api/json/object_reader.hpp"
#include "core/base/time.hpp"

/// VDA 5050 2.1 as JSON. Outbound strictly as the official schemas ask; inbound liberally: unknown
/// fields are ignored, a missing or wrong one is an error that names it.
namespace pulseline::vda5050 {

using json::Json;

enum class Topic {
    kOrder,
    kInstantActions,
    kState,
    kVisualization,
    kConnection,
    kFactsheet,
    kHandHeld,  // ours, both ways: hand_held.hpp
};
inline constexpr std::size_t kTopics = 7;
const char* to_string(Topic topic);  // "order", the last level of the MQTT topic

inline constexpr const char* kVersion = "2.1.0";

/// The fields every message begins with.
struct Header {
    std::int64_t header_id = 0;
    std::string timestamp;
    std::string manufacturer;
    std::string serial_number;
};

/// Numbers the messages of one sender to one vehicle, apart for each topic.
class HeaderSource {
public:
    HeaderSource(std::string manufacturer, std::string serial_number)
        : manufacturer_(std::move(manufacturer)), serial_number_(std::move(serial_number)) {}
    Header next(Topic topic, Time now);

private:
    std::string manufacturer_;
    std::string serial_number_;
    std::array<std::int64_t, kTopics> sent_{};
};

/// "2026-01-31T12:00:00.123Z"
std::string timestamp(Time time);

Json begin_message(const Header& header);
/// Whose message a payload is; also refuses other major versions than 2.
[[nodiscard]] Result<Header> decode_header(const Json& payload);

// Building blocks of the codecs.
std::string print(const Json& message);

/// A message of ours has a number that is none. That is our own bug, but one message's: whoever
/// sends messages leaves this one out, says so and goes on.
class NotFinite : public std::runtime_error {
public:
    NotFinite() : std::runtime_error("a number of the message is infinite or undefined") {}
};
/// The number itself. Throws NotFinite.
double finite(double value);

}  // namespace pulseline::vda5050
