#include "api/vda5050/information.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <map>
#include <utility>

#include "api/json/utf8.hpp"
#include "api/vda5050/limits.hpp"

namespace pulseline::vda5050 {
namespace {

std::string number_text(double value) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, finite(value)).ptr;
    return {text, end};
}

// Sixteen names of 64 bytes fit in, quoted.
constexpr std::size_t kValue = 2000;

using References = std::vector<std::pair<const char*, std::string>>;

Json entry(const char* type, const References& references) {
    Json list = Json::array();
    for (const auto& [key, value] : references) {
        list.push_back({{"referenceKey", key}, {"referenceValue", json::printable(value, kValue)}});
    }
    return {{"infoType", type}, {"infoLevel", "INFO"}, {"infoReferences", std::move(list)}};
}

Json encode_camera(const CameraReading& reading) {
    References references{{"camera", reading.camera}, {"found", reading.found ? "true" : "false"}};
    if (reading.found) {
        references.insert(references.end(), {{"payload", reading.payload},
                                             {"x_m", number_text(reading.code.x_m)},
                                             {"y_m", number_text(reading.code.y_m)},
                                             {"angle_rad", number_text(reading.angle_rad)},
                                             {"sigma_m", number_text(reading.sigma_m)},
                                             {"rms_px", number_text(reading.rms_px)}});
    } else {
        references.emplace_back("why_not", reading.why_not);
    }
    return entry("camera", references);
}

/// Names in one reference, whatever they contain.
std::string joined(const std::vector<std::string>& names) {
    return Json(names).dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// None where it is no list of names: it may mean something else.
std::vector<std::string> parted(const std::string& text) {
    std::vector<std::string> names;
    const auto parsed = json::parse_json(text);
    if (!parsed || !parsed->is_array()) return names;
    for (const Json& name : *parsed) {
        if (name.is_string()) names.push_back(name.get<std::string>());
    }
    return names;
}

Json encode_receiver(const ReceiverReading& reading) {
    References references{{"receiver", reading.receiver},
                          {"found", reading.found ? "true" : "false"},
                          {"transmitters", joined(reading.transmitters)}};
    if (reading.found) {
        references.insert(references.end(), {{"x_m", number_text(reading.place.x_m)},
                                             {"y_m", number_text(reading.place.y_m)},
                                             {"z_m", number_text(reading.z_m)},
                                             {"sigma_m", number_text(reading.sigma_m)}});
    } else {
        references.emplace_back("why_not", reading.why_not);
    }
    return entry("receiver", references);
}

Json encode_sight(const ReflectorSight& sight) {
    return entry("reflector", {{"x_m", number_text(sight.place.x_m)},
                               {"y_m", number_text(sight.place.y_m)},
                               {"sigma_m", number_text(sight.sigma_m)}});
}

Json encode_navigation(const NavigationStatus& status) {
    References references{{"by", status.by}, {"driven_m", number_text(status.driven_m)}};
    if (status.explained >= 0) references.emplace_back("explained", number_text(status.explained));
    if (!status.why_not.empty()) references.emplace_back("why_not", status.why_not);
    return entry("navigation", references);
}

Json encode_fix(const PoseFixReport& fix) {
    References references{{"by", fix.by},
                          {"result", fix.result},
                          {"moved_m", number_text(fix.moved_m)},
                          {"turned_rad", number_text(fix.turned_rad)},
                          {"times", std::to_string(fix.times)},
                          {"ago_s", number_text(fix.ago_s)}};
    if (!fix.what.empty()) references.emplace_back("what", fix.what);
    if (!fix.why.empty()) references.emplace_back("why", fix.why);
    return entry("poseFix", references);
}

/// References of one entry of ours. Asking for what is absent or no number spoils the entry: it is
/// then left out, since vehicles may use our type names for something else. A number that cannot be
/// true is an error of the message.
class Values {
public:
    struct Value {
        std::string text;
        std::string pointer;
    };
    Values(std::map<std::string, Value> values, json::FieldErrors& errors)
        : values_(std::move(values)), errors_(errors) {}

    std::string text(const char* key) {
        usable_ &= values_.count(key) != 0;
        return text_or_empty(key);
    }
    std::string text_or_empty(const char* key) const {
        const auto found = values_.find(key);
        return found == values_.end() ? std::string{} : found->second.text;
    }
    bool has(const char* key) const { return values_.count(key) != 0; }
    double number(const char* key, json::NumberLimits within) {
        const auto found = values_.find(key);
        if (found == values_.end()) {
            usable_ = false;
            return 0;
        }
        const auto& [text, pointer] = found->second;
        double read = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), read);
        const bool whole = end == text.data() + text.size();
        if (whole && error == std::errc::result_out_of_range) {
            read = std::numeric_limits<double>::infinity();  // 1e999; 1e-999 is no number either
        } else if (!whole || error != std::errc{}) {
            usable_ = false;
            return 0;
        }
        return json::read_number(read, pointer, errors_, within);
    }
    bool usable() const { return usable_; }

private:
    std::map<std::string, Value> values_;
    json::FieldErrors& errors_;
    bool usable_ = true;
};

CameraReading decode_camera(Values& in) {
    CameraReading reading;
    reading.camera = in.text("camera");
    reading.found = in.text("found") == "true";
    if (!reading.found) {
        reading.why_not = in.text_or_empty("why_not");
        return reading;
    }
    reading.payload = in.text("payload");
    reading.code = {in.number("x_m", limits::kOnVehicle_m), in.number("y_m", limits::kOnVehicle_m)};
    reading.angle_rad = in.number("angle_rad", limits::kAngle_rad);
    reading.sigma_m = in.number("sigma_m", limits::kSigma_m);
    reading.rms_px = in.number("rms_px", limits::kResidual_px);
    return reading;
}

ReceiverReading decode_receiver(Values& in) {
    ReceiverReading reading;
    reading.receiver = in.text("receiver");
    reading.found = in.text("found") == "true";
    reading.transmitters = parted(in.text_or_empty("transmitters"));
    if (!reading.found) {
        reading.why_not = in.text_or_empty("why_not");
        return reading;
    }
    reading.place = {in.number("x_m", limits::kPlace_m), in.number("y_m", limits::kPlace_m)};
    reading.z_m = in.number("z_m", limits::kPlace_m);
    reading.sigma_m = in.number("sigma_m", limits::kSigma_m);
    return reading;
}

bool is_known_source(const std::string& by) {
    constexpr std::array kSources{"person", "stop", "codes", "igps", "reflectors", "contours"};
    return std::ranges::find(kSources, by) != kSources.end();
}

NavigationStatus decode_navigation(Values& in) {
    NavigationStatus status;
    status.by = in.text("by");
    status.driven_m = in.number("driven_m", limits::kDeviation_m);
    if (in.has("explained")) status.explained = in.number("explained", limits::kShare);
    status.why_not = in.text_or_empty("why_not");
    return status;
}

PoseFixReport decode_fix(Values& in) {
    PoseFixReport fix;
    fix.by = in.text("by");
    fix.what = in.text_or_empty("what");
    fix.result = in.text("result");
    fix.why = in.text_or_empty("why");
    fix.moved_m = in.number("moved_m", limits::kDeviation_m);
    fix.turned_rad = in.number("turned_rad", limits::kAngle_rad);
    fix.times = static_cast<std::int64_t>(in.number("times", limits::kTimes));
    fix.ago_s = in.number("ago_s", limits::kAgo_s);
    return fix;
}

bool is_known_result(const std::string& result) {
    constexpr std::array kResults{"taken", "agreed", "refused", "begun_anew"};
    return std::ranges::find(kResults, result) != kResults.end();
}

template <class T>
void keep(std::vector<T>& list, T item, const Values& in) {
    if (in.usable()) list.push_back(std::move(item));
}

void decode_entry(const std::string& type, Values& in, StateMessage& state) {
    if (type == "bracketLoad") {
        BracketStatus bracket{in.text("name"), in.number("force_a_n", limits::kForce_n),
                              in.number("force_b_n", limits::kForce_n)};
        if (in.has("height_m")) bracket.height_m = in.number("height_m", limits::kOnVehicle_m);
        keep(state.brackets, std::move(bracket), in);
    } else if (type == "wheel") {
        WheelStatus wheel{in.text("name"), in.number("steering_rad", limits::kAngle_rad),
                          in.number("speed_mps", limits::kVelocity_mps),
                          in.number("temperature_c", limits::kTemperature_c),
                          in.text_or_empty("fault")};
        keep(state.wheels, std::move(wheel), in);
    } else if (type == "parkingFoot") {
        ParkingFoot foot{in.text("name"), in.number("extension_m", limits::kOnVehicle_m)};
        if (in.has("force_n")) foot.force_n = in.number("force_n", limits::kForce_n);
        keep(state.parking_feet, std::move(foot), in);
    } else if (type == "camera") {
        keep(state.cameras, decode_camera(in), in);
    } else if (type == "receiver") {
        keep(state.receivers, decode_receiver(in), in);
    } else if (type == "reflector") {
        ReflectorSight sight{
            {in.number("x_m", limits::kOnVehicle_m), in.number("y_m", limits::kOnVehicle_m)},
            in.number("sigma_m", limits::kSight_m)};
        if (state.reflectors.size() < kMostReflectorSights) keep(state.reflectors, sight, in);
    } else if (type == "navigation") {
        auto status = decode_navigation(in);
        if (in.usable() && is_known_source(status.by)) state.navigation = std::move(status);
    } else if (type == "poseFix") {
        auto fix = decode_fix(in);
        const bool ours = is_known_source(fix.by) && is_known_result(fix.result);
        if (ours && state.fixes.size() < kMostPoseFixes) keep(state.fixes, std::move(fix), in);
    } else if (type == "handHeld") {
        auto person = in.text("person");
        if (in.usable()) state.in_hand_of = std::move(person);
    } else if (type == "load") {
        const double load_kg = in.number("load_kg", limits::kLoad_kg);
        if (in.usable()) state.load_kg = load_kg;
    }
}

}  // namespace

Json encode_information(const StateMessage& state) {
    Json list = Json::array();
    for (const auto& bracket : state.brackets) {
        References references{{"name", bracket.name},
                              {"force_a_n", number_text(bracket.force_a_n)},
                              {"force_b_n", number_text(bracket.force_b_n)}};
        if (bracket.height_m) references.emplace_back("height_m", number_text(*bracket.height_m));
        list.push_back(entry("bracketLoad", references));
    }
    for (const auto& wheel : state.wheels) {
        References references{{"name", wheel.name},
                              {"steering_rad", number_text(wheel.steering_rad)},
                              {"speed_mps", number_text(wheel.speed_mps)},
                              {"temperature_c", number_text(wheel.temperature_c)}};
        if (!wheel.fault.empty()) references.emplace_back("fault", wheel.fault);
        list.push_back(entry("wheel", references));
    }
    for (const auto& reading : state.cameras) list.push_back(encode_camera(reading));
    for (const auto& reading : state.receivers) list.push_back(encode_receiver(reading));
    for (const auto& sight : state.reflectors) list.push_back(encode_sight(sight));
    if (!state.navigation.by.empty()) list.push_back(encode_navigation(state.navigation));
    for (const auto& fix : state.fixes) list.push_back(encode_fix(fix));
    for (const auto& foot : state.parking_feet) {
        References references{{"name", foot.name}, {"extension_m", number_text(foot.extension_m)}};
        if (foot.force_n) references.emplace_back("force_n", number_text(*foot.force_n));
        list.push_back(entry("parkingFoot", references));
    }
    if (state.in_hand_of) list.push_back(entry("handHeld", {{"person", *state.in_hand_of}}));
    list.push_back(entry("load", {{"load_kg", number_text(state.load_kg)}}));
    return list;
}

void decode_information(json::ObjectReader& message, StateMessage& state) {
    json::FieldErrors& errors = message.errors();
    message.items_if_any("information", {0, 500}, [&](const Json& item, const std::string& at) {
        json::ObjectReader in(item, at, errors);
        const std::string type = in.printable("infoType", 200);
        in.printable("infoLevel", 64);
        std::map<std::string, Values::Value> values;
        in.items_if_any("infoReferences", {0, 100}, [&](const Json& ref, const std::string& where) {
            json::ObjectReader reference(ref, where, errors);
            const std::string key = reference.printable("referenceKey", 200);
            values[key] = {reference.printable("referenceValue", kValue),
                           where + "/referenceValue"};
        });
        Values read(std::move(values), errors);
        decode_entry(type, read, state);
    });
}

}  // namespace pulseline::vda5050
