#pragma once

#include <string>
#include <vector>

#include "core/base/result.hpp"
#include "server/base/net.hpp"

namespace pulseline::server {

/// The address as it is meant: "::ffff:10.0.0.1" is 10.0.0.1.
net::ip::address plain_address(const net::ip::address& address);

/// What one person or attacker has at hand: an IPv4 address, or the /64 of an IPv6 address. What is
/// no address counts as it is.
std::string neighbourhood(const std::string& peer);

/// The proxies in front of the server whose X-Forwarded headers are believed. Anybody else's could
/// name any address.
class TrustedProxies {
public:
    TrustedProxies() = default;
    /// Addresses and blocks ("10.0.0.2", "10.1.0.0/16", "fd00::/8").
    static Result<TrustedProxies> parse(const std::vector<std::string>& texts);

    bool empty() const { return blocks_.empty(); }
    bool contains(const std::string& peer) const;
    /// Who asks, by X-Forwarded-For as a trusted `peer` sent it: the last address in it that is no
    /// proxy of ours.
    std::string client(const std::string& peer, const std::string& forwarded_for) const;

private:
    struct Block {
        net::ip::address address;
        unsigned bits = 0;
    };
    bool contains(const net::ip::address& address) const;

    std::vector<Block> blocks_;
};

}  // namespace pulseline::server
