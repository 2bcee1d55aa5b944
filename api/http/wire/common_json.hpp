#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "api/http/wire/message.hpp"
#include "core/base/error.hpp"
#include "core/base/time.hpp"
#include "core/geometry/polygon.hpp"
#include "core/geometry/pose2.hpp"
#include "core/plant/plant.hpp"

/// The pieces that every resource's JSON is made of, named as in openapi.yaml.
namespace pulseline::api {

using Json = nlohmann::json;

/// "2026-11-21T03:50:36.125Z". UTC with milliseconds (RFC 3339).
std::string rfc3339(Time time);

Json point_json(const geometry::Point2& point);
Json pose_json(const geometry::Pose2& pose);
Json ring_json(const geometry::Polygon& ring);
Json rings_json(const std::vector<geometry::Polygon>& rings);
Json params_json(const Params& params);
Json reason_json(const Reason& reason);
Json tolerance_json(const plant::Tolerance& tolerance);

/// A list of resources: {"items": [...]}.
template <class Items, class ToJson>
Json list_json(const Items& items, const ToJson& to_json) {
    Json array = Json::array();
    for (const auto& item : items) array.push_back(to_json(item));
    return array;
}

/// Never throws: what is no UTF-8 comes out as U+FFFD.
std::string dump(const Json& json);
Response json_response(int status, const Json& body);

}  // namespace pulseline::api
