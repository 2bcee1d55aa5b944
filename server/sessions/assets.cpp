#include "server/sessions/assets.hpp"

#include <algorithm>

namespace pulseline::server {

const Asset* find_asset(std::string_view path) {
    const auto all = assets();
    const auto exact = [&](std::string_view wanted) -> const Asset* {
        const auto found = std::ranges::lower_bound(all, wanted, {}, &Asset::path);
        return found != all.end() && found->path == wanted ? &*found : nullptr;
    };
    if (const auto* asset = exact(path)) return asset;
    const auto name = path.substr(path.rfind('/') + 1);
    if (name.find('.') != std::string_view::npos) return nullptr;
    return exact("/index.html");
}

}  // namespace pulseline::server
