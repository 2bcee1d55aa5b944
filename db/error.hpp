#pragma once

#include <stdexcept>
#include <string>

namespace pulseline::db {

/// The database is broken, full, locked or not ours: nothing was stored. `what()` names the path
/// and the remedy. Expected outcomes (no such row) are no errors.
class Error : public std::runtime_error {
public:
    enum class Kind { kLocked, kUnusable, kTooNew, kFailed, kFull, kReadOnly, kBadValue };

    Error(Kind kind, const std::string& what) : std::runtime_error(what), kind_(kind) {}
    Kind kind() const { return kind_; }

private:
    Kind kind_;
};

}  // namespace pulseline::db
