// Move-only owners of GL objects' names. Objects that contexts share and objects that they do not are of
// different types, because the latter may only be used and deleted where they were made.
#pragma once

#include <memory>
#include <utility>

#include "gpu/device.h"

namespace tidemark::gpu {

template <auto kKind>
class Handle {
 public:
  Handle() = default;
  Handle(Device& device, unsigned id) : device_(&device), id_(id) { device.count_handle(1); }
  Handle(Handle&& other) noexcept
      : device_(std::exchange(other.device_, nullptr)), id_(std::exchange(other.id_, 0U)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(id_, other.id_);
    return *this;
  }
  ~Handle() {
    if (device_ == nullptr) return;
    if (id_ != 0) device_->destroy(kKind, id_);
    device_->count_handle(-1);
  }

  [[nodiscard]] unsigned id() const { return id_; }
  [[nodiscard]] Device& device() const { return *device_; }
  explicit operator bool() const { return id_ != 0; }

 private:
  Device* device_ = nullptr;
  unsigned id_ = 0;
};

using TextureHandle = Handle<SharedObject::texture>;
using BufferHandle = Handle<SharedObject::buffer>;
using ProgramHandle = Handle<SharedObject::program>;
using ShaderHandle = Handle<SharedObject::shader>;
using VertexArrayHandle = Handle<ContextObject::vertex_array>;
using FramebufferHandle = Handle<ContextObject::framebuffer>;

}  // namespace tidemark::gpu
