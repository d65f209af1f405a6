#include "ui/views/mouse_scheme.h"

#include <QSettings>

namespace tidemark {
namespace {

constexpr const char* kSetting = "mouse/scheme";
constexpr const char* kItkSnap = "itk-snap";

}  // namespace

MouseScheme mouse_scheme() {
  return QSettings().value(kSetting).toString() == kItkSnap ? MouseScheme::itk_snap : MouseScheme::tidemark;
}

void set_mouse_scheme(MouseScheme scheme) {
  QSettings().setValue(kSetting, scheme == MouseScheme::itk_snap ? kItkSnap : "tidemark");
}

}  // namespace tidemark
