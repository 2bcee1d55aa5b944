#include "server/agent/picture_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>

#include "server/base/log.hpp"

namespace pulseline::agent {
namespace {

using namespace std::chrono_literals;

constexpr auto kMoving = 50ms;
constexpr auto kStanding = 100ms;

/// Whole, and dated before anybody can open it by its name.
bool replace(const std::filesystem::path& path, const cv::Mat& grey, Time exposed) {
    const auto beside = path.string() + ".new";
    {
        std::ofstream file(beside, std::ios::binary | std::ios::trunc);
        file << "P5\n" << grey.cols << ' ' << grey.rows << "\n255\n";
        for (int row = 0; row < grey.rows; ++row) {
            file.write(reinterpret_cast<const char*>(grey.ptr(row)), grey.cols);
        }
        if (!file.flush()) return false;
    }
    timespec date{};
    date.tv_sec = to_ns(exposed) / 1'000'000'000;
    date.tv_nsec = to_ns(exposed) % 1'000'000'000;
    const timespec both[2] = {date, date};
    if (::utimensat(AT_FDCWD, beside.c_str(), both, 0) != 0) return false;
    std::error_code ec;
    std::filesystem::rename(beside, path, ec);
    return !ec;
}

}  // namespace

Result<PictureFolder> PictureFolder::open(const std::string& path,
                                          const std::vector<plant::Camera>& cameras) {
    std::error_code ec;
    std::filesystem::create_directories(path, ec);
    if (ec || !std::filesystem::is_directory(path)) {
        return fail(Errc::kUnavailable, "pictures_unwritable",
                    "cannot make --pictures " + path + "; check the folder and its rights");
    }
    PictureFolder folder;
    for (const auto& camera : cameras) {
        const auto frame = std::chrono::duration<double>(1 / camera.frame_rate_hz);
        folder.files_.push_back({std::filesystem::path(path) / (camera.name + ".pgm"),
                                 std::chrono::duration_cast<Steady::duration>(frame)});
    }
    return folder;
}

std::optional<std::size_t> PictureFolder::due(Steady::time_point now, bool moving) {
    const auto oldest = std::ranges::min_element(files_, {}, &File::drawn);
    if (oldest == files_.end()) return std::nullopt;
    const Steady::duration every = moving ? kMoving : kStanding;
    if (now - oldest->drawn < std::max(every, oldest->frame)) return std::nullopt;
    oldest->drawn = now;
    return static_cast<std::size_t>(oldest - files_.begin());
}

void PictureFolder::write(std::size_t camera, const cv::Mat& grey, Time exposed) {
    File& file = files_[camera];
    const bool failed = !replace(file.path, grey, exposed);
    if (failed && !file.failing) {
        server::log::warn("picture.not_written", {{"file", file.path.string()}});
    }
    file.failing = failed;
}

}  // namespace pulseline::agent
