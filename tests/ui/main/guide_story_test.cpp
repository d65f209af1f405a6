// The guide's first minute (handbook/first-page.md) as it is written, and the layouts in both themes
// (handbook/window.md). With TIDEMARK_SCREENSHOTS it leaves the pictures of both pages.
#include <QApplication>
#include <QMessageBox>
#include <QPushButton>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/story_language.h"
#include "ui/look/theme.h"
#include "ui/main/panel_docks.h"
#include "ui/views/next_step.h"

namespace tidemark::test::guide_story_test {

class GuideStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void the_first_minute_leads_to_a_tumour();
  void every_layout_is_whole_in_both_themes();

 private:
  // Presses the button with that name or text.
  static bool click(Desktop& desktop, const QString& name);
};

bool GuideStoryTest::click(Desktop& desktop, const QString& name) {
  for (QAbstractButton* button : desktop.window().findChildren<QAbstractButton*>()) {
    const bool named = button->objectName() == name || button->text().remove('&').startsWith(name);
    if (!named || !button->isVisible() || !button->isEnabled()) continue;
    QTest::mouseClick(button, Qt::LeftButton);
    return true;
  }
  return false;
}

void GuideStoryTest::the_first_minute_leads_to_a_tumour() {
  Desktop desktop(story_executor(), {1382, 858});
  desktop.screenshot("minute-1-start");
  QVERIFY(click(desktop, "phantom_tumour"));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() != nullptr; }, 60000));
  desktop.wait_until_idle();
  desktop.screenshot("minute-2-opened");
  QVERIFY(!desktop.state().begun);

  // A sphere in the middle of the tumour, by press and drag.
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const glm::dvec3 centre = desktop.proxy().display().settings().cursor_mm;
  QVERIFY2(glm::distance(centre, desktop.seed_mm()) < 15.0, "the study opens at the tumour");
  QVERIFY(desktop.proxy().display().settings().tool == engine::Tool::seed);
  Desktop::mouse(*axial, QEvent::MouseButtonPress, centre);
  Desktop::mouse(*axial, QEvent::MouseMove, centre + glm::dvec3(6, 0, 0));
  Desktop::mouse(*axial, QEvent::MouseMove, centre + glm::dvec3(14, 0, 0));
  desktop.screenshot("minute-3-sphere");
  Desktop::mouse(*axial, QEvent::MouseButtonRelease, centre + glm::dvec3(14, 0, 0));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);

  auto* play = desktop.window().findChild<ui::PlayButton*>();
  QVERIFY(play && play->isVisible());
  QTest::mouseClick(play, Qt::LeftButton);
  const auto is_on_its_way = [&] {
    const auto views = desktop.window().active_case()->views();
    return std::all_of(views.begin(), views.end(), [](const ui::PictureView* view) {
      return !view->isVisible() || view->feed().shown().step > 120;
    });
  };
  QVERIFY(Desktop::wait_for(is_on_its_way, 60000));
  desktop.screenshot_at_once("minute-4-playing");
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 120000));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().converged);
  QVERIFY2(std::abs(desktop.state().surface.volume_ml / 117.6 - 1.0) < 0.04,
           qPrintable(QString::number(desktop.state().surface.volume_ml)));
  const std::int64_t inside = desktop.state().surface.voxels_inside;
  desktop.screenshot("minute-5-converged");

  desktop.press(Qt::Key_E);
  const glm::dvec3 beside = centre + glm::dvec3(14, 0, 0);
  Desktop::drag(*axial, {beside, beside + glm::dvec3(4, 0, 0), beside + glm::dvec3(9, 0, 0)});
  desktop.wait_until_idle();
  desktop.screenshot("minute-6-erased");
  QVERIFY(desktop.state().surface.voxels_inside < inside);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().surface.voxels_inside, inside);

  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  QVERIFY(click(desktop, in_story_language("Accept surface into label")));
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  QCOMPARE(desktop.state().label_statistics[0].voxels, desktop.state().surface.voxels_inside);
  desktop.screenshot("minute-7-label");

  QString question;
  QTimer user;
  connect(&user, &QTimer::timeout, this, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box || !box->isVisible()) return;
    question = box->text();
    desktop.screenshot_at_once("minute-8-export");
    box->reject();
  });
  user.start(200);
  desktop.press(Qt::Key_E, Qt::ControlModifier);
  QCOMPARE(question, in_story_language("What is to be written?"));
}

void GuideStoryTest::every_layout_is_whole_in_both_themes() {
  Desktop desktop(story_executor(), {1400, 900});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.begin(14.0);
  desktop.proxy().play();
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 30 && !desktop.state().playing; }, 120000));
  const QString scale = QString::number(std::lround(100.0 * desktop.window().devicePixelRatioF()));
  for (const ui::Theme theme : {ui::Theme::light, ui::Theme::dark}) {
    ui::apply_theme(*qApp, theme);
    const QList<QAction*> layouts = desktop.window().actions().layouts->actions();
    for (int layout = 0; layout < layouts.size(); ++layout) {
      layouts[layout]->trigger();
      desktop.wait_until_idle();
      for (const ui::PictureView* view : desktop.window().active_case()->views()) {
        QVERIFY2(!view->isVisible() || shows_a_picture(*view), qPrintable(view->title()));
      }
      desktop.screenshot(QStringLiteral("layout-%1-%2-%3")
                             .arg(layout + 1)
                             .arg(theme == ui::Theme::light ? "light" : "dark", scale));
    }
  }
  ui::apply_theme(*qApp, ui::Theme::light);
}

TIDEMARK_TEST(GuideStoryTest)

}  // namespace tidemark::test::guide_story_test

#include "guide_story_test.moc"
