// Any text as a plant file: decoded, validated, written and read again.
#include <cstdlib>
#include <string_view>

#include "api/plant/image_file.hpp"
#include "api/plant/occupancy_file.hpp"
#include "api/plant/plant_codec.hpp"
#include "core/plant/validate.hpp"

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
    using namespace pulseline;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    (void)api::plant_file::parse_map_yaml(text, "map.yaml");
    (void)api::plant_file::decode_image(text, "map.pgm");
    const auto json = json::parse_json(text, {32, 100'000});
    if (!json) return 0;
    json::FieldErrors errors;
    const auto plant = api::plant_file::decode_plant(*json, errors);
    if (!errors.empty()) return 0;
    (void)plant::validate(plant);
    const auto again = json::parse_json(api::plant_file::plant_to_json(plant), {32, 1'000'000});
    json::FieldErrors none;
    if (!again || (api::plant_file::decode_plant(*again, none), !none.empty())) std::abort();
    return 0;
}
