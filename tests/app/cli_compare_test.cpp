// Segmentations compared: the figures against other programs, labels by name, and what is refused.
#include <QJsonArray>
#include <QRegularExpression>
#include <glm/geometric.hpp>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "imaging/results/results.h"
#include "tests/app/cli_runner.h"
#include "tests/support/grid.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_compare_test {

namespace {

Mask ellipsoid(const Geometry& grid, glm::dvec3 centre_mm, glm::dvec3 radii_mm) {
  Mask mask{grid, {}};
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    const glm::dvec3 place = glm::dvec3(grid.voxel_at(i)) * grid.spacing_mm;
    mask.voxels.push_back(glm::length((place - centre_mm) / radii_mm) < 1.0 ? 1 : 0);
  }
  return mask;
}

// What a program prints; fatal when it fails.
QByteArray output_of(const QString& program, const QStringList& arguments) {
  QProcess process;
  process.start(program, arguments);
  if (!process.waitForFinished(120'000) || process.exitStatus() != QProcess::NormalExit ||
      process.exitCode() != 0)
    qFatal("%s: %s %s", qPrintable(program), qPrintable(process.errorString()),
           process.readAllStandardError().constData());
  return process.readAllStandardOutput();
}

}  // namespace

class CliCompareTest : public QObject {
  Q_OBJECT

 private slots:
  void figures_are_those_of_an_independent_program_data() {
    QTest::addColumn<double>("shift_mm");
    QTest::addColumn<double>("thickness_mm");
    QTest::newRow("cubes") << 1.3 << 1.0;
    QTest::newRow("thick slices") << 2.0 << 2.7;
    QTest::newRow("the same") << 0.0 << 1.5;
    QTest::newRow("apart") << 19.0 << 1.5;
  }
  void figures_are_those_of_an_independent_program() {
    QFETCH(double, shift_mm);
    QFETCH(double, thickness_mm);
    const Geometry grid = grid_of({40, 26, 15}, {0.8, 1.0, thickness_mm});
    const auto [a, b] = write_pair(ellipsoid(grid, {9.0, 12.0, 10.0}, {7.0, 6.0, 7.0}),
                                   ellipsoid(grid, {9.0 + shift_mm, 12.0, 10.5}, {6.0, 7.0, 7.0}));
    QStringList arguments{QStringLiteral(TIDEMARK_COMPARE_REGIONS), text(folder_ / "a"), text(folder_ / "b")};
    for (int axis = 0; axis < 3; ++axis) arguments << QString::number(grid.size[axis]);
    for (int axis = 0; axis < 3; ++axis) arguments << QString::number(grid.spacing_mm[axis], 'g', 17);
    const QList<QByteArray> expected = output_of("/usr/bin/python3", arguments).simplified().split(' ');
    QCOMPARE(expected.size(), qsizetype{5});
    const QJsonObject found = compare({a, b});
    const QStringList names{"dice", "jaccard", "mean_distance_mm", "hausdorff95_mm", "hausdorff_mm"};
    for (int n = 0; n < 5; ++n) {
      const double off = found[names[n]].toDouble() - expected[n].toDouble();
      qInfo("%s: %.6f, off by %.1e", qPrintable(names[n]), found[names[n]].toDouble(), off);
      QVERIFY2(std::abs(off) < 1e-4, qPrintable(names[n] + ": " + QString::number(off)));
    }
    const double ml = found["volume_a_ml"].toDouble() - found["only_a_ml"].toDouble();
    QVERIFY(std::abs(ml - (found["volume_b_ml"].toDouble() - found["only_b_ml"].toDouble())) < 1e-9);
    QVERIFY(std::abs(ml - found["voxels_common"].toDouble() * 0.8e-3 * thickness_mm) < 1e-6);
  }

  // Its distances are between voxel centres: after a shift by whole voxels they are the same.
  void overlap_and_a_shift_are_those_of_plastimatch() {
    const Geometry grid = grid_of({44, 30, 24}, {1.0, 1.0, 1.0});
    const auto [a, b] = write_pair(ellipsoid(grid, {18.0, 15.0, 12.0}, {9.0, 9.0, 9.0}),
                                   ellipsoid(grid, {21.0, 15.0, 12.0}, {9.0, 9.0, 9.0}));
    const QString said = QString::fromUtf8(output_of("plastimatch", {"dice", "--all", a, b}));
    const auto number = [&](const QString& name) {
      const QRegularExpressionMatch match =
          QRegularExpression("(?:^|\\n)\\s*" + name + "\\s*[:=]\\s*([0-9.eE+-]+)").match(said);
      return match.hasMatch() ? match.captured(1).toDouble() : qQNaN();
    };
    const QJsonObject found = compare({a, b});
    const double dice_off = found["dice"].toDouble() - number("DICE");
    const double mm_off = found["hausdorff_mm"].toDouble() - number("Hausdorff distance \\(boundary\\)");
    qInfo("Dice off by %.1e, Hausdorff by %.1e mm", dice_off, mm_off);
    QVERIFY2(std::abs(dice_off) < 1e-5 && std::abs(mm_off) < 0.02, qPrintable(said));
  }

  void labels_are_compared_by_name() {
    const Geometry grid = grid_of({30, 20, 20}, {1.0, 1.0, 1.0});
    const auto map_of = [&](double x) {
      Volume map;
      map.geometry = grid;
      std::vector<std::int16_t> voxels;
      const Mask one = ellipsoid(grid, {x, 10.0, 10.0}, {5.0, 5.0, 5.0});
      const Mask two = ellipsoid(grid, {20.0, 10.0, 10.0}, {4.0, 4.0, 4.0});
      for (std::size_t i = 0; i < one.voxels.size(); ++i)
        voxels.push_back(two.voxels[i] != 0 ? 4 : one.voxels[i] != 0 ? 2 : 0);
      map.voxels = voxels;
      return map;
    };
    const QString a = text(folder_ / "a.nii.gz");
    const QString b = text(folder_ / "b.nrrd");
    Volume without = map_of(9.0);
    for (std::int16_t& value : std::get<std::vector<std::int16_t>>(without.voxels))
      value = value == 4 ? 9 : value;
    QCOMPARE(failure(imaging::write_volume_file(map_of(8.0), a.toStdString())), QString());
    QCOMPARE(failure(imaging::write_volume_file(without, b.toStdString())), QString());
    const QJsonArray rows =
        json_of(must_run({"compare", a, b, "--labels", "--json"}).out)["comparisons"].toArray();
    QCOMPARE(rows.size(), qsizetype{3});
    QCOMPARE(rows[0]["label"].toString(), QStringLiteral("Segment 2"));
    QVERIFY(rows[0]["dice"].toDouble() > 0.7 && rows[0]["dice"].toDouble() < 1.0);
    QCOMPARE(rows[1]["label"].toString(), QStringLiteral("Segment 4"));
    QCOMPARE(rows[1]["dice"].toDouble(), 0.0);
    QVERIFY(rows[1]["hausdorff_mm"].isNull());
    QCOMPARE(rows[1]["voxels_b"].toInt(), 0);
    QCOMPARE(rows[2]["label"].toString(), QStringLiteral("Segment 9"));
    QCOMPARE(rows[2]["voxels_a"].toInt(), 0);
    // Without --labels they are masks, whatever the numbers are.
    QVERIFY(compare({a, b})["dice"].toDouble() > 0.8);
    const Outcome said = must_run({"compare", a, b, "--labels"});
    QVERIFY2(said.out.contains("Segment 9"), said.told());
  }

  void several_readers_are_compared_and_estimated() {
    const Geometry grid = grid_of({40, 40, 30}, {1.0, 1.0, 1.0});
    QStringList files;
    const Mask truth = ellipsoid(grid, {20.0, 20.0, 15.0}, {10.0, 10.0, 10.0});
    // Two who see the truth, one who draws too much.
    for (const double radius : {10.0, 10.0, 13.0}) {
      files << text(folder_ / ("reader" + std::to_string(files.size()) + ".nii.gz"));
      QCOMPARE(failure(imaging::write_mask_file(ellipsoid(grid, {20.0, 20.0, 15.0}, glm::dvec3(radius)),
                                                files.last().toStdString())),
               QString());
    }
    const QString estimate = text(folder_ / "estimate.nii.gz");
    const QJsonObject found =
        json_of(must_run(QStringList{"compare"} + files + QStringList{"--staple", estimate, "--json"}).out);
    QCOMPARE(found["comparisons"].toArray().size(), qsizetype{3});
    QCOMPARE(found["comparisons"][0]["dice"].toDouble(), 1.0);
    const QJsonArray readers = found["staple"]["readers"].toArray();
    QCOMPARE(readers.size(), qsizetype{3});
    QVERIFY(readers[0]["specificity"].toDouble() > 0.999);
    QVERIFY(readers[2]["specificity"].toDouble() < 0.95);
    const auto written = imaging::load_mask(estimate.toStdString());
    QCOMPARE(failure(written), QString());
    QCOMPARE(dice(*written, truth), 1.0);
  }

  void what_does_not_fit_ends_with_one_line() {
    const Geometry grid = grid_of({20, 20, 20}, {1.0, 1.0, 1.0});
    const Geometry other = grid_of({20, 20, 21}, {1.0, 1.0, 1.0});
    const auto [a, b] = write_pair(ellipsoid(grid, glm::dvec3(10.0), glm::dvec3(5.0)),
                                   ellipsoid(other, glm::dvec3(10.0), glm::dvec3(5.0)));
    QVERIFY2(run_cli({"compare", a}).failed_in_one_line(2), run_cli({"compare", a}).told());
    const Outcome refused = run_cli({"compare", a, b});
    QVERIFY2(refused.failed_in_one_line(3) && refused.err.contains("--grid"), refused.told());
    QVERIFY(run_cli({"compare", a, a, "--staple", a}).failed_in_one_line(2));
    QVERIFY(
        run_cli({"compare", a, a, "--labels", "--staple", text(folder_ / "s.nii")}).failed_in_one_line(2));
    QVERIFY(run_cli({"compare", a, text(folder_ / "missing.nii")}).failed_in_one_line(3));
    QVERIFY(run_cli({"compare", a, a, "--staple", text(folder_ / "s.txt")}).failed_in_one_line(2));
  }

 private:
  // As files for the program, and as bytes for others.
  std::pair<QString, QString> write_pair(const Mask& a, const Mask& b) {
    for (const auto& [name, mask] : {std::pair("a", &a), {"b", &b}}) {
      const std::string bytes(mask->voxels.begin(), mask->voxels.end());
      if (!write_file(folder_ / name, bytes) ||
          !imaging::write_mask_file(*mask, folder_ / (std::string(name) + ".nii.gz")))
        qFatal("the masks cannot be written");
    }
    return {text(folder_ / "a.nii.gz"), text(folder_ / "b.nii.gz")};
  }
  // The first comparison.
  static QJsonObject compare(const QStringList& files) {
    return json_of(must_run(QStringList{"compare"} + files + QStringList{"--json"}).out)["comparisons"][0]
        .toObject();
  }

  TemporaryFolder folder_;
};

TIDEMARK_TEST(CliCompareTest)

}  // namespace tidemark::test::cli_compare_test

#include "cli_compare_test.moc"
