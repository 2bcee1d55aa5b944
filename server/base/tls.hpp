#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "core/base/result.hpp"
#include "server/base/net.hpp"
#include "server/base/options.hpp"

namespace pulseline::server {

struct Tls {
    ssl::context context{ssl::context::tls_server};
    std::string fingerprint;  // SHA-256 of the certificate, "AB:CD:..."
};

/// Seconds of UTC between which a self-signed certificate is good.
struct Validity {
    std::int64_t from_s = 0;
    std::int64_t until_s = 0;
};
/// For one made when the machine's clock says `utc_s`. It is kept for years: one that was made
/// while that clock stood in 1970, or ahead, has to be good by a right one, too.
Validity self_signed_validity(std::int64_t utc_s);

/// From the named files, or self-signed for the host of the listen address. A self-signed one is
/// kept beside the database, so that its fingerprint stays.
Result<std::unique_ptr<Tls>> make_tls(const Options& options, const std::string& host);

}  // namespace pulseline::server
