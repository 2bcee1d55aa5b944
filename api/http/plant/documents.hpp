#pragma once

#include "api/http/wire/contexts.hpp"

namespace pulseline::api {

/// api/openapi.json, embedded at build time.
extern const char* const kOpenApiJson;

/// Everything that never changes while the server runs, made once.
Documents make_documents(const plant::Plant& plant);

}  // namespace pulseline::api
