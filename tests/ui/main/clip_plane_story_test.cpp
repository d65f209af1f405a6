// Spheres placed on the clip plane of the 3D view while the surface moves, voxel by voxel.
#include <QObject>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"

namespace tidemark::test::clip_plane_story_test {
namespace {

constexpr double kRadius = 6.0;

// Voxels of phi within a sphere, on either side of a plane through it.
struct Content {
  int inside[2] = {0, 0};
  int all[2] = {0, 0};
};

Content content(const solver::Field& phi, const Geometry& geometry, const solver::Sphere& sphere,
                glm::dvec3 normal) {
  Content content;
  for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
    const Index3 v = geometry.voxel_at(i);
    const glm::dvec3 way = geometry.to_patient(v) - sphere.centre_mm;
    if (glm::length(way) >= sphere.radius_mm) continue;
    const int side = glm::dot(way, normal) < 0.0 ? 0 : 1;
    ++content.all[side];
    content.inside[side] += phi.at(v) > 0.0F ? 1 : 0;
  }
  return content;
}

}  // namespace

class ClipPlaneStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void spheres_on_the_plane_change_the_voxels_there_while_it_plays_data();
  void spheres_on_the_plane_change_the_voxels_there_while_it_plays();

 private:
  using Snapshot = std::shared_ptr<const engine::CaseProxy::Snapshot>;
  static Snapshot snapshot(Desktop& desktop);
};

// Null: there is none.
ClipPlaneStoryTest::Snapshot ClipPlaneStoryTest::snapshot(Desktop& desktop) {
  Snapshot taken;
  desktop.proxy().take_snapshot("{}", [&taken](const auto& snapshot) { taken = snapshot; });
  static_cast<void>(Desktop::wait_for([&taken] { return taken != nullptr; }));
  return taken;
}

void ClipPlaneStoryTest::spheres_on_the_plane_change_the_voxels_there_while_it_plays_data() {
  add_executor_rows({solver::ExecutorKind::stream});
}

void ClipPlaneStoryTest::spheres_on_the_plane_change_the_voxels_there_while_it_plays() {
  QFETCH(int, executor);
  Desktop desktop(static_cast<solver::ExecutorKind>(executor), {1100, 760});
  QVERIFY(desktop.open_phantom("tumour"));
  desktop.window().active_case()->set_layout(ui::ViewLayout::paper);
  desktop.begin(6.0);
  auto* view = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(view);
  const glm::dvec3 centre = desktop.seed_mm();
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, 1.0, 0.2));
  desktop.proxy().display().change([&](engine::DisplaySettings& s) {
    s.cursor_mm = centre;
    s.camera.zoom = 3.0;
    s.camera.focus_mm = centre;
    s.clip.normal = normal;
    s.clip.offset_mm = glm::dot(normal, centre);
  });
  desktop.press(Qt::Key_X);
  desktop.press(Qt::Key_S);
  // A picture after each step: few steps lie between an edit and the snapshot after it.
  desktop.proxy().set_steps_per_picture(1);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.wait_until_idle();
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && desktop.state().step > 3; }));

  const Geometry& geometry = desktop.proxy().volume().geometry;
  const glm::dvec3 along = glm::normalize(glm::cross(normal, {0.3, 0.1, 1.0}));
  const glm::dvec3 place = centre + along * 24.0;
  const struct {
    Qt::MouseButton button;
    solver::Brush brush;
  } edits[] = {{Qt::LeftButton, solver::Brush::add}, {Qt::RightButton, solver::Brush::erase}};
  for (const auto& [button, brush] : edits) {
    const Snapshot before = snapshot(desktop);
    QVERIFY(before);
    Desktop::drag(*view, {place, place + along * 2.0, place + along * kRadius}, button);
    // Commands come in their order: this one after the sphere, with or without steps between.
    const Snapshot after = snapshot(desktop);
    QVERIFY(after);
    QVERIFY(desktop.state().playing);
    const document::Recipe& recipe = after->contents.recipe;
    QVERIFY(recipe.steps >= before->contents.recipe.steps);
    const auto* painted = std::get_if<document::PaintEvent>(&recipe.events.back().what);
    QVERIFY(painted && painted->brush == brush);
    const solver::Sphere sphere = painted->sphere;
    QVERIFY(std::abs(glm::dot(sphere.centre_mm - centre, normal)) < 1e-6);
    QVERIFY2(glm::distance(sphere.centre_mm, place) < 1.0 && std::abs(sphere.radius_mm - kRadius) < 1.0,
             qPrintable(QString("%1 mm").arg(sphere.radius_mm)));

    // What the steps since then cannot have reached: a voxel is the most that a step moves it.
    const auto steps = static_cast<double>(recipe.steps - recipe.events.back().step);
    const double voxel = geometry.spacing_mm.x;
    const solver::Sphere core{sphere.centre_mm, sphere.radius_mm - voxel * (1.0 + steps)};
    const Content was = content(*before->contents.phi, geometry, core, normal);
    const Content is = content(*after->contents.phi, geometry, core, normal);
    qInfo("%.0f steps after it: %d and %d of %d and %d voxels, %d and %d before", steps, is.inside[0],
          is.inside[1], is.all[0], is.all[1], was.inside[0], was.inside[1]);
    for (const int side : {0, 1}) {
      QVERIFY2(is.all[side] > 40, qPrintable(QString("%1 steps").arg(steps)));
      QVERIFY(brush == solver::Brush::add ? was.inside[side] == 0 : was.inside[side] > is.all[side] / 4);
      QCOMPARE(is.inside[side], brush == solver::Brush::add ? is.all[side] : 0);
    }
    desktop.screenshot_at_once(
        QStringLiteral("clip-voxels-%1-%2").arg(executor).arg(brush == solver::Brush::add));
  }
}

TIDEMARK_TEST(ClipPlaneStoryTest)

}  // namespace tidemark::test::clip_plane_story_test

#include "clip_plane_story_test.moc"
