#include "api/access/new_user.hpp"

#include <algorithm>
#include <cctype>

namespace pulseline::api::access {
namespace {

constexpr std::size_t kMinPasswordBytes = 8;
constexpr std::size_t kMaxPasswordBytes = 128;
constexpr std::size_t kMaxNameBytes = 64;

bool usable_name(const std::string& name) {
    return !name.empty() && name.size() <= kMaxNameBytes &&
           std::all_of(name.begin(), name.end(), [](unsigned char c) {
               return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-' || c == '@';
           });
}

}  // namespace

Status check_new_user(const std::string& name, const std::string& password) {
    if (!usable_name(name)) {
        return fail(Errc::kInvalid, "bad_user_name",
                    "A user name is 1 to 64 letters, digits or any of . _ - @; choose another.",
                    "/name");
    }
    if (password.size() < kMinPasswordBytes || password.size() > kMaxPasswordBytes) {
        return fail(Errc::kInvalid, "bad_password",
                    "A password has 8 to 128 bytes; choose one of that length.", "/password",
                    {{"min_bytes", static_cast<std::int64_t>(kMinPasswordBytes)},
                     {"max_bytes", static_cast<std::int64_t>(kMaxPasswordBytes)}});
    }
    if (password == name) {
        return fail(Errc::kInvalid, "bad_password",
                    "The password is the user's name; choose another.", "/password");
    }
    return {};
}

}  // namespace pulseline::api::access
