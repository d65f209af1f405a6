// A surface that is placed coarse to fine, by the panel.
#include <QCheckBox>
#include <QPushButton>
#include <QToolButton>
#include <cmath>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/initialise_panel.h"
#include "ui/panels/level_set_panel.h"
#include "ui/views/next_step.h"
#include "ui/views/volume_view.h"

namespace tidemark::test::coarse_to_fine_story_test {

class CoarseToFineStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void it_rests_soon_and_undo_brings_back_what_was();
  void a_small_study_does_not_offer_it();
  void the_raw_form_of_D_does_not_offer_it();

 private:
  static ui::InitialisePanel* open_panel(Desktop& desktop) {
    desktop.window().panels().show("initialise");
    desktop.wait_until_idle();
    return desktop.window().findChild<ui::InitialisePanel*>();
  }
  static void choose_form_of_D(Desktop& desktop, const QString& form) {
    desktop.window().panels().show("level-set");
    desktop.wait_until_idle();
    auto* panel = desktop.window().findChild<ui::LevelSetPanel*>();
    for (auto* unfold : panel->findChildren<QToolButton*>()) {
      if (unfold->accessibleName() == "Details of the speed" && !unfold->isChecked())
        QTest::mouseClick(unfold, Qt::LeftButton);
    }
    Desktop::choose_in(*panel, "Data term D", form);
    desktop.wait_until_idle();
  }
  template <class Button>
  static Button* button(const QWidget& panel, const QString& text) {
    for (auto* one : panel.findChildren<Button*>()) {
      if (one->text() == text) return one;
    }
    return nullptr;
  }
};

void CoarseToFineStoryTest::it_rests_soon_and_undo_brings_back_what_was() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("tumour"));
  auto* panel = open_panel(desktop);
  QVERIFY(panel && panel->isVisible());
  auto* coarse = button<QCheckBox>(*panel, "Coarse to fine");
  auto* place = button<QPushButton>(*panel, "Place surface");
  QVERIFY(coarse && place);
  // A level set that was saved goes on as it is.
  Desktop::choose_in(*panel, "Begin with", "Saved level set");
  QVERIFY(!coarse->isVisible());
  Desktop::choose_in(*panel, "Begin with", "Spheres");
  QVERIFY(coarse->isVisible() && !coarse->isChecked());
  desktop.screenshot("coarse-to-fine-0-panel");

  QTest::mouseClick(place, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().begun; }));
  desktop.wait_until_idle();
  const double sphere_ml = desktop.state().surface.volume_ml;

  QCOMPARE(open_panel(desktop), panel);
  QVERIFY(panel->isVisible());
  QTest::mouseClick(coarse, Qt::LeftButton, {}, {8, coarse->height() / 2});
  QVERIFY(coarse->isChecked());
  QTest::mouseClick(place, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] {
    desktop.wait_until_idle();
    return std::abs(desktop.state().surface.volume_ml - sphere_ml) > 1.0;
  }));
  QCOMPARE(desktop.state().step, std::int64_t{0});
  desktop.screenshot("coarse-to-fine-1-placed");
  const double at_rest_ml = desktop.state().surface.volume_ml;
  QTest::mouseClick(desktop.view<ui::VolumeViewWidget>()->findChild<ui::PlayButton*>(), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().converged && !desktop.state().playing; }, 60000));
  desktop.wait_until_idle();
  // Little is left for the finest level.
  QVERIFY2(std::abs(desktop.state().surface.volume_ml / at_rest_ml - 1.0) < 0.05,
           qPrintable(QString("%1 %2").arg(at_rest_ml).arg(desktop.state().surface.volume_ml)));
  desktop.screenshot("coarse-to-fine-2-rests");

  for (int i = 0; i < 2; ++i) {
    desktop.press(Qt::Key_Z, Qt::ControlModifier);
    desktop.wait_until_idle();
  }
  QVERIFY(Desktop::wait_for([&] { return std::abs(desktop.state().surface.volume_ml - sphere_ml) < 1e-6; }));
}

void CoarseToFineStoryTest::a_small_study_does_not_offer_it() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* panel = open_panel(desktop);
  QVERIFY(panel);
  QVERIFY(!button<QCheckBox>(*panel, "Coarse to fine")->isVisible());
}

void CoarseToFineStoryTest::the_raw_form_of_D_does_not_offer_it() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("tumour"));
  auto* panel = open_panel(desktop);
  QVERIFY(panel);
  auto* coarse = button<QCheckBox>(*panel, "Coarse to fine");
  QVERIFY(coarse && coarse->isVisible());
  choose_form_of_D(desktop, "Raw");
  QCOMPARE(open_panel(desktop), panel);
  QVERIFY(panel->isVisible() && !coarse->isVisible());
  choose_form_of_D(desktop, "Clamped");
  QCOMPARE(open_panel(desktop), panel);
  QVERIFY(coarse->isVisible());
}

TIDEMARK_TEST(CoarseToFineStoryTest)

}  // namespace tidemark::test::coarse_to_fine_story_test

#include "coarse_to_fine_story_test.moc"
