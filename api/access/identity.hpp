#pragma once

#include <optional>
#include <string>

#include "core/access/access.hpp"
#include "core/base/time.hpp"

namespace pulseline::api::access {

// core/access has what is stored; here are the rules.
using pulseline::access::parse_role;
using pulseline::access::Role;
using pulseline::access::Session;
using pulseline::access::Store;
using pulseline::access::to_string;
using pulseline::access::Token;
using pulseline::access::User;

/// Who a request comes from, as its cookie or bearer token proves it.
struct Identity {
    enum class Kind {
        kAnonymous,
        kUser,     // a person with a session cookie
        kToken,    // a program with an API token
        kVehicle,  // a vehicle's token: may open its own link and nothing else
    };
    Kind kind = Kind::kAnonymous;
    std::string name;          // user name, or "token:<id>"; kept in the journal as the actor
    std::optional<Role> role;  // none: may use public operations only
    std::optional<Time> expires;

    std::string token_sha256;    // kToken, kVehicle: names the token without being its secret
    std::string session_sha256;  // kUser: likewise the session
    std::string csrf_token;      // kUser: what X-Pulseline-CSRF must carry

    std::string vehicle_manufacturer;  // kVehicle
    std::string vehicle_serial;

    bool by_cookie() const { return kind == Kind::kUser; }
    bool at_least(Role least) const { return role && *role >= least; }
};

}  // namespace pulseline::api::access
