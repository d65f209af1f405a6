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
  void start(const QString& program, const QStringList& arguments);
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
