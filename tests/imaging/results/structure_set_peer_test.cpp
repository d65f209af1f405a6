// What plastimatch, a program of radiotherapy, makes of our structure sets: it fills contours by rules of its
// own.
#include <QFile>
#include <QProcess>
#include <QStandardPaths>
#include <algorithm>
#include <glm/geometric.hpp>

#include "imaging/load_study.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::structure_set_peer_test {

namespace {

namespace fs = std::filesystem;

constexpr int kLongestRun = 60'000;  // ms

QString text_of(const fs::path& path) {
  return QString::fromStdString(path.string());
}

// A trunk that parts into a thick and a thin branch, the same in no mirror; the thick one leaves through the
// grid's side, and it fills the first slice and the last. Voxels alone: no phi places its contours.
imaging::Segment fork_segment(const Geometry& geometry) {
  std::vector<std::uint8_t> inside;
  for (std::int64_t k = 0; k < geometry.size.z; ++k) {
    const double apart = 1.5 * std::max(0.0, static_cast<double>(k) - 8.0);
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        const glm::dvec2 voxel(static_cast<double>(i), static_cast<double>(j));
        const bool thick = glm::distance(voxel, {24.0 - apart, 21.0}) < 6.0;
        const bool thin = glm::distance(voxel, {24.0 + apart, 21.0}) < 3.5;
        inside.push_back(thick || thin ? 1 : 0);
      }
    }
  }
  imaging::Segment segment;
  segment.name = "fork \xc3\xbc";
  segment.colour = imaging::SegmentColour{0, 114, 178};
  segment.slices = imaging::slices_of(geometry, inside);
  return segment;
}

// The regions that plastimatch finds, one a line as it lists them: number, colour, name.
QStringList convert(const fs::path& structure_set, const fs::path& series, const fs::path& target) {
  QProcess process;
  process.setProcessChannelMode(QProcess::MergedChannels);
  process.start("plastimatch", {"convert", "--input", text_of(structure_set), "--referenced-ct",
                                text_of(series), "--prefix-format", "nrrd", "--output-prefix",
                                text_of(target), "--output-ss-list", text_of(target / "regions.txt")});
  const bool ended = process.waitForFinished(kLongestRun) && process.exitCode() == 0;
  if (!ended) {
    qFatal("plastimatch cannot convert it: %s %s", qPrintable(process.errorString()),
           process.readAll().constData());
  }
  QFile list(text_of(target / "regions.txt"));
  if (!list.open(QIODevice::ReadOnly)) qFatal("plastimatch lists no regions");
  return QString::fromUtf8(list.readAll()).split('\n', Qt::SkipEmptyParts);
}

}  // namespace

class StructureSetPeerTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    QVERIFY2(!QStandardPaths::findExecutable("plastimatch").isEmpty(),
             "plastimatch is not there (docs/5-dependencies.md)");
  }

  void plastimatch_fills_what_was_segmented_data() { test::add_orientation_rows(); }

  // Not one voxel differs, at the boundary neither. Who fills contours asks whether a voxel's centre is
  // inside, and no centre lies on a contour of ours: without phi they run half way between centres, with phi
  // at least a 64th of the way from one (contours.cpp), while a coordinate is rounded to a thousandth. The
  // keyhole of the shell has no width, so it takes no voxel out and lets none of the hole in.
  void plastimatch_fills_what_was_segmented() {
    QFETCH(int, index);
    const test::TemporaryFolder folder;
    const auto series = test::write_oriented_series(index, {60, 50, 22}, folder / "series");
    imaging::Segments written{series.geometry, {test::ball_segment(series.geometry, 14.0)}, {}};
    written.list.push_back(test::ball_segment(series.geometry, 15.0, 8.0));
    written.list.back().name = "shell";
    written.list.push_back(fork_segment(series.geometry));
    const fs::path file = folder / "set.dcm";
    QCOMPARE(test::failure(imaging::write_structure_set(written, series.files, file)), QString());
    const auto read = imaging::read_structure_set(file, series.geometry);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->list.size(), written.list.size());

    const QStringList regions = convert(file, series.folder, folder / "masks");
    const QStringList expected{"0|255 255 0|ball", "1|255 255 0|shell", "2|0 114 178|fork \u00fc"};
    QCOMPARE(regions, expected);
    for (std::size_t n = 0; n < written.list.size(); ++n) {
      const std::string& name = written.list[n].name;
      const auto peer = imaging::load_mask(folder / "masks" / (name + ".nrrd"));
      QCOMPARE(test::failure(peer), QString());
      QVERIFY2(same_grid(peer->geometry, series.geometry, 0.01), name.c_str());
      const Mask segmented = imaging::union_of({series.geometry, {written.list[n]}, {}});
      const Mask read_back = imaging::union_of({series.geometry, {read->list[n]}, {}});
      QVERIFY(segmented.count() > 1000);
      QCOMPARE(dice(*peer, segmented), 1.0);
      QCOMPARE(dice(*peer, read_back), 1.0);
    }
  }
};

TIDEMARK_TEST(StructureSetPeerTest)

}  // namespace tidemark::test::structure_set_peer_test

#include "structure_set_peer_test.moc"
