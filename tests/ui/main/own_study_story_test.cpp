// The handbook's first page on a study of one's own (handbook/first-page.md), with a phantom that lies in a
// folder as a scanner's series would. With TIDEMARK_SCREENSHOTS it leaves the pictures of the page.
#include <QFileInfo>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/index_walk.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"
#include "tests/ui/main/story_language.h"
#include "tests/ui/main/student.h"
#include "ui/main/panel_docks.h"

namespace tidemark::test::own_study_story_test {

namespace {

#ifdef TIDEMARK_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// Every second voxel along each axis, of a volume of int16.
Volume thinned_out(const Volume& whole) {
  Volume thin = whole;
  thin.geometry.size = (whole.geometry.size + Index3(1)) / std::int64_t{2};
  thin.geometry.spacing_mm *= 2.0;
  const auto& from = std::get<std::vector<std::int16_t>>(whole.voxels);
  std::vector<std::int16_t> voxels;
  voxels.reserve(static_cast<std::size_t>(thin.geometry.voxel_count()));
  for_each_index(Index3(0), thin.geometry.size, [&](Index3 v) {
    voxels.push_back(from[static_cast<std::size_t>(whole.geometry.offset(v * std::int64_t{2}))]);
  });
  thin.voxels = std::move(voxels);
  return thin;
}

}  // namespace

class OwnStudyStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_folder_leads_to_an_stl_file();
};

void OwnStudyStoryTest::a_folder_leads_to_an_stl_file() {
  const TemporaryFolder folder;
  auto phantom = imaging::make_phantom("organ");
  QVERIFY(phantom);
  // OpenGL without a GPU takes a quarter of an hour for all of the voxels, and so does a sanitizer.
  if (kSanitized || story_executor() != solver::ExecutorKind::host)
    phantom->volume = thinned_out(phantom->volume);
  const Status written = imaging::write_phantom(*phantom, folder / "study");
  QVERIFY2(written, failure(written).toUtf8());
  const glm::dvec3 middle{-64.0, 4.0, -32.0};  // of the organ, in the patient

  Desktop desktop(story_executor(), {1382, 858});
  QVERIFY(desktop.open(QString::fromStdString((folder / "study" / "series").string())));
  desktop.proxy().display().change([&](engine::DisplaySettings& settings) { settings.cursor_mm = middle; });
  desktop.wait_until_idle();
  desktop.screenshot("own-1-opened");
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);

  desktop.press(Qt::Key_T);
  Desktop::drag(*axial, {middle, middle + glm::dvec3(8, 6, 0), middle + glm::dvec3(16, 12, 0)});
  desktop.wait_until_idle();
  desktop.screenshot("own-2-probed");

  desktop.press(Qt::Key_S);
  Desktop::drag(*axial, {middle, middle + glm::dvec3(5, 0, 0), middle + glm::dvec3(12, 0, 0)});
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  desktop.press(Qt::Key_P);
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step > 30 && !desktop.state().playing; }, 600000));
  desktop.wait_until_idle();
  desktop.screenshot("own-3-played");
  QVERIFY(desktop.state().converged);
  const double truth_ml = 1134325 * std::pow(0.9, 3) / 1000.0;
  QVERIFY2(std::abs(desktop.state().surface.volume_ml / truth_ml - 1.0) < 0.1,
           qPrintable(QString::number(desktop.state().surface.volume_ml)));

  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  QTest::mouseClick(seen<QAbstractButton>(desktop.window(), in_story_language("Accept surface into label")),
                    Qt::LeftButton);
  desktop.wait_until_idle();
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});

  const auto file = folder / "organ.stl";
  name_file_when_asked(QString::fromStdString(file.string()));
  desktop.window().actions().export_mesh->trigger();
  QVERIFY(Desktop::wait_for([&] { return QFileInfo(QString::fromStdString(file.string())).size() > 1000; },
                            60000));
}

TIDEMARK_TEST(OwnStudyStoryTest)

}  // namespace tidemark::test::own_study_story_test

#include "own_study_story_test.moc"
