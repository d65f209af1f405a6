#include "ui/views/mouse_scheme.h"

#include "ui/settings.h"

namespace tidemark::ui {
namespace {

constexpr const char* kItkSnap = "itk-snap";

}  // namespace

MouseScheme mouse_scheme() {
  return settings::mouse_scheme().get() == kItkSnap ? MouseScheme::itk_snap : MouseScheme::tidemark;
}

void set_mouse_scheme(MouseScheme scheme) {
  settings::mouse_scheme().set(scheme == MouseScheme::itk_snap ? kItkSnap : "tidemark");
}

}  // namespace tidemark::ui
