#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/vda5050/messages.hpp"

namespace pulseline::onboard {

/// Port: what a vehicle does standing besides measuring, as its executor needs it: charging,
/// parking feet, brackets. Thread safety: none. No clock.
class Equipment {
public:
    virtual ~Equipment() = default;

    /// VDA 5050 action types that it runs at nodes.
    virtual const std::vector<std::string>& action_types() const = 0;
    /// Begins an action of action_types(), the vehicle standing. The error is the resultDescription
    /// of the failed action.
    virtual std::optional<std::string> begin(const vda5050::Action& action) = 0;
    virtual bool busy() const = 0;
    /// Why the movement that was begun last did not end; nullopt: it did, or is at work.
    virtual std::optional<std::string> failure() const = 0;
    /// What moves stays where it is.
    virtual void abort() = 0;
    /// Plugged in or on its feet: it must not drive.
    virtual bool holds_vehicle() const = 0;
    /// A load lies on its brackets in part, and in part on what held it: it must neither drive nor
    /// be raised. Only going on with taking it over or setting it down ends that.
    virtual bool half_transferred() { return false; }
    /// What the load cells of its brackets show now, and how high these are; empty: it has none.
    virtual std::vector<vda5050::BracketStatus> brackets() { return {}; }
};

/// "bracket_force_out_of_range: bracket front left, force_n 81234, limit_n 80000"
std::string sentence_of(const Reason& reason);

}  // namespace pulseline::onboard
