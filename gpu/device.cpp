#include "gpu/device.h"

#include <algorithm>
#include <cassert>

#include "gpu/gl.h"
#include "gpu/headless.h"

namespace tidemark::gpu {
namespace {

const char* error_name(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "invalid enum";
    case GL_INVALID_VALUE:
      return "invalid value";
    case GL_INVALID_OPERATION:
      return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "incomplete framebuffer";
    case GL_OUT_OF_MEMORY:
      return "out of memory";
    case GL_CONTEXT_LOST:
      return "context lost";
    default:
      return "unknown error";
  }
}

// Only the values of the specification are believed: drivers have been seen to return others.
bool context_was_reset(const Capabilities& capabilities) {
  if (!capabilities.reset_reported) return false;
  const GLenum status =
      capabilities.at_least(4, 5) ? glGetGraphicsResetStatus() : glGetGraphicsResetStatusARB();
  return status == GL_GUILTY_CONTEXT_RESET || status == GL_INNOCENT_CONTEXT_RESET ||
         status == GL_UNKNOWN_CONTEXT_RESET;
}

}  // namespace

Result<std::shared_ptr<Device>> Device::create_headless(const DeviceOptions& options) {
  auto context = HeadlessContext::create(options);
  if (!context) return pass_on(context);
  std::shared_ptr<Device> device(new Device());
  device->headless_ = std::make_unique<Headless>(Headless{std::move(*context)});
  TIDEMARK_TRY(device->start(options));
  return device;
}

Result<std::shared_ptr<Device>> Device::adopt_current(const DeviceOptions& options) {
  std::shared_ptr<Device> device(new Device());
  TIDEMARK_TRY(device->start(options));
  return device;
}

Device::~Device() {
  assert(handles_ == 0 && "a GL object outlives its device");
  if (debug_ && !lost_ && make_current()) glDebugMessageCallback(nullptr, nullptr);
}

Status Device::start(const DeviceOptions& options) {
  TIDEMARK_TRY(make_current());
  capabilities_ = query_capabilities();
  if (options.as_gpu) capabilities_.software = false;
  const auto limit = [](std::int64_t& largest, std::int64_t option) {
    if (option > 0) largest = std::min(largest, option);
  };
  limit(capabilities_.largest_texture, options.largest_texture);
  limit(capabilities_.largest_volume_texture, options.largest_volume_texture);
  const bool wants_compute = options.version == GlVersion::gl45;
  if (!(wants_compute ? capabilities_.at_least(4, 5) : capabilities_.at_least(3, 3))) {
    return fail(ErrorKind::capability, "OpenGL {} is needed; {} offers {}.{}", wants_compute ? "4.5" : "3.3",
                capabilities_.renderer, capabilities_.major, capabilities_.minor);
  }
  debug_ = options.debug && (capabilities_.at_least(4, 3) || epoxy_has_gl_extension("GL_KHR_debug"));
  if (debug_) {
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageCallback(&Device::receive_message, this);
  }
  // Rows of textures are packed without gaps wherever they go.
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  return check("starting OpenGL");
}

void Device::receive_message(unsigned /*source*/, unsigned type, unsigned /*id*/, unsigned severity,
                             int /*length*/, const char* text, const void* device) {
  auto* self = const_cast<Device*>(static_cast<const Device*>(device));
  const bool severe = severity == GL_DEBUG_SEVERITY_HIGH || type == GL_DEBUG_TYPE_ERROR;
  if (severe) ++self->severe_messages_;
  if (self->sink_ && severity != GL_DEBUG_SEVERITY_NOTIFICATION) self->sink_(severe, text);
}

Status Device::make_current() {
  if (headless_ == nullptr) return {};
  return headless_->context.make_current();
}

Status Device::check(std::string_view stage) {
  if (checks_until_loss_ > 0 && --checks_until_loss_ == 0) lost_ = true;
  if (!lost_ && context_was_reset(capabilities_)) lost_ = true;
  if (lost_) return fail(ErrorKind::capability, "the graphics driver lost its context while {}", stage);
  // Only the first error tells what went wrong, but all are cleared.
  GLenum first = GL_NO_ERROR;
  for (int i = 0; i < 16; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    if (error == GL_CONTEXT_LOST) lost_ = true;
    if (first == GL_NO_ERROR) first = error;
  }
  if (first == GL_NO_ERROR) return {};
  const ErrorKind kind =
      first == GL_OUT_OF_MEMORY || first == GL_CONTEXT_LOST ? ErrorKind::capability : ErrorKind::internal;
  return fail(kind, "OpenGL: {} while {}", error_name(first), stage);
}

void Device::destroy(SharedObject kind, unsigned id) {
  if (lost_ || !make_current()) return;
  switch (kind) {
    case SharedObject::texture:
      glDeleteTextures(1, &id);
      break;
    case SharedObject::buffer:
      glDeleteBuffers(1, &id);
      break;
    case SharedObject::program:
      glDeleteProgram(id);
      break;
    case SharedObject::shader:
      glDeleteShader(id);
      break;
  }
}

void Device::destroy(ContextObject kind, unsigned id) {
  if (lost_ || !make_current()) return;
  switch (kind) {
    case ContextObject::vertex_array:
      glDeleteVertexArrays(1, &id);
      break;
    case ContextObject::framebuffer:
      glDeleteFramebuffers(1, &id);
      break;
  }
}

}  // namespace tidemark::gpu
