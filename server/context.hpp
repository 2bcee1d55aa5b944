#pragma once

#include "api/access/access_control.hpp"
#include "api/http/contexts.hpp"
#include "api/http/router.hpp"
#include "core/fleet/views/motion_preview.hpp"
#include "core/fleet/views/order_preview.hpp"
#include "server/assets.hpp"
#include "server/await.hpp"
#include "server/camera_store.hpp"
#include "server/connections.hpp"
#include "server/fleet_runtime.hpp"
#include "server/lane.hpp"
#include "server/metrics.hpp"
#include "server/options.hpp"
#include "server/proxies.hpp"
#include "server/sign_in_gate.hpp"
#include "server/stream_hub.hpp"
#include "server/vehicle_gateway.hpp"

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
    access::AccessControl& access;
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
