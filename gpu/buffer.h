// Buffers, and reading them back without waiting.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "gpu/handles.h"

namespace tidemark::gpu {

// Memory of the GPU, which stays there. Offsets and sizes are in bytes. Requests beyond the end are the
// caller's defect.
class Buffer {
 public:
  Buffer() = default;
  // Zeroed. Fails (ErrorKind::capability) when memory is short.
  static Result<Buffer> create(Device& device, std::int64_t bytes, std::string_view label);

  [[nodiscard]] std::int64_t bytes() const { return bytes_; }
  [[nodiscard]] unsigned id() const { return handle_.id(); }

  void upload(std::int64_t offset, std::span<const std::byte> data);
  // The first `bytes` of another, by the GPU.
  void copy_from(const Buffer& other, std::int64_t bytes);
  // Waits for the GPU.
  void download(std::int64_t offset, std::span<std::byte> data) const;

  void bind_storage(unsigned binding) const;  // OpenGL 4.3
  void bind_as_dispatch_arguments() const;    // OpenGL 4.3

  template <class T>
  void upload_values(std::int64_t first, std::span<const T> values) {
    upload(first * static_cast<std::int64_t>(sizeof(T)), std::as_bytes(values));
  }
  template <class T>
  [[nodiscard]] std::vector<T> download_values(std::int64_t first, std::int64_t count) const {
    std::vector<T> values(static_cast<std::size_t>(count));
    download(first * static_cast<std::int64_t>(sizeof(T)), std::as_writable_bytes(std::span(values)));
    return values;
  }

 private:
  BufferHandle handle_;
  std::int64_t bytes_ = 0;
};

// Marks a place in the stream of commands.
class Fence {
 public:
  Fence() = default;
  Fence(Fence&& other) noexcept;
  Fence& operator=(Fence&& other) noexcept;
  ~Fence();

  static Fence insert(Device& device);
  // Takes over a fence (GLsync) that another context of the share group has inserted and flushed.
  static Fence adopt(Device& device, void* sync);

  // Whether the GPU has come this far.
  [[nodiscard]] bool reached() const;
  // Waits until it has. Fails (ErrorKind::capability) when the context is lost meanwhile.
  Status wait() const;

 private:
  Device* device_ = nullptr;
  void* sync_ = nullptr;  // GLsync
};

// A copy of a part of a buffer on its way to the processor.
class Readback {
 public:
  Readback() = default;
  static Result<Readback> create(Device& device, std::int64_t bytes, std::string_view label);

  // Orders the copy of as many bytes as this was made for; returns at once.
  void start(Device& device, const Buffer& from, std::int64_t offset);
  [[nodiscard]] bool ready() const { return fence_.reached(); }
  // Waits if need be.
  Status finish(std::span<std::byte> data);

 private:
  BufferHandle staging_;
  std::int64_t bytes_ = 0;
  Fence fence_;
};

}  // namespace tidemark::gpu
