#pragma once

#include <string>

#include "core/base/error.hpp"

namespace pulseline::api {

/// Errc::kNotFound with {id} as it was asked for, cut where it is too long to be one.
inline Error unknown(const char* code, const std::string& id, const char* what) {
    return {Errc::kNotFound, {code, {{"id", id.substr(0, 64)}}}, what, {}};
}

inline Error unknown_vehicle(const std::string& id) {
    return unknown("unknown_vehicle", id,
                   "There is no vehicle of that id; GET /api/v1/vehicles lists them.");
}

}  // namespace pulseline::api
