// A segmentation from the first look to the saved session, with every executor.
#include <QApplication>
#include <QObject>
#include <cmath>

#include "imaging/load_study.h"
#include "imaging/phantom/phantom.h"
#include "solver/ball.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"

namespace tidemark::test::steering_story_test {

class SteeringStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_study_is_opened_probed_steered_and_saved_data();
  void a_study_is_opened_probed_steered_and_saved();
};

void SteeringStoryTest::a_study_is_opened_probed_steered_and_saved_data() {
  add_executor_rows({solver::ExecutorKind::compute});
}

void SteeringStoryTest::a_study_is_opened_probed_steered_and_saved() {
  QFETCH(int, executor);
  // Where the processor plays the GPU, a study of many megabytes takes a minute and shows nothing else.
  const bool is_host = executor == static_cast<int>(solver::ExecutorKind::host);
  const TemporaryFolder folder;
  const auto phantom = imaging::make_phantom(is_host ? "tumour" : "sphere");
  QVERIFY(phantom);
  QCOMPARE(failure(imaging::write_phantom(*phantom, folder.path())), QString());
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(static_cast<solver::ExecutorKind>(executor)));
  Desktop desktop(static_cast<solver::ExecutorKind>(executor), {1000, 700});

  // A DICOM folder.
  QVERIFY(desktop.open(QString::fromStdString((folder / "series").string())));
  QVERIFY(desktop.proxy().volume().geometry.size == phantom->volume.geometry.size);
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* speed = desktop.view<ui::SliceViewWidget>("Speed map, axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(axial && speed && volume);
  QVERIFY(!axial->feed().shown().image.isNull());
  QVERIFY(desktop.engine().contexts_made() == 1);

  // The slice of the tumour, by the linked cursor.
  const Geometry& geometry = desktop.proxy().volume().geometry;
  const auto& seed = *phantom->seed;
  const glm::dvec3 centre = geometry.to_patient({seed[0], seed[1], seed[2]});
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = centre; });

  // Probe: T and epsilon from the tissue.
  desktop.press(Qt::Key_T);
  QCOMPARE(desktop.proxy().display().settings().tool, engine::Tool::probe_speed);
  Desktop::drag(*axial, {centre - glm::dvec3(8, 0, 0), centre, centre + glm::dvec3(8, 4, 0)});
  desktop.wait_until_idle();
  QVERIFY(std::abs(desktop.state().parameters.target - phantom->target) < 60.0);
  const double probed_range = desktop.state().parameters.range;
  QVERIFY(probed_range > 1.0 && probed_range < 200.0);
  desktop.screenshot(QStringLiteral("story-%1-1-probed").arg(executor));
  // One drag is one entry of the history.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().parameters.range, desktop.proxy().study().parameters.range);
  solver::Parameters parameters = desktop.state().parameters;
  parameters.target = phantom->target;
  parameters.range = phantom->range;
  parameters.alpha = phantom->alpha;
  desktop.proxy().set_parameters(parameters);

  // A sphere by press and drag, which go by whole pixels.
  constexpr double kRadius = 10.0;
  desktop.press(Qt::Key_S);
  Desktop::drag(*axial, {centre, centre + glm::dvec3(3, 0, 0), centre + glm::dvec3(kRadius, 0, 0)});
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  const double radius = solver::radius_of_ball_mm(desktop.state().surface.volume_ml);
  QVERIFY2(std::abs(radius - kRadius) < axial->mm_per_pixel() + 0.1, qPrintable(QString::number(radius)));

  // Play, change T in mid-run, erase while it runs: not so fast that it rests before.
  const std::uint64_t pictures = axial->feed().shown().number;
  desktop.proxy().set_pace(100.0);
  desktop.press(Qt::Key_P);
  // Once it is so large that the eraser takes a part of it only.
  const auto large_enough = [&] {
    return desktop.state().playing && desktop.state().step > 20 && desktop.state().surface.volume_ml > 15.0;
  };
  QVERIFY(Desktop::wait_for(large_enough, 120000));
  parameters.target += 5.0;
  desktop.proxy().set_parameters(parameters);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().parameters.target == parameters.target; }));
  desktop.press(Qt::Key_E);
  const glm::dvec3 outwards = centre + glm::dvec3(5, 0, 0);
  Desktop::drag(*axial, {centre, outwards});
  QVERIFY(desktop.state().playing);
  desktop.proxy().set_pace(0.0);
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 120000));
  desktop.wait_until_idle();
  QVERIFY(axial->feed().shown().number > pictures);
  QVERIFY(desktop.state().converged);
  const glm::dvec3 spacing = geometry.spacing_mm;
  const double truth_ml =
      static_cast<double>(phantom->truth.count()) * spacing.x * spacing.y * spacing.z / 1000.0;
  QVERIFY2(std::abs(desktop.state().surface.volume_ml / truth_ml - 1.0) < 0.12,
           qPrintable(QString::number(desktop.state().surface.volume_ml)));
  desktop.screenshot(QStringLiteral("story-%1-2-converged").arg(executor));
  qInfo("step %lld, %.0f steps/s with pictures", static_cast<long long>(desktop.state().step),
        desktop.state().solver_steps_per_second);

  // Pictures come from the executor's own memory: phi is neither read nor sent for them.
  const PhiTraffic traffic = desktop.phi_traffic(desktop.proxy());
  qInfo("phi was read %lld times for %llu pictures of the axial view, %lld pages were uploaded",
        static_cast<long long>(traffic.copies), static_cast<unsigned long long>(axial->feed().shown().number),
        static_cast<long long>(traffic.pages_uploaded));
  QCOMPARE(traffic.copies, 0);
  QCOMPARE(traffic.pages_uploaded, 0);

  // Undo takes the evolution back, redo brings it again.
  const double volume_ml = desktop.state().surface.volume_ml;
  const std::int64_t step = desktop.state().step;
  const auto curve = desktop.state().curve.points();
  QVERIFY(curve->size() > 2);
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().step < step);
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().step, step);
  QVERIFY(std::abs(desktop.state().surface.volume_ml - volume_ml) < 1e-9);
  QVERIFY(desktop.state().curve.points()->size() >= curve->size());

  // Into a label, out as mask and polygons.
  desktop.proxy().add_label("Tumour");
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  desktop.proxy().accept_surface(desktop.state().labels[0].id);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().label_statistics[0].voxels, desktop.state().surface.voxels_inside);
  int written = 0;
  ui::CaseExports& exports = desktop.window().exports();
  QObject::connect(&desktop.window().files(), &ui::CaseFiles::written, &exports, [&] { ++written; });
  const QString mask_file = QString::fromStdString((folder / "mask.nii.gz").string());
  exports.write_mask(*desktop.window().active_case(), mask_file);
  exports.write_labels(*desktop.window().active_case(),
                       QString::fromStdString((folder / "labels.nrrd").string()));
  exports.write_surface(*desktop.window().active_case(),
                        QString::fromStdString((folder / "surface.stl").string()));
  QVERIFY(Desktop::wait_for([&] { return written == 3; }));
  const auto mask = imaging::load_mask(folder / "mask.nii.gz");
  QVERIFY(mask);
  QCOMPARE(mask->count(), desktop.state().surface.voxels_inside);
  QVERIFY(dice(*mask, phantom->truth) > 0.97);
  const auto labels = imaging::load_volume(folder / "labels.nrrd");
  QCOMPARE(failure(labels), QString());
  const auto id = static_cast<float>(desktop.state().labels[0].id);
  std::int64_t labelled = 0;
  for (std::int64_t v = 0; v < labels->geometry.voxel_count(); ++v)
    labelled += labels->value(v) == id ? 1 : 0;
  QCOMPARE(labelled, desktop.state().label_statistics[0].voxels);

  // A session, closed and opened again: everything is there.
  const QString session_file = QString::fromStdString((folder / "case.tidemark").string());
  desktop.window().active_case()->session_file = session_file;
  QVERIFY(desktop.state().modified);
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return written == 4; }));
  desktop.wait_until_idle();
  QVERIFY(!desktop.state().modified);
  const QImage before = volume->grab_picture();
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QVERIFY(desktop.open(session_file));
  QCOMPARE(desktop.state().step, step);
  QCOMPARE(desktop.state().surface.voxels_inside, mask->count());
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  QCOMPARE(desktop.state().parameters.target, parameters.target);
  QVERIFY(desktop.state().curve.points()->size() >= curve->size());
  QVERIFY(!desktop.state().modified);
  auto* volume_again = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(volume_again);
  desktop.screenshot(QStringLiteral("story-%1-3-reopened").arg(executor));
  QCOMPARE(volume_again->grab_picture().size(), before.size());
  QVERIFY(difference(volume_again->grab_picture(), before) < 0.02);
  QCOMPARE(desktop.engine().contexts_made(), 1);
}

TIDEMARK_TEST(SteeringStoryTest)

}  // namespace tidemark::test::steering_story_test

#include "steering_story_test.moc"
