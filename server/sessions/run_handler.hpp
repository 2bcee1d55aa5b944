#pragma once

#include "server/sessions/context.hpp"

namespace pulseline::server {

/// Runs the handler of an admitted route where the table says and gives its answer.
net::awaitable<api::Response> run_handler(Context& context, const api::Route& route,
                                          const api::Request& request);

}  // namespace pulseline::server
