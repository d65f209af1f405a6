// A label that is refined: the surface stays near, and views show what has changed.
#include <QAbstractButton>
#include <QCheckBox>
#include <QLabel>
#include <cmath>

#include "solver/distance_transform.h"
#include "solver/speed/motion_limit.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/change_controls.h"
#include "ui/panels/initialise_panel.h"
#include "ui/panels/labels_panel.h"
#include "ui/widgets/number_box.h"

namespace tidemark::test::refine_story_test {

class RefineStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_label_is_refined_shown_and_undone();

 private:
  static void click(Desktop& desktop, QWidget& in, const QString& text) {
    auto* button = find_seen<QAbstractButton>(in, text);
    QVERIFY2(button && button->isEnabled(), qPrintable(text));
    QTest::mouseClick(button, Qt::LeftButton, {}, {8, button->height() / 2});
    desktop.wait_until_idle();
  }
  // The same choice stands in the panel Place surface.
  static void see_where_it_is_placed(Desktop& desktop) {
    desktop.window().panels().show("initialise");
    desktop.wait_until_idle();
    auto* panel = desktop.window().findChild<ui::InitialisePanel*>();
    QVERIFY(panel && panel->isVisible());
    Desktop::choose_in(*panel, "Begin with", "Label");
    click(desktop, *panel, "Refine it alone");
    desktop.screenshot("refine-0-place");
  }
  // In which orange leads, but not so much as in the outline.
  static int orange_pixels(const ui::PictureView& view) {
    const QImage picture = const_cast<ui::PictureView&>(view).grab_picture();
    int count = 0;
    for (int y = 0; y < picture.height(); ++y) {
      for (int x = 0; x < picture.width(); ++x) {
        const QColor colour = picture.pixelColor(x, y);
        count += colour.red() > colour.blue() + 40 && colour.red() > colour.green() + 30 ? 1 : 0;
      }
    }
    return count;
  }
};

void RefineStoryTest::a_label_is_refined_shown_and_undone() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(6.0);
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  auto* labels = desktop.window().findChild<ui::LabelsPanel*>();
  QVERIFY(labels && labels->isVisible());
  QVERIFY(!find_seen<QAbstractButton>(*labels, "Refine label")->isEnabled());  // there is none
  click(desktop, *labels, "Accept surface into label");
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});

  // 2.4 mm, typed.
  ui::NumberBox* within = nullptr;
  for (auto* box : labels->findChildren<ui::NumberBox*>()) {
    if (box->isVisible() && box->accessibleName() == "Stay within") within = box;
  }
  QVERIFY(within);
  within->setFocus();
  within->selectAll();
  QTest::keyClicks(within, "2.4");
  QTest::keyClick(within, Qt::Key_Return);
  desktop.screenshot("refine-0-labels");
  see_where_it_is_placed(desktop);
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  click(desktop, *labels, "Refine label");
  QVERIFY(desktop.state().limit);
  QCOMPARE(desktop.state().limit->within_mm(), 2.4);
  const Mask start = desktop.state().phi->mask();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(axial && volume);
  const int slice_before = orange_pixels(*axial);
  const int volume_before = orange_pixels(*volume);

  // The phantom's ball is much larger: it grows as far as it may.
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 10 && !desktop.state().playing; }, 60000));
  desktop.wait_until_idle();
  const std::vector<float> distance = solver::distance_transform(start, 10.0).dense();
  const Geometry& geometry = desktop.proxy().volume().geometry;
  const double smallest = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  const Mask now = desktop.state().phi->mask();
  QVERIFY(now.count() > 2 * start.count());
  for (std::size_t i = 0; i < now.voxels.size(); ++i)
    QVERIFY(now.voxels[i] == 0 || static_cast<double>(distance[i]) * smallest > -2.4);
  QVERIFY(orange_pixels(*axial) > slice_before + 200);
  QVERIFY(orange_pixels(*volume) > volume_before + 500);
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  desktop.screenshot("refine-1-grown");

  auto* change = desktop.window().findChild<ui::ChangeControls*>();
  QVERIFY(change && find_text(*change, QStringLiteral("2.4") + QChar(0x00A0) + "mm"));
  const int with_colours = orange_pixels(*axial);
  click(desktop, *change, "Show what has changed");
  QVERIFY(orange_pixels(*axial) < with_colours - 200);
  click(desktop, *change, "Show what has changed");
  QCOMPARE(orange_pixels(*axial), with_colours);
  ui::apply_theme(*qApp, ui::Theme::dark);
  desktop.screenshot("refine-2-dark");
  ui::apply_theme(*qApp, ui::Theme::light);

  // The run, and the start with its limit; and again.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().phi->mask().voxels, start.voxels);
  QVERIFY(desktop.state().limit);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().limit);
  QVERIFY(!find_seen<QAbstractButton>(*change, "Show what has changed"));
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().limit);
  QCOMPARE(desktop.state().phi->mask().voxels, now.voxels);
}

TIDEMARK_TEST(RefineStoryTest)

}  // namespace tidemark::test::refine_story_test

#include "refine_story_test.moc"
