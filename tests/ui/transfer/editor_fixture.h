// A transfer function editor in a window, on a made-up study.
#pragma once

#include <QTest>
#include <cmath>

#include "ui/transfer/preset_picker.h"
#include "ui/transfer/primitive_page.h"
#include "ui/transfer/transfer_function_editor.h"

namespace tidemark::test {

// Values as of a CT: much air, a hill of soft tissue, few beyond; steeper where tissues meet.
inline engine::SourceSummary summary_like_ct() {
  engine::SourceSummary summary;
  summary.low = -1000.0F;
  summary.high = 800.0F;
  summary.lowest = -1024.0F;
  summary.highest = 1500.0F;
  summary.steepest = 400.0F;
  const auto hill = [](double x, double centre, double width) {
    const double u = (x - centre) / width;
    return std::exp(-u * u);
  };
  const auto often = [&](double value) {
    return 4e5 * hill(value, -1000.0, 40.0) + 3e4 * hill(value, -100.0, 60.0) +
           8e4 * hill(value, 50.0, 60.0) + 900.0 * hill(value, 500.0, 400.0);
  };
  constexpr int kBins = engine::SourceSummary::kBins;
  for (int i = 0; i < kBins; ++i) {
    summary.values.push_back(std::llround(often(-1024.0 + 2524.0 * (i + 0.5) / kBins)));
  }
  for (int row = 0; row < kBins; ++row) {
    for (int column = 0; column < kBins; ++column) {
      const double value = -1000.0 + 1800.0 * (column + 0.5) / kBins;
      const double slope = 400.0 * (row + 0.5) / kBins;
      const double arc = 300.0 * (1.0 - std::pow((value + 475.0) / 525.0, 2.0));
      summary.value_gradient.push_back(
          std::llround(0.02 * often(value) * std::exp(-slope / 30.0) + 60.0 * hill(slope, arc, 30.0)));
    }
  }
  return summary;
}

class EditorFixture {
 public:
  EditorFixture() {
    display.change([](engine::DisplaySettings& s) {
      s.transfer.source = {
          {{renderer::TransferFactor::Kind::gaussian, 0.0, 200.0}, {}, {}, 0.25, {0.9F, 0.4F, 0.3F}},
          {{renderer::TransferFactor::Kind::ramp, 300.0, 700.0}, {}, {}, 1.0, {1.0F, 1.0F, 0.9F}}};
    });
    editor.resize(420, 860);
    editor.set_display(&display, &summary, "HU");
    editor.show();
    editor.activateWindow();
  }

  [[nodiscard]] bool is_shown() { return QTest::qWaitForWindowExposed(&editor); }
  [[nodiscard]] ui::TransferPlot& plot() { return *editor.volume_page()->shown_plot(); }
  [[nodiscard]] const renderer::TransferFunction& function() const { return display.settings().transfer; }

  // Where the handle is in the plot that is shown.
  [[nodiscard]] QPoint at(const ui::HandleKind& kind) {
    ui::TransferPlot& shown =
        editor.tabs()->currentIndex() == 0 ? plot() : *editor.surface_page()->shown_plot();
    for (const ui::Handle& handle : shown.handles()) {
      if (handle.kind == kind) return shown.pixel_of(handle).toPoint();
    }
    return {-1, -1};
  }

  static void press(QWidget& widget, QPoint at) { QTest::mousePress(&widget, Qt::LeftButton, {}, at); }
  // As a hand does: not at once.
  static void move(QWidget& widget, QPoint from, QPoint to) {
    for (int i = 1; i <= 4; ++i) send_move(widget, from + (to - from) * i / 4);
  }
  static void release(QWidget& widget, QPoint at) { QTest::mouseRelease(&widget, Qt::LeftButton, {}, at); }
  static void drag(QWidget& widget, QPoint from, QPoint to) {
    press(widget, from);
    move(widget, from, to);
    release(widget, to);
  }

  engine::Display display;
  engine::SourceSummary summary = summary_like_ct();
  ui::TransferFunctionEditor editor;

 private:
  // QTest::mouseMove() says that no button is held.
  static void send_move(QWidget& widget, QPoint to) {
    QMouseEvent event(QEvent::MouseMove, to, widget.mapToGlobal(to), Qt::NoButton, Qt::LeftButton, {});
    QCoreApplication::sendEvent(&widget, &event);
  }
};

inline constexpr ui::HandleKind kCentre{ui::Grip::whole, ui::Grip::none, false};
inline constexpr ui::HandleKind kAbove{ui::Grip::above, ui::Grip::none, false};
inline constexpr ui::HandleKind kOpacity{ui::Grip::none, ui::Grip::none, true};

}  // namespace tidemark::test
