#include "server/agent/kept_transfer.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "api/json/object_reader.hpp"
#include "api/json/parse.hpp"
#include "api/plant/occupancy_file.hpp"

namespace pulseline::agent {

KeptTransfer::KeptTransfer(const std::filesystem::path& folder, const std::string& vehicle)
    : file_(folder / (vehicle + ".transfer.json")) {
    std::error_code unwritable;  // save() says so
    std::filesystem::create_directories(folder, unwritable);
}

std::optional<onboard::BegunTransfer> KeptTransfer::load() const {
    std::ifstream file(file_, std::ios::binary);
    if (!file) return std::nullopt;
    onboard::BegunTransfer begun;
    const auto parsed = json::parse_json(std::string(std::istreambuf_iterator<char>(file), {}));
    if (!parsed) return begun;
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    begun.load_kg = in.number("load_kg");
    if (in.has("empty_m")) begun.empty_m = in.number("empty_m");
    if (in.has("laden_m")) begun.laden_m = in.number("laden_m");
    const bool usable = errors.empty() && begun.load_kg >= 0;
    return usable ? begun : onboard::BegunTransfer{};
}

Status KeptTransfer::save(const std::optional<onboard::BegunTransfer>& begun) const {
    if (begun) {
        json::Json text{{"load_kg", begun->load_kg}};
        if (begun->empty_m) text["empty_m"] = *begun->empty_m;
        if (begun->laden_m) text["laden_m"] = *begun->laden_m;
        return api::plant_file::write_file(file_, text.dump() + "\n");
    }
    std::error_code failed;
    std::filesystem::remove(file_, failed);
    if (!failed) return {};
    return fail(Errc::kUnavailable, "file_unwritable",
                "cannot remove " + file_.string() + ": " + failed.message(), {},
                {{"file", file_.string()}});
}

}  // namespace pulseline::agent
