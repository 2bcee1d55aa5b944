#pragma once

#include <filesystem>
#include <fstream>
#include <string>

namespace pulseline::server::cli {

/// Whether all of it is in the file now.
inline bool write_file(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream out(path, std::ios::binary);
    out << bytes;
    return static_cast<bool>(out.flush());
}

}  // namespace pulseline::server::cli
