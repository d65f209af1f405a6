// A desktop with a small study in it, for stories about what goes out and comes in.
#pragma once

#include <QPushButton>
#include <filesystem>
#include <memory>

#include "tests/ui/main/desktop.h"

namespace tidemark::test {

inline constexpr int kPatience = 60'000;  // ms

// The middles of two bright balls in the dark, of 9 and 8 mm.
inline constexpr glm::dvec3 kLeft{34.0, 20.0, 16.0};
inline constexpr glm::dvec3 kRight{14.0, 20.0, 16.0};

// The balls as a CT series, of the patient Phantom^Paula.
void write_balls(const std::filesystem::path& folder);

// A button by its text; ends the test when there is none.
QPushButton* button(QWidget& in, const QString& text);
// Whether a label in it has this text.
bool says(QWidget& dialog, const QString& text);
// Whether every control in it has a tip, and a name or a text.
bool is_explained(QWidget& dialog);
// In both themes, into the folder of TIDEMARK_SCREENSHOTS.
void picture(QWidget& widget, const QString& name);

class ResultsDesktop {
 protected:
  // With the study of the balls open, in one view.
  void open();
  void close() { desktop_.reset(); }

  [[nodiscard]] QString path(const char* name) const {
    return QString::fromStdString((folder_ / name).string());
  }
  [[nodiscard]] const Geometry& grid() { return desktop_->proxy().volume().geometry; }

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  ui::CaseWindow* window_ = nullptr;
};

}  // namespace tidemark::test
