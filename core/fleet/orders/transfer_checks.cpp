#include "core/fleet/orders/transfer_checks.hpp"

#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/fleet/orders/candidates.hpp"
#include "core/fleet/vehicle/loads.hpp"
#include "core/plant/carrying.hpp"
#include "core/vda5050/actions.hpp"

namespace pulseline::fleet {
namespace {

std::string who_of(const NewOrder& order) {
    return order.vehicle.empty() ? "The vehicle" : "Vehicle " + order.vehicle.str();
}

/// What an order says of its vehicle's load up to here; nothing: what it brings along.
class Story {
public:
    Story(const FleetState& fleet, const NewOrder& order) : fleet_(fleet), order_(order) {}

    /// `at`: where it happens; nullptr: where the order finds the vehicle.
    Status tell(const StepAction& action, const plant::Station* at, const std::string& field) {
        if (!vda5050::is_transfer(action.type)) return {};
        if (at != nullptr && !at->support) {
            return fail(Errc::kUnreachable, "no_support",
                        "Nothing holds a load at station " + std::to_string(at->number) + ".",
                        field + "/type", {{"station", std::int64_t{at->number}}});
        }
        return action.type == vda5050::kPick ? pick(action, field) : drop(field);
    }

private:
    Status pick(const StepAction& action, const std::string& field) {
        const std::string at = field + "/parameters/load";
        const plant::LoadId id = load_named(action);
        if (id.empty()) {
            return fail(Errc::kInvalid, "missing_field", "Which load? Its id belongs here.", at);
        }
        const auto* load = find_load(fleet_, id);
        if (load == nullptr) {
            return fail(Errc::kUnreachable, "unknown_load",
                        "There is no load \"" + id.str() + "\".", at, {{"load", id.str()}});
        }
        if (carries_ != nullptr) {
            return fail(
                Errc::kUnreachable, "vehicle_loaded",
                who_of(order_) + " carries " + carries_->name + " by then. Set that down first.",
                at, {{"vehicle", order_.vehicle.str()}, {"load", carries_->name}});
        }
        tells_ = true;
        carries_ = load;
        return some_vehicle_may(*load, at);
    }

    Status drop(const std::string& field) {
        if (tells_ && carries_ == nullptr) {
            return fail(Errc::kUnreachable, "vehicle_empty",
                        who_of(order_) + " carries nothing by then.", field + "/type",
                        {{"vehicle", order_.vehicle.str()}});
        }
        tells_ = true;
        carries_ = nullptr;
        return {};
    }

    Status some_vehicle_may(const plant::Load& load, const std::string& field) const {
        std::optional<Reason> why_not;
        for (const auto& [id, live] : fleet_.vehicles) {
            if (!is_candidate(fleet_, order_, live)) continue;
            why_not = plant::cannot_carry(*live.type, load);
            if (!why_not) return {};
        }
        if (!why_not) return {};  // there is no candidate, which is told elsewhere
        return fail(Errc::kUnreachable, why_not->code.c_str(),
                    "No vehicle that may take this order may carry " + load.name + ".", field,
                    std::move(why_not->params));
    }

    const FleetState& fleet_;
    const NewOrder& order_;
    bool tells_ = false;  // it has told what the vehicle carries
    const plant::Load* carries_ = nullptr;
};

}  // namespace

Status check_transfers(const FleetState& fleet, const NewOrder& order,
                       const std::vector<const plant::Station*>& stations) {
    Story story(fleet, order);
    for (std::size_t i = 0; i < order.steps.size(); ++i) {
        const std::string step = "/steps/" + std::to_string(i);
        const auto* from = i == 0 ? nullptr : stations[i - 1];
        for (const auto& [actions, name, at] :
             {std::tuple{&order.steps[i].before, "/before/", from},
              std::tuple{&order.steps[i].after, "/after/", stations[i]}}) {
            for (std::size_t k = 0; k < actions->size(); ++k) {
                auto told = story.tell((*actions)[k], at, step + name + std::to_string(k));
                if (!told) return told;
            }
        }
    }
    return {};
}

}  // namespace pulseline::fleet
