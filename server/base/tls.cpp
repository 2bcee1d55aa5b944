#include "server/base/tls.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <optional>

#include "server/base/server_clock.hpp"

namespace pulseline::server {
namespace {

constexpr std::int64_t kYear_s = 365L * 24 * 3600;

template <auto F>
struct Free {
    template <class T>
    void operator()(T* pointer) const {
        F(pointer);
    }
};
using Certificate = std::unique_ptr<X509, Free<X509_free>>;
using PrivateKey = std::unique_ptr<EVP_PKEY, Free<EVP_PKEY_free>>;
using File = std::unique_ptr<std::FILE, Free<std::fclose>>;

struct Pair {
    Certificate certificate;
    PrivateKey key;
};

std::string fingerprint(X509* certificate) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned length = 0;
    X509_digest(certificate, EVP_sha256(), digest.data(), &length);
    std::string text;
    for (unsigned i = 0; i < length; ++i) {
        text += fmt::format("{}{:02X}", i == 0 ? "" : ":", digest[i]);
    }
    return text;
}

bool add_names(X509* certificate, const std::string& host) {
    std::string names = "DNS:localhost,IP:127.0.0.1,IP:::1";
    const bool any = host == "0.0.0.0" || host == "::";
    error_code ec;
    net::ip::make_address(host, ec);
    if (!any) names += (ec ? ",DNS:" : ",IP:") + host;
    std::array<char, 256> own{};
    if (gethostname(own.data(), own.size() - 1) == 0 && own[0] != 0) {
        names += std::string(",DNS:") + own.data();
    }
    X509_EXTENSION* extension =
        X509V3_EXT_conf_nid(nullptr, nullptr, NID_subject_alt_name, names.c_str());
    if (!extension) return false;
    const bool added = X509_add_ext(certificate, extension, -1) == 1;
    X509_EXTENSION_free(extension);
    return added;
}

std::optional<Pair> self_signed(const std::string& host) {
    Pair pair;
    pair.key.reset(EVP_EC_gen("P-256"));
    pair.certificate.reset(X509_new());
    X509* certificate = pair.certificate.get();
    if (!pair.key || !certificate) return std::nullopt;
    std::uint64_t serial = 0;
    RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial);
    X509_set_version(certificate, 2);
    ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), serial >> 1U);
    const Validity validity = self_signed_validity(std::time(nullptr));
    ASN1_TIME_set(X509_getm_notBefore(certificate), validity.from_s);
    ASN1_TIME_set(X509_getm_notAfter(certificate), validity.until_s);
    X509_set_pubkey(certificate, pair.key.get());
    X509_NAME* name = X509_get_subject_name(certificate);
    const auto* text = reinterpret_cast<const unsigned char*>("Pulseline");
    X509_NAME_add_entry_by_txt(name, "CN", MBSTRING_ASC, text, -1, -1, 0);
    X509_set_issuer_name(certificate, name);
    if (!add_names(certificate, host) ||
        X509_sign(certificate, pair.key.get(), EVP_sha256()) == 0) {
        return std::nullopt;
    }
    return pair;
}

std::optional<Pair> load_pair(const std::string& path) {
    const File file(std::fopen(path.c_str(), "r"));
    if (!file) return std::nullopt;
    Pair pair;
    pair.key.reset(PEM_read_PrivateKey(file.get(), nullptr, nullptr, nullptr));
    pair.certificate.reset(PEM_read_X509(file.get(), nullptr, nullptr, nullptr));
    if (!pair.key || !pair.certificate ||
        X509_cmp_current_time(X509_get0_notAfter(pair.certificate.get())) <= 0) {
        return std::nullopt;
    }
    return pair;
}

bool save_pair(const Pair& pair, const std::string& path) {
    const int handle = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
    if (handle < 0) return false;
    const File file(::fdopen(handle, "w"));
    return file &&
           PEM_write_PrivateKey(file.get(), pair.key.get(), nullptr, nullptr, 0, nullptr,
                                nullptr) == 1 &&
           PEM_write_X509(file.get(), pair.certificate.get()) == 1;
}

}  // namespace

Validity self_signed_validity(std::int64_t utc_s) {
    const std::int64_t built_s = to_ns(ServerClock::built()) / 1'000'000'000;
    return {built_s - 24 * 3600, std::max(utc_s, built_s) + 3 * kYear_s};
}

Result<std::unique_ptr<Tls>> make_tls(const Options& options, const std::string& host) {
    auto tls = std::make_unique<Tls>();
    tls->context.set_options(ssl::context::default_workarounds | ssl::context::no_tlsv1 |
                             ssl::context::no_tlsv1_1);
    error_code ec;
    if (options.tls_self_signed) {
        const std::string path = options.database + ".tls.pem";
        auto pair = load_pair(path);
        if (!pair) {
            pair = self_signed(host);
            if (!pair || !save_pair(*pair, path)) {
                return fail(Errc::kUnavailable, "tls_unusable",
                            "the self-signed certificate cannot be kept in " + path +
                                "; check that its directory is writable");
            }
        }
        SSL_CTX_use_certificate(tls->context.native_handle(), pair->certificate.get());
        SSL_CTX_use_PrivateKey(tls->context.native_handle(), pair->key.get());
    } else {
        tls->context.use_certificate_chain_file(options.tls_cert, ec);
        if (ec) {
            return fail(Errc::kInvalid, "tls_unusable",
                        "--tls-cert " + options.tls_cert +
                            " is no readable PEM certificate: " + ec.message());
        }
        tls->context.use_private_key_file(options.tls_key, ssl::context::pem, ec);
        if (ec || SSL_CTX_check_private_key(tls->context.native_handle()) != 1) {
            return fail(
                Errc::kInvalid, "tls_unusable",
                "--tls-key " + options.tls_key + " is no readable PEM key of that certificate");
        }
    }
    tls->fingerprint = fingerprint(SSL_CTX_get0_certificate(tls->context.native_handle()));
    return tls;
}

}  // namespace pulseline::server
