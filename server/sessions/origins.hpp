#pragma once

#include <string>
#include <vector>

#include "server/sessions/listener.hpp"

namespace pulseline::server {

/// Origins under which browsers reach this server itself, beside those the options allow. Exact:
/// scheme, host and port.
std::vector<std::string> allowed_origins(const Options& options, const Address& bound);

}  // namespace pulseline::server
