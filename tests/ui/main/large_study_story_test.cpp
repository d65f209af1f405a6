// A study of 512 x 512 x 300 voxels is opened, steered, saved and closed like a small one.
#include <QObject>
#include <bit>
#include <cmath>
#include <fstream>
#include <glm/geometric.hpp>

#include "core/thread_pool.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"

namespace tidemark::test::large_study_story_test {

class LargeStudyStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void a_large_study_is_steered_like_a_small_one();

 private:
  static constexpr std::int64_t kWidth = 512;
  static constexpr std::int64_t kDepth = 300;
  static constexpr double kAcross = 0.7;  // mm, within a slice
  static constexpr double kBetween = 1.0;
  static constexpr double kRadius = 25.0;  // mm, of the lesion
  static constexpr int kLesion = 120;
  static constexpr int kBody = 40;

  static glm::dvec3 centre() { return {kAcross * 300.0, kAcross * 230.0, kBetween * 140.0}; }

  TemporaryFolder folder_;
  QString file_;
};

// A lesion in a body in air, with noise, as a MetaImage file.
void LargeStudyStoryTest::initTestCase() {
  static_assert(std::endian::native == std::endian::little, "the file says that its bytes are little endian");
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(kWidth * kWidth * kDepth));
  ThreadPool(0).for_each(kDepth, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t k = begin; k < end; ++k) {
      auto random = static_cast<std::uint32_t>(k + 1);
      auto* voxel = voxels.data() + k * kWidth * kWidth;
      for (std::int64_t j = 0; j < kWidth; ++j) {
        for (std::int64_t i = 0; i < kWidth; ++i) {
          const glm::dvec3 p(kAcross * static_cast<double>(i), kAcross * static_cast<double>(j),
                             kBetween * static_cast<double>(k));
          const glm::dvec3 q = (p - glm::dvec3(179.0, 179.0, 150.0)) / glm::dvec3(160.0, 120.0, 400.0);
          int value = -1000;
          if (glm::dot(q, q) < 1.0) value = glm::distance(p, centre()) < kRadius ? kLesion : kBody;
          random = random * 1664525U + 1013904223U;
          *voxel++ = static_cast<std::int16_t>(value + static_cast<int>(random >> 27U) - 16);
        }
      }
    }
  });
  const std::filesystem::path path = folder_ / "large.mha";
  std::ofstream file(path, std::ios::binary);
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
       << "DimSize = " << kWidth << ' ' << kWidth << ' ' << kDepth << "\nElementSpacing = " << kAcross << ' '
       << kAcross << ' ' << kBetween << "\nElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  file.write(reinterpret_cast<const char*>(voxels.data()),
             static_cast<std::streamsize>(voxels.size() * sizeof(std::int16_t)));
  QVERIFY(file.good());
  file_ = QString::fromStdString(path.string());
}

void LargeStudyStoryTest::a_large_study_is_steered_like_a_small_one() {
  Desktop desktop(story_executor());
  QVERIFY(desktop.open(file_));
  QCOMPARE(desktop.proxy().volume().geometry.size, Index3(kWidth, kWidth, kDepth));
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  auto* volume = desktop.view<ui::VolumeViewWidget>();
  QVERIFY(axial && volume);
  Desktop::in_an_event(
      [&] { desktop.proxy().display().change([](engine::DisplaySettings& s) { s.cursor_mm = centre(); }); });
  desktop.wait_until_idle();

  // T and epsilon from the lesion, a seed in it, and on to convergence, erasing on the way.
  desktop.press(Qt::Key_T);
  Desktop::drag(*axial, {centre() - glm::dvec3(12, 0, 0), centre(), centre() + glm::dvec3(12, 6, 0)});
  desktop.wait_until_idle();
  QVERIFY(std::abs(desktop.state().parameters.target - kLesion) < 5.0);
  solver::Parameters parameters = desktop.state().parameters;
  parameters.range = 40.0;
  Desktop::in_an_event([&] { desktop.proxy().set_parameters(parameters); });
  desktop.press(Qt::Key_S);
  Desktop::drag(*axial, {centre(), centre() + glm::dvec3(5, 0, 0), centre() + glm::dvec3(15, 0, 0)});
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing && desktop.state().step > 10; }, 60000));
  parameters.target += 2.0;
  Desktop::in_an_event([&] { desktop.proxy().set_parameters(parameters); });
  desktop.press(Qt::Key_E);
  Desktop::drag(*axial, {centre(), centre() + glm::dvec3(8, 0, 0)});
  desktop.press(Qt::Key_W);
  Desktop::drag(static_cast<QWidget&>(*volume), {QPoint(60, 60), QPoint(100, 80), QPoint(160, 90)});
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().playing; }, 240000));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().converged);
  const double lesion_ml = 4.0 / 3.0 * M_PI * kRadius * kRadius * kRadius / 1000.0;
  QVERIFY2(std::abs(desktop.state().surface.volume_ml / lesion_ml - 1.0) < 0.05,
           qPrintable(QString::number(desktop.state().surface.volume_ml)));
  desktop.screenshot("large");
  qInfo("step %lld, %.0f steps/s with pictures", static_cast<long long>(desktop.state().step),
        desktop.state().solver_steps_per_second);

  // Through the layouts, back and forth, into a label, out as a mask, and closed while it runs.
  for (QAction* layout : desktop.window().actions().layouts->actions()) {
    Desktop::in_an_event([&] { layout->trigger(); });
    desktop.wait_until_idle();
  }
  // Undo takes back the last steps, which hardly move the surface, or what was erased, where the surface had
  // come to rest before.
  const std::int64_t inside = desktop.state().surface.voxels_inside;
  const std::int64_t step = desktop.state().step;
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  QVERIFY(desktop.state().step < step || desktop.state().surface.voxels_inside != inside);
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().step, step);
  QCOMPARE(desktop.state().surface.voxels_inside, inside);
  Desktop::in_an_event([&] { desktop.proxy().add_label("Lesion"); });
  desktop.wait_until_idle();
  Desktop::in_an_event([&] { desktop.proxy().accept_surface(desktop.state().labels[0].id); });
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().label_statistics[0].voxels, desktop.state().surface.voxels_inside);
  bool written = false;
  ui::CaseExports& exports = desktop.window().exports();
  QObject::connect(&desktop.window().files(), &ui::CaseFiles::written, &exports, [&] { written = true; });
  const std::filesystem::path mask = folder_ / "mask.nii.gz";
  Desktop::in_an_event(
      [&] { exports.write_mask(*desktop.window().active_case(), QString::fromStdString(mask.string())); });
  QVERIFY(Desktop::wait_for([&] { return written; }, 60000));
  QVERIFY(std::filesystem::file_size(mask) > 0);
  Desktop::in_an_event([&] {
    desktop.proxy().restart();
    desktop.proxy().set_pause_at_convergence(false);
  });
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().playing; }));
  Desktop::answer(QMessageBox::Discard);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QCOMPARE(desktop.engine().contexts_made(), 1);
}

TIDEMARK_TEST(LargeStudyStoryTest)

}  // namespace tidemark::test::large_study_story_test

#include "large_study_story_test.moc"
