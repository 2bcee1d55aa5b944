#pragma once

#include "api/access/access_control.hpp"
#include "api/http/router.hpp"
#include "api/http/wire/contexts.hpp"
#include "core/fleet/views/motion_preview.hpp"
#include "core/fleet/views/order_preview.hpp"
#include "server/base/camera_store.hpp"
#include "server/base/connections.hpp"
#include "server/base/lane.hpp"
#include "server/base/metrics.hpp"
#include "server/base/options.hpp"
#include "server/base/proxies.hpp"
#include "server/runtime/await.hpp"
#include "server/runtime/fleet_runtime.hpp"
#include "server/sessions/assets.hpp"
#include "server/sessions/sign_in_gate.hpp"
#include "server/stream/stream_hub.hpp"
#include "server/vehicles/vehicle_gateway.hpp"

namespace pulseline::server {

/// What every session may use. The server owns it and outlives the sessions.
struct Context {
    const Options& options;
    const plant::Plant& plant;
    const api::Documents& documents;
    const api::Service& service;
    const Clock& clock;
    Metrics& metrics;
    CameraStore& images;
    FleetRuntime& runtime;
    api::access::AccessControl& access;
    fleet::History& history;
    StreamHub& hub;
    VehicleGateway& gateway;
    api::AccessPolicy policy;
    net::io_context& io;
    Lane& lists;           // reads of the history that take milliseconds
    Lane& heavy;           // marker sheets, images: a second each
    Lane& workers;         // waits for the store
    Lane& planners;        // previews of orders and motions
    Lane& encoders;        // long answers, and what dashboards begin with
    Lane& known_sign_ins;  // hash passwords
    Lane& stranger_sign_ins;
    SignInGate& gate;
    const TrustedProxies& proxies;
    StopList stops;
    Quota peers;
    Quota streams;
    Quota bodies;
    std::size_t connections = 0;
    // Of the planners' lane.
    fleet::MotionPreviewer motions = {};
    fleet::OrderPreviewer orders = {};
};

}  // namespace pulseline::server
