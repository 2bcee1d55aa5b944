#include "server/base/proxies.hpp"

#include <algorithm>

namespace pulseline::server {
namespace {

/// Whether the first `bits` of two addresses are the same.
template <class Bytes>
bool same_start(const Bytes& a, const Bytes& b, unsigned bits) {
    for (std::size_t i = 0; i < a.size() && bits > 0; ++i) {
        const unsigned here = std::min(bits, 8U);
        const unsigned mask = 0xFFU & (0xFFU << (8U - here));
        if (((a[i] ^ b[i]) & mask) != 0) return false;
        bits -= here;
    }
    return true;
}

std::string trimmed(std::string text) {
    text.erase(0, std::min(text.find_first_not_of(" \t"), text.size()));
    text.erase(text.find_last_not_of(" \t") + 1);
    return text;
}

}  // namespace

net::ip::address plain_address(const net::ip::address& address) {
    if (!address.is_v6() || !address.to_v6().is_v4_mapped()) return address;
    return net::ip::make_address_v4(net::ip::v4_mapped, address.to_v6());
}

std::string neighbourhood(const std::string& peer) {
    error_code ec;
    const auto address = plain_address(net::ip::make_address(peer, ec));
    if (ec) return peer;
    if (address.is_v4()) return address.to_string();
    auto bytes = address.to_v6().to_bytes();
    std::fill(bytes.begin() + 8, bytes.end(), 0);
    return net::ip::address_v6(bytes).to_string() + "/64";
}

Result<TrustedProxies> TrustedProxies::parse(const std::vector<std::string>& texts) {
    TrustedProxies proxies;
    for (const auto& text : texts) {
        const auto slash = text.find('/');
        const auto bits = slash == std::string::npos ? std::string() : text.substr(slash + 1);
        error_code ec;
        const auto address = plain_address(net::ip::make_address(text.substr(0, slash), ec));
        const unsigned most = address.is_v4() ? 32 : 128;
        const bool number = bits.size() <= 3 &&
                            bits.find_first_not_of("0123456789") == std::string::npos &&
                            (slash == std::string::npos || !bits.empty());
        const unsigned size =
            number && !bits.empty() ? static_cast<unsigned>(std::stoul(bits)) : most;
        if (ec || !number || size > most) {
            return fail(Errc::kInvalid, "bad_option",
                        "--behind-proxy " + text +
                            " is no address; name the proxies, such as 127.0.0.1 or 10.0.0.0/24");
        }
        proxies.blocks_.push_back({address, size});
    }
    return proxies;
}

bool TrustedProxies::contains(const net::ip::address& address) const {
    return std::ranges::any_of(blocks_, [&](const Block& block) {
        if (block.address.is_v4() != address.is_v4()) return false;
        if (address.is_v4()) {
            return same_start(block.address.to_v4().to_bytes(), address.to_v4().to_bytes(),
                              block.bits);
        }
        return same_start(block.address.to_v6().to_bytes(), address.to_v6().to_bytes(), block.bits);
    });
}

bool TrustedProxies::contains(const std::string& peer) const {
    error_code ec;
    const auto address = net::ip::make_address(peer, ec);
    return !ec && contains(plain_address(address));
}

std::string TrustedProxies::client(const std::string& peer, const std::string& forwarded) const {
    std::string client = peer;
    std::size_t end = forwarded.size();
    while (contains(client) && end != std::string::npos && end > 0) {
        const auto comma = forwarded.rfind(',', end - 1);
        const auto begin = comma == std::string::npos ? 0 : comma + 1;
        error_code ec;
        const auto address =
            net::ip::make_address(trimmed(forwarded.substr(begin, end - begin)), ec);
        if (ec) break;  // a proxy that writes no address tells nothing
        client = plain_address(address).to_string();
        end = comma;
    }
    return client;
}

}  // namespace pulseline::server
