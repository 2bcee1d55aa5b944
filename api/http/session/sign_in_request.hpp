#pragma once

#include <string>

#include "api/http/wire/message.hpp"
#include "core/base/result.hpp"

namespace pulseline::api {

struct SignIn {
    std::string name;
    std::string password;
};
Result<SignIn> read_sign_in(const Request& request);

}  // namespace pulseline::api
