#include "api/http/routing/routing_requests.hpp"

#include "api/http/wire/body.hpp"
#include "api/http/wire/query.hpp"

namespace pulseline::api {
namespace {

using json::Json;
using json::ObjectReader;

constexpr std::size_t kMaxClosed = 1000;
constexpr std::int64_t kMaxRoutes = 10;
constexpr double kMaxCoordinate_m = 1e5;  // no hall is larger
constexpr json::TextLimits kPlantName{1, 64};
constexpr json::TextLimits kClosureName{1, 100};
constexpr json::CountLimits kOutline{0, 64};

}  // namespace

Result<fleet::NewClosure> read_new_closure(const Request& request) {
    return read_object<fleet::NewClosure>(request, [](ObjectReader& in) {
        fleet::NewClosure closure;
        closure.name = in.text("name", kClosureName);
        closure.hall = plant::HallId(in.text_or("hall", "", kPlantName));
        in.items_if_any("outline", kOutline, [&](const Json& item, const std::string& pointer) {
            ObjectReader point(item, pointer, in.errors());
            const json::NumberLimits metres{-kMaxCoordinate_m, kMaxCoordinate_m};
            closure.outline.push_back({point.number("x_m", metres), point.number("y_m", metres)});
            point.refuse_unknown();
        });
        in.items_if_any(
            "edges", {0, kMaxClosed}, [&](const Json& item, const std::string& pointer) {
                closure.edges.emplace_back(json::read_text(item, pointer, in.errors(), kPlantName));
            });
        return closure;
    });
}

Result<planning::WhatIf> read_what_if(const Request& request) {
    return read_object<planning::WhatIf>(request, [](ObjectReader& in) {
        planning::WhatIf read;
        read.vehicle_type = plant::VehicleTypeId(in.text("vehicle_type", kPlantName));
        read.from = static_cast<int>(in.integer("from", {0, kMaxStation}));
        read.to = static_cast<int>(in.integer("to", {0, kMaxStation}));
        read.loaded = in.boolean_or("loaded", false);
        read.present_closures = in.boolean_or("present_closures", true);
        read.alternatives = static_cast<int>(in.integer_or("alternatives", 2, {0, kMaxRoutes}));
        in.items_if_any(
            "closed_edges", {0, kMaxClosed}, [&](const Json& item, const std::string& pointer) {
                read.closed.emplace_back(json::read_text(item, pointer, in.errors(), kPlantName));
            });
        return read;
    });
}

}  // namespace pulseline::api
