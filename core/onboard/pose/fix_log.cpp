#include "core/onboard/pose/fix_log.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pulseline::onboard {
namespace {

bool alike(const vda5050::PoseFixReport& a, const vda5050::PoseFixReport& b) {
    return a.by == b.by && a.what == b.what && a.result == b.result && a.why == b.why;
}

bool tells_often(const std::string& by) {
    return by == to_string(PoseSource::kLight) || by == to_string(PoseSource::kReflectors) ||
           by == to_string(PoseSource::kContours);
}

}  // namespace

const char* to_string(PoseSource source) {
    switch (source) {
        case PoseSource::kPerson:
            return "person";
        case PoseSource::kStop:
            return "stop";
        case PoseSource::kCodes:
            return "codes";
        case PoseSource::kLight:
            return "igps";
        case PoseSource::kReflectors:
            return "reflectors";
        case PoseSource::kContours:
            return "contours";
    }
    return "";
}

void FixLog::step(double dt_s) {
    for (auto& fix : newest_) fix.ago_s += dt_s;
}

void FixLog::took(PoseSource by, const std::string& what, const geometry::Pose2& off) {
    add({to_string(by), what, "taken", {}}, off);
}

void FixLog::agreed(PoseSource by, const geometry::Pose2& off) {
    add({to_string(by), {}, "agreed", {}}, off);
}

void FixLog::began_anew(PoseSource by, const std::string& what, const geometry::Pose2& off) {
    add({to_string(by), what, "begun_anew", {}}, off);
}

void FixLog::refused(PoseSource by, const std::string& what, const std::string& why,
                     const geometry::Pose2& off) {
    add({to_string(by), what, "refused", why}, off);
}

void FixLog::add(vda5050::PoseFixReport fix, const geometry::Pose2& off) {
    // What is no number is refused; a state message has no place for it.
    const double moved_m = norm(off.position());
    fix.moved_m = std::isfinite(moved_m) ? moved_m : 0;
    fix.turned_rad = std::isfinite(off.heading_rad) ? std::abs(wrap(off.heading_rad)) : 0;
    // A code that is refused in picture after picture is one, too.
    const auto known =
        tells_often(fix.by) || (!newest_.empty() && alike(newest_.front(), fix))
            ? std::ranges::find_if(newest_, [&](const auto& k) { return alike(k, fix); })
            : newest_.end();
    if (known != newest_.end()) {
        fix.times = known->times + 1;
        newest_.erase(known);
    }
    newest_.insert(newest_.begin(), std::move(fix));
    if (newest_.size() > vda5050::kMostPoseFixes) newest_.pop_back();
}

}  // namespace pulseline::onboard
