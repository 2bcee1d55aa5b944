#include "server/base/store_fault.hpp"

#include "db/error.hpp"

namespace pulseline::server {
namespace {

constexpr const char* kRetry =
    "Reading goes on, and the server tries again by itself every second.";

Error refusal(const std::optional<fleet::StoreFault>& fault, std::string what, Params more) {
    Params params{{"retry_after_s", std::int64_t{2}}};
    params.insert(params.end(), more.begin(), more.end());
    if (fault) {
        params.push_back({"cause", fault->cause});
        if (fault->cause == "disk_full") {
            what += "Its disk is full: free space there. ";
        } else if (fault->cause == "write_protected") {
            what += "It is write-protected: make the file and its folder writable. ";
        } else if (fault->cause == "disk_hangs") {
            what += "Its disk does not answer: look at it, and at the network if it is elsewhere. ";
        } else if (fault->cause == "internal") {
            what += "The server met a fault of its own: its log says which. ";
        } else {
            what += "Its disk reports a fault: look at it and at the server's log. ";
        }
    }
    return {Errc::kUnavailable, {"store_unavailable", std::move(params)}, what + kRetry, {}};
}

std::string cause_of(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const db::Error& e) {
        if (e.kind() == db::Error::Kind::kFull) return "disk_full";
        if (e.kind() == db::Error::Kind::kReadOnly) return "write_protected";
    } catch (const StoreHangs&) {
        return "disk_hangs";
    } catch (...) {
    }
    return "disk_error";
}

}  // namespace

WriteFailure write_failure(const std::exception_ptr& error) {
    return {cause_of(error), what(error)};
}

Error store_unavailable(const std::optional<fleet::StoreFault>& fault) {
    return refusal(fault, "The database cannot be written now, so nothing was changed. ", {});
}

Error outcome_unknown(const std::optional<fleet::StoreFault>& fault) {
    return refusal(fault,
                   "The database did not confirm this in time, so it is unknown whether it is "
                   "kept. Ask again with the same Idempotency-Key, or look before you repeat it. ",
                   {{"outcome", std::string("unknown")}});
}

std::string what(const std::exception_ptr& error) {
    try {
        std::rethrow_exception(error);
    } catch (const std::exception& e) {
        return e.what();
    } catch (...) {
        return "unknown exception";
    }
}

}  // namespace pulseline::server
