#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace pulseline {

enum class Errc {
    kInvalid,      // the request itself is wrong
    kNotFound,     // it names something that does not exist
    kConflict,     // it does not fit the present state
    kStale,        // it was decided by what has changed meanwhile
    kUnreachable,  // no route or motion leads there
    kTimeout,
    kUnavailable,      // the store or a vehicle cannot answer now
    kUnauthenticated,  // nobody knows who asks
    kForbidden,
    kTooMany,     // whoever asks asks for too much at once
    kOverloaded,  // all together do
    kNeedsPlan,   // only a plan made beside the fleet can tell
    kInternal,    // a fault of the program's own
};

/// One named value that explains an error, a wait or an event. Screens translate `reason` codes and
/// fill these in; the server never sends prose that a screen has to show as it is.
using ParamValue = std::variant<bool, std::int64_t, double, std::string>;
struct Param {
    std::string name;  // SI unit in the name: "clearance_m"
    ParamValue value;
    friend bool operator==(const Param&, const Param&) = default;
};
using Params = std::vector<Param>;

/// A machine-readable "why": a stable snake_case code and its parameters.
struct Reason {
    std::string code;
    Params params;
    friend bool operator==(const Reason&, const Reason&) = default;
};

/// An expected failure. `reason.code` is stable and becomes the problem type of the API.
struct Error {
    Errc code = Errc::kInvalid;
    Reason reason;
    std::string what;   // one sentence for a person: what is wrong and the remedy
    std::string field;  // JSON pointer of the input at fault, empty when none is
};

}  // namespace pulseline
