// A server with models that tests start, and volumes to ask it about.
#pragma once

#include <QProcess>
#include <filesystem>
#include <string>

#include "core/volume.h"
#include "imaging/ai/ai_services.h"
#include "tests/support/support.h"

namespace tidemark::test {

// Runs model_server.py on a free port of the loopback interface. Ends the test where it cannot be started.
class ModelServer {
 public:
  // "monai-label", "dls" or "dls-old", which knows one model and none of the paths v2/.
  explicit ModelServer(const std::string& protocol);
  ~ModelServer();
  ModelServer(const ModelServer&) = delete;
  ModelServer& operator=(const ModelServer&) = delete;

  [[nodiscard]] imaging::AiServer server() const { return server_; }
  // All requests that have come, one after the other, as they were sent.
  [[nodiscard]] std::string heard() const;
  // A file of servers with this one.
  void write_configuration(const std::filesystem::path& file) const;

 private:
  TemporaryFolder requests_;
  QProcess process_;
  imaging::AiServer server_;
};

// The model of that name; ends the test when the server has none.
imaging::AiModel model_of(const imaging::AiServer& server, const std::string& name);

// Two balls of different brightness, 400 and 900 in air of -100, on a grid that is oblique and anisotropic.
Volume oblique_balls();
inline constexpr Index3 kDimBall{8, 9, 5};  // its middle
inline constexpr Index3 kBrightBall{24, 9, 5};
inline constexpr Index3 kAir{1, 1, 0};
// The voxels of a value.
Mask voxels_of(const Volume& volume, float value);

}  // namespace tidemark::test
