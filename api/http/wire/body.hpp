#pragma once

#include <nlohmann/json.hpp>

#include "api/http/wire/message.hpp"
#include "api/json/object_reader.hpp"
#include "core/base/result.hpp"

/// Decoders of what a client may send. Each error names the field: a JSON pointer into the body,
/// "?name" for a query parameter (query.hpp), the header's name for a header (asker.hpp). All of
/// them are answered with 400.
namespace pulseline::api {

/// Names of the plant's things and ids of a client's own.
inline constexpr json::TextLimits kName{1, 64};

/// The body as it is; an empty one is an error.
Result<nlohmann::json> read_body(const Request& request);

/// Parses the body and lets `read` take its members; the first fault is the answer.
template <class T, class Read>
Result<T> read_object(const Request& request, Read read) {
    const auto body = read_body(request);
    if (!body) return fail(body.error());
    json::FieldErrors errors;
    json::ObjectReader in(*body, "", errors);
    T value = read(in);
    in.refuse_unknown();
    if (const Status ok = errors.status(); !ok) return fail(ok.error());
    return value;
}

}  // namespace pulseline::api
