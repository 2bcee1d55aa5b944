#include "api/http/orders/order_requests.hpp"

#include <algorithm>

#include "api/http/orders/order_body.hpp"
#include "api/http/wire/asker.hpp"
#include "api/http/wire/body.hpp"
#include "api/http/wire/query.hpp"

namespace pulseline::api {
namespace {

using json::FieldErrors;
using json::ObjectReader;

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

}  // namespace

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

}  // namespace pulseline::api
