#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "api/vda5050/header.hpp"
#include "core/geometry/pose2.hpp"
#include "core/kinematics/wheels.hpp"

/// What hand-held controls say to a vehicle's program, and what it answers: one JSON object each,
/// as a line of the socket beside the vehicle, as a text frame of a page of the dashboard, and,
/// with a header and the control's name, as the topic `handHeld` of the vehicle link, which is no
/// part of VDA 5050.
///   {"do":"take"}  {"do":"drive","vx_mps":0.2,"vy_mps":0,"turn_radps":0}  {"do":"give_back"}
///   {"do":"where"}; each with an optional "sequence", which the answer has, too, and a drive with
///   "sent_ms" on the control's own clock.
/// {"sequence":3,"ok":true,"operating_mode":"MANUAL","standing":false,"person":"ann","mine":true,
///  "pose":{...}} or {"sequence":3,"ok":false,"reason":CODE,"params":{...},"why":...}
namespace pulseline::vda5050 {

struct HandCommand {
    enum class What { kTake, kDrive, kWhere, kGiveBack, kLeft };  // kLeft: on the link only
    What what = What::kWhere;
    kinematics::Twist twist;
    std::optional<double> sent_s;
    std::int64_t sequence = 0;
};
const char* to_string(HandCommand::What what);

struct HandAnswer {
    std::int64_t sequence = 0;
    std::optional<Error> refused;
    std::string operating_mode;
    bool standing = true;
    std::optional<std::string> person;  // who has it in hand; empty: somebody beside it
    bool mine = false;                  // the control that is answered has it
    std::optional<geometry::Pose2> pose;
};

/// The members of a command, of an object that may have others. `on_link`: as the server says it.
HandCommand read_hand_command(json::ObjectReader& in, bool on_link = false);
/// A command as one control of the dashboard says it; unknown members are refused.
[[nodiscard]] Result<HandCommand> decode_hand_command(std::string_view text);
Json hand_answer_json(const HandAnswer& answer);

/// The same on the link between the server and a vehicle.
struct HandFrame {
    std::string control;
    std::string person;
    HandCommand command;
};
std::string encode_hand_frame(const HandFrame& frame, const Header& header);
[[nodiscard]] Result<HandFrame> decode_hand_frame(const Json& payload);
struct HandAnswerFrame {
    std::string control;
    HandAnswer answer;
};
std::string encode_hand_answer(const HandAnswerFrame& frame, const Header& header);
[[nodiscard]] Result<HandAnswerFrame> decode_hand_answer(const Json& payload);

}  // namespace pulseline::vda5050
