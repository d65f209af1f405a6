#include "imaging/pacs/transport.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmnet/dcmlayer.h>
#include <dcmtk/dcmnet/dcmtrans.h>
#include <dcmtk/dcmtls/tlslayer.h>
#include <dcmtk/dcmtls/tlstrans.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <openssl/ssl.h>
#include <sys/socket.h>

#include <utility>

namespace tidemark::imaging {
namespace {

constexpr auto kProfile = TSP_Profile_BCP195;

// An IPv4 address, which is no server name for TLS.
bool is_address(const std::string& host) {
  return host.find_first_not_of("0123456789.") == std::string::npos;
}

using NextWatch = std::function<std::shared_ptr<ConnectionWatch>()>;

// A connection of DCMTK's that reports its waiting and its bytes to the watch.
template <class Connection>
class Watched final : public Connection {
 public:
  template <class... Arguments>
  Watched(std::shared_ptr<ConnectionWatch> watch, DcmNativeSocketType socket, Arguments... arguments)
      : Connection(socket, arguments...), watch_(std::move(watch)) {
    watch_->opened(socket);
    set(TCP_NODELAY);
  }
  // Here, where closing still is ours: the base's destructor would close without the watch.
  ~Watched() override { Watched::close(); }
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  OFCondition clientSideHandshake() override {
    const ConnectionWatch::Wait wait(*watch_);
    return Connection::clientSideHandshake();
  }
  OFCondition serverSideHandshake() override {
    const ConnectionWatch::Wait wait(*watch_);
    return Connection::serverSideHandshake();
  }
  OFBool networkDataAvailable(int seconds) override {
    const ConnectionWatch::Wait wait(*watch_);
    return Connection::networkDataAvailable(seconds);
  }
  ssize_t read(void* bytes, size_t count) override {
    const ConnectionWatch::Wait wait(*watch_);
    set(TCP_QUICKACK);  // it lasts for a while only
    const ssize_t got = Connection::read(bytes, count);
    if (got > 0 && !watch_->received(got)) return 0;  // as if the peer had hung up
    return got;
  }
  ssize_t write(void* bytes, size_t count) override {
    const ConnectionWatch::Wait wait(*watch_);
    const ssize_t put = Connection::write(bytes, count);
    if (put > 0) watch_->sent(put);
    return put;
  }
  void close() override {
    const ConnectionWatch::Wait wait(*watch_);  // TLS says goodbye
    Connection::close();
  }
  void closeTransportConnection() override {
    watch_->closing();
    Connection::closeTransportConnection();
  }

 private:
  // A message is written in pieces, so that by default either side waits some 40 ms in each for the other's
  // receipt.
  void set(int option) {
    const int on = 1;
    ::setsockopt(this->getSocket(), IPPROTO_TCP, option, &on, sizeof(on));
  }

  std::shared_ptr<ConnectionWatch> watch_;
};

class PlainTransport final : public DcmTransportLayer {
 public:
  explicit PlainTransport(NextWatch next_watch) : next_watch_(std::move(next_watch)) {}
  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool /*secure*/) override {
    return new Watched<DcmTCPConnection>(next_watch_(), socket);
  }

 private:
  NextWatch next_watch_;
};

class TlsTransport final : public DcmTLSTransportLayer {
 public:
  TlsTransport(TransportRole whose, std::string host, NextWatch next_watch)
      : DcmTLSTransportLayer(whose == TransportRole::caller ? NET_REQUESTOR : NET_ACCEPTOR, nullptr, OFTrue),
        host_(whose == TransportRole::caller ? std::move(host) : std::string()),
        next_watch_(std::move(next_watch)) {}

  DcmTransportConnection* createConnection(DcmNativeSocketType socket, OFBool /*secure*/) override {
    SSL* tls = SSL_new(getNativeHandle());
    if (tls == nullptr) return nullptr;
    SSL_set_fd(tls, socket);
    if (!host_.empty() && !is_address(host_)) SSL_set_tlsext_host_name(tls, host_.c_str());
    return new Watched<DcmTLSConnection>(next_watch_(), socket, tls);
  }

 private:
  std::string host_;
  NextWatch next_watch_;
};

// The trusted certificates, and the host that they must be for.
Status set_up_verification(TlsTransport& transport, const TlsFiles& tls, TransportRole role,
                           const std::string& host) {
  SSL_CTX* context = transport.getNativeHandle();
  if (!tls.verify) {
    transport.setCertificateVerification(DCV_ignoreCertificate);
    return {};
  }
  transport.setCertificateVerification(DCV_requireCertificate);
  if (tls.ca.empty()) {
    SSL_CTX_set_default_verify_paths(context);
  } else if (const OFCondition added = transport.addTrustedCertificateFile(tls.ca.c_str(), DCF_Filetype_PEM);
             added.bad()) {
    return fail(ErrorKind::input, "{}: no certificate can be read from it: {}", tls.ca.string(),
                added.text());
  }
  if (role == TransportRole::called) return {};
  // DCMTK checks the chain alone: any other certificate of the same authority would do.
  X509_VERIFY_PARAM* wanted = SSL_CTX_get0_param(context);
  const bool by_number = X509_VERIFY_PARAM_set1_ip_asc(wanted, host.c_str()) == 1;
  if (!by_number && X509_VERIFY_PARAM_set1_host(wanted, host.c_str(), host.size()) != 1) {
    return fail(ErrorKind::internal, "the host {} cannot be verified", host);
  }
  return {};
}

// DCMTK 3.6.9 wants the profile, too.
template <class Transport>
OFCondition read_certificate(Transport& transport, const std::filesystem::path& file) {
  constexpr auto kType = DCF_Filetype_PEM;
  if constexpr (requires { transport.setCertificateFile(file.c_str(), kType, kProfile); }) {
    return transport.setCertificateFile(file.c_str(), kType, kProfile);
  } else {
    return transport.setCertificateFile(file.c_str(), kType);
  }
}

Status set_up_own_certificate(TlsTransport& transport, const TlsFiles& tls) {
  if (tls.certificate.empty()) return {};
  // A key with a password must not make the library ask for it on the terminal.
  transport.setPrivateKeyPasswd("");
  if (const OFCondition read = transport.setPrivateKeyFile(tls.key.c_str(), DCF_Filetype_PEM); read.bad()) {
    return fail(ErrorKind::input, "{}: no private key can be read from it: {}", tls.key.string(),
                read.text());
  }
  if (const OFCondition read = read_certificate(transport, tls.certificate); read.bad()) {
    return fail(ErrorKind::input, "{}: no certificate can be read from it: {}", tls.certificate.string(),
                read.text());
  }
  if (!transport.checkPrivateKeyMatchesCertificate()) {
    return fail(ErrorKind::input, "{}: is not the key of {}", tls.key.string(), tls.certificate.string());
  }
  return {};
}

}  // namespace

Result<std::unique_ptr<DcmTransportLayer>> make_transport(const std::optional<TlsFiles>& tls,
                                                          TransportRole role, const std::string& host,
                                                          NextWatch next_watch) {
  if (!tls) return std::make_unique<PlainTransport>(std::move(next_watch));
  auto transport = std::make_unique<TlsTransport>(role, host, std::move(next_watch));
  TIDEMARK_TRY(set_up_verification(*transport, *tls, role, host));
  TIDEMARK_TRY(set_up_own_certificate(*transport, *tls));
  const OFCondition chosen = transport->setTLSProfile(kProfile);
  if (chosen.bad() || transport->activateCipherSuites().bad()) {
    return fail(ErrorKind::capability, "TLS of BCP 195 is not to be had from this OpenSSL");
  }
  return transport;
}

}  // namespace tidemark::imaging
