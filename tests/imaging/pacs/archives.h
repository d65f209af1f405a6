// Real archives, started on this machine for a test and ended with it.
#pragma once

#include <QProcess>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "imaging/pacs/configuration.h"
#include "tests/support/support.h"

namespace tidemark::test {

// A port of the loopback interface that nobody uses now.
int free_port();

// A program that serves until the object goes. Ends the test program when it cannot be started.
class Archive {
 public:
  Archive();
  virtual ~Archive();
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  // How it is reached; retrieval by get.
  [[nodiscard]] imaging::PacsServer server() const { return server_; }
  // The same, with calls to the port under which the archive knows us.
  [[nodiscard]] imaging::PacsServer server_by_move() const;

 protected:
  // Returns when it answers at its own port and at `also`.
  void start(const QString& program, const QStringList& arguments, const std::vector<int>& also = {});
  imaging::PacsServer server_;
  TemporaryFolder folder_;

 private:
  QProcess process_;
};

// In PEM.
struct TlsFiles {
  std::filesystem::path authority;  // of who may call
  std::filesystem::path certificate;
  std::filesystem::path key;
};
std::unique_ptr<Archive> start_orthanc(const TlsFiles* tls = nullptr);

// Orthanc with its plugin for DICOMweb beside DICOM's own protocol.
class WebArchive : public Archive {
 public:
  // By https where there are files for it; with a user's password in a file, which the user needs.
  WebArchive(const TlsFiles* tls, const std::string& user);
  ~WebArchive() override;
  [[nodiscard]] imaging::PacsServer web_server() const { return web_server_; }

 private:
  // Debian's Orthanc ends when it is asked by https: another program has the certificate, and passes bytes
  // on.
  void start_front(const TlsFiles& tls, int port, int to);
  imaging::PacsServer web_server_;
  QProcess front_;
};
std::unique_ptr<Archive> start_dcmqrscp();
// By "orthanc" or "dcmqrscp".
std::unique_ptr<Archive> start_archive(const QString& name);

// storescp, with arguments of the caller's.
class StoringPeer : public Archive {
 public:
  explicit StoringPeer(const QStringList& arguments);
  [[nodiscard]] std::filesystem::path received() const { return folder_ / "received"; }
};

}  // namespace tidemark::test
