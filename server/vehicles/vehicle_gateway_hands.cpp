#include "api/vda5050/frame.hpp"
#include "server/vehicles/vehicle_gateway.hpp"

/// What passes between hand-held controls and the vehicles.
namespace pulseline::server {
namespace {

vda5050::HandAnswer not_connected() {
    vda5050::HandAnswer answer;
    answer.refused = Error{Errc::kUnavailable,
                           {"vehicle_not_connected", {}},
                           "The vehicle is not connected; whatever it did, it brakes.",
                           {}};
    return answer;
}

}  // namespace

bool VehicleGateway::hand_held_opened(const plant::VehicleId& id, const std::string& control,
                                      const std::string& person, HandHeldPage& page) {
    auto& hands = hands_[id];
    if (hands.size() >= kMostControls) return false;
    hands.insert_or_assign(control, HandHeld{person, &page});
    log::info("hand_held.open", {{"vehicle", id.str()}, {"control", control}, {"person", person}});
    return true;
}

void VehicleGateway::hand_held(const plant::VehicleId& id, const std::string& control,
                               const vda5050::HandCommand& command) {
    auto& hands = hands_[id];
    const auto found = hands.find(control);
    if (found == hands.end()) return;
    const auto row = rows_.find(id);
    if (row == rows_.end() || !row->second.socket) {
        auto answer = not_connected();
        answer.sequence = command.sequence;
        return found->second.page->answer(answer);
    }
    ++ports_.metrics.vehicle_messages_out;
    const auto header = next_header(id, row->second, vda5050::Topic::kHandHeld);
    const auto socket = row->second.socket;  // close() inside send() must not end it under us
    socket->send(vda5050::encode_frame(
        vda5050::Topic::kHandHeld, false,
        vda5050::encode_hand_frame({control, found->second.person, command}, header)));
}

void VehicleGateway::hand_held_closed(const plant::VehicleId& id, const std::string& control) {
    hand_held(id, control, {vda5050::HandCommand::What::kLeft, {}, {}, 0});
    if (hands_[id].erase(control) == 0) return;
    log::info("hand_held.closed", {{"vehicle", id.str()}, {"control", control}});
}

void VehicleGateway::tell_not_connected(const plant::VehicleId& id) const {
    const auto hands = hands_.find(id);
    if (hands == hands_.end()) return;
    for (const auto& [control, hand] : hands->second) hand.page->answer(not_connected());
}

void VehicleGateway::pass_hand_answer(const plant::VehicleId& id,
                                      const vda5050::HandAnswerFrame& frame) const {
    const auto hands = hands_.find(id);
    if (hands == hands_.end()) return;
    const auto found = hands->second.find(frame.control);
    if (found != hands->second.end()) found->second.page->answer(frame.answer);
}

}  // namespace pulseline::server
