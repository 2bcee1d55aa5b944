#pragma once

#include <memory>
#include <string>

#include "core/base/result.hpp"
#include "server/net.hpp"
#include "server/options.hpp"

namespace pulseline::server {

struct Tls {
    ssl::context context{ssl::context::tls_server};
    std::string fingerprint;  // SHA-256 of the certificate, "AB:CD:..."
};

/// From the named files, or self-signed for the host of the listen address. A self-signed one is
/// kept beside the database, so that its fingerprint stays.
Result<std::unique_ptr<Tls>> make_tls(const Options& options, const std::string& host);

}  // namespace pulseline::server
