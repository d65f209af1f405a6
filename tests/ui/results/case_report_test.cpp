// The report of a case as a file: its form by the name, what foreign files put into it, and a disk without
// room.
#include "ui/results/case_report.h"

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"

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
