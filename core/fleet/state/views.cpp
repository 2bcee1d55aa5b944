#include "core/fleet/state/views.hpp"

#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {

const char* to_string(Link link) {
    switch (link) {
        case Link::kNever:
            return "never";
        case Link::kLive:
            return "live";
        case Link::kLate:
            return "late";
        case Link::kLost:
            return "lost";
        case Link::kGone:
            return "gone";
    }
    return "never";
}

const char* to_string(PoseBasis::Kind kind) {
    switch (kind) {
        case PoseBasis::Kind::kVehicle:
            return "vehicle";
        case PoseBasis::Kind::kCodes:
            return "codes";
        case PoseBasis::Kind::kStop:
            return "stop";
        case PoseBasis::Kind::kStatement:
            return "statement";
        case PoseBasis::Kind::kReceivers:
            return "receivers";
        case PoseBasis::Kind::kReflectors:
            return "reflectors";
    }
    return "vehicle";
}

CodesUnderWay codes_under_way(const vda5050::StateMessage& state) {
    CodesUnderWay codes;
    for (const auto& action : state.action_states) {
        if (action.type != vda5050::kObserveMarkers ||
            action.status != vda5050::ActionStatus::kFinished)
            continue;
        ++codes.passed;
        if (action.result_description.empty()) continue;
        ++codes.read;
        codes.last = action.result_description;
    }
    return codes;
}

const char* to_string(LiftMove::State state) {
    switch (state) {
        case LiftMove::State::kUnderWay:
            return "under_way";
        case LiftMove::State::kDone:
            return "done";
        case LiftMove::State::kFailed:
            return "failed";
    }
    return "";
}

const char* to_string(Activity activity) {
    switch (activity) {
        case Activity::kStanding:
            return "standing";
        case Activity::kMoving:
            return "moving";
        case Activity::kMeasuring:
            return "measuring";
        case Activity::kWaiting:
            return "waiting";
        case Activity::kPaused:
            return "paused";
        case Activity::kBlocked:
            return "blocked";
        case Activity::kCharging:
            return "charging";
        case Activity::kUnknown:
            return "unknown";
    }
    return "unknown";
}

}  // namespace pulseline::fleet
