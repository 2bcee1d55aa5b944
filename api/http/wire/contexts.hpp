#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "api/http/wire/message.hpp"
#include "core/base/time.hpp"
#include "core/fleet/fleet.hpp"
#include "core/plant/plant.hpp"

/// What the handlers are given. The server makes them once and keeps them alive.
namespace pulseline::api::access {
class AccessControl;
}
namespace pulseline::fleet {
class MotionPreviewer;
class OrderPreviewer;
}  // namespace pulseline::fleet

namespace pulseline::api {

/// Newest camera pictures, kept by the vehicle gateway. Thread safe.
class CameraImages {
public:
    struct Image {
        std::string mime;  // "image/jpeg"
        std::string bytes;
        Time taken;
    };
    virtual ~CameraImages() = default;
    virtual std::optional<Image> newest(const plant::VehicleId& vehicle,
                                        const std::string& camera) const = 0;
    virtual std::optional<Time> taken(const plant::VehicleId& vehicle,
                                      const std::string& camera) const = 0;
};

/// What the process knows of itself. Thread safe.
class Service {
public:
    virtual ~Service() = default;
    /// Nothing when orders are accepted, else why not.
    virtual std::optional<Error> not_ready() const = 0;
    virtual std::string metrics() const = 0;  // Prometheus text format
    virtual std::string version() const = 0;
};

/// Documents made once at start (documents.hpp).
struct Documents {
    std::string plant_json;
    std::string plant_etag;
    std::map<std::string, std::string> grid_png;  // by hall id
    std::string openapi_json;
};

struct InlineContext {
    const plant::Plant& plant;
    const Documents& documents;
    const CameraImages& images;
    const Service& service;
    Time now;
};

/// On the fleet thread.
struct FleetContext {
    fleet::Fleet& fleet;
    const plant::Plant& plant;
    const CameraImages& images;
    Time now;
};

/// On the history thread.
struct HistoryContext {
    fleet::History& history;
    const plant::Plant& plant;
};

/// On the thread that plans for those who only ask: that may take seconds.
struct PlanContext {
    fleet::MotionPreviewer& motions;
    fleet::OrderPreviewer& orders;
};

/// On the thread that writes long answers down, so that neither the fleet's nor the sockets' has
/// to.
struct EncodeContext {
    const plant::Plant& plant;
    const CameraImages& images;
};

/// On the worker pool: may block (password hashing, waiting for a commit).
struct WorkerContext {
    access::AccessControl& access;
    Time now;
};

/// What a fleet handler answers. With one of the functions set the response is not final: the
/// server calls it on its thread, `plan` before the others, and sends what that returns. `again` is
/// a command of its own.
struct FleetAnswer {
    Response response;
    std::function<FleetAnswer(const PlanContext&)> plan = nullptr;
    std::function<Response(const HistoryContext&)> then = nullptr;
    std::function<Response(const EncodeContext&)> encode = nullptr;
    std::function<FleetAnswer(FleetContext&)> again = nullptr;
};

}  // namespace pulseline::api
