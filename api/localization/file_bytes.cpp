#include "api/localization/file_bytes.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace pulseline::api::localization {

Result<std::string> read_bytes(const std::string& path, std::size_t most_bytes) {
    const auto unreadable = [&](const std::string& why) {
        return fail(Errc::kNotFound, "file_unreadable", path + ": " + why, {}, {{"file", path}});
    };
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (error || !std::filesystem::exists(status)) return unreadable("there is no such file.");
    // A pipe or a device would block or never end.
    if (!std::filesystem::is_regular_file(status)) return unreadable("this is no regular file.");
    const auto size = std::filesystem::file_size(path, error);
    if (error) return unreadable(error.message() + ".");
    if (size > most_bytes)
        return fail(Errc::kInvalid, "file_too_large", path + ": the file is too large.", {},
                    {{"file", path}, {"limit_bytes", static_cast<std::int64_t>(most_bytes)}});
    std::ifstream in(path, std::ios::binary);
    std::string bytes(size, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (!in) return unreadable("it cannot be read.");
    return bytes;
}

}  // namespace pulseline::api::localization
