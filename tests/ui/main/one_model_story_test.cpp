// Every view and panel shows the same parameters and tools, and the clip plane is a place to work on.
#include <QApplication>
#include <QDoubleSpinBox>
#include <QMenu>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/panels/speed_controls.h"
#include "ui/views/view_bar.h"

namespace tidemark::test::one_model_story_test {

class OneModelStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_parameter_reads_the_same_everywhere();
  void a_tool_is_the_same_in_all_bars();
  void a_sphere_that_is_being_drawn_is_seen_in_all_views();
  void the_clip_plane_is_moved_tilted_and_worked_on();

 private:
  static QList<QDoubleSpinBox*> numbers(QWidget& in, const QString& name);
};

QList<QDoubleSpinBox*> OneModelStoryTest::numbers(QWidget& in, const QString& name) {
  QList<QDoubleSpinBox*> found;
  for (QDoubleSpinBox* number : in.findChildren<QDoubleSpinBox*>()) {
    if (number->accessibleName() == name) found << number;
  }
  return found;
}

// Pixels of the surface's cut, as the shader colours them (kOutlineYellow).
qint64 yellow_pixels(const ui::VolumeViewWidget& view) {
  const QImage& image = view.feed().shown().image;
  qint64 count = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const QColor colour = image.pixelColor(x, y);
      if (colour.red() > 225 && std::abs(colour.green() - 217) < 30 && colour.blue() < 40) ++count;
    }
  }
  return count;
}

void OneModelStoryTest::a_parameter_reads_the_same_everywhere() {
  Desktop desktop(story_executor(), {1300, 600});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(10.0);
  ui::CaseWindow& window = *desktop.window().active_case();
  auto* panel = desktop.window().findChild<ui::SpeedControls*>();
  QVERIFY(panel);
  const struct {
    QString in_bar;
    QString in_panel;
    double solver::Parameters::*value;
  } kinds[] = {{"Target T", "Target T", &solver::Parameters::target},
               {"Range epsilon", "Range ε", &solver::Parameters::range}};
  for (const auto& kind : kinds) {
    QList<QDoubleSpinBox*> all = numbers(window, kind.in_bar);
    QCOMPARE(all.size(), 3);
    const QList<QDoubleSpinBox*> in_panel = numbers(*panel, kind.in_panel);
    QCOMPARE(in_panel.size(), 1);
    all << in_panel;
    double value = 31.0;
    for (QDoubleSpinBox* typed : all) {
      if (typed != in_panel.first()) QVERIFY(typed->isVisible());
      typed->setFocus();
      typed->selectAll();
      QTest::keyClicks(typed, QString::number(value));
      QTest::keyClick(typed, Qt::Key_Return);
      desktop.wait_until_idle();
      for (const QDoubleSpinBox* read : all) QCOMPARE(read->value(), value);
      QCOMPARE(desktop.proxy().parameters().*kind.value, value);
      QCOMPARE(desktop.state().parameters.*kind.value, value);
      value += 4.0;
    }
  }
  // And one that is taken back.
  const double range = desktop.state().parameters.range;
  desktop.proxy().undo();
  desktop.wait_until_idle();
  QVERIFY(desktop.state().parameters.range != range);
  for (const QDoubleSpinBox* read : numbers(window, "Range epsilon"))
    QCOMPARE(read->value(), desktop.state().parameters.range);
}

void OneModelStoryTest::a_tool_is_the_same_in_all_bars() {
  Desktop desktop(story_executor(), {1300, 600});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::CaseWindow& window = *desktop.window().active_case();
  QList<QToolButton*> buttons;
  for (QToolButton* button : window.findChildren<QToolButton*>()) {
    if (button->accessibleName() == "Tool") buttons << button;
  }
  QCOMPARE(buttons.size(), 3);
  const QList<QAction*> tools = desktop.window().actions().tools->actions();
  for (qsizetype tool = 0; tool < tools.size(); ++tool) {
    // From the menu of one bar after the other.
    buttons[tool % 3]->menu()->actions().at(tool)->trigger();
    QCOMPARE(static_cast<int>(desktop.proxy().display().settings().tool), tools[tool]->data().toInt());
    QVERIFY(tools[tool]->isChecked());
    QCOMPARE(desktop.window().actions().tools->checkedAction(), tools[tool]);
    for (const QToolButton* button : buttons) QVERIFY(button->toolTip().contains(tools[tool]->toolTip()));
  }
}

void OneModelStoryTest::a_sphere_that_is_being_drawn_is_seen_in_all_views() {
  Desktop desktop(solver::ExecutorKind::host, {1300, 800});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.window().active_case()->set_layout(ui::ViewLayout::two_two);
  desktop.wait_until_idle();
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* coronal = desktop.view<ui::SliceViewWidget>("Coronal");
  auto* sagittal = desktop.view<ui::SliceViewWidget>("Sagittal");
  QVERIFY(axial && coronal && sagittal);
  const glm::dvec3 centre = desktop.seed_mm();
  constexpr double kRadius = 13.0;
  constexpr double kBeside = 5.0;  // the coronal slice does not go through the middle
  desktop.proxy().display().change([&](engine::DisplaySettings& s) {
    s.cursor_mm = centre + glm::dvec3(0.0, kBeside, 0.0);
    s.brush_mm = 2.0;
  });
  desktop.press(Qt::Key_S);
  Desktop::mouse(*axial, QEvent::MouseButtonPress, centre);
  Desktop::mouse(*axial, QEvent::MouseMove, centre + glm::dvec3(kRadius, 0.0, 0.0));
  const auto radius_in = [](const ui::PictureView& view) {
    const auto ring = view.ring();
    return ring ? ring->radius * view.mm_per_pixel() : -1.0;
  };
  QCOMPARE(radius_in(*axial), kRadius);
  QVERIFY(std::abs(radius_in(*sagittal) - kRadius) < 1e-6);
  QVERIFY(std::abs(radius_in(*coronal) - std::sqrt(kRadius * kRadius - kBeside * kBeside)) < 1e-6);
  QVERIFY(radius_in(*desktop.view<ui::VolumeViewWidget>()) > 0.0);
  desktop.screenshot("sphere-being-drawn");
  // Then it is the brush again.
  Desktop::mouse(*axial, QEvent::MouseButtonRelease, centre + glm::dvec3(kRadius, 0.0, 0.0));
  QVERIFY(std::abs(radius_in(*axial) - 2.0) < 1e-6);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
}

void OneModelStoryTest::the_clip_plane_is_moved_tilted_and_worked_on() {
  Desktop desktop(story_executor(), {1100, 760});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.window().active_case()->set_layout(ui::ViewLayout::paper);
  desktop.begin(10.0);
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  engine::Display& display = desktop.proxy().display();
  const glm::dvec3 centre = desktop.seed_mm();
  display.change([&](engine::DisplaySettings& s) {
    s.cursor_mm = centre;
    s.camera.zoom = 3.0;
    s.camera.focus_mm = centre;
    s.clip.offset_mm = glm::dot(s.clip.normal, centre) - 6.0;
  });
  desktop.press(Qt::Key_X);
  desktop.wait_until_idle();
  QVERIFY(display.settings().clip_on);

  // By its handles: along the normal, and about the middle of the cut.
  const auto drag_grip = [&](ui::ClipHandles::Grip grip, QPoint way) {
    const QPoint from = view->handles().position_of(grip).toPoint();
    Desktop::drag(static_cast<QWidget&>(*view), {from, from + way / 2, from + way});
    desktop.wait_until_idle();
  };
  const renderer::ClipPlane first = display.settings().clip;
  const QPointF along = view->position_of(first.normal) - view->position_of(glm::dvec3(0.0));
  const double length = std::hypot(along.x(), along.y());
  QVERIFY(length > 0.0);
  drag_grip(ui::ClipHandles::Grip::move, (along * (20.0 / length)).toPoint());
  const renderer::ClipPlane moved = display.settings().clip;
  QVERIFY(moved.offset_mm > first.offset_mm + 0.5);
  QVERIFY(glm::distance(moved.normal, first.normal) < 1e-9);
  drag_grip(ui::ClipHandles::Grip::tilt, {14, 10});
  const renderer::ClipPlane tilted = display.settings().clip;
  QVERIFY(glm::dot(tilted.normal, moved.normal) < 0.999);
  // So that it goes through the seed, whatever the drags were.
  display.change([&](engine::DisplaySettings& s) { s.clip.offset_mm = glm::dot(s.clip.normal, centre); });
  desktop.wait_until_idle();
  desktop.screenshot("clip-1-tilted");
  const qint64 cut = yellow_pixels(*view);
  QVERIFY2(cut > 50, qPrintable(QString::number(cut)));

  // Probe T on it: in the plane, beside the handle in its middle.
  const glm::dvec3 aside = glm::normalize(glm::cross(display.settings().clip.normal, {0.3, 0.1, 1.0}));
  desktop.press(Qt::Key_T);
  Desktop::drag(*view, {centre - aside * 6.0, centre, centre + aside * 6.0});
  desktop.wait_until_idle();
  QVERIFY2(std::abs(desktop.state().parameters.target - desktop.proxy().study().parameters.target) < 60.0,
           qPrintable(QString::number(desktop.state().parameters.target)));
  QVERIFY(desktop.state().parameters != desktop.proxy().study().parameters);

  // The transfer function's Gaussian, too.
  desktop.press(Qt::Key_G);
  const auto before = display.settings().transfer;
  Desktop::drag(*view, {centre - aside * 6.0, centre, centre + aside * 6.0});
  desktop.wait_until_idle();
  QVERIFY(display.settings().transfer != before);
  QCOMPARE(display.settings().chosen_primitive, 0);
  QVERIFY(!display.settings().transfer.source.empty());
  QVERIFY(display.settings().show_source);
  display.change([](engine::DisplaySettings& s) { s.show_source = false; });
  desktop.proxy().set_parameters(desktop.proxy().study().parameters);
  desktop.wait_until_idle();

  // Spheres drawn and taken away on it while the surface moves: the cut in the picture follows.
  const qint64 before_sphere = yellow_pixels(*view);
  const std::int64_t inside = desktop.state().surface.voxels_inside;
  desktop.proxy().set_pause_at_convergence(false);
  desktop.proxy().play();
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && desktop.state().step > 5; }));
  desktop.press(Qt::Key_S);
  const std::uint64_t edits = desktop.state().edits;
  const glm::dvec3 beside = centre + aside * 16.0;
  Desktop::drag(*view, {beside, beside + aside * 4.0, beside + aside * 9.0});
  QVERIFY(Desktop::wait_for([&] { return desktop.state().edits > edits; }));
  desktop.proxy().pause();
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }));
  desktop.wait_until_idle();
  const qint64 with_sphere = yellow_pixels(*view);
  const std::int64_t inside_with = desktop.state().surface.voxels_inside;
  desktop.screenshot("clip-2-sphere");
  QVERIFY(inside_with > inside);
  QVERIFY2(with_sphere != before_sphere, qPrintable(QString("%1 %2").arg(before_sphere).arg(with_sphere)));
  Desktop::drag(*view, {beside, beside + aside * 4.0, beside + aside * 14.0}, Qt::RightButton);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().surface.voxels_inside < inside_with);
  QVERIFY(yellow_pixels(*view) != with_sphere);
  desktop.screenshot("clip-3-erased");
  qInfo("cut: %lld pixels, %lld with the sphere, %lld without", static_cast<long long>(before_sphere),
        static_cast<long long>(with_sphere), static_cast<long long>(yellow_pixels(*view)));
}

TIDEMARK_TEST(OneModelStoryTest)

}  // namespace tidemark::test::one_model_story_test

#include "one_model_story_test.moc"
