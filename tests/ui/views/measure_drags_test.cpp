// Distances and angles that are drawn in slices, changed there and removed.
#include <QMouseEvent>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/views/slice_view.h"
#include "ui/views/volume_view.h"

namespace tidemark::test::measure_drags_test {

namespace {

using engine::Measurement;
using engine::Tool;

constexpr double kSliceMm = 2.0;  // of the ball's study

void send_mouse(ui::PictureView& view, QEvent::Type type, QPointF at, Qt::MouseButton held = Qt::NoButton) {
  const bool moves = type == QEvent::MouseMove;
  QMouseEvent event(type, at, view.mapToGlobal(at), moves ? Qt::NoButton : Qt::LeftButton, held, {});
  QCoreApplication::sendEvent(&view, &event);
}

}  // namespace

class MeasureDragsTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    engine::CaseProxy& proxy = *the_case_->proxy;
    middle_ = proxy.volume().geometry.to_patient({23.0, 21.0, 12.0});
    display().change([this](engine::DisplaySettings& settings) { settings.cursor_mm = middle_; });
    view_ =
        std::make_unique<ui::SliceViewWidget>(proxy, ui::SlicePlane::axial, renderer::SliceContent::source);
    view_->resize(140, 120);
    view_->show();
  }
  void cleanup() {
    view_.reset();
    the_case_.reset();
  }

  void an_end_is_grabbed_where_it_is_seen_alone() {
    display().choose_tool(Tool::measure_distance);
    drag({-10.0, 0.0}, {10.0, 0.0});
    QCOMPARE(measured().size(), std::size_t{1});
    const Measurement first = measured().front();
    QCOMPARE(first.value(), 20.0);
    // In 3D its ends are nearer than the mouse reaches.
    QVERIFY(kSliceMm < 8.0 * view_->mm_per_pixel());
    next_slice();
    drag({-10.0, 0.0}, {10.0, 0.0});
    QCOMPARE(measured().size(), std::size_t{2});
    QVERIFY(measured().front() == first);
    QVERIFY(measured().back().points_mm.front().z != first.points_mm.front().z);
    drag({10.0, 0.0}, {5.0, 0.0});
    QCOMPARE(measured().size(), std::size_t{2});
    QVERIFY(measured().front() == first);
    QCOMPARE(measured().back().value(), 15.0);
  }

  void an_angle_is_a_drag_and_a_click_or_a_second_drag() {
    display().choose_tool(Tool::measure_angle);
    drag({10.0, 0.0}, {0.0, 0.0});
    QVERIFY(measured().empty());
    hover({0.0, 5.0});
    QVERIFY(measured().empty());
    press({0.0, 10.0});
    release({0.0, 10.0});
    QCOMPARE(measured().size(), std::size_t{1});
    QVERIFY(measured().front().complete());
    QCOMPARE(measured().front().value(), 90.0);
    drag({-14.0, -12.0}, {-4.0, -12.0});
    drag({-4.0, -2.0}, {-14.0, -2.0});
    QCOMPARE(measured().size(), std::size_t{2});
    QCOMPARE(measured().back().value(), 45.0);
  }

  void an_angle_that_is_not_complete_goes_data() {
    QTest::addColumn<QString>("with");
    for (const char* with : {"its tool", "its slice", "its view", "Escape"})
      QTest::newRow(with) << QString(with);
  }
  void an_angle_that_is_not_complete_goes() {
    QFETCH(QString, with);
    display().choose_tool(Tool::measure_angle);
    const QImage before = view_->grab().toImage();
    drag({10.0, 0.0}, {0.0, 0.0});
    QVERIFY(view_->grab().toImage() != before);
    if (with == "its tool") {
      display().choose_tool(Tool::measure_distance);
      drag({-14.0, -12.0}, {-4.0, -12.0});
      QCOMPARE(measured().size(), std::size_t{1});
      QVERIFY(measured().front().kind == Measurement::Kind::distance);
      return;
    }
    if (with == "its slice") next_slice();
    if (with == "its view") {
      QEvent leave(QEvent::Leave);
      QCoreApplication::sendEvent(view_.get(), &leave);
    }
    if (with == "Escape") QTest::keyClick(view_.get(), Qt::Key_Escape);
    drag({-14.0, -12.0}, {-4.0, -12.0});
    QVERIFY(measured().empty());
    drag({-4.0, -2.0}, {-14.0, -2.0});
    QCOMPARE(measured().size(), std::size_t{1});
    QCOMPARE(measured().front().value(), 45.0);
    const glm::dvec3 place = display().settings().cursor_mm;
    for (const glm::dvec3& point : measured().front().points_mm) QCOMPARE(point.z, place.z);
  }

  void a_measurement_whose_points_are_put_together_goes() {
    display().choose_tool(Tool::measure_angle);
    drag({10.0, 0.0}, {0.0, 0.0});
    drag({0.0, 10.0}, {0.0, 10.0});
    QCOMPARE(measured().size(), std::size_t{1});
    drag({0.0, 10.0}, {0.0, 0.0});
    QVERIFY(measured().empty());
    display().choose_tool(Tool::measure_distance);
    drag({-10.0, 0.0}, {10.0, 0.0});
    QCOMPARE(measured().size(), std::size_t{1});
    drag({10.0, 0.0}, {-10.0, 0.0});
    QVERIFY(measured().empty());
    // Nor is there one of no length.
    drag({5.0, 5.0}, {5.0, 5.0});
    QVERIFY(measured().empty());
  }

  void in_3d_the_tools_turn_the_picture_data() {
    QTest::addColumn<Tool>("tool");
    QTest::newRow("distance") << Tool::measure_distance;
    QTest::newRow("angle") << Tool::measure_angle;
  }
  void in_3d_the_tools_turn_the_picture() {
    QFETCH(Tool, tool);
    the_case_->begin(8.0);
    ui::VolumeViewWidget volume(*the_case_->proxy);
    volume.resize(300, 300);
    volume.show();
    the_case_->wait_until_idle();
    display().choose_tool(tool);
    const double azimuth = display().settings().camera.azimuth;
    const QPointF on_surface = volume.position_of(the_case_->middle());
    send_mouse(volume, QEvent::MouseButtonPress, on_surface, Qt::LeftButton);
    the_case_->wait_until_idle();
    const QPointF there = on_surface + QPointF(60.0, 0.0);
    send_mouse(volume, QEvent::MouseMove, there, Qt::LeftButton);
    send_mouse(volume, QEvent::MouseButtonRelease, there);
    QVERIFY(measured().empty());
    QVERIFY(display().settings().camera.azimuth != azimuth);
  }

 private:
  [[nodiscard]] engine::Display& display() const { return the_case_->proxy->display(); }
  [[nodiscard]] const std::vector<Measurement>& measured() const { return display().settings().measurements; }
  // Of a place in the slice: mm to the patient's left and back of its middle.
  [[nodiscard]] QPointF position(glm::dvec2 place) const {
    return view_->position_of(middle_ + glm::dvec3(place, 0.0));
  }
  void press(glm::dvec2 at) { send_mouse(*view_, QEvent::MouseButtonPress, position(at), Qt::LeftButton); }
  void hover(glm::dvec2 at) { send_mouse(*view_, QEvent::MouseMove, position(at)); }
  void release(glm::dvec2 at) { send_mouse(*view_, QEvent::MouseButtonRelease, position(at)); }
  void drag(glm::dvec2 from, glm::dvec2 to) {
    press(from);
    send_mouse(*view_, QEvent::MouseMove, position(to), Qt::LeftButton);
    release(to);
  }
  void next_slice() {
    const double before = display().settings().cursor_mm.z;
    QTest::keyClick(view_.get(), Qt::Key_Up);
    QCOMPARE(std::abs(display().settings().cursor_mm.z - before), kSliceMm);
  }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::SliceViewWidget> view_;
  glm::dvec3 middle_{0.0};
};

TIDEMARK_TEST(MeasureDragsTest)

}  // namespace tidemark::test::measure_drags_test

#include "measure_drags_test.moc"
