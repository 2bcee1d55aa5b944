#include "server/sessions/origins.hpp"

#include <ifaddrs.h>
#include <netdb.h>
#include <unistd.h>

#include <array>
#include <memory>

namespace pulseline::server {
namespace {

std::vector<std::string> hosts_of_this_machine() {
    std::vector<std::string> hosts = {"localhost", "127.0.0.1", "::1"};
    std::array<char, 256> name{};
    if (gethostname(name.data(), name.size() - 1) == 0 && name[0] != 0) {
        hosts.emplace_back(name.data());
    }
    ifaddrs* list = nullptr;
    if (getifaddrs(&list) != 0) return hosts;
    for (const ifaddrs* entry = list; entry; entry = entry->ifa_next) {
        if (!entry->ifa_addr) continue;
        const int family = entry->ifa_addr->sa_family;
        if (family != AF_INET && family != AF_INET6) continue;
        const socklen_t size = family == AF_INET ? sizeof(sockaddr_in) : sizeof(sockaddr_in6);
        std::array<char, NI_MAXHOST> text{};
        if (getnameinfo(entry->ifa_addr, size, text.data(), text.size(), nullptr, 0,
                        NI_NUMERICHOST) == 0) {
            hosts.emplace_back(text.data());
        }
    }
    freeifaddrs(list);
    return hosts;
}

}  // namespace

std::vector<std::string> allowed_origins(const Options& options, const Address& bound) {
    std::vector<std::string> origins = options.allow_origins;
    if (!options.behind_proxy.empty()) return origins;  // only the proxy's public name counts
    const std::string scheme = options.tls() ? "https" : "http";
    const bool standard = bound.port == (options.tls() ? 443 : 80);
    const auto add = [&](const std::string& host) {
        const bool six = host.find(':') != std::string::npos;
        std::string origin = scheme + "://" + (six ? "[" + host + "]" : host);
        if (!standard) origin += ":" + std::to_string(bound.port);
        origins.push_back(std::move(origin));
    };
    error_code ec;
    const auto ip = net::ip::make_address(bound.host, ec);
    if (ip.is_unspecified()) {
        for (const auto& host : hosts_of_this_machine()) add(host);
    } else {
        add(bound.host);
        if (ip.is_loopback()) add("localhost");
    }
    return origins;
}

}  // namespace pulseline::server
