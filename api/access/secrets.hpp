#pragma once

#include <span>
#include <string>
#include <string_view>

#include "api/access/access_control.hpp"

/// The only place that touches cryptography: random secrets, digests and password hashes
/// (libsodium).
namespace pulseline::api::access {

std::string sha256_hex(std::string_view text);
/// `bytes` of the system's random source in base64url without padding.
std::string random_text(std::size_t bytes);
/// Same length and content, in a time that does not depend on where they differ.
bool same_secret(std::string_view a, std::string_view b);

std::string base64url(std::string_view bytes);
/// Empty when `text` is no base64url.
std::string from_base64url(std::string_view text);

/// libsodium's encoded Argon2id. Throws std::bad_alloc when the memory is not to be had.
std::string hash_password(const std::string& password, const HashCost& cost);
bool verify_password(const std::string& hash, const std::string& password);

}  // namespace pulseline::api::access
