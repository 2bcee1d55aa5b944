#pragma once

#include <string>
#include <vector>

#include "api/plant/plant_codec.hpp"

/// The parts of decode_plant(). Not for use elsewhere.
namespace pulseline::api::plant_file::decoding {

using json::CountLimits;
using json::Json;
using json::ObjectReader;
using json::TextLimits;

inline constexpr TextLimits kId{1, 64};
inline constexpr TextLimits kName{0, 200};
inline constexpr json::NumberLimits kMetres{-1e6, 1e6};
inline constexpr json::NumberLimits kHeading{-6.2832, 6.2832};
inline constexpr json::NumberLimits kQuantity{-1e9, 1e9};
inline constexpr CountLimits kFew{0, 1000};

plant::Point2 decode_point(ObjectReader in);
plant::Pose2 decode_pose(ObjectReader in);
plant::Polygon decode_ring(ObjectReader& in, const char* name, bool required = true);
/// {"zh": "..."}: what it is called in other languages.
plant::Names decode_names(ObjectReader& in);
plant::VehicleType decode_vehicle_type(ObjectReader& in);

template <class K>
K decode_key(ObjectReader& in, const char* name) {
    return K(in.text(name, kId));
}

/// The empty key where the field is absent.
template <class K>
K decode_key_or_none(ObjectReader& in, const char* name) {
    return K(in.text_or(name, {}, kId));
}

template <class T, class Decode>
void decode_all(ObjectReader& in, const char* name, CountLimits limits, std::vector<T>& to,
                Decode decode, bool required = true) {
    const auto add = [&](const Json& item, const std::string& at) {
        ObjectReader element(item, at, in.errors());
        to.push_back(decode(element));
        element.refuse_unknown();
    };
    if (required) {
        in.items(name, limits, add);
    } else {
        in.items_if_any(name, limits, add);
    }
}

}  // namespace pulseline::api::plant_file::decoding
