#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "api/http/message.hpp"
#include "api/vision/localization.hpp"
#include "core/base/result.hpp"
#include "core/fleet/fleet.hpp"
#include "core/fleet/views/motion_preview.hpp"
#include "core/planning/what_if.hpp"
#include "core/printing/marker_sheet.hpp"

/// Decoders of everything a client may send. Each error names the field: a JSON pointer into the
/// body,
/// "?name" for a query parameter, the header's name for a header. All of them are answered with
/// 400.
namespace pulseline::api {

/// The body as it is; an empty one is an error.
Result<nlohmann::json> read_body(const Request& request);

struct SignIn {
    std::string name;
    std::string password;
};
Result<SignIn> read_sign_in(const Request& request);
/// Body, Idempotency-Key and who asks.
Result<fleet::NewOrder> read_new_order(const Request& request);
/// The same of who asks for an order of a template.
Status read_asker_of_instance(const Request& request, fleet::NewOrder& order);
Result<fleet::ControlRequest> read_job_control(const Request& request);
Result<fleet::NewSchedule> read_new_schedule(const Request& request);
Result<geometry::Pose2> read_pose(const Request& request);
struct IntegrationRequest {
    fleet::Integration level = fleet::Integration::kUtilise;
    bool off_floor = false;
};
Result<IntegrationRequest> read_integration(const Request& request);
Result<std::vector<plant::VehicleId>> read_resume_fleet(const Request& request);

Result<fleet::NewClosure> read_new_closure(const Request& request);
Result<planning::WhatIf> read_what_if(const Request& request);
Result<fleet::MotionQuestion> read_motion_question(const Request& request);
Result<vision::LocalizationQuestion> read_localization(const Request& request);

struct SheetsRequest {
    std::vector<int> stations;                    // none: all markers
    std::optional<printing::SheetFormat> format;  // none: the list
};
Result<SheetsRequest> read_sheets(const Request& request);

Result<bool> read_dry_run(const Request& request);
Result<fleet::OrderQuery> read_order_query(const Request& request);
Result<fleet::StopQuery> read_stop_query(const Request& request);
Result<fleet::UnmeasuredQuery> read_unmeasured_query(const Request& request);
/// Sequence number behind which an event stream starts; nothing: with the next event.
Result<std::optional<std::int64_t>> read_event_start(const Request& request);

}  // namespace pulseline::api
