#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "core/base/error.hpp"

namespace pulseline {

/// An expected failure is a value. tl::expected until std::expected can take its place.
template <class T>
using Result = tl::expected<T, Error>;
using Status = Result<void>;

inline tl::unexpected<Error> fail(Error error) { return tl::unexpected<Error>(std::move(error)); }

inline tl::unexpected<Error> fail(Errc code, std::string reason, std::string what,
                                  std::string field = {}, Params params = {}) {
    return fail(Error{code, Reason{std::move(reason), std::move(params)}, std::move(what),
                      std::move(field)});
}

}  // namespace pulseline
