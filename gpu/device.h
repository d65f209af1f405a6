// One OpenGL context and everything that belongs to it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "core/result.h"
#include "gpu/capabilities.h"
#include "gpu/shader_source.h"

namespace tidemark::gpu {

enum class GlVersion { gl33, gl45 };

struct DeviceOptions {
  GlVersion version = GlVersion::gl45;  // a core context of exactly this version
  bool debug = false;                   // KHR_debug: messages are counted and logged, objects carry labels
  bool as_gpu = false;                  // tests: takes the paths of a GPU, even if a processor plays it
  // Tests: texels along an axis at most, of 2D and 3D textures; 0: as the driver says.
  std::int64_t largest_texture = 0;
  std::int64_t largest_volume_texture = 0;
};

// Objects that contexts of a share group have in common, and objects that belong to one context.
enum class SharedObject { texture, buffer, program, shader };
enum class ContextObject { vertex_array, framebuffer };

// Used on one thread at a time. Handles (handles.h) must die before their device.
class Device {
 public:
  // A context without a window (EGL, surfaceless). Fails (ErrorKind::capability) and says what is missing.
  static Result<std::shared_ptr<Device>> create_headless(const DeviceOptions& options);
  // Takes the context that is current on this thread, which its owner keeps and makes current.
  static Result<std::shared_ptr<Device>> adopt_current(const DeviceOptions& options);

  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;
  ~Device();

  [[nodiscard]] const Capabilities& capabilities() const { return capabilities_; }
  [[nodiscard]] bool debugging() const { return debug_; }

  // Makes a headless context current on this thread; an adopted one must be.
  Status make_current();

  // Whether everything up to here worked: no GL error, memory, no lost context. `stage` is for the message.
  // Fails with ErrorKind::capability; a lost context stays lost.
  Status check(std::string_view stage);
  [[nodiscard]] bool lost() const { return lost_; }

  // Tests: the context counts as lost at the n-th check from now (1: the next one).
  void lose_at_check(std::int64_t n) { checks_until_loss_ = n; }

  // Messages of high severity since the start; 0 unless debugging.
  [[nodiscard]] std::int64_t severe_messages() const { return severe_messages_; }
  // Where debug messages go: severe or not, and the text. By default they are only counted.
  void on_message(std::function<void(bool severe, const std::string& text)> sink) { sink_ = std::move(sink); }
  // Sends a message of our own there: all messages of a compiler.
  void report_message(const std::string& text) const {
    if (sink_) sink_(false, text);
  }

  // Tests: called with each program before it is compiled. Its failure is the program's.
  void on_program(std::function<Status(const ProgramSource&)> listener) { programs_ = std::move(listener); }
  Status announce(const ProgramSource& program) const { return programs_ ? programs_(program) : Status(); }

  // For the handles. Nothing is deleted in a lost context: its objects went with it.
  void destroy(SharedObject kind, unsigned id);
  void destroy(ContextObject kind, unsigned id);
  void count_handle(int change) { handles_ += change; }
  [[nodiscard]] std::int64_t handles() const { return handles_; }

 private:
  struct Headless;  // EGL's objects

  Device() = default;
  Status start(const DeviceOptions& options);
  static void receive_message(unsigned source, unsigned type, unsigned id, unsigned severity, int length,
                              const char* text, const void* device);

  std::unique_ptr<Headless> headless_;
  Capabilities capabilities_;
  bool debug_ = false;
  bool lost_ = false;
  std::int64_t checks_until_loss_ = 0;
  std::int64_t severe_messages_ = 0;
  std::int64_t handles_ = 0;
  std::function<void(bool, const std::string&)> sink_;
  std::function<Status(const ProgramSource&)> programs_;
};

}  // namespace tidemark::gpu
