#include "gpu/buffer.h"

#include "gpu/gl.h"
#include "gpu/label.h"

namespace tidemark::gpu {

// Buffers are edited through a binding that nothing draws from, which works in every version.
namespace {

// The processor reads from it, and no shader works on it. An error is left for the next check of the device.
BufferHandle make_staging(Device& device, std::int64_t bytes) {
  GLuint id = 0;
  glGenBuffers(1, &id);
  glBindBuffer(GL_COPY_WRITE_BUFFER, id);
  glBufferData(GL_COPY_WRITE_BUFFER, bytes, nullptr, GL_STREAM_READ);
  return {device, id};
}

void copy(unsigned from, std::int64_t from_offset, unsigned to, std::int64_t to_offset, std::int64_t bytes) {
  glBindBuffer(GL_COPY_READ_BUFFER, from);
  glBindBuffer(GL_COPY_WRITE_BUFFER, to);
  glCopyBufferSubData(GL_COPY_READ_BUFFER, GL_COPY_WRITE_BUFFER, from_offset, to_offset, bytes);
}

void read(unsigned from, std::span<std::byte> data) {
  glBindBuffer(GL_COPY_READ_BUFFER, from);
  glGetBufferSubData(GL_COPY_READ_BUFFER, 0, static_cast<GLsizeiptr>(data.size()), data.data());
}

}  // namespace

Result<Buffer> Buffer::create(Device& device, std::int64_t bytes, std::string_view label) {
  TIDEMARK_TRY(device.check("allocating a buffer"));
  Buffer buffer;
  GLuint id = 0;
  glGenBuffers(1, &id);
  buffer.handle_ = BufferHandle(device, id);
  buffer.bytes_ = bytes;
  const std::vector<std::byte> zeros(static_cast<std::size_t>(bytes));
  glBindBuffer(GL_COPY_WRITE_BUFFER, id);
  // Storage that cannot be mapped stays in the GPU's memory. Where the processor has read it often, NVIDIA's
  // driver moves any other to the machine's memory, where atomic operations of shaders can be lost without a
  // word.
  if (device.capabilities().at_least(4, 4) || epoxy_has_gl_extension("GL_ARB_buffer_storage")) {
    glBufferStorage(GL_COPY_WRITE_BUFFER, bytes, zeros.data(), GL_DYNAMIC_STORAGE_BIT);
  } else {
    glBufferData(GL_COPY_WRITE_BUFFER, bytes, zeros.data(), GL_DYNAMIC_COPY);
  }
  set_label(device, GL_BUFFER, id, label);
  TIDEMARK_TRY(device.check("allocating a buffer"));
  return buffer;
}

void Buffer::upload(std::int64_t offset, std::span<const std::byte> data) {
  if (data.empty()) return;
  glBindBuffer(GL_COPY_WRITE_BUFFER, handle_.id());
  glBufferSubData(GL_COPY_WRITE_BUFFER, offset, static_cast<GLsizeiptr>(data.size()), data.data());
}

void Buffer::copy_from(const Buffer& other, std::int64_t bytes) {
  copy(other.id(), 0, id(), 0, bytes);
}

void Buffer::download(std::int64_t offset, std::span<std::byte> data) const {
  if (data.empty()) return;
  const auto bytes = static_cast<std::int64_t>(data.size());
  const BufferHandle staging = make_staging(handle_.device(), bytes);
  copy(handle_.id(), offset, staging.id(), 0, bytes);
  read(staging.id(), data);
}

void Buffer::bind_storage(unsigned binding) const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, handle_.id());
}

void Buffer::bind_as_dispatch_arguments() const {
  glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, handle_.id());
}

Fence::Fence(Fence&& other) noexcept
    : device_(std::exchange(other.device_, nullptr)), sync_(std::exchange(other.sync_, nullptr)) {}

Fence& Fence::operator=(Fence&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(sync_, other.sync_);
  return *this;
}

Fence::~Fence() {
  if (sync_ != nullptr && !device_->lost() && device_->make_current())
    glDeleteSync(static_cast<GLsync>(sync_));
}

Fence Fence::insert(Device& device) {
  Fence fence;
  fence.device_ = &device;
  fence.sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();  // or the place may never be reached
  return fence;
}

Fence Fence::adopt(Device& device, void* sync) {
  Fence fence;
  fence.device_ = &device;
  fence.sync_ = sync;
  return fence;
}

bool Fence::reached() const {
  if (sync_ == nullptr) return true;
  const GLenum state = glClientWaitSync(static_cast<GLsync>(sync_), 0, 0);
  return state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED;
}

Status Fence::wait() const {
  if (sync_ == nullptr) return {};
  constexpr GLuint64 kNanosecondsPerTry = 100'000'000;
  for (;;) {
    const GLenum state =
        glClientWaitSync(static_cast<GLsync>(sync_), GL_SYNC_FLUSH_COMMANDS_BIT, kNanosecondsPerTry);
    if (state == GL_ALREADY_SIGNALED || state == GL_CONDITION_SATISFIED) return {};
    TIDEMARK_TRY(device_->check("waiting for the GPU"));
    if (state == GL_WAIT_FAILED) return fail(ErrorKind::internal, "OpenGL: waiting for the GPU failed");
  }
}

Result<Readback> Readback::create(Device& device, std::int64_t bytes, std::string_view label) {
  Readback readback;
  readback.staging_ = make_staging(device, bytes);
  readback.bytes_ = bytes;
  set_label(device, GL_BUFFER, readback.staging_.id(), label);
  TIDEMARK_TRY(device.check("allocating a buffer to read from"));
  return readback;
}

void Readback::start(Device& device, const Buffer& from, std::int64_t offset) {
  copy(from.id(), offset, staging_.id(), 0, bytes_);
  fence_ = Fence::insert(device);
}

Status Readback::finish(std::span<std::byte> data) {
  TIDEMARK_TRY(fence_.wait());
  read(staging_.id(), data);
  return {};
}

}  // namespace tidemark::gpu
