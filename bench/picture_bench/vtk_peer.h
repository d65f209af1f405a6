// One of VTK's ray casters, in a process of its own that draws on request.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "core/result.h"
#include "core/volume.h"
#include "renderer/views.h"

namespace tidemark::bench {

class VtkPeer {
 public:
  enum class Mapper { processor, opengl };
  // `folder` is for the volume, whose values are rounded; VTK draws it along the patient's axes. Fails
  // (ErrorKind::usage) for values that 16 bits do not hold, (ErrorKind::capability) where Python has no VTK.
  static Result<std::unique_ptr<VtkPeer>> start(Mapper mapper, const Volume& volume,
                                                const std::filesystem::path& folder,
                                                const std::string& python);
  ~VtkPeer();
  VtkPeer(const VtkPeer&) = delete;
  VtkPeer& operator=(const VtkPeer&) = delete;

  [[nodiscard]] const std::string& version() const { return version_; }

  struct Drawing {
    double seconds = 0.0;
    double first_seconds = 0.0;  // of the first picture with this function, which prepares for it
  };
  // Draws with shading, one ray a pixel, a sample each `step_mm`; the picture is left in `file`, as PNG.
  Result<Drawing> draw(const renderer::TransferFunction& function, std::int64_t side, double step_mm,
                       double half_height_mm, const renderer::Camera& camera,
                       const std::filesystem::path& file);

 private:
  VtkPeer() = default;
  Result<std::string> ask(const std::string& line);

  int to_peer_ = -1;
  int from_peer_ = -1;
  int process_ = -1;
  std::string version_;
  double low_ = 0.0;  // of the volume's values
  double high_ = 0.0;
};

}  // namespace tidemark::bench
