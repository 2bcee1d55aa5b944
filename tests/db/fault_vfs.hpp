#pragma once

#include <cstdint>
#include <vector>

namespace pulseline::db::testing {

/// A file system for SQLite that fails when told to: it wraps the machine's own and becomes the
/// default one. Counts every call that changes or locks something; one of them, by its number, and
/// as many after it as wanted go wrong. Thread safety: all functions.
class FaultVfs {
public:
    enum class Call { kOpen, kWrite, kTruncate, kSync, kLock, kShared, kDelete };
    enum class Kind { kIo, kFull, kShortWrite };  // the last two concern writes only
    struct Plan {
        std::int64_t at = 0;  // number of the first call that fails, from 1; 0: none
        std::int64_t calls = 1;
        Kind kind = Kind::kIo;
    };

    /// Makes it the default for all connections opened from now on.
    static void install();
    /// Counts from the start again.
    static void begin(const Plan& plan);
    /// Nothing fails any more.
    static void heal();
    static std::int64_t faults();
    static std::vector<Call> calls();  // since begin()
};

}  // namespace pulseline::db::testing
