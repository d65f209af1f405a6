#include "tests/imaging/pacs/certificates.h"

#include <QProcess>

namespace tidemark::test {
namespace {

QString text(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

void openssl(const QStringList& arguments) {
  QProcess process;
  process.start("openssl", arguments);
  if (!process.waitForFinished(60'000) || process.exitCode() != 0)
    qFatal("openssl %s: %s", qPrintable(arguments.join(' ')), process.readAllStandardError().constData());
}

}  // namespace

Certificates::Certificates() {
  openssl({"req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "2", "-subj", "/CN=Test authority",
           "-keyout", text(folder_ / "ca.key"), "-out", text(authority())});
}

Certificates::Pair Certificates::signed_for(const std::string& host) const {
  const bool is_address = host.find_first_not_of("0123456789.") == std::string::npos;
  const QString name = QString::fromStdString((is_address ? "IP:" : "DNS:") + host);
  const Pair pair{folder_ / (host + ".pem"), folder_ / (host + ".key")};
  openssl({"req",
           "-x509",
           "-newkey",
           "rsa:2048",
           "-nodes",
           "-days",
           "2",
           "-subj",
           "/CN=" + QString::fromStdString(host),
           "-addext",
           "subjectAltName=" + name,
           "-addext",
           "basicConstraints=critical,CA:FALSE",
           "-CA",
           text(authority()),
           "-CAkey",
           text(folder_ / "ca.key"),
           "-keyout",
           text(pair.key),
           "-out",
           text(pair.certificate)});
  return pair;
}

}  // namespace tidemark::test
