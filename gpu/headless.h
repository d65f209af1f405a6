// A context without a window, by EGL. Private to this folder.
#pragma once

#include "gpu/device.h"

namespace tidemark::gpu {

class HeadlessContext {
 public:
  static Result<HeadlessContext> create(const DeviceOptions& options);
  HeadlessContext(HeadlessContext&& other) noexcept;
  HeadlessContext& operator=(HeadlessContext&&) = delete;
  ~HeadlessContext();

  Status make_current() const;

 private:
  HeadlessContext(void* display, void* context) : display_(display), context_(context) {}

  void* display_;  // EGLDisplay; shared by the process and never terminated
  void* context_;  // EGLContext
};

struct Device::Headless {
  HeadlessContext context;
};

}  // namespace tidemark::gpu
