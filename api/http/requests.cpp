#include "api/http/requests.hpp"

#include <algorithm>
#include <limits>

#include "api/access/secrets.hpp"
#include "api/http/base64.hpp"
#include "api/http/motion_question_body.hpp"
#include "api/http/order_body.hpp"
#include "api/http/page.hpp"
#include "api/json/object_reader.hpp"

namespace pulseline::api {
namespace {

using json::FieldErrors;
using json::Json;
using json::ObjectReader;

constexpr std::size_t kMaxImages = 2;
constexpr std::size_t kMaxImageText = 6'000'000;
constexpr std::size_t kMaxResumed = 1000;
constexpr std::size_t kMaxClosed = 1000;
constexpr std::int64_t kMaxRoutes = 10;
constexpr std::int64_t kMaxStation = 1'000'000'000;
constexpr double kMaxCoordinate_m = 1e5;  // no hall is larger
constexpr std::size_t kMaxKeyBytes = 128;
constexpr json::TextLimits kVehicleName{1, 64};
constexpr json::TextLimits kClosureName{1, 100};
constexpr json::CountLimits kOutline{0, 64};

/// Parses the body and lets `read` take its members; the first fault is the answer.
template <class T, class Read>
Result<T> read_object(const Request& request, Read read) {
    const auto body = read_body(request);
    if (!body) return fail(body.error());
    FieldErrors errors;
    ObjectReader in(*body, "", errors);
    T value = read(in);
    in.refuse_unknown();
    if (const Status ok = errors.status(); !ok) return fail(ok.error());
    return value;
}

/// The draft standard quotes the key, most clients do not: both are the same key.
Result<std::string> read_idempotency_key(const Request& request) {
    const auto it = request.headers.find("idempotency-key");
    if (it == request.headers.end()) return std::string();
    std::string key = it->second;
    if (key.size() >= 2 && key.front() == '"' && key.back() == '"') {
        key = key.substr(1, key.size() - 2);
    }
    const bool printable =
        std::all_of(key.begin(), key.end(), [](char c) { return c > ' ' && c <= '~'; });
    if (key.empty() || key.size() > kMaxKeyBytes || !printable) {
        return fail(Errc::kInvalid, "bad_idempotency_key",
                    "An Idempotency-Key has 1 to 128 printable ASCII characters; send such a one.",
                    "Idempotency-Key");
    }
    return key;
}

Result<bool> read_flag(const Request& request, const std::string& name) {
    const auto text = request.query_value(name);
    if (!text || *text == "false") return false;
    if (*text == "true") return true;
    return fail(Errc::kInvalid, "wrong_type", name + " is true or false.", "?" + name,
                {{"expected", std::string("boolean")}});
}

Result<int> read_limit(const Request& request) {
    const auto text = request.query_value("limit");
    if (!text) return kDefaultPage;
    const auto limit = parse_integer(*text, 1, kLargestPage);
    if (!limit) {
        return fail(Errc::kInvalid, "out_of_range", "The limit is a whole number from 1 to 500.",
                    "?limit", {{"min", std::int64_t{1}}, {"max", std::int64_t{kLargestPage}}});
    }
    return static_cast<int>(*limit);
}

tl::unexpected<Error> bad_cursor() {
    return fail(Errc::kInvalid, "bad_cursor",
                "Take the cursor unchanged from next_cursor of an earlier page.", "?cursor");
}

template <class AnyId>
Result<AnyId> read_cursor(const Request& request) {
    const auto text = request.query_value("cursor");
    if (!text) return AnyId{};
    const auto uuid = uuid_of_cursor(*text);
    if (!uuid) return bad_cursor();
    return AnyId(*uuid);
}

Result<std::vector<fleet::JobState>> read_states(const std::string& text) {
    using fleet::JobState;
    std::vector<JobState> states;
    std::size_t start = 0;
    while (start <= text.size()) {
        const auto end = std::min(text.find(',', start), text.size());
        const std::string name = text.substr(start, end - start);
        start = end + 1;
        bool known = false;
        for (const JobState state :
             {JobState::kNotAllowedToStart, JobState::kAllowedToStart, JobState::kRunning,
              JobState::kInterrupted, JobState::kEnded, JobState::kAborted}) {
            if (name != fleet::to_string(state)) continue;
            states.push_back(state);
            known = true;
        }
        if (!known) {
            return fail(Errc::kInvalid, "not_one_of",
                        "Name states separated by commas: NotAllowedToStart, AllowedToStart, "
                        "Running, Interrupted, Ended, Aborted.",
                        "?state");
        }
    }
    return states;
}

/// Who asks, and the key under which the answer is kept.
template <class Asked>
Status read_asker(const Request& request, const std::string& digested, Asked& to) {
    const auto key = read_idempotency_key(request);
    if (!key) return fail(key.error());
    to.actor = request.identity.name;
    to.idempotency_client = request.identity.name;
    to.idempotency_key = *key;
    to.body_sha256 = access::sha256_hex(digested);
    return {};
}

/// Which stops a page is of, measured or not, and how many.
template <class Query>
Status read_which_stops(const Request& request, Query& query) {
    query.vehicle = plant::VehicleId(request.query_value("vehicle").value_or(""));
    if (const auto text = request.query_value("station")) {
        const auto number = parse_integer(*text, 0, kMaxStation);
        if (!number) {
            return fail(Errc::kInvalid, "wrong_type", "The station is a number.", "?station",
                        {{"expected", std::string("integer")}});
        }
        query.station_number = static_cast<int>(*number);
    }
    if (const auto text = request.query_value("order")) {
        const auto id = fleet::JobOrderId::parse(*text);
        if (!id) {
            return fail(Errc::kInvalid, "wrong_type", "The order is the id of a job order.",
                        "?order", {{"expected", std::string("uuid")}});
        }
        query.order = *id;
    }
    const auto limit = read_limit(request);
    if (!limit) return fail(limit.error());
    query.limit = *limit;
    return {};
}

}  // namespace

Result<Json> read_body(const Request& request) {
    if (request.body.empty()) {
        return fail(Errc::kInvalid, "body_missing", "This operation needs a JSON body; send one.");
    }
    return json::parse_json(request.body);
}

Result<SignIn> read_sign_in(const Request& request) {
    return read_object<SignIn>(request, [](ObjectReader& in) {
        SignIn credentials;
        credentials.name = in.text("name", {1, 64});
        credentials.password = in.text("password", {1, 128});
        return credentials;
    });
}

Result<fleet::NewOrder> read_new_order(const Request& request) {
    const auto body = read_body(request);
    if (!body) return fail(body.error());
    FieldErrors errors;
    ObjectReader in(*body, "", errors);
    fleet::NewOrder order = read_order_body(in, OrderUse::kCreate);
    if (const Status ok = errors.status(); !ok) return fail(ok.error());
    if (auto asker = read_asker(request, request.body, order); !asker) return fail(asker.error());
    return order;
}

Status read_asker_of_instance(const Request& request, fleet::NewOrder& order) {
    return read_asker(request, request.path + "\n" + request.body, order);
}

Result<fleet::ControlRequest> read_job_control(const Request& request) {
    using fleet::JobMethod;
    auto control = read_object<fleet::ControlRequest>(request, [](ObjectReader& in) {
        fleet::ControlRequest read;
        read.method =
            in.one_of("method", {JobMethod::kStore, JobMethod::kStoreAndStart, JobMethod::kStart,
                                 JobMethod::kRevokeStart, JobMethod::kPause, JobMethod::kResume,
                                 JobMethod::kUpdate, JobMethod::kAbort, JobMethod::kStop,
                                 JobMethod::kCancel, JobMethod::kClear});
        if (read.method == JobMethod::kUpdate) {
            ObjectReader order = in.object("order");
            if (in.has("order")) read.update = read_order_body(order, OrderUse::kUpdate);
        }
        return read;
    });
    if (!control) return control;
    const std::string digested = request.path + "\n" + request.body;
    if (auto asker = read_asker(request, digested, *control); !asker) return fail(asker.error());
    return control;
}

Result<geometry::Pose2> read_pose(const Request& request) {
    return read_object<geometry::Pose2>(request, read_pose_members);
}

Result<IntegrationRequest> read_integration(const Request& request) {
    return read_object<IntegrationRequest>(request, [](ObjectReader& in) {
        using fleet::Integration;
        IntegrationRequest wanted;
        wanted.level = in.one_of("level", {Integration::kIgnore, Integration::kNotice,
                                           Integration::kRespect, Integration::kUtilise});
        wanted.off_floor = in.boolean_or("off_floor", false);
        return wanted;
    });
}

Result<std::vector<plant::VehicleId>> read_resume_fleet(const Request& request) {
    return read_object<std::vector<plant::VehicleId>>(request, [](ObjectReader& in) {
        std::vector<plant::VehicleId> vehicles;
        in.items("vehicles", {1, kMaxResumed}, [&](const Json& item, const std::string& pointer) {
            vehicles.emplace_back(json::read_text(item, pointer, in.errors(), kVehicleName));
        });
        return vehicles;
    });
}

Result<fleet::NewClosure> read_new_closure(const Request& request) {
    return read_object<fleet::NewClosure>(request, [](ObjectReader& in) {
        fleet::NewClosure closure;
        closure.name = in.text("name", kClosureName);
        closure.hall = plant::HallId(in.text_or("hall", "", kVehicleName));
        in.items_if_any("outline", kOutline, [&](const Json& item, const std::string& pointer) {
            ObjectReader point(item, pointer, in.errors());
            const json::NumberLimits metres{-kMaxCoordinate_m, kMaxCoordinate_m};
            closure.outline.push_back({point.number("x_m", metres), point.number("y_m", metres)});
            point.refuse_unknown();
        });
        in.items_if_any("edges", {0, kMaxClosed},
                        [&](const Json& item, const std::string& pointer) {
                            closure.edges.emplace_back(
                                json::read_text(item, pointer, in.errors(), kVehicleName));
                        });
        return closure;
    });
}

Result<planning::WhatIf> read_what_if(const Request& request) {
    return read_object<planning::WhatIf>(request, [](ObjectReader& in) {
        planning::WhatIf read;
        read.vehicle_type = plant::VehicleTypeId(in.text("vehicle_type", kVehicleName));
        read.from = static_cast<int>(in.integer("from", {0, kMaxStation}));
        read.to = static_cast<int>(in.integer("to", {0, kMaxStation}));
        read.loaded = in.boolean_or("loaded", false);
        read.present_closures = in.boolean_or("present_closures", true);
        read.alternatives = static_cast<int>(in.integer_or("alternatives", 2, {0, kMaxRoutes}));
        in.items_if_any(
            "closed_edges", {0, kMaxClosed}, [&](const Json& item, const std::string& pointer) {
                read.closed.emplace_back(json::read_text(item, pointer, in.errors(), kVehicleName));
            });
        return read;
    });
}

Result<fleet::MotionQuestion> read_motion_question(const Request& request) {
    return read_object<fleet::MotionQuestion>(request, read_motion_question_body);
}

Result<vision::LocalizationQuestion> read_localization(const Request& request) {
    return read_object<vision::LocalizationQuestion>(request, [](ObjectReader& in) {
        vision::LocalizationQuestion read;
        read.vehicle = plant::VehicleId(in.text("vehicle", kVehicleName));
        if (in.has("station")) {
            read.station = static_cast<int>(in.integer("station", {0, kMaxStation}));
        }
        in.items("images", {1, kMaxImages}, [&](const Json& item, const std::string& pointer) {
            ObjectReader image(item, pointer, in.errors());
            vision::CameraImage& added = read.images.emplace_back();
            added.camera = image.text("camera", kVehicleName);
            const std::string coded = image.text("image", {1, kMaxImageText});
            if (auto bytes = from_base64(coded)) {
                added.bytes = std::move(*bytes);
            } else if (!coded.empty()) {
                in.errors().add(pointer + "/image", {"not_base64", {}},
                                "An image is the base64 of the file, without line breaks.");
            }
            image.refuse_unknown();
        });
        return read;
    });
}

Result<bool> read_dry_run(const Request& request) { return read_flag(request, "dryRun"); }

Result<fleet::OrderQuery> read_order_query(const Request& request) {
    fleet::OrderQuery query;
    if (const auto text = request.query_value("state")) {
        auto states = read_states(*text);
        if (!states) return fail(states.error());
        query.states = std::move(*states);
    }
    query.vehicle = plant::VehicleId(request.query_value("vehicle").value_or(""));
    const auto removed = read_flag(request, "removed");
    if (!removed) return fail(removed.error());
    query.removed = *removed;
    const auto limit = read_limit(request);
    if (!limit) return fail(limit.error());
    query.limit = *limit;
    const auto before = read_cursor<fleet::JobOrderId>(request);
    if (!before) return fail(before.error());
    query.before = *before;
    return query;
}

Result<SheetsRequest> read_sheets(const Request& request) {
    SheetsRequest wanted;
    const std::string format = request.query_value("format").value_or("pdf");
    if (format == "pdf") {
        wanted.format = printing::SheetFormat::kPdf;
    } else if (format == "svg") {
        wanted.format = printing::SheetFormat::kSvg;
    } else if (format != "csv") {
        return fail(Errc::kInvalid, "unknown_value", "The format is pdf, svg or csv (the list).",
                    "?format", {{"value", format.substr(0, 64)}});
    }
    const auto text = request.query_value("stations");
    if (!text) return wanted;
    for (std::size_t at = 0; at <= text->size();) {
        const std::size_t end = std::min(text->find(',', at), text->size());
        const auto number = parse_integer(text->substr(at, end - at), 0, kMaxStation);
        if (!number) {
            return fail(Errc::kInvalid, "wrong_type",
                        "The stations are numbers with commas between them.", "?stations",
                        {{"expected", std::string("integers")}});
        }
        wanted.stations.push_back(static_cast<int>(*number));
        at = end + 1;
    }
    return wanted;
}

Result<fleet::StopQuery> read_stop_query(const Request& request) {
    fleet::StopQuery query;
    if (const Status ok = read_which_stops(request, query); !ok) return fail(ok.error());
    const auto before = read_cursor<fleet::StopRecordId>(request);
    if (!before) return fail(before.error());
    query.before = *before;
    return query;
}

Result<fleet::UnmeasuredQuery> read_unmeasured_query(const Request& request) {
    fleet::UnmeasuredQuery query;
    if (const Status ok = read_which_stops(request, query); !ok) return fail(ok.error());
    if (const auto text = request.query_value("cursor")) {
        query.before = parse_integer(*text, 0, std::numeric_limits<std::int64_t>::max());
        if (!query.before) return bad_cursor();
    }
    return query;
}

Result<std::optional<std::int64_t>> read_event_start(const Request& request) {
    const std::string& header = request.header("last-event-id");
    const bool in_header = !header.empty();
    const auto text = in_header ? std::optional<std::string>(header) : request.query_value("after");
    if (!text) return std::optional<std::int64_t>();
    const auto seq = parse_integer(*text, 0, std::numeric_limits<std::int64_t>::max());
    if (!seq) {
        return fail(Errc::kInvalid, "wrong_type",
                    "Name the sequence number of the last event you have, 0 for none.",
                    in_header ? "Last-Event-ID" : "?after", {{"expected", std::string("integer")}});
    }
    return seq;
}

}  // namespace pulseline::api
