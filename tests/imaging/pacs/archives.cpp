#include "tests/imaging/pacs/archives.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QFile>
#include <QStandardPaths>
#include <QThread>
#include <algorithm>

namespace tidemark::test {
namespace {

namespace fs = std::filesystem;

constexpr int kLongestStart = 60'000;  // ms, also on a busy machine
constexpr const char* kOwnTitle = "TIDEMARK";

bool answers(int port) {
  const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool connected = ::connect(probe, reinterpret_cast<sockaddr*>(&address), sizeof(address)) == 0;
  ::close(probe);
  return connected;
}

QString path_of(const QString& program) {
  const QString found = QStandardPaths::findExecutable(program);
  if (!found.isEmpty()) return found;
  return QStandardPaths::findExecutable(program, {"/usr/sbin", "/usr/local/sbin"});
}

void write_text(const fs::path& file, const std::string& text) {
  QFile opened(QString::fromStdString(file.string()));
  if (!opened.open(QIODevice::WriteOnly) || opened.write(text.data(), static_cast<qint64>(text.size())) < 0)
    qFatal("cannot write %s", file.c_str());
}

// Orthanc's configuration; `more` ends with a comma.
std::string orthanc_configuration(const fs::path& folder, const imaging::PacsServer& server,
                                  const std::string& more, bool calls_by_tls) {
  return fmt::format(R"({{
  "Name": "Test", "StorageDirectory": "{0}/storage", "IndexDirectory": "{0}/index", {5}
  "DicomAet": "ORTHANC", "DicomCheckCalledAet": true, "DicomPort": {1},
  "DicomModalities": {{ "tidemark": {{ "AET": "{2}", "Host": "127.0.0.1", "Port": {3}, "UseDicomTls": {4} }} }}
}})",
                     folder.string(), server.port, kOwnTitle, server.move_port, calls_by_tls, more);
}

class Orthanc : public Archive {
 public:
  explicit Orthanc(const TlsFiles* tls) {
    server_.name = "orthanc";
    server_.ae_title = "ORTHANC";
    const fs::path configuration = folder_ / "orthanc.json";
    std::string more = R"("HttpServerEnabled": false, "RemoteAccessAllowed": false, "Plugins": [],)";
    if (tls != nullptr) {
      more += fmt::format(R"("DicomTlsEnabled": true, "DicomTlsCertificate": "{}", "DicomTlsPrivateKey": "{}",
  "DicomTlsTrustedCertificates": "{}",)",
                          tls->certificate.string(), tls->key.string(), tls->authority.string());
    }
    write_text(configuration, orthanc_configuration(folder_.path(), server_, more, tls != nullptr));
    start("Orthanc", {QString::fromStdString(configuration.string())});
  }
};

class Dcmqrscp : public Archive {
 public:
  Dcmqrscp() {
    server_.name = "dcmqrscp";
    server_.ae_title = "ARCHIVE";
    const fs::path storage = folder_ / "storage";
    fs::create_directories(storage);
    const fs::path configuration = folder_ / "dcmqrscp.cfg";
    write_text(configuration,
               fmt::format("NetworkTCPPort = {}\nMaxPDUSize = 16384\nMaxAssociations = 16\n"
                           "HostTable BEGIN\n{} = ({}, 127.0.0.1, {})\nHostTable END\n"
                           "VendorTable BEGIN\nVendorTable END\n"
                           "AETable BEGIN\nARCHIVE {} RW (100, 1024mb) ANY\nAETable END\n",
                           server_.port, "tidemark", kOwnTitle, server_.move_port, storage.string()));
    start("dcmqrscp", {"-c", QString::fromStdString(configuration.string())});
  }
};

}  // namespace

int free_port() {
  const int probe = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof(address);
  const bool found = ::bind(probe, reinterpret_cast<sockaddr*>(&address), size) == 0 &&
                     ::getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size) == 0;
  ::close(probe);
  if (!found) qFatal("no free port on the loopback interface");
  return ntohs(address.sin_port);
}

Archive::Archive() {
  server_.host = "localhost";
  server_.port = free_port();
  server_.own_ae_title = kOwnTitle;
  server_.move_port = free_port();
}

Archive::~Archive() {
  process_.terminate();
  if (!process_.waitForFinished(5000)) process_.kill();
  process_.waitForFinished(5000);
}

void Archive::start(const QString& program, const QStringList& arguments, const std::vector<int>& also) {
  const QString path = path_of(program);
  if (path.isEmpty()) qFatal("%s is not installed: packaging/dependencies.sh has it", qPrintable(program));
  process_.setProcessChannelMode(QProcess::MergedChannels);
  process_.setStandardOutputFile(QString::fromStdString((folder_ / "log.txt").string()));
  process_.start(path, arguments);
  QElapsedTimer timer;
  for (timer.start(); timer.elapsed() < kLongestStart; QThread::msleep(50)) {
    if (!process_.waitForStarted(5000) || process_.state() != QProcess::Running) break;
    if (answers(server_.port) && std::ranges::all_of(also, answers)) return;
    process_.waitForFinished(1);  // notices when it has ended
  }
  QFile log(QString::fromStdString((folder_ / "log.txt").string()));
  static_cast<void>(log.open(QIODevice::ReadOnly));
  qFatal("%s does not serve: %s", qPrintable(program), log.readAll().constData());
}

WebArchive::WebArchive(const TlsFiles* tls, const std::string& user) {
  constexpr const char* kPlugin = "/usr/share/orthanc/plugins/libOrthancDicomWeb.so";
  if (!fs::exists(kPlugin)) qFatal("orthanc-dicomweb is not installed: packaging/dependencies.sh has it");
  const int port = free_port();
  const int called = tls != nullptr ? free_port() : port;
  server_.name = "orthanc";
  server_.ae_title = "ORTHANC";
  web_server_.name = "web";
  web_server_.timeout_seconds = 20;
  imaging::WebAccess& web = web_server_.web.emplace();
  web.url = fmt::format("{}://localhost:{}/dicom-web", tls != nullptr ? "https" : "http", called);
  std::string more = fmt::format(
      R"("DefaultEncoding": "Utf8", "HttpServerEnabled": true, "RemoteAccessAllowed": true, "HttpPort": {}, "Plugins": ["{}"],
  "AuthenticationEnabled": {},)",
      port, kPlugin, !user.empty());
  if (!user.empty()) {
    web.user = user;
    web.secret = folder_ / "secret.txt";
    write_text(web.secret, "Grüße & more\n");
    more += fmt::format(R"("RegisteredUsers": {{ "{}": "Grüße & more" }},)", user);
  }
  const fs::path configuration = folder_ / "orthanc.json";
  write_text(configuration, orthanc_configuration(folder_.path(), server_, more, false));
  start("Orthanc", {QString::fromStdString(configuration.string())}, {port});
  if (tls != nullptr) start_front(*tls, called, port);
}

WebArchive::~WebArchive() {
  front_.kill();
  front_.waitForFinished(5000);
}

void WebArchive::start_front(const TlsFiles& tls, int port, int to) {
  web_server_.tls = imaging::TlsFiles{tls.authority, {}, {}, true};
  front_.start("python3",
               {TIDEMARK_TLS_FRONT, QString::number(port), QString::number(to),
                QString::fromStdString(tls.certificate.string()), QString::fromStdString(tls.key.string())});
  if (!front_.waitForReadyRead(kLongestStart)) qFatal("tls_front.py does not serve");
}

imaging::PacsServer Archive::server_by_move() const {
  imaging::PacsServer server = server_;
  server.retrieve = imaging::PacsServer::Retrieve::move;
  return server;
}

StoringPeer::StoringPeer(const QStringList& arguments) {
  server_.name = "storescp";
  server_.ae_title = "STORESCP";
  fs::create_directories(received());
  start("storescp", arguments + QStringList{"-od", QString::fromStdString(received().string()),
                                            QString::number(server_.port)});
}

std::unique_ptr<Archive> start_orthanc(const TlsFiles* tls) {
  return std::make_unique<Orthanc>(tls);
}

std::unique_ptr<Archive> start_dcmqrscp() {
  return std::make_unique<Dcmqrscp>();
}

std::unique_ptr<Archive> start_archive(const QString& name) {
  return name == "orthanc" ? start_orthanc() : start_dcmqrscp();
}

}  // namespace tidemark::test
