#pragma once

#include <string>

#include "core/base/result.hpp"

namespace pulseline::api::access {

/// Whether a user may have this name and this password. Errors: bad_user_name, bad_password.
Status check_new_user(const std::string& name, const std::string& password);

}  // namespace pulseline::api::access
