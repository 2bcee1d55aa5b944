#include "api/http/stops/light_handlers.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "api/http/wire/body.hpp"
#include "api/http/wire/common_json.hpp"
#include "api/http/wire/problem.hpp"
#include "core/localisation/receiver_fix.hpp"

namespace pulseline::api {
namespace {

using json::ObjectReader;
using localisation::LightPulses;

constexpr json::CountLimits kReceivers{1, 256};
constexpr json::CountLimits kTurns{1, 64};
// A day; of larger numbers a double has no digits left for the angles of a turn.
constexpr json::NumberLimits kClock_s{-1e5, 1e5};

struct ReceiverTurns {
    std::string receiver;
    std::vector<LightPulses> turns;
};

struct LightQuestion {
    plant::HallId hall;
    std::vector<ReceiverTurns> receivers;
};

LightPulses read_turn(ObjectReader& in) {
    LightPulses pulses;
    pulses.transmitter = plant::TransmitterId(in.text("transmitter", kName));
    pulses.zero_s = in.number("zero_s", kClock_s);
    pulses.next_zero_s = in.number("next_zero_s", kClock_s);
    pulses.first_s = in.number("first_s", kClock_s);
    pulses.second_s = in.number("second_s", kClock_s);
    in.refuse_unknown();
    return pulses;
}

Result<LightQuestion> read_question(const Request& request) {
    return read_object<LightQuestion>(request, [](ObjectReader& in) {
        LightQuestion question;
        question.hall = plant::HallId(in.text("hall", kName));
        in.items("receivers", kReceivers, [&](const Json& item, const std::string& pointer) {
            ObjectReader receiver(item, pointer, in.errors());
            ReceiverTurns& added = question.receivers.emplace_back();
            added.receiver = receiver.text("receiver", kName);
            receiver.items("turns", kTurns, [&](const Json& turn, const std::string& at) {
                ObjectReader read(turn, at, in.errors());
                added.turns.push_back(read_turn(read));
            });
            receiver.refuse_unknown();
        });
        return question;
    });
}

Result<std::vector<plant::Transmitter>> transmitters_of(const plant::Plant& plant,
                                                        const plant::HallId& hall) {
    if (plant::find_hall(plant, hall) == nullptr) {
        return fail(Errc::kNotFound, "unknown_hall",
                    "There is no hall \"" + hall.str() + "\"; name one of the plant's.", "/hall",
                    {{"hall", hall.str()}});
    }
    std::vector<plant::Transmitter> found;
    for (const auto& transmitter : plant.transmitters) {
        if (transmitter.hall == hall) found.push_back(transmitter);
    }
    if (found.empty()) {
        return fail(Errc::kNotFound, "no_transmitters",
                    "Hall \"" + hall.str() +
                        "\" has no transmitters of iGPS; put them into the plant file.",
                    "/hall", {{"hall", hall.str()}});
    }
    return found;
}

/// What each turn tells, or the first that tells nothing.
Result<std::vector<localisation::LightAngles>> angles_of(
    const ReceiverTurns& receiver, const std::string& pointer,
    const std::vector<plant::Transmitter>& transmitters) {
    std::vector<localisation::LightAngles> light;
    for (std::size_t i = 0; i < receiver.turns.size(); ++i) {
        const LightPulses& turn = receiver.turns[i];
        const std::string at = pointer + "/turns/" + std::to_string(i);
        const bool twice =
            std::ranges::find(light, turn.transmitter, &localisation::LightAngles::transmitter) !=
            light.end();
        if (twice) {
            return fail(Errc::kInvalid, "twice",
                        "Send one turn of each transmitter, the newest; \"" +
                            turn.transmitter.str() + "\" is there twice.",
                        at + "/transmitter", {{"transmitter", turn.transmitter.str()}});
        }
        if (std::ranges::find(transmitters, turn.transmitter, &plant::Transmitter::id) ==
            transmitters.end()) {
            return fail(Errc::kNotFound, "unknown_transmitter",
                        "The hall has no transmitter \"" + turn.transmitter.str() + "\".",
                        at + "/transmitter", {{"transmitter", turn.transmitter.str()}});
        }
        auto angles = localisation::feature_angles(turn);
        if (!angles) {
            return fail(Errc::kInvalid, angles.error().reason.code, angles.error().what, at,
                        angles.error().reason.params);
        }
        light.push_back(std::move(*angles));
    }
    return light;
}

Json space_json(double x_m, double y_m, double z_m) {
    return {{"x_m", x_m}, {"y_m", y_m}, {"z_m", z_m}};
}

Json measurement_json(const std::string& receiver,
                      const std::vector<localisation::LightAngles>& light,
                      const std::vector<plant::Transmitter>& transmitters) {
    const auto fix = localisation::locate_receiver(light, transmitters);
    Json json{{"receiver", receiver}, {"found", fix.has_value()}};
    if (!fix) {
        json["reason"] = reason_json(fix.error().reason);
        return json;
    }
    const auto sigma_m = [&](int axis) { return std::sqrt(fix->covariance(axis, axis)); };
    json["place"] = space_json(fix->position.x(), fix->position.y(), fix->position.z());
    json["sigma"] = space_json(sigma_m(0), sigma_m(1), sigma_m(2));
    json["transmitters"] = Json::array();
    for (const auto& angles : light) {
        if (angles.transmitter != fix->refused) {
            json["transmitters"].push_back(angles.transmitter.str());
        }
    }
    if (fix->refused) json["refused"] = fix->refused->str();
    return json;
}

}  // namespace

Response measure_by_light(const HistoryContext& context, const Request& request) {
    const auto question = read_question(request);
    if (!question) return problem(400, question.error(), request);
    const auto transmitters = transmitters_of(context.plant, question->hall);
    if (!transmitters) return problem(422, transmitters.error(), request);
    Json measurements = Json::array();
    for (std::size_t i = 0; i < question->receivers.size(); ++i) {
        const ReceiverTurns& receiver = question->receivers[i];
        const auto light = angles_of(receiver, "/receivers/" + std::to_string(i), *transmitters);
        if (!light) return problem(422, light.error(), request);
        measurements.push_back(measurement_json(receiver.receiver, *light, *transmitters));
    }
    return json_response(200, {{"measurements", std::move(measurements)}});
}

}  // namespace pulseline::api
