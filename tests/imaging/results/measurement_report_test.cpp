// Structured reports about segments, as other programs read them.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QDateTime>
#include <QJsonArray>
#include <QProcess>
#include <cstdlib>
#include <ctime>
#include <fstream>

#include "imaging/results/measurement_report.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::measurement_report_test {

namespace {

const imaging::Code kVolume{"118565006", "SCT", "Volume"};
const imaging::Code kMl{"cm3", "UCUM", "cubic centimeter"};
const imaging::Code kAttenuation{"112031", "DCM", "Attenuation Coefficient"};
const imaging::Code kHounsfield{"[hnsf'U]", "UCUM", "Hounsfield unit"};
const imaging::Code kMean{"373098007", "SCT", "Mean"};

std::vector<imaging::ReportedSegment> sample_measures() {
  return {{0, {{kVolume, 12.3456789, kMl, {}}, {kAttenuation, -987.25, kHounsfield, kMean}}},
          {2, {{kVolume, 1e-7, kMl, {}}}}};
}

}  // namespace

class MeasurementReportTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() {
    series_ = write_oriented_series(0, {11, 7, 6}, folder_ / "series");
    const imaging::Segments segments = speckled_segments(series_.geometry);
    QCOMPARE(failure(imaging::write_segmentation(segments, series_.files, segmentation_)), QString());
    QCOMPARE(failure(imaging::write_measurement_report(segmentation_, sample_measures(), "CT", report_)),
             QString());
  }

  void validators_find_no_error() {
    const QString found = validate(report_);
    QVERIFY2(!found.contains("Error"), qPrintable(found));
    QProcess dump;
    dump.start("dsrdump", {QString::fromStdString(report_.string())});
    QVERIFY2(dump.waitForFinished() && dump.exitCode() == 0, dump.readAllStandardError().constData());
    const QString tree = QString::fromUtf8(dump.readAllStandardOutput());
    QVERIFY2(tree.contains("12.3456789") && tree.contains("Imaging Measurement Report"), qPrintable(tree));
    QVERIFY2(tree.contains("Leber \xc3\xbc"), qPrintable(tree));
  }

  void pydicom_reads_the_numbers_back() {
    const QJsonObject found = read_with_pydicom(report_, series_.folder);
    for (const char* what : {"same_patient", "same_study", "own_series", "source_series"})
      QVERIFY2(found[what].toBool(), what);
    QCOMPARE(found["template"].toString(), QStringLiteral("1500"));
    const QJsonArray groups = found["groups"].toArray();
    QCOMPARE(groups.size(), qsizetype{2});
    QCOMPARE(groups[0]["name"].toString(), QString::fromUtf8("Leber \xc3\xbc"));
    QCOMPARE(groups[0]["finding"].toString(), QStringLiteral("Liver"));
    QCOMPARE(groups[0]["segment"].toInt(), 1);
    QCOMPARE(groups[1]["segment"].toInt(), 3);
    const auto expected = sample_measures();
    for (std::size_t n = 0; n < expected.size(); ++n) {
      const QJsonArray measures = groups[static_cast<qsizetype>(n)]["measures"].toArray();
      QCOMPARE(measures.size(), static_cast<qsizetype>(expected[n].measures.size()));
      for (std::size_t m = 0; m < expected[n].measures.size(); ++m) {
        const imaging::ReportedMeasure& wanted = expected[n].measures[m];
        const QJsonObject seen = measures[static_cast<qsizetype>(m)].toObject();
        QCOMPARE(seen["quantity"].toString().toStdString(), wanted.quantity.meaning);
        QCOMPARE(seen["value"].toDouble(), wanted.value);
        QCOMPARE(seen["unit"].toString().toStdString(), wanted.unit.value);
        QCOMPARE(seen["derivation"].toString().toStdString(),
                 wanted.derivation ? wanted.derivation->meaning : std::string());
        QVERIFY2(seen["known"].toBool(), wanted.quantity.meaning.c_str());
      }
    }
  }

  // DCMTK dates the content, we the series.
  void its_dates_are_by_one_clock_in_every_time_zone() {
    const auto dated = folder_ / "dated.dcm";
    {
      const Variable zone("TZ", "NZST-12");
      ::tzset();
      QCOMPARE(failure(imaging::write_measurement_report(segmentation_, sample_measures(), "CT", dated)),
               QString());
    }
    ::tzset();
    DcmFileFormat file;
    QVERIFY(file.loadFile(dated.c_str()).good());
    const auto moment = [&](const DcmTagKey& date, const DcmTagKey& time) {
      OFString day;
      OFString hour;
      file.getDataset()->findAndGetOFString(date, day);
      file.getDataset()->findAndGetOFString(time, hour);
      return QDateTime::fromString(QString::fromLatin1((day + hour.substr(0, 6)).c_str()),
                                   QStringLiteral("yyyyMMddHHmmss"));
    };
    const QDateTime series = moment(DCM_SeriesDate, DCM_SeriesTime);
    const QDateTime content = moment(DCM_ContentDate, DCM_ContentTime);
    QVERIFY(series.isValid() && content.isValid());
    QVERIFY2(std::abs(series.secsTo(content)) < 60, qPrintable(series.toString() + content.toString()));
  }

  void what_is_no_segmentation_has_no_report() {
    const auto refused = folder_ / "refused.dcm";
    const auto written = [&](const std::filesystem::path& segmentation,
                             const std::vector<imaging::ReportedSegment>& segments) {
      return imaging::write_measurement_report(segmentation, segments, "CT", refused);
    };
    const auto of_image = written(series_.files.front(), sample_measures());
    QVERIFY(!of_image && of_image.error().kind == ErrorKind::input);
    QVERIFY2(of_image.error().message.find("is no DICOM segmentation") != std::string::npos,
             of_image.error().message.c_str());
    const auto too_many = written(segmentation_, {{3, {}}});
    QVERIFY(!too_many && too_many.error().message.find("has 3 segments") != std::string::npos);
    QVERIFY(!written(folder_ / "missing.dcm", {}));
    std::ofstream(folder_ / "text.dcm") << "no DICOM";
    QVERIFY(!written(folder_ / "text.dcm", {}));
    QVERIFY(!std::filesystem::exists(refused));
    const auto nowhere = imaging::write_measurement_report(segmentation_, sample_measures(), "CT",
                                                           folder_ / "no" / "folder.dcm");
    QVERIFY(!nowhere && nowhere.error().kind == ErrorKind::write);
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path segmentation_ = folder_ / "seg.dcm";
  std::filesystem::path report_ = folder_ / "report.dcm";
  SampleSeries series_;
};

TIDEMARK_TEST(MeasurementReportTest)

}  // namespace tidemark::test::measurement_report_test

#include "measurement_report_test.moc"
