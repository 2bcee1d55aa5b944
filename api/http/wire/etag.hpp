#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "api/http/wire/message.hpp"

/// Entity tags: the revision of a resource in quotes, or a digest where there is no revision.
namespace pulseline::api {

std::string etag_of(std::int64_t revision);
std::string etag_of_content(const std::string& body);

/// If-Match: true when it is absent, "*" or names the tag (strong comparison).
bool if_match_allows(const Request& request, const std::string& etag);
/// If-None-Match names the tag or is "*" (weak comparison): answer 304.
bool if_none_match_has(const Request& request, const std::string& etag);

}  // namespace pulseline::api
