#include <utility>

#include "api/vda5050/connection.hpp"
#include "api/vda5050/factsheet.hpp"
#include "api/vda5050/frame.hpp"
#include "api/vda5050/instant_actions.hpp"
#include "api/vda5050/order.hpp"
#include "api/vda5050/state.hpp"
#include "api/vda5050/visualization.hpp"
#include "core/onboard/foot_faults.hpp"
#include "server/agent/utc.hpp"
#include "server/agent/vehicle.hpp"
#include "server/base/log.hpp"

/// What a vehicle says to its server, and hears from it.
namespace pulseline::agent {

using vda5050::Topic;

namespace {

// What deviationRange covers, both axes together as in Li 2022, Table 1: of three sigma of one axis
// one place in a hundred lies outside.
constexpr double kRangeSigmas = 3;

}  // namespace

vda5050::StateMessage Vehicle::state() {
    vda5050::StateMessage state;
    executor_.write_state(state);
    if (executor_.in_hand()) state.in_hand_of = hands_.holder()->person;
    machine_.write_state(state);
    if (!handling_.busy()) {
        for (auto& fault : onboard::foot_faults(type_, state.parking_feet)) {
            state.errors.push_back(std::move(fault));
        }
    }
    if (look_out_ && !executor_.in_hand()) {
        look_out_->write_state(state);
        going_round_->write_state(state);
    }
    if (const std::string& code = watch_.refused(); !code.empty()) {
        state.errors.push_back({"codeRefused",
                                false,
                                "Code " + code + " does not lie where the survey says.",
                                {{"marker", code}}});
    }
    if (const std::string& code = watch_.mistimed(); !code.empty()) {
        state.errors.push_back({"codeMistimed",
                                false,
                                "The picture of code " + code +
                                    " is stamped in the future or too long ago: a clock is wrong.",
                                {{"marker", code}}});
    }
    watch_.segments().write_state(state);
    write_codes(state);
    if (light_) write_light(state);
    if (reflectors_) write_reflectors(state);
    if (executor_.position_initialized()) write_navigation(state.navigation);
    write_advice(state);
    state.fixes = estimate_.fixes().newest();
    state.cameras = cameras_.readings();
    const auto covariance = estimate_.covariance();
    // The pose said is what the drive steers by, which is led slowly to where it is known to be.
    const double to_lead_m =
        guard_ ? guard_->to_lead_m(estimate_) : norm(estimate_.to_lead().position());
    state.deviation_range_m =
        kRangeSigmas * std::sqrt(covariance(0, 0) + covariance(1, 1)) + to_lead_m;
    state.localization_score = estimate_.score();
    return state;
}

void Vehicle::write_navigation(vda5050::NavigationStatus& status) const {
    status.by = onboard::to_string(estimate_.source());
    status.driven_m = estimate_.driven_since_m();
    if (!contours_) return;
    if (const auto& explained = contours_->explained()) status.explained = *explained;
    if (const auto& why_not = contours_->why_not()) status.why_not = why_not->reason.code;
}

/// That it knows too little where it is, or has known it for a moment only, and which sense leaves
/// it alone.
void Vehicle::write_advice(vda5050::StateMessage& state) const {
    const bool waits = executor_.waits_to_begin();
    if (waits && advice_ != onboard::PoseGuard::Advice::kLookAround) {
        state.errors.push_back({"poseTaken",
                                false,
                                "The vehicle knows a better place since a moment ago. It drives as "
                                "soon as it steers by that, in some seconds.",
                                {}});
    }
    const bool stays = drive_.idle() && !waits;
    if (stays || advice_ == onboard::PoseGuard::Advice::kDrive) return;
    using Lacks = onboard::ContourWatch::Lacks;
    const Lacks lacks = contours_ ? contours_->lacks() : Lacks::kNothing;
    if (lacks == Lacks::kThingsNear) {
        state.errors.push_back({"contoursNoneNear",
                                false,
                                "The scanners see nothing near by which the vehicle finds itself "
                                "in its map.",
                                {}});
    } else if (lacks == Lacks::kFeatures) {
        state.errors.push_back({"contoursFeatureless",
                                false,
                                "The scanners see walls that look alike all along, which do not "
                                "tell where along them the vehicle is.",
                                {}});
    }
    if (advice_ == onboard::PoseGuard::Advice::kDriveSlowly) {
        state.errors.push_back({"poseVague",
                                false,
                                "The vehicle knows less where it is and drives slowly until "
                                "something tells it.",
                                {}});
    } else if (advice_ == onboard::PoseGuard::Advice::kLookAround) {
        state.errors.push_back({"poseSought",
                                false,
                                "The vehicle knows too little where it is to drive. It stands and "
                                "looks for something that tells it.",
                                {}});
    }
}

/// It drives slowly, looks around or asks: each sense that tells nothing is named then.
bool Vehicle::lacks_pose() const {
    return lost_ || (!drive_.idle() && advice_ != onboard::PoseGuard::Advice::kDrive);
}

void Vehicle::write_codes(vda5050::StateMessage& state) const {
    if (type_.cameras.empty() || !lacks_pose()) return;
    if (std::ranges::any_of(cameras_.readings(), &vda5050::CameraReading::found)) return;
    state.errors.push_back({"codesNoneInView", false, "No camera sees a code.", {}});
}

void Vehicle::write_light(vda5050::StateMessage& state) const {
    state.receivers = light_->readings();
    // Who has cameras, too, is not lost without light alone.
    const bool misses_it = type_.cameras.empty() || lacks_pose();
    if (const auto& why_not = light_->why_not(); why_not && misses_it) {
        state.errors.push_back(
            {"lightLost", false, why_not->what, {{"why", why_not->reason.code}}});
    }
    if (!light_->newest()) return;
    for (const auto& out : light_->newest()->left_out) {
        state.errors.push_back({"lightRefused",
                                false,
                                out.name + " is left out: " + out.code + ".",
                                {{"part", out.name}, {"why", out.code}}});
    }
}

void Vehicle::write_reflectors(vda5050::StateMessage& state) const {
    state.reflectors = reflectors_->sights();
    const auto& why_not = reflectors_->why_not();
    if (why_not && ((type_.cameras.empty() && !light_) || lacks_pose())) {
        state.errors.push_back(
            {"reflectorsLost", false, why_not->what, {{"why", why_not->reason.code}}});
    } else if (lost_) {
        // Which of them it sees, only who knows where he is can tell.
        state.errors.push_back({"reflectorsLost",
                                false,
                                "The scanner sees " + std::to_string(state.reflectors.size()) +
                                    " reflectors, and they do not tell where the vehicle is.",
                                {}});
    }
    if (!reflectors_->newest()) return;
    for (const auto& out : reflectors_->newest()->left_out) {
        state.errors.push_back({"reflectorRefused",
                                false,
                                "Reflector " + out.name + " does not stand where the survey says.",
                                {{"part", out.name}, {"why", out.code}}});
    }
}

template <class Put>
void Vehicle::put_whole(Put put) {
    try {
        put();
    } catch (const vda5050::NotFinite& broken) {
        server::log::error("message.left_out",
                           {{"vehicle", vehicle_.id.str()}, {"what", broken.what()}});
    }
}

void Vehicle::send_state(Steady::time_point now) {
    last_state_ = now;
    state_due_ = false;
    put_whole([&] {
        outbox_.put_state(vda5050::encode_frame(
            Topic::kState, false,
            vda5050::encode_state(state(), headers_.next(Topic::kState, utc_now()))));
    });
}

void Vehicle::send_visualization() {
    const vda5050::VisualizationMessage message{drive_.believed_pose(), true, drive_.velocity_mps(),
                                                drive_.turn_rate_radps()};
    vda5050::StateMessage map;
    executor_.write_state(map);
    put_whole([&] {
        outbox_.put_visualization(vda5050::encode_frame(
            Topic::kVisualization, false,
            vda5050::encode_visualization(message, map.map_id,
                                          headers_.next(Topic::kVisualization, utc_now()))));
    });
}

void Vehicle::send_pictures(Steady::time_point now) {
    pictures_due_ = false;
    last_pictures_ = now;
    for (const auto& picture : cameras_.pictures()) {
        auto frame = vda5050::encode_camera_frame(
            {picture.camera, vda5050::timestamp(utc_now()), "image/jpeg", picture.jpeg});
        if (frame) outbox_.put_picture(picture.camera, std::move(*frame));
    }
}

void Vehicle::send_factsheet() {
    if (!linked_) return;
    vda5050::FactsheetSource source;
    source.type = &type_;
    source.has_map = contours_.has_value();
    source.time_factor = drive_.time_factor();
    source.node_actions = onboard::stop_action_types();
    const auto& acts = handling_.action_types();
    source.node_actions.insert(source.node_actions.end(), acts.begin(), acts.end());
    source.edge_actions = onboard::edge_action_types();
    source.instant_actions = onboard::instant_action_types(type_);
    put_whole([&] {
        outbox_.put_event(vda5050::encode_frame(
            Topic::kFactsheet, true,
            vda5050::encode_factsheet(source, headers_.next(Topic::kFactsheet, utc_now()))));
    });
}

void Vehicle::link_up() {
    outbox_.clear();
    linked_ = true;
    outbox_.put_event(vda5050::encode_frame(
        Topic::kConnection, true,
        vda5050::encode_connection(vda5050::ConnectionState::kOnline,
                                   headers_.next(Topic::kConnection, utc_now()))));
    send_factsheet();
    state_due_ = true;
    last_state_ = {};
    last_look_ = {};
    last_pictures_ = {};
}

void Vehicle::link_down() {
    // It drives on to the end of its base; what it has to say waits for the next link.
    executor_.lose_link();
    linked_ = false;
    outbox_.clear();
}

std::string Vehicle::offline_frame() {
    return vda5050::encode_frame(
        Topic::kConnection, true,
        vda5050::encode_connection(vda5050::ConnectionState::kOffline,
                                   headers_.next(Topic::kConnection, utc_now())));
}

void Vehicle::report(const Error& error, const char* topic) {
    server::log::warn("message.refused", {{"vehicle", vehicle_.id.str()},
                                          {"topic", topic},
                                          {"what", error.what},
                                          {"field", error.field}});
    vda5050::VehicleError out;
    out.type = "validationError";
    out.description = error.what;
    out.references = {{"topic", topic}, {"field", error.field}};
    executor_.report(std::move(out));
}

void Vehicle::receive(std::string_view text) {
    const auto frame = vda5050::decode_frame(text);
    if (!frame) return report(frame.error(), "unknown");
    const char* topic = to_string(frame->topic);
    const auto header = vda5050::decode_header(frame->payload);
    if (!header) return report(header.error(), topic);
    if (header->manufacturer != vehicle_.manufacturer ||
        header->serial_number != vehicle_.serial_number) {
        return report({Errc::kInvalid,
                       {"wrong_identity", {}},
                       "the message is for another vehicle",
                       "/serialNumber"},
                      topic);
    }
    if (frame->topic == Topic::kOrder) {
        const auto order = vda5050::decode_order(frame->payload);
        if (!order) {
            // The order is named, so that the sender sees this as its rejection.
            vda5050::OrderMessage named;
            const auto& payload = frame->payload;
            if (payload.contains("orderId") && payload["orderId"].is_string()) {
                named.order_id = payload["orderId"].get<std::string>();
            }
            if (payload.contains("orderUpdateId") && payload["orderUpdateId"].is_number_integer()) {
                named.order_update_id = payload["orderUpdateId"].get<std::int64_t>();
            }
            auto error = onboard::order_error("validationError", order.error().what, named);
            error.references.emplace_back("field", order.error().field);
            return executor_.report(std::move(error));
        }
        server::log::info("order.here", {{"vehicle", vehicle_.id.str()},
                                         {"order", order->order_id},
                                         {"update", std::to_string(order->order_update_id)}});
        return executor_.handle(*order);
    }
    if (frame->topic == Topic::kInstantActions) {
        const auto actions = vda5050::decode_instant_actions(frame->payload);
        if (!actions) return report(actions.error(), topic);
        executor_.handle(*actions);
        if (const auto told = executor_.take_told()) {
            estimate_.start_at(
                told->pose, told->sigma_xy_m, told->sigma_heading_rad,
                told->worked_out ? onboard::PoseSource::kStop : onboard::PoseSource::kPerson);
        }
        return;
    }
    if (frame->topic == Topic::kHandHeld) {
        const auto said = vda5050::decode_hand_frame(frame->payload);
        if (!said) return report(said.error(), topic);
        const auto answer = hand_held({said->control, said->person}, said->command, Steady::now());
        put_whole([&] {
            outbox_.put_event(vda5050::encode_frame(
                Topic::kHandHeld, false,
                vda5050::encode_hand_answer({said->control, answer},
                                            headers_.next(Topic::kHandHeld, utc_now()))));
        });
        return;
    }
    report({Errc::kInvalid,
            {"wrong_topic", {}},
            "a vehicle hears order, instantActions and handHeld only",
            "/topic"},
           topic);
}

vda5050::HandAnswer Vehicle::hand_held(const onboard::HandControl& control,
                                       const vda5050::HandCommand& command,
                                       Steady::time_point now) {
    using What = vda5050::HandCommand::What;
    const double now_s = std::chrono::duration<double>(now.time_since_epoch()).count();
    Status done;
    hands_.heard(control.id, now_s);
    switch (command.what) {
        case What::kTake:
            done = hands_.take(control, now_s);
            break;
        case What::kDrive:
            done = hands_.drive(control.id, command.twist, command.sent_s, now_s);
            break;
        case What::kGiveBack:
            done = hands_.give_back(control.id);
            break;
        case What::kLeft:
            hands_.left(control.id);
            break;
        case What::kWhere:
            break;
    }
    state_due_ |= command.what != What::kWhere && command.what != What::kDrive;
    vda5050::HandAnswer answer;
    answer.sequence = command.sequence;
    if (!done) answer.refused = done.error();
    answer.operating_mode = executor_.in_hand() ? "MANUAL" : "AUTOMATIC";
    answer.standing = drive_.standing();
    if (executor_.in_hand()) {
        answer.person = hands_.holder()->person;
        answer.mine = hands_.holder()->id == control.id;
    }
    // Before anybody has said where it stands it does not know.
    if (executor_.position_initialized()) answer.pose = drive_.believed_pose();
    return answer;
}

}  // namespace pulseline::agent
