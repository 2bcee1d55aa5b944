#include "core/access/access.hpp"

namespace pulseline::access {

const char* to_string(Role role) {
    switch (role) {
        case Role::kViewer:
            return "viewer";
        case Role::kOperator:
            return "operator";
        case Role::kEngineer:
            return "engineer";
        case Role::kAdmin:
            return "admin";
    }
    return "viewer";
}

std::optional<Role> parse_role(const std::string& text) {
    for (const Role role : {Role::kViewer, Role::kOperator, Role::kEngineer, Role::kAdmin}) {
        if (text == to_string(role)) return role;
    }
    return std::nullopt;
}

}  // namespace pulseline::access
