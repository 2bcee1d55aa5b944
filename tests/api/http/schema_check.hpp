#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// The OpenAPI document as a judge of what the API really says.
namespace pulseline::api::testing {

using Json = nlohmann::json;

const Json& openapi();
/// The operation's object, null when the document has none.
const Json* operation(const std::string& operation_id);
const Json& schema(const std::string& name);  // of components/schemas
const Json& resolved(const Json& node);       // follows $ref

/// First breach of the schema in `value` with its place; empty when it fits. Stricter than JSON
/// Schema: a property that the schema does not name is a breach unless it allows any.
std::string breach(const Json& schema, const Json& value, const std::string& at = "");

}  // namespace pulseline::api::testing
