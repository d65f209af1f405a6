// Strokes of examples, walls and anchors, painted by mouse and keys.
#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/example_controls.h"
#include "ui/panels/speed_histogram.h"
#include "ui/panels/wall_controls.h"
#include "ui/views/next_step.h"

namespace tidemark::test::examples_story_test {

class ExamplesStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void strokes_are_painted_shown_and_undone();
  void strokes_go_into_the_case_under_the_mouse();
  void walls_and_anchors_are_painted_and_cleared();
  void what_was_erased_does_not_grow_back();
  void each_stroke_moves_the_surface_and_pauses_it();
  void five_strokes_and_play_find_a_texture();

 private:
  static constexpr std::int64_t kSide = 72;
  static constexpr double kRadius = 17.0;

  static glm::dvec3 centre() { return glm::dvec3(36.0, 36.0, 36.0); }
  static const document::Drive& drive(Desktop& desktop) { return desktop.proxy().drive(); }
  static std::size_t inside(Desktop& desktop) {
    return drive(desktop).strokes ? drive(desktop).strokes->inside.size() : 0;
  }
  static std::size_t outside(Desktop& desktop) {
    return drive(desktop).strokes ? drive(desktop).strokes->outside.size() : 0;
  }
  static bool is_driven_by(Desktop& desktop, const char* function) {
    const auto& terms = drive(desktop).setting.terms;
    return terms.size() == 1 && terms.front().function == function;
  }
  // Pixels of the overlay in which one colour leads, by so much.
  static int orange_pixels(const ui::PictureView& view);

  TemporaryFolder folder_;
  QString file_;
  Mask truth_;
};

// A ball of fine texture in a coarse one: mean and spread are the same inside and outside, so that no range
// of brightness tells them apart.
void ExamplesStoryTest::initTestCase() {
  Geometry geometry;
  geometry.size = Index3(kSide);
  std::vector<float> values;
  truth_.geometry = geometry;
  std::uint32_t random = 7;
  for (std::int64_t k = 0; k < kSide; ++k) {
    for (std::int64_t j = 0; j < kSide; ++j) {
      for (std::int64_t i = 0; i < kSide; ++i) {
        const glm::dvec3 p(i, j, k);
        const bool is_inside = glm::distance(p, centre()) < kRadius;
        random = random * 1664525U + 1013904223U;
        const double fine = static_cast<double>(random >> 16U) / 65536.0 - 0.5;
        const double coarse =
            (std::sin(0.23 * p.x + 1.0) + std::sin(0.29 * p.y + 0.11 * p.x) + std::sin(0.26 * p.z)) / 4.0;
        values.push_back(static_cast<float>(500.0 + 300.0 * (is_inside ? fine : coarse)));
        truth_.voxels.push_back(is_inside ? 1 : 0);
      }
    }
  }
  Volume volume;
  volume.geometry = geometry;
  volume.voxels = std::move(values);
  const std::filesystem::path path = folder_ / "textures.nii.gz";
  QCOMPARE(failure(imaging::write_volume_file(volume, path)), QString());
  file_ = QString::fromStdString(path.string());
}

int ExamplesStoryTest::orange_pixels(const ui::PictureView& view) {
  const QImage picture = const_cast<ui::PictureView&>(view).grab_picture();
  int count = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const QColor colour = picture.pixelColor(x, y);
      count += colour.red() > colour.blue() + 60 && colour.red() > colour.green() + 20 ? 1 : 0;
    }
  }
  return count;
}

void ExamplesStoryTest::strokes_are_painted_shown_and_undone() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const glm::dvec3 middle = desktop.proxy().display().settings().cursor_mm;
  const int orange_before = orange_pixels(*axial);
  desktop.press(Qt::Key_M);
  QVERIFY(desktop.proxy().display().settings().tool == engine::Tool::examples);

  Desktop::drag(*axial, {middle, middle + glm::dvec3(6.0, 0.0, 0.0)});
  desktop.wait_until_idle();
  const std::size_t first = inside(desktop);
  QVERIFY(first > 30 && outside(desktop) == 0);
  // In one slice, that of the view.
  const Geometry& geometry = desktop.proxy().volume().geometry;
  const std::int64_t slice = std::llround(geometry.to_voxel(middle).z);
  for (const std::int64_t offset : drive(desktop).strokes->inside)
    QCOMPARE(offset / (geometry.size.x * geometry.size.y), slice);
  QVERIFY(is_driven_by(desktop, "tent"));  // one kind alone teaches nothing
  QVERIFY(orange_pixels(*axial) > orange_before + 100);

  // Until the button is released all views show what will be.
  Desktop::mouse(*axial, QEvent::MouseButtonPress, middle + glm::dvec3(0.0, 8.0, 0.0));
  QVERIFY(desktop.proxy().display().drawn_marks());
  QCOMPARE(inside(desktop), first);
  Desktop::mouse(*axial, QEvent::MouseMove, middle + glm::dvec3(6.0, 8.0, 0.0));
  const std::size_t drawn = desktop.proxy().display().drawn_marks()->strokes->inside.size();
  QVERIFY(drawn > first);
  Desktop::mouse(*axial, QEvent::MouseButtonRelease, middle + glm::dvec3(6.0, 8.0, 0.0));
  desktop.wait_until_idle();
  QVERIFY(!desktop.proxy().display().drawn_marks());
  QCOMPARE(inside(desktop), drawn);

  // With the first stroke outside the surface is driven by examples.
  Desktop::drag(*axial, {middle + glm::dvec3(-25.0, -25.0, 0.0), middle + glm::dvec3(-15.0, -25.0, 0.0)},
                Qt::RightButton);
  desktop.wait_until_idle();
  QVERIFY(outside(desktop) > 30);
  QVERIFY(is_driven_by(desktop, "examples"));
  const std::size_t second = outside(desktop);

  // Ctrl takes away, where it goes over.
  Desktop::drag(*axial, {middle + glm::dvec3(0.0, 8.0, 0.0), middle + glm::dvec3(6.0, 8.0, 0.0)},
                Qt::LeftButton, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(inside(desktop), first);
  QCOMPARE(outside(desktop), second);

  // One stroke is one entry of the history.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(inside(desktop), drawn);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(outside(desktop), std::size_t{0});
  QVERIFY(is_driven_by(desktop, "tent"));
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).strokes);
  QCOMPARE(orange_pixels(*axial), orange_before);
  for (int redo = 0; redo < 3; ++redo) desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QCOMPARE(outside(desktop), second);
  QVERIFY(is_driven_by(desktop, "examples"));

  // The panel clears all of it, and says what is missing then.
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::ExampleControls*>();
  QVERIFY(panel && panel->isVisible());
  auto* clear = find_seen<QAbstractButton>(*panel, "Clear strokes");
  QVERIFY(clear && clear->isEnabled());
  QTest::mouseClick(clear, Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).strokes);
  QVERIFY(is_driven_by(desktop, "tent"));
  QVERIFY(find_text(*panel, "Paint inside with the left button, outside with the right one."));
}

void ExamplesStoryTest::strokes_go_into_the_case_under_the_mouse() {
  Desktop desktop(story_executor(), {1200, 760});
  ui::CaseWindow* one = desktop.open_phantom("sphere");
  ui::CaseWindow* two = desktop.open_phantom("tumour");
  desktop.window().actions().tile->trigger();
  desktop.wait_until_idle();
  desktop.press(Qt::Key_M);  // the second is active
  for (ui::CaseWindow* under : {one, two}) {
    ui::CaseWindow* other = under == one ? two : one;
    const auto before = other->proxy().drive().strokes;
    auto* slice = qobject_cast<ui::SliceViewWidget*>(under->views().first());
    QVERIFY(slice && slice->isVisible());
    const glm::dvec3 middle = under->proxy().display().settings().cursor_mm;
    const bool was_active = desktop.window().active_case() == under;
    Desktop::drag(*slice, {middle, middle + glm::dvec3(5.0, 0.0, 0.0)});
    desktop.wait_until_idle();
    if (!was_active) {
      // That made the case active, and nothing else.
      QVERIFY(!under->proxy().drive().strokes);
      Desktop::drag(*slice, {middle, middle + glm::dvec3(5.0, 0.0, 0.0)});
      desktop.wait_until_idle();
    }
    QVERIFY(under->proxy().drive().strokes);
    QCOMPARE(other->proxy().drive().strokes, before);
  }
}

void ExamplesStoryTest::walls_and_anchors_are_painted_and_cleared() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 middle = desktop.proxy().display().settings().cursor_mm;
  const auto count = [&](solver::Constraint what) {
    const auto& constraints = drive(desktop).constraints;
    return constraints ? constraints->count(what) : 0;
  };
  desktop.press(Qt::Key_K);
  Desktop::drag(*axial, {middle + glm::dvec3(12.0, -8.0, 0.0), middle + glm::dvec3(12.0, 8.0, 0.0)});
  Desktop::drag(*axial, {middle, middle}, Qt::LeftButton, Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(count(solver::Constraint::wall) > 50);
  QVERIFY(count(solver::Constraint::anchor) > 20);
  desktop.window().panels().show("paint");
  desktop.wait_until_idle();
  desktop.screenshot("walls");
  Desktop::drag(*axial, {middle, middle}, Qt::RightButton);
  desktop.wait_until_idle();
  QCOMPARE(count(solver::Constraint::anchor), 0);
  auto* panel = desktop.window().findChild<ui::WallControls*>();
  QVERIFY(panel && panel->isVisible());
  auto* clear = find_seen<QAbstractButton>(*panel, "Clear walls and anchors");
  QVERIFY(clear);
  QTest::mouseClick(clear, Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).constraints);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(count(solver::Constraint::wall) > 50);
}

void ExamplesStoryTest::what_was_erased_does_not_grow_back() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 0 && !desktop.state().playing; }, 60000));
  desktop.wait_until_idle();
  const glm::dvec3 at = desktop.seed_mm();
  const auto encloses = [&] {
    return desktop.state().phi->at(Index3(glm::round(desktop.proxy().volume().geometry.to_voxel(at)))) > 0.0F;
  };
  QVERIFY(encloses());
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const auto erase_and_play = [&] {
    desktop.press(Qt::Key_E);
    Desktop::drag(*axial, {at, at});
    desktop.wait_until_idle();
    QVERIFY(!encloses());
    const std::int64_t before = desktop.state().step;
    desktop.press(Qt::Key_P);
    QVERIFY(
        Desktop::wait_for([&] { return desktop.state().step > before && !desktop.state().playing; }, 60000));
    desktop.wait_until_idle();
  };
  erase_and_play();
  QVERIFY(encloses());  // it has grown back

  desktop.window().panels().show("paint");
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::WallControls*>();
  auto* check = find_seen<QAbstractButton>(*panel, "Erasing leaves a wall");
  QVERIFY(check);
  QTest::mouseClick(check, Qt::LeftButton, {}, {8, check->height() / 2});
  erase_and_play();
  QVERIFY(!encloses());
  // The stroke and its wall are one entry.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);  // the run
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!drive(desktop).constraints);
  QVERIFY(encloses());
}

void ExamplesStoryTest::each_stroke_moves_the_surface_and_pauses_it() {
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open(file_));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 middle = desktop.proxy().volume().geometry.to_patient(centre());
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = middle; });
  desktop.window().panels().show("level-set");
  desktop.press(Qt::Key_M);
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::ExampleControls*>();
  QVERIFY(panel && panel->isVisible());
  auto* motion = panel->findChild<QComboBox*>();
  QVERIFY(motion && motion->isVisible());
  QCOMPARE(motion->currentIndex(), 0);
  motion->setFocus();
  QTest::keyClick(motion, Qt::Key_Down);
  QTest::keyClick(motion, Qt::Key_Down);
  QCOMPARE(desktop.proxy().display().settings().stroke_steps, std::int64_t{60});

  // No Play is pressed: the second stroke is the first one that has something to teach.
  const auto stroke = [&](glm::dvec3 from, glm::dvec3 to, Qt::MouseButton button) {
    Desktop::drag(*axial, {middle + from, middle + 0.5 * (from + to), middle + to}, button);
  };
  const auto rests_after = [&](std::int64_t step) {
    return Desktop::wait_for([&] { return desktop.state().step == step && !desktop.state().playing; },
                             120000);
  };
  stroke({-6.0, -4.0, 0.0}, {6.0, -4.0, 0.0}, Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().begun);
  stroke({-28.0, -20.0, 0.0}, {28.0, -26.0, 0.0}, Qt::RightButton);
  QVERIFY(rests_after(60));
  const std::size_t first_outside = outside(desktop);
  stroke({-27.0, 10.0, 0.0}, {-22.0, 28.0, 0.0}, Qt::RightButton);
  QVERIFY(rests_after(120));
  // One stroke is two entries: itself, and the run.
  desktop.wait_until_idle();
  desktop.screenshot("examples-0-each-stroke");
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().step, std::int64_t{60});
  QVERIFY(outside(desktop) > first_outside);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(outside(desktop), first_outside);
  QCOMPARE(desktop.state().step, std::int64_t{60});
  QVERIFY(!desktop.state().playing);
}

void ExamplesStoryTest::five_strokes_and_play_find_a_texture() {
  QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open(file_));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  const glm::dvec3 middle = desktop.proxy().volume().geometry.to_patient(centre());
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = middle; });
  desktop.wait_until_idle();
  desktop.press(Qt::Key_M);
  const auto stroke = [&](glm::dvec3 from, glm::dvec3 to, Qt::MouseButton button) {
    Desktop::drag(*axial, {middle + from, middle + 0.5 * (from + to), middle + to}, button);
  };
  WatchedApplication::instance().restart();
  stroke({-13.0, -4.0, 0.0}, {13.0, -4.0, 0.0}, Qt::LeftButton);
  stroke({-11.0, 8.0, 0.0}, {11.0, 8.0, 0.0}, Qt::LeftButton);
  desktop.screenshot_at_once("examples-1-inside");
  stroke({-28.0, -20.0, 0.0}, {28.0, -26.0, 0.0}, Qt::RightButton);
  stroke({-27.0, 10.0, 0.0}, {-22.0, 28.0, 0.0}, Qt::RightButton);
  stroke({24.0, -10.0, 0.0}, {26.0, 26.0, 0.0}, Qt::RightButton);
  desktop.wait_until_idle();
  qInfo("while strokes were painted: %s", qPrintable(WatchedApplication::instance().longest()));
  QVERIFY(is_driven_by(desktop, "examples"));
  QVERIFY(Desktop::wait_for([&] { return desktop.state().speed && !desktop.state().speed_waits; }, 60000));
  desktop.window().panels().show("level-set");
  desktop.wait_until_idle();
  QVERIFY(
      Desktop::wait_for([&] { return !desktop.window().findChild<ui::SpeedHistogram*>()->bars().empty(); }));
  desktop.screenshot("examples-2-strokes");

  // The map shows what they leave in doubt.
  auto* map = desktop.view<ui::SliceViewWidget>("Speed map, axial");
  QVERIFY(map);
  auto* doubt = find_seen<QAbstractButton>(desktop.window(), "Map of the doubt");
  QVERIFY(doubt && doubt->isEnabled());
  const auto pink = [&] {
    const QImage picture = map->grab_picture();
    int count = 0;
    for (int y = 0; y < picture.height(); y += 2) {
      for (int x = 0; x < picture.width(); x += 2) {
        const QColor c = picture.pixelColor(x, y);
        count += c.red() > c.green() + 15 && c.blue() > c.green() + 15 ? 1 : 0;
      }
    }
    return count;
  };
  const int pink_before = pink();
  QTest::mouseClick(doubt, Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(desktop.proxy().display().settings().speed_term == renderer::SpeedTerm::doubt);
  QVERIFY(pink() > pink_before + 500);
  desktop.screenshot("examples-2-doubt");
  QTest::mouseClick(find_seen<QAbstractButton>(desktop.window(), "Map of the speed"), Qt::LeftButton);
  desktop.wait_until_idle();
  QVERIFY(desktop.proxy().display().settings().speed_term == renderer::SpeedTerm::data);

  // There is no surface yet: Play begins in the strokes.
  QVERIFY(!desktop.state().begun);
  auto* play = desktop.window().findChild<ui::PlayButton*>();
  QVERIFY(play && play->isVisible());
  QTest::mouseClick(play, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 5; }, 60000));
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 240000));
  desktop.wait_until_idle();
  desktop.screenshot("examples-3-found");
  const double overlap = tidemark::dice(desktop.state().phi->mask(), truth_);
  qInfo("Dice %.3f after %lld steps", overlap, static_cast<long long>(desktop.state().step));
  QVERIFY2(overlap >= 0.9, qPrintable(QString::number(overlap)));

  ui::apply_theme(*qApp, ui::Theme::dark);
  desktop.screenshot("examples-4-dark");
  ui::apply_theme(*qApp, ui::Theme::light);

  // The way back: the run, the start, and the last stroke.
  const std::size_t painted = outside(desktop);
  for (int undo = 0; undo < 3; ++undo) desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().begun);
  QVERIFY(outside(desktop) > 0 && outside(desktop) < painted);
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QCOMPARE(outside(desktop), painted);
  QLocale::setDefault(QLocale::c());
}

TIDEMARK_TEST(ExamplesStoryTest)

}  // namespace tidemark::test::examples_story_test

#include "examples_story_test.moc"
