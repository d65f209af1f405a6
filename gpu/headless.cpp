#include "gpu/headless.h"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <utility>

namespace tidemark::gpu {
namespace {

// epoxy ends the process when a library is missing, so this opens the library first, and keeps it open.
bool library_is_there(const char* name) {
  return ::dlopen(name, RTLD_LAZY | RTLD_GLOBAL) != nullptr;
}

Result<EGLDisplay> open_display() {
  if (!library_is_there("libEGL.so.1")) {
    return fail(ErrorKind::capability,
                "OpenGL cannot be used: libEGL.so.1 cannot be loaded (Debian: libegl1)");
  }
  if (!library_is_there("libGL.so.1") && !library_is_there("libOpenGL.so.0")) {
    return fail(ErrorKind::capability, "OpenGL cannot be used: libGL.so.1 cannot be loaded (Debian: libgl1)");
  }
  EGLDisplay display = EGL_NO_DISPLAY;
  if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base")) {
    // A GPU first: where there is one, the surfaceless platform may still give the software renderer.
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
      EGLDeviceEXT devices[8];
      EGLint count = 0;
      if (eglQueryDevicesEXT(8, devices, &count) == EGL_TRUE) {
        for (EGLint i = 0; i < count && display == EGL_NO_DISPLAY; ++i) {
          const char* extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
          if (extensions != nullptr &&
              std::string_view(extensions).find("software") != std::string_view::npos) {
            continue;
          }
          EGLDisplay candidate = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr);
          if (candidate != EGL_NO_DISPLAY && eglInitialize(candidate, nullptr, nullptr) == EGL_TRUE) {
            display = candidate;
          }
        }
      }
    }
    if (display == EGL_NO_DISPLAY &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
      display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    }
  }
  if (display == EGL_NO_DISPLAY) display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
    return fail(ErrorKind::capability,
                "OpenGL cannot be used: EGL finds no driver (Debian: libegl1, libgl1-mesa-dri)");
  }
  if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context")) {
    return fail(ErrorKind::capability, "OpenGL cannot be used: EGL's driver needs a window");
  }
  return display;
}

EGLContext make_context(EGLDisplay display, const DeviceOptions& options, bool robust) {
  const bool v45 = options.version == GlVersion::gl45;
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                               v45 ? 4 : 3,
                               EGL_CONTEXT_MINOR_VERSION_KHR,
                               v45 ? 5 : 3,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                               EGL_CONTEXT_FLAGS_KHR,
                               options.debug ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                               robust ? EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY_EXT : EGL_NONE,
                               EGL_LOSE_CONTEXT_ON_RESET_EXT,
                               EGL_NONE};
  return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
}

}  // namespace

Result<HeadlessContext> HeadlessContext::create(const DeviceOptions& options) {
  auto display = open_display();
  if (!display) return pass_on(display);
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
    return fail(ErrorKind::capability, "OpenGL cannot be used: EGL's driver has OpenGL ES alone");
  }
  EGLContext context = EGL_NO_CONTEXT;
  if (epoxy_has_egl_extension(*display, "EGL_EXT_create_context_robustness")) {
    context = make_context(*display, options, true);
  }
  if (context == EGL_NO_CONTEXT) context = make_context(*display, options, false);
  if (context == EGL_NO_CONTEXT) {
    return fail(ErrorKind::capability, "the graphics driver has no OpenGL {} core context",
                options.version == GlVersion::gl45 ? "4.5" : "3.3");
  }
  return HeadlessContext(*display, context);
}

HeadlessContext::HeadlessContext(HeadlessContext&& other) noexcept
    : display_(other.display_), context_(std::exchange(other.context_, nullptr)) {}

HeadlessContext::~HeadlessContext() {
  if (context_ == nullptr) return;
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, context_);
}

Status HeadlessContext::make_current() const {
  if (eglGetCurrentContext() == context_) return {};
  eglBindAPI(EGL_OPENGL_API);  // the choice is a thread's
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    return fail(ErrorKind::capability, "the graphics driver refuses its context on this thread");
  }
  return {};
}

}  // namespace tidemark::gpu
