#pragma once

#include <set>
#include <string>

#include "core/base/result.hpp"
#include "server/base/options.hpp"

namespace pulseline::server {

/// Reads a TOML file into `options`. Keys are the option names with underscores ("tls_cert");
/// those in `given` were set on the command line and win. An unknown key is an error.
Status read_config_file(const std::string& path, const std::set<std::string>& given,
                        Options& options);
/// The same of its text; errors name it `path`.
Status read_config(const std::string& path, const std::string& bytes,
                   const std::set<std::string>& given, Options& options);

}  // namespace pulseline::server
