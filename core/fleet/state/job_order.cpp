#include "core/fleet/state/job_order.hpp"

namespace pulseline::fleet {

const char* to_string(Integration level) {
    switch (level) {
        case Integration::kIgnore:
            return "ignore";
        case Integration::kNotice:
            return "notice";
        case Integration::kRespect:
            return "respect";
        case Integration::kUtilise:
            return "utilise";
    }
    return "utilise";
}

const char* to_string(StepPhase phase) {
    switch (phase) {
        case StepPhase::kBefore:
            return "before";
        case StepPhase::kDrive:
            return "drive";
        case StepPhase::kAfter:
            return "after";
    }
    return "drive";
}

const char* to_string(JobState state) {
    switch (state) {
        case JobState::kNotAllowedToStart:
            return "NotAllowedToStart";
        case JobState::kAllowedToStart:
            return "AllowedToStart";
        case JobState::kRunning:
            return "Running";
        case JobState::kInterrupted:
            return "Interrupted";
        case JobState::kEnded:
            return "Ended";
        case JobState::kAborted:
            return "Aborted";
    }
    return "Aborted";
}

const char* to_string(StepState state) {
    switch (state) {
        case StepState::kPending:
            return "pending";
        case StepState::kDriving:
            return "driving";
        case StepState::kMeasuring:
            return "measuring";
        case StepState::kDone:
            return "done";
        case StepState::kSkipped:
            return "skipped";
    }
    return "skipped";
}

bool is_final(JobState state) { return state == JobState::kEnded || state == JobState::kAborted; }

}  // namespace pulseline::fleet
