// The report of a case as a file: its form by the name, what foreign files put into it, and a disk without
// room.
#include "ui/results/case_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <glm/geometric.hpp>

#include "solver/statistics.h"
#include "tests/support/test_program.h"
#include "ui/widgets/number_text.h"

namespace tidemark::test::case_report_test {
namespace {

std::shared_ptr<const Volume> even_volume(const char* unit) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {16, 16, 16};
  volume->voxels =
      std::vector<std::int16_t>(static_cast<std::size_t>(volume->geometry.voxel_count()), std::int16_t{100});
  volume->unit = unit;
  return volume;
}

// With a ball in its middle.
document::SessionContents contents_of(const Volume& volume) {
  constexpr double kBand = 2.5;
  constexpr double kRadius = 5.0;
  document::SessionContents contents;
  contents.geometry = volume.geometry;
  std::vector<float> phi;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 voxel(volume.geometry.voxel_at(offset));
    const double inside = kRadius - glm::distance(voxel, glm::dvec3(7.5));
    phi.push_back(static_cast<float>(std::clamp(inside, -kBand, kBand)));
  }
  contents.phi =
      std::make_shared<const solver::Field>(solver::Field::from_dense(volume.geometry, phi, kBand));
  return contents;
}

}  // namespace

class CaseReportTest : public QObject {
  Q_OBJECT

  static ui::ReportSource source(const char* unit = "HU") {
    ui::ReportSource source;
    source.study = QStringLiteral("Study");
    source.volume = even_volume(unit);
    return source;
  }

 private slots:
  void a_unit_from_a_file_is_text_and_no_markup() {
    const ui::ReportSource of = source("<b>&");
    const auto page = ui::report_page(of, contents_of(*of.volume));
    QCOMPARE(failure(page), QString());
    QVERIFY2(page->contains("&lt;b&gt;&amp;") && !page->contains("<b>"), qPrintable(*page));
  }

  // Half of the ball lies beyond the image.
  void the_part_that_an_image_covers_is_told() {
    const ui::ReportSource of = source();
    document::SessionContents contents = contents_of(*of.volume);
    auto volume = std::make_shared<Volume>(*even_volume("HU"));
    volume->geometry.size.z = 8;
    std::vector<std::int16_t> voxels(static_cast<std::size_t>(volume->geometry.voxel_count()), 7);
    voxels.front() = -1000;
    volume->voxels = std::move(voxels);
    auto image = std::make_shared<document::CaseImage>();
    image->name = "Other";
    image->volume = volume;
    contents.images = {image};
    const auto page = ui::report_page(of, contents);
    QCOMPARE(failure(page), QString());
    QVERIFY2(page->contains("Other (covers " + ui::share_text(0.5) + " of the region)"), qPrintable(*page));
    QVERIFY2(!page->contains("-1000"), qPrintable(*page));
  }

  void volume_and_area_are_those_of_the_panel() {
    const ui::ReportSource of = source();
    const document::SessionContents contents = contents_of(*of.volume);
    const solver::SurfaceStatistics surface = solver::measure(*contents.phi);
    const QString volume = ui::size_text(surface.volume_ml, 2, "ml");
    // So it can be told from the volume of the voxels.
    const double of_voxels = static_cast<double>(surface.voxels_inside) * contents.geometry.voxel_volume_ml();
    QVERIFY(ui::size_text(of_voxels, 2, "ml") != volume);
    const auto page = ui::report_page(of, contents);
    QCOMPARE(failure(page), QString());
    for (const QString& figure : {volume, ui::size_text(surface.surface_mm2, 0, QStringLiteral("mm²"))})
      QVERIFY2(page->contains("<td align='left'>" + figure + "</td>"), qPrintable(*page));
  }

  void the_form_is_that_of_the_suffix_in_capitals_too() {
    const TemporaryFolder folder;
    const ui::ReportSource of = source();
    const auto contents = contents_of(*of.volume);
    for (const char* name : {"one.pdf", "two.PDF"}) {
      QCOMPARE(failure(ui::write_report(of, contents, folder / name)), QString());
      QVERIFY2(bytes_of(folder / name).startsWith("%PDF"), name);
    }
    QCOMPARE(failure(ui::write_report(of, contents, folder / "three.html")), QString());
    QVERIFY(bytes_of(folder / "three.html").startsWith("<!DOCTYPE html>"));
  }

  void a_disk_that_is_full_leaves_the_older_report_alone() {
    const TemporaryFolder folder;
    const ui::ReportSource of = source();
    const auto contents = contents_of(*of.volume);
    const auto file = folder / "report.pdf";
    QCOMPARE(failure(ui::write_report(of, contents, file)), QString());
    const QByteArray older = bytes_of(file);
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    QCOMPARE(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 2000;
    setrlimit(RLIMIT_FSIZE, &small);
    const Status status = ui::write_report(of, contents, file);
    setrlimit(RLIMIT_FSIZE, &before);
    QVERIFY(!status);
    QCOMPARE(status.error().kind, ErrorKind::write);
    QCOMPARE(bytes_of(file), older);
    QCOMPARE(std::distance(std::filesystem::directory_iterator(folder.path()), {}), std::ptrdiff_t{1});
  }
};

TIDEMARK_TEST(CaseReportTest)

}  // namespace tidemark::test::case_report_test

#include "case_report_test.moc"
