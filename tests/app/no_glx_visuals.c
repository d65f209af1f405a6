// A GLX that has nothing to draw with, for LD_PRELOAD: as that of a display whose server has another driver than the program.
#include <stddef.h>

void** glXGetFBConfigs(void* display, int screen, int* count) {
  (void)display, (void)screen;
  *count = 0;
  return NULL;
}

void** glXChooseFBConfig(void* display, int screen, const int* attributes, int* count) {
  (void)attributes;
  return glXGetFBConfigs(display, screen, count);
}

void* glXChooseVisual(void* display, int screen, int* attributes) {
  (void)display, (void)screen, (void)attributes;
  return NULL;
}
