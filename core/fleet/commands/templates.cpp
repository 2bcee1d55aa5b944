#include "core/fleet/fleet.hpp"
#include "core/fleet/journal/recorder.hpp"
#include "core/fleet/state/event_types.hpp"
#include "core/fleet/state/events.hpp"
#include "core/fleet/state/fleet_state.hpp"

// Named order bodies. What they mean is the API's; the fleet keeps them and says who changed them.
namespace pulseline::fleet {
namespace {

constexpr std::size_t kMaxTemplates = 1000;

}  // namespace

Result<OrderTemplate> Fleet::store_template(const OrderTemplate& wanted, Time now) {
    FleetState& fleet = input<&Fleet::store_template>(now, wanted);
    auto& templates = fleet.standing.templates;
    const auto known = templates.find(wanted.name);
    if (known != templates.end()) {
        if (known->second.same_content(wanted)) return known->second;
        return fail(Errc::kConflict, "duplicate_template",
                    "There is another template " + wanted.name +
                        ". Use another name, or delete that one first.",
                    "/name", {{"template", wanted.name}});
    }
    if (templates.size() >= kMaxTemplates) {
        return fail(Errc::kConflict, "too_many_templates",
                    "There are 1000 templates. Delete one that nobody uses, then repeat.", "/name");
    }
    OrderTemplate made = wanted;
    made.created = now;
    templates[made.name] = made;
    fleet.standing.changed_templates.push_back(made);
    add_event(fleet, now, event::kJobOrderTemplateCreated, {}, {}, {}, wanted.created_by,
              {{"template", wanted.name}});
    return made;
}

Status Fleet::delete_template(const std::string& name, const std::string& actor, Time now) {
    FleetState& fleet = input<&Fleet::delete_template>(now, name, actor);
    auto& templates = fleet.standing.templates;
    const auto known = templates.find(name);
    if (known == templates.end()) {
        return fail(Errc::kNotFound, "unknown_template",
                    "There is no such template; GET /api/v1/job-order-templates lists them.", {},
                    {{"template", name}});
    }
    known->second.deleted = true;
    fleet.standing.changed_templates.push_back(known->second);
    templates.erase(known);
    add_event(fleet, now, event::kJobOrderTemplateDeleted, {}, {}, {}, actor, {{"template", name}});
    return {};
}

std::optional<OrderTemplate> Fleet::order_template(const std::string& name) const {
    const auto known = state_->standing.templates.find(name);
    return known == state_->standing.templates.end() ? std::nullopt : std::optional(known->second);
}

std::vector<OrderTemplate> Fleet::order_templates() const {
    std::vector<OrderTemplate> all;
    for (const auto& [name, one] : state_->standing.templates) all.push_back(one);
    return all;
}

}  // namespace pulseline::fleet
