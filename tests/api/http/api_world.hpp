#pragma once

#include <map>
#include <memory>
#include <string>

#include "api/access/access_control.hpp"
#include "api/http/plant/documents.hpp"
#include "api/http/router.hpp"
#include "core/fleet/views/motion_preview.hpp"
#include "core/fleet/views/order_preview.hpp"
#include "tests/api/access/memory_store.hpp"
#include "tests/api/http/schema_check.hpp"
#include "tests/core/fleet/fleet_world.hpp"

namespace pulseline::api::testing {

/// What the gateway would hold: one picture of V1's front camera.
class OneImage : public CameraImages {
public:
    std::optional<Image> newest(const plant::VehicleId& vehicle,
                                const std::string& camera) const override;
    std::optional<Time> taken(const plant::VehicleId& vehicle,
                              const std::string& camera) const override;
    std::string bytes = "JPEG";
};

class FakeService : public Service {
public:
    std::optional<Error> not_ready() const override { return why_not; }
    std::string metrics() const override { return "pulseline_up 1\n"; }
    std::string version() const override { return "0.0"; }
    std::optional<Error> why_not;
};

/// History over what the fleet's test world committed.
class WorldHistory : public fleet::History {
public:
    explicit WorldHistory(const fleet::testing::MemoryStore& store) : store_(store) {}
    std::vector<fleet::StopRecord> stops(const fleet::StopQuery& query) override;
    std::optional<fleet::StopRecord> stop(fleet::StopRecordId id) override;
    std::vector<fleet::JobOrder> orders(const fleet::OrderQuery& query) override;
    std::optional<fleet::JobOrder> order(fleet::JobOrderId id) override;
    std::vector<fleet::Event> unmeasured_stops(const fleet::UnmeasuredQuery& query) override;
    std::vector<fleet::LoadMove> load_moves(const fleet::LoadMoveQuery& query) override;
    bool has_load_sheet(const plant::LoadId& id) override {
        return store_.load_sheets.contains(id);
    }
    std::vector<fleet::Event> events_after(std::int64_t seq, int limit) override;
    fleet::StopStatistics statistics(const std::vector<plant::VehicleId>& vehicles,
                                     plant::MotionMode mode, int newest) override;

private:
    const fleet::testing::MemoryStore& store_;
};

struct Answer : Response {
    Json json() const { return Json::parse(body, nullptr, false); }
    std::string code() const { return json().value("code", ""); }
    std::string field() const { return json().value("field", ""); }
    std::string header(const std::string& name) const;
};

/// The whole API without sockets: requests go through admit() and the handler as in the server.
/// Every answer is checked against openapi.yaml; what does not fit fails the test.
class ApiWorld {
public:
    using Headers = std::map<std::string, std::string>;

    ApiWorld() : ApiWorld(fleet::testing::small_plant()) {}
    explicit ApiWorld(plant::Plant plant);

    Answer call(const std::string& method, const std::string& target, const std::string& body = "",
                const Headers& headers = {});
    Answer get(const std::string& target) { return call("GET", target); }
    Answer post(const std::string& target, const std::string& body = "",
                const Headers& headers = {}) {
        return call("POST", target, body, headers);
    }

    fleet::testing::World world;
    access::MemoryStore access_store;
    access::AccessControl access;
    OneImage images;
    FakeService service;
    WorldHistory history;
    fleet::MotionPreviewer motions;
    fleet::OrderPreviewer orders;
    Documents documents;
    AccessPolicy policy{{"http://127.0.0.1:8080"}};
    access::Identity identity;  // who calls when the headers prove nobody: an operator's token
    std::string peer = "127.0.0.1";
    bool secure = false;

private:
    Response run(const Route& route, const Request& request);
};

}  // namespace pulseline::api::testing
