// A start on displays whose GLX has no visual for us, as that of some remote desktops.
#pragma once

namespace tidemark::desktop {

// Qt ends a program that makes its first OpenGL context there. While this lives, which is while QApplication
// is made, the program is started again instead, with OpenGL by EGL or none at all. Nothing is open yet.
class GlxFallback {
 public:
  explicit GlxFallback(char** arguments);  // as main() has them
  GlxFallback(const GlxFallback&) = delete;
  GlxFallback& operator=(const GlxFallback&) = delete;
  ~GlxFallback();
};

}  // namespace tidemark::desktop
