#include "api/plant/decode_parts.hpp"

#include <algorithm>
#include <string_view>

namespace pulseline::api::plant_file::decoding {

using namespace plant;

namespace {

constexpr CountLimits kRingPoints{0, 1000};

/// A language tag as BCP 47 begins them: "zh", "pt-BR".
bool is_language(std::string_view tag) {
    const auto end = std::ranges::find(tag, '-');
    const auto letters = end - tag.begin();
    const auto is_lower = [](char c) { return 'a' <= c && c <= 'z'; };
    const auto is_part = [&](char c) {
        return is_lower(c) || ('A' <= c && c <= 'Z') || ('0' <= c && c <= '9') || c == '-';
    };
    return (letters == 2 || letters == 3) && tag.size() <= 35 && tag.back() != '-' &&
           std::all_of(tag.begin(), end, is_lower) && std::all_of(end, tag.end(), is_part);
}

}  // namespace

Point2 decode_point(ObjectReader in) {
    const Point2 point{in.number("x_m", kMetres), in.number("y_m", kMetres)};
    in.refuse_unknown();
    return point;
}

Pose2 decode_pose(ObjectReader in) {
    const Pose2 pose{in.number("x_m", kMetres), in.number("y_m", kMetres),
                     wrap(in.number("heading_rad", kHeading))};
    in.refuse_unknown();
    return pose;
}

Polygon decode_ring(ObjectReader& in, const char* name, bool required) {
    Polygon polygon;
    const auto add = [&](const Json& item, const std::string& at) {
        polygon.push_back(decode_point({item, at, in.errors()}));
    };
    if (required) {
        in.items(name, kRingPoints, add);
    } else {
        in.items_if_any(name, kRingPoints, add);
    }
    return polygon;
}

Names decode_names(ObjectReader& in) {
    static constexpr std::size_t kLanguages = 16;
    Names names;
    const Json* object = in.find("names");
    if (object == nullptr) return names;
    const std::string pointer = json::child_pointer(in.pointer(), std::string_view("names"));
    if (!object->is_object() || object->size() > kLanguages) {
        in.errors().add(pointer, {"wrong_type", {{"expected", std::string("object")}}},
                        "Expected an object of at most 16 names by language here.");
        return names;
    }
    for (const auto& [language, name] : object->items()) {
        const std::string at = json::child_pointer(pointer, std::string_view(language));
        if (!is_language(language)) {
            in.errors().add(at, {"not_a_language", {}},
                            "Name a language by its tag, such as zh or pt-BR.");
            continue;
        }
        names[language] = json::read_text(name, at, in.errors(), kName);
    }
    return names;
}

}  // namespace pulseline::api::plant_file::decoding
