#include "api/vda5050/hand_held.hpp"

#include <utility>

#include "api/vda5050/limits.hpp"

namespace pulseline::vda5050 {
namespace {

using What = HandCommand::What;

constexpr json::NumberLimits kHandVelocity{-10, 10};  // m/s, rad/s; the vehicle is far slower
constexpr json::NumberLimits kClock_ms{0, 1e12};
constexpr json::IntegerLimits kHandSequence{0, std::int64_t{1} << 52};
constexpr json::TextLimits kControlName{1, 200};
constexpr json::TextLimits kPersonName{0, 200};
constexpr json::TextLimits kReasonCode{1, 100};
constexpr std::size_t kMostReasonParams = 8;

Json params_json(const Params& params) {
    Json out = Json::object();
    for (const auto& [name, value] : params) {
        std::visit([&, &key = name](const auto& v) { out[key] = v; }, value);
    }
    return out;
}

Params read_params(const Json* params) {
    Params out;
    if (params == nullptr || !params->is_object()) return out;
    for (const auto& [name, value] : params->items()) {
        if (out.size() >= kMostReasonParams) break;
        if (value.is_boolean())
            out.push_back({name, value.get<bool>()});
        else if (value.is_number_integer())
            out.push_back({name, value.get<std::int64_t>()});
        else if (value.is_number())
            out.push_back({name, value.get<double>()});
        else if (value.is_string())
            out.push_back({name, value.get<std::string>()});
    }
    return out;
}

Json command_json(const HandCommand& command) {
    Json out = {{"do", to_string(command.what)}, {"sequence", command.sequence}};
    if (command.what != What::kDrive) return out;
    out["vx_mps"] = finite(command.twist.vx_mps);
    out["vy_mps"] = finite(command.twist.vy_mps);
    out["turn_radps"] = finite(command.twist.turn_radps);
    if (command.sent_s) out["sent_ms"] = finite(1e3 * *command.sent_s);
    return out;
}

HandAnswer read_answer(json::ObjectReader& in) {
    HandAnswer answer;
    answer.sequence = in.integer_or("sequence", 0, kHandSequence);
    if (!in.boolean("ok")) {
        Error error{Errc::kConflict,
                    {in.text("reason", kReasonCode), {}},
                    in.printable_or("why", "", 500),
                    {}};
        error.reason.params = read_params(in.find("params"));
        answer.refused = std::move(error);
    }
    answer.operating_mode = in.text_or("operating_mode", "", kPersonName);
    answer.standing = in.boolean_or("standing", false);
    if (in.has("person")) answer.person = in.text("person", kPersonName);
    answer.mine = in.boolean_or("mine", false);
    if (in.has("pose")) {
        auto pose = in.object("pose");
        answer.pose = geometry::Pose2{pose.number("x_m", limits::kPlace_m),
                                      pose.number("y_m", limits::kPlace_m),
                                      pose.number("heading_rad", limits::kAngle_rad)};
    }
    return answer;
}

}  // namespace

const char* to_string(What what) {
    switch (what) {
        case What::kTake:
            return "take";
        case What::kDrive:
            return "drive";
        case What::kWhere:
            return "where";
        case What::kGiveBack:
            return "give_back";
        case What::kLeft:
            return "left";
    }
    return "";
}

HandCommand read_hand_command(json::ObjectReader& in, bool on_link) {
    HandCommand command;
    command.what =
        on_link ? in.one_of("do",
                            {What::kTake, What::kDrive, What::kWhere, What::kGiveBack, What::kLeft})
                : in.one_of("do", {What::kTake, What::kDrive, What::kWhere, What::kGiveBack});
    command.sequence = in.integer_or("sequence", 0, kHandSequence);
    if (command.what != What::kDrive) return command;
    command.twist = {in.number_or("vx_mps", 0, kHandVelocity),
                     in.number_or("vy_mps", 0, kHandVelocity),
                     in.number_or("turn_radps", 0, kHandVelocity)};
    if (in.has("sent_ms")) command.sent_s = in.number("sent_ms", kClock_ms) / 1e3;
    return command;
}

Result<HandCommand> decode_hand_command(std::string_view text) {
    const auto parsed = json::parse_json(text);
    if (!parsed) return fail(parsed.error());
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    const HandCommand command = read_hand_command(in);
    in.refuse_unknown();
    if (auto status = errors.status(); !status) return fail(status.error());
    return command;
}

Json hand_answer_json(const HandAnswer& answer) {
    Json out = {{"sequence", answer.sequence}, {"ok", !answer.refused.has_value()}};
    if (const auto& refused = answer.refused) {
        out["reason"] = refused->reason.code;
        out["params"] = params_json(refused->reason.params);
        out["why"] = refused->what;
    }
    if (!answer.operating_mode.empty()) {
        out["operating_mode"] = answer.operating_mode;
        out["standing"] = answer.standing;
    }
    if (answer.person) out["person"] = *answer.person;
    if (answer.mine) out["mine"] = true;
    if (const auto& pose = answer.pose) {
        out["pose"] = {{"x_m", finite(pose->x_m)},
                       {"y_m", finite(pose->y_m)},
                       {"heading_rad", finite(pose->heading_rad)}};
    }
    return out;
}

std::string encode_hand_frame(const HandFrame& frame, const Header& header) {
    Json out = begin_message(header);
    out["control"] = frame.control;
    out["person"] = frame.person;
    out.update(command_json(frame.command));
    return print(out);
}

Result<HandFrame> decode_hand_frame(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    HandFrame frame;
    frame.control = in.text("control", kControlName);
    frame.person = in.text("person", kPersonName);
    frame.command = read_hand_command(in, true);
    if (auto status = errors.status(); !status) return fail(status.error());
    return frame;
}

std::string encode_hand_answer(const HandAnswerFrame& frame, const Header& header) {
    Json out = begin_message(header);
    out["control"] = frame.control;
    out.update(hand_answer_json(frame.answer));
    return print(out);
}

Result<HandAnswerFrame> decode_hand_answer(const Json& payload) {
    json::FieldErrors errors;
    json::ObjectReader in(payload, "", errors);
    HandAnswerFrame frame;
    frame.control = in.text("control", kControlName);
    frame.answer = read_answer(in);
    if (auto status = errors.status(); !status) return fail(status.error());
    return frame;
}

}  // namespace pulseline::vda5050
