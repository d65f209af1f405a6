#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>

#include "imaging/audit/stream_connection.h"

namespace tidemark::imaging {
namespace {

std::string tls_reason() {
  const char* text = ERR_reason_error_string(ERR_get_error());
  ERR_clear_error();
  return text != nullptr ? text : "unknown";
}

tl::unexpected<Error> no_certificate(const std::filesystem::path& file) {
  return fail(ErrorKind::input, "{}: no certificate can be read from it: {}", file.string(), tls_reason());
}

Status trust(SSL_CTX& context, const TlsFiles& tls, const std::string& host) {
  if (!tls.verify) {
    SSL_CTX_set_verify(&context, SSL_VERIFY_NONE, nullptr);
    return {};
  }
  SSL_CTX_set_verify(&context, SSL_VERIFY_PEER, nullptr);
  if (tls.ca.empty()) {
    SSL_CTX_set_default_verify_paths(&context);
  } else if (SSL_CTX_load_verify_locations(&context, tls.ca.c_str(), nullptr) != 1) {
    return no_certificate(tls.ca);
  }
  X509_VERIFY_PARAM* wanted = SSL_CTX_get0_param(&context);
  const bool by_number = X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1;
  if (!by_number && X509_VERIFY_PARAM_set1_host(wanted, host.c_str(), host.size()) != 1) {
    return fail(ErrorKind::internal, "the host {} cannot be verified", host);
  }
  return {};
}

Status show(SSL_CTX& context, const TlsFiles& tls) {
  if (tls.certificate.empty()) return {};
  // A key with a password must not make the library ask for it on the terminal.
  SSL_CTX_set_default_passwd_cb(&context, [](char*, int, int, void*) { return 0; });
  if (SSL_CTX_use_certificate_chain_file(&context, tls.certificate.c_str()) != 1) {
    return no_certificate(tls.certificate);
  }
  if (SSL_CTX_use_PrivateKey_file(&context, tls.key.c_str(), SSL_FILETYPE_PEM) != 1 &&
      ERR_GET_REASON(ERR_peek_error()) != X509_R_KEY_VALUES_MISMATCH) {
    return fail(ErrorKind::input, "{}: no private key can be read from it: {}", tls.key.string(),
                tls_reason());
  }
  if (SSL_CTX_check_private_key(&context) != 1) {
    ERR_clear_error();
    return fail(ErrorKind::input, "{}: is not the key of {}", tls.key.string(), tls.certificate.string());
  }
  return {};
}

}  // namespace

Result<TlsContext> make_tls_context(const TlsFiles& tls, const std::string& host) {
  const TlsContext context(SSL_CTX_new(TLS_client_method()), SSL_CTX_free);
  if (context == nullptr || SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION) != 1) {
    return fail(ErrorKind::capability, "TLS of BCP 195 is not to be had from this OpenSSL");
  }
  SSL_CTX_set_mode(context.get(), SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  // Who hangs up without a goodbye has hung up all the same: each message has its length.
  SSL_CTX_set_options(context.get(), SSL_OP_IGNORE_UNEXPECTED_EOF);
  TIDEMARK_TRY(trust(*context, tls, host));
  TIDEMARK_TRY(show(*context, tls));
  return context;
}

}  // namespace tidemark::imaging
