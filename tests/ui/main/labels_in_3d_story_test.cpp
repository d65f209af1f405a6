// What was accepted into a label is seen in 3D in its colour, for as long as the label is visible.
#include <QApplication>
#include <QPushButton>
#include <QTableView>
#include <QToolButton>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/labels_model.h"

namespace tidemark::test::labels_in_3d_story_test {
namespace {

constexpr double kRadius = 12.0;  // mm

// Pixels of the 3D view that have the hue of a label's colour and light on them.
int pixels_of(const document::Label& label, const ui::VolumeViewWidget& view) {
  const QColor wanted(label.colour[0], label.colour[1], label.colour[2]);
  const QImage& image = view.feed().shown().image;
  int count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor colour = image.pixelColor(x, y);
      const int off = std::abs(colour.hsvHue() - wanted.hsvHue());
      if (std::min(off, 360 - off) < 10 && colour.value() > 90 && colour.hsvSaturation() > 100) ++count;
    }
  }
  return count;
}

void click(QWidget& in, const QString& text) {
  for (QAbstractButton* one : in.findChildren<QAbstractButton*>()) {
    if (one->text() == text && one->isVisible()) return QTest::mouseClick(one, Qt::LeftButton);
  }
  QFAIL(qPrintable("there is no " + text));
}

}  // namespace

class LabelsIn3dStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_label_shows_in_its_colour_while_it_is_visible();
};

void LabelsIn3dStoryTest::a_label_shows_in_its_colour_while_it_is_visible() {
  Desktop desktop(story_executor(), {1280, 800});
  QVERIFY(desktop.open_phantom("tumour"));
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  desktop.begin(kRadius);
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  click(desktop.window(), "Add");
  desktop.wait_until_idle();
  click(desktop.window(), "Accept surface into label");
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  const document::Label label = desktop.state().labels.front();
  // The surface has taken something of the label's colour; without it the label is seen alone.
  desktop.screenshot("labels-1-accepted");
  desktop.proxy().display().change([](engine::DisplaySettings& s) {
    s.surface = false;
    s.label_opacity = 1.0;
  });
  desktop.wait_until_idle();
  for (const ui::Theme theme : {ui::Theme::light, ui::Theme::dark}) {
    ui::apply_theme(*qApp, theme);
    desktop.screenshot(theme == ui::Theme::light ? "labels-2-alone-light" : "labels-2-alone-dark");
  }
  const double px = kRadius / view->mm_per_pixel();
  const int seen = pixels_of(label, *view);
  QVERIFY2(std::abs(seen / (M_PI * px * px) - 1.0) < 0.1,
           qPrintable(QString::number(seen / (M_PI * px * px))));

  QTableView* table = nullptr;
  for (QTableView* one : desktop.window().findChildren<QTableView*>()) {
    if (qobject_cast<ui::LabelsModel*>(one->model())) table = one;
  }
  QVERIFY(table && table->isVisible());
  const QRect cell = table->visualRect(table->model()->index(0, ui::LabelsModel::visible));
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, {cell.left() + 10, cell.center().y()});
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().labels.front().visible);
  QCOMPARE(pixels_of(label, *view), 0);
  desktop.proxy().undo();
  desktop.wait_until_idle();
  QVERIFY(pixels_of(label, *view) > seen / 2);
  desktop.proxy().display().change([](engine::DisplaySettings& s) { s.mode = renderer::Mode::slices; });
  desktop.wait_until_idle();
  desktop.screenshot("labels-3-slices");
  QVERIFY(std::abs(pixels_of(label, *view) - seen) < seen / 10);
}

TIDEMARK_TEST(LabelsIn3dStoryTest)

}  // namespace tidemark::test::labels_in_3d_story_test

#include "labels_in_3d_story_test.moc"
