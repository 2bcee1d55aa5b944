#pragma once

#include <span>
#include <string_view>

namespace pulseline::server {

/// One file of the web client, embedded at build time.
struct Asset {
    std::string_view path;  // "/assets/index-1a2b3c.js"
    std::string_view content_type;
    std::string_view etag;   // strong, quoted
    bool immutable = false;  // its name changes with its content
    std::string_view bytes;
    std::string_view gzip;  // empty: not smaller
};

std::span<const Asset> assets();  // sorted by path

/// The file of that path; for a path that names no file ("/orders") the page itself.
const Asset* find_asset(std::string_view path);

}  // namespace pulseline::server
