#include "server/agent/begun_transfer.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "api/json/object_reader.hpp"
#include "api/json/parse.hpp"
#include "api/plant/occupancy_file.hpp"

namespace pulseline::agent {

BegunTransfer::BegunTransfer(const std::filesystem::path& folder, const std::string& vehicle)
    : file_(folder / (vehicle + ".transfer.json")) {
    std::error_code unwritable;  // save() says so
    std::filesystem::create_directories(folder, unwritable);
}

std::optional<double> BegunTransfer::load() const {
    std::ifstream file(file_, std::ios::binary);
    if (!file) return std::nullopt;
    const auto parsed = json::parse_json(std::string(std::istreambuf_iterator<char>(file), {}));
    if (!parsed) return 0;
    json::FieldErrors errors;
    json::ObjectReader in(*parsed, "", errors);
    const double load_kg = in.number("load_kg");
    return errors.empty() && load_kg >= 0 ? load_kg : 0;
}

Status BegunTransfer::save(const std::optional<double>& load_kg) const {
    if (load_kg) {
        return api::plant_file::write_file(file_, json::Json{{"load_kg", *load_kg}}.dump() + "\n");
    }
    std::error_code failed;
    std::filesystem::remove(file_, failed);
    if (!failed) return {};
    return fail(Errc::kUnavailable, "file_unwritable",
                "cannot remove " + file_.string() + ": " + failed.message(), {},
                {{"file", file_.string()}});
}

}  // namespace pulseline::agent
