// What values stand for: Hounsfield units, standardized uptake values, real-world mappings.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>
#include <functional>
#include <optional>

#include "imaging/dicom/dicom.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/enhanced_files.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_quantity_test {

namespace fs = std::filesystem;

namespace {

using Change = std::function<void(DcmDataset&)>;
using Groups = std::function<void(DcmItem&, std::size_t)>;

DcmItem& tracer_of(DcmDataset& dataset) {
  DcmItem* item = nullptr;
  dataset.findOrCreateSequenceItem(DCM_RadiopharmaceuticalInformationSequence, item);
  return *item;
}

// 70 kg, 200 MBq of fluorine 18 an hour before the scan.
void make_pet(DcmDataset& dataset) {
  const auto put = [&](const DcmTagKey& key, const char* value) { dataset.putAndInsertString(key, value); };
  put(DCM_Modality, "PT");
  put(DCM_SOPClassUID, UID_PositronEmissionTomographyImageStorage);
  put(DCM_RescaleSlope, "0.5");
  put(DCM_RescaleIntercept, "0");
  dataset.findAndDeleteElement(DCM_RescaleType);
  put(DCM_WindowCenter, "1000");
  put(DCM_WindowWidth, "4000");
  put(DCM_Units, "BQML");
  put(DCM_CorrectedImage, "NORM\\DTIM\\ATTN\\SCAT\\DECY\\RAN");
  put(DCM_DecayCorrection, "START");
  put(DCM_PatientWeight, "70");
  put(DCM_SeriesDate, "20240315");
  put(DCM_SeriesTime, "103000.00");
  put(DCM_AcquisitionDate, "20240315");
  put(DCM_AcquisitionTime, "103210");
  DcmItem& tracer = tracer_of(dataset);
  tracer.putAndInsertString(DCM_RadiopharmaceuticalStartTime, "093000");
  tracer.putAndInsertString(DCM_RadionuclideTotalDose, "200000000");
  tracer.putAndInsertString(DCM_RadionuclideHalfLife, "6588");
}

// g/ml of one Bq/ml after so many seconds of decay.
double factor(double seconds) {
  return 70.0 * 1000.0 / (200e6 * std::exp2(-seconds / 6588.0));
}

void put_mapping(DcmItem& dataset, const char* unit, Uint16 last = 65535) {
  DcmItem* mapping = nullptr;
  dataset.findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, mapping, -2);
  mapping->putAndInsertFloat64(DCM_RealWorldValueSlope, 1e-6);
  mapping->putAndInsertFloat64(DCM_RealWorldValueIntercept, 0.25);
  mapping->putAndInsertUint16(DcmTag(DCM_RealWorldValueFirstValueMapped, EVR_US), 0);
  mapping->putAndInsertUint16(DcmTag(DCM_RealWorldValueLastValueMapped, EVR_US), last);
  DcmItem* code = nullptr;
  mapping->findOrCreateSequenceItem(DCM_MeasurementUnitsCodeSequence, code);
  code->putAndInsertString(DCM_CodeValue, unit);
  code->putAndInsertString(DCM_CodingSchemeDesignator, "UCUM");
}

// A series of three slices, changed.
class Made {
 public:
  Made(const char* modality, const std::vector<Change>& changes, const std::optional<Change>& last = {}) {
    const auto files = test::write_series(sample_, folder_ / "series", modality);
    for (const fs::path& file : files) {
      for (const Change& change : changes) test::edit(file, change);
    }
    if (last) test::edit(files.back(), *last);
  }
  [[nodiscard]] imaging::Series series() const { return test::only_series(folder_ / "series"); }
  [[nodiscard]] double stored(std::int64_t voxel) const { return static_cast<double>(sample_.value(voxel)); }

 private:
  test::TemporaryFolder folder_;
  Volume sample_ = test::sample_volume_uint16({5, 4, 3});
};

// One file of three frames.
class Enhanced {
 public:
  Enhanced(
      const char* modality, const Groups& frame, const Change& change = [](DcmDataset&) {}) {
    test::Enhanced enhanced;
    enhanced.frame = frame;
    enhanced.whole = [&](DcmDataset& dataset) {
      dataset.putAndInsertString(DCM_Modality, modality);
      dataset.findAndDeleteElement(DCM_RescaleType);
      change(dataset);
    };
    test::write_enhanced(test::frames_of(sample_), folder_ / "image.dcm", enhanced);
  }
  [[nodiscard]] imaging::Series series() const { return test::only_series(folder_.path()); }

 private:
  test::TemporaryFolder folder_;
  Volume sample_ = test::sample_volume_uint16({5, 4, 3});
};

bool told(const std::vector<std::string>& lines, const QString& part) {
  return std::any_of(lines.begin(), lines.end(),
                     [&](const std::string& line) { return QString::fromStdString(line).contains(part); });
}

}  // namespace

class DicomQuantityTest : public QObject {
  Q_OBJECT

 private slots:
  void ct_is_in_hounsfield_units_unless_it_says_otherwise() {
    QCOMPARE(Made("CT", {}).series().unit, std::string("HU"));
    QCOMPARE(Made("MR", {}).series().unit, std::string());
    const Made other("CT", {[](DcmDataset& d) { d.putAndInsertString(DCM_RescaleType, "US"); }});
    QCOMPARE(other.series().unit, std::string());
  }

  void ct_in_two_units_is_no_volume() {
    const Change other = [](DcmDataset& d) { d.putAndInsertString(DCM_RescaleType, "US"); };
    const Made mixed("CT", {}, other);
    QVERIFY(!mixed.series().loadable);
    QVERIFY(told({mixed.series().reason}, "the unit of the values is not the same"));
    const Made silent("CT", {}, [](DcmDataset& d) { d.findAndDeleteElement(DCM_RescaleType); });
    QCOMPARE(silent.series().unit, std::string("HU"));
  }

  void activity_becomes_suv_data() {
    QTest::addColumn<Change>("change");
    QTest::addColumn<double>("expected");
    const auto row = [](const char* name, double expected, const Change& change) {
      QTest::newRow(name) << change << expected;
    };
    row("an hour of decay", factor(3600.0), [](DcmDataset&) {});
    row("corrected to the injection", factor(0.0),
        [](DcmDataset& d) { d.putAndInsertString(DCM_DecayCorrection, "ADMIN"); });
    row("injected at a date and time", factor(5400.5), [](DcmDataset& d) {
      tracer_of(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20240315085959.5");
    });
    // By the dataset's clock, where both zones are known; else (0018,1072) counts, which is that clock's.
    const auto row_of_zones = [&](const char* name, double expected, const char* moment, const char* zone) {
      row(name, expected, [=](DcmDataset& d) {
        tracer_of(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, moment);
        if (*zone != '\0') d.putAndInsertString(DCM_TimezoneOffsetFromUTC, zone);
      });
    };
    row_of_zones("injected in the dataset's zone", factor(5400.5), "20240315085959.5+0100", "+0100");
    row_of_zones("injected in a zone to the east", factor(5400.5), "20240315132959.5+0530", "+0100");
    row_of_zones("injected in a zone where it is yesterday", factor(7200.0), "20240314220000-0930", "+0100");
    row_of_zones("injected without a zone, which the dataset has", factor(5400.5), "20240315085959.5",
                 "+0100");
    row_of_zones("injected in a zone, and the dataset has none", factor(3600.0), "20240315085959.5+0100", "");
    row_of_zones("injected in a zone that makes no sense", factor(3600.0), "20240315085959.5+1", "+0100");
    row_of_zones("a dataset's zone that makes no sense", factor(3600.0), "20240315085959.5+0100", "CET");
    row("injected before midnight", factor(3600.0), [](DcmDataset& d) {
      d.putAndInsertString(DCM_SeriesTime, "003000");
      tracer_of(d).putAndInsertString(DCM_RadiopharmaceuticalStartTime, "233000");
    });
    row("no date of the acquisition", factor(3600.0),
        [](DcmDataset& d) { d.findAndDeleteElement(DCM_AcquisitionDate); });
  }

  void activity_becomes_suv() {
    QFETCH(Change, change);
    QFETCH(double, expected);
    const Made made("CT", {make_pet, change});
    const imaging::Series series = made.series();
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.unit, std::string("SUVbw g/ml"));
    QVERIFY(told(series.changes, "SUVbw"));
    QVERIFY(series.warnings.empty());
    const auto volume = imaging::load_series(series);
    QCOMPARE(test::failure(volume), QString());
    QCOMPARE(volume->unit, series.unit);
    const std::int64_t last = volume->geometry.voxel_count() - 1;
    const double suv = 0.5 * made.stored(last) * expected;
    QVERIFY2(std::abs(static_cast<double>(volume->value(last)) - suv) < 1e-5 * suv,
             qPrintable(QString::number(static_cast<double>(volume->value(last)))));
    QVERIFY(std::abs(volume->window->centre - 1000.0 * expected) < 1e-9);
  }

  void what_is_missing_or_contradicts_leaves_activity_data() {
    QTest::addColumn<Change>("change");
    QTest::addColumn<QString>("named");
    const auto row = [](const char* named, const Change& change) {
      QTest::newRow(named) << change << QString(named);
    };
    const auto set = [](const DcmTagKey& key, const char* value) {
      return [key, value](DcmDataset& d) { d.putAndInsertString(key, value); };
    };
    const auto set_tracer = [](const DcmTagKey& key, const char* value) {
      return [key, value](DcmDataset& d) { tracer_of(d).putAndInsertString(key, value); };
    };
    row("PatientWeight (0010,1030) is missing", set(DCM_PatientWeight, ""));
    row("PatientWeight (0010,1030) is 0 kg", set(DCM_PatientWeight, "0"));
    row("RadionuclideTotalDose (0018,1074) is missing", set_tracer(DCM_RadionuclideTotalDose, ""));
    row("RadionuclideTotalDose (0018,1074) is 200 Bq", set_tracer(DCM_RadionuclideTotalDose, "200"));
    row("RadionuclideHalfLife (0018,1075) is 0 s", set_tracer(DCM_RadionuclideHalfLife, "0"));
    row("RadiopharmaceuticalStartTime (0018,1072) is missing",
        set_tracer(DCM_RadiopharmaceuticalStartTime, "93"));
    row("RadiopharmaceuticalStartTime (0018,1072) is missing or", [](DcmDataset& d) {
      tracer_of(d).putAndInsertString(DCM_RadiopharmaceuticalStartDateTime, "20240315093000+0100");
      tracer_of(d).findAndDeleteElement(DCM_RadiopharmaceuticalStartTime);
    });
    row("RadiopharmaceuticalStartDateTime (0018,1078) is later",
        set_tracer(DCM_RadiopharmaceuticalStartDateTime, "20240316093000"));
    row("RadiopharmaceuticalStartDateTime (0018,1078) is 8785.0 hours",
        set_tracer(DCM_RadiopharmaceuticalStartDateTime, "20230315093000"));
    row("RadiopharmaceuticalStartTime (0018,1072) is 23.5 hours",
        set_tracer(DCM_RadiopharmaceuticalStartTime, "110000"));
    row("DecayCorrection (0054,1102) is 'NONE'", set(DCM_DecayCorrection, "NONE"));
    row("CorrectedImage (0028,0051) does not name ATTN", set(DCM_CorrectedImage, "DECY"));
    row("SeriesTime (0008,0031) is later than AcquisitionTime", set(DCM_SeriesTime, "120000"));
    row("AcquisitionTime (0008,0032) is missing", set(DCM_AcquisitionTime, "noon"));
    row("SeriesTime (0008,0031) is missing", set(DCM_SeriesTime, "2500"));
    row("RadionuclideTotalDose (0018,1074) is missing or",
        [](DcmDataset& d) { d.findAndDeleteElement(DCM_RadiopharmaceuticalInformationSequence); });
  }

  void what_is_missing_or_contradicts_leaves_activity() {
    QFETCH(Change, change);
    QFETCH(QString, named);
    const Made made("CT", {make_pet, change});
    const imaging::Series series = made.series();
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.unit, std::string("Bq/ml"));
    QVERIFY2(told(series.warnings, named), series.warnings.empty() ? "" : series.warnings[0].c_str());
    const auto volume = imaging::load_series(series);
    QCOMPARE(test::failure(volume), QString());
    const std::int64_t last = volume->geometry.voxel_count() - 1;
    QCOMPARE(static_cast<double>(volume->value(last)), 0.5 * made.stored(last));
  }

  void all_images_must_say_the_same() {
    const Made made("CT", {make_pet}, [](DcmDataset& d) { d.putAndInsertString(DCM_PatientWeight, "71"); });
    QCOMPARE(made.series().unit, std::string("Bq/ml"));
    QVERIFY(told(made.series().warnings, "PatientWeight (0010,1030) is not the same in all images"));
    const Made mixed("CT", {make_pet}, [](DcmDataset& d) { d.putAndInsertString(DCM_Units, "GML"); });
    QVERIFY(!mixed.series().loadable);
    QVERIFY(told({mixed.series().reason}, "the unit of the values is not the same"));
  }

  void what_is_no_activity_is_named_as_it_is() {
    const auto units = [](const char* value) {
      return [value](DcmDataset& d) { d.putAndInsertString(DCM_Units, value); };
    };
    QCOMPARE(Made("CT", {make_pet, units("GML")}).series().unit, std::string("SUVbw g/ml"));
    const Made counts("CT", {make_pet, units("CNTS")});
    QCOMPARE(counts.series().unit, std::string());
    QVERIFY(told(counts.series().warnings, "Units (0054,1001) is 'CNTS'"));
    const Made odd("CT", {make_pet, units("CN\n\xff")});
    QVERIFY(told(odd.series().warnings,
                 "Units (0054,1001) is 'CN?"
                 "?'"));
  }

  void a_mapping_to_a_unit_is_used_in_mr() {
    const Made made("MR", {[](DcmDataset& d) { put_mapping(d, "mm2/s"); }});
    const imaging::Series series = made.series();
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.unit, std::string("mm2/s"));
    QVERIFY(told(series.changes, "RealWorldValueMappingSequence (0040,9096)"));
    const auto volume = imaging::load_series(series);
    QCOMPARE(test::failure(volume), QString());
    const std::int64_t last = volume->geometry.voxel_count() - 1;
    QVERIFY(std::abs(static_cast<double>(volume->value(last)) - (1e-6 * made.stored(last) + 0.25)) < 1e-6);
  }

  void a_mapping_converts_the_window_data() {
    QTest::addColumn<QByteArray>("slope");
    QTest::addColumn<QByteArray>("intercept");
    QTest::addColumn<double>("centre");
    QTest::addColumn<double>("width");
    // By the mapping of the stored values that lie in the window 1500 / 3000.
    const auto row = [](const char* name, const char* slope, const char* intercept, double centre,
                        double width) {
      QTest::newRow(name) << QByteArray(slope) << QByteArray(intercept) << 1e-6 * centre + 0.25
                          << 1e-6 * width;
    };
    row("stored values", "1", "0", 1500.0, 3000.0);
    row("rescaled values", "2", "-7", 753.5, 1500.0);
    row("values that fall", "-2", "0", -750.0, 1500.0);
  }

  void a_mapping_converts_the_window() {
    QFETCH(QByteArray, slope);
    QFETCH(QByteArray, intercept);
    QFETCH(double, centre);
    QFETCH(double, width);
    const auto put_values = [&](DcmItem& values, DcmItem& window) {
      values.putAndInsertString(DCM_RescaleSlope, slope.constData());
      values.putAndInsertString(DCM_RescaleIntercept, intercept.constData());
      window.putAndInsertString(DCM_WindowCenter, "1500");
      window.putAndInsertString(DCM_WindowWidth, "3000");
    };
    const Made classic("MR", {[&](DcmDataset& d) {
                         put_values(d, d);
                         put_mapping(d, "mm2/s");
                       }});
    const Enhanced enhanced("MR", [&](DcmItem& groups, std::size_t) {
      put_values(test::group(groups, DCM_PixelValueTransformationSequence),
                 test::group(groups, DCM_FrameVOILUTSequence));
      put_mapping(groups, "mm2/s");
    });
    for (const imaging::Series& series : {classic.series(), enhanced.series()}) {
      const auto volume = imaging::load_series(series);
      QCOMPARE(test::failure(volume), QString());
      QVERIFY(volume->window);
      QVERIFY(std::abs(volume->window->centre - centre) < 1e-12);
      QVERIFY(std::abs(volume->window->width - width) < 1e-12);
    }
  }

  void a_mapping_that_is_not_sure_is_told_and_not_used_data() {
    QTest::addColumn<QByteArray>("modality");
    QTest::addColumn<Change>("change");
    QTest::addColumn<QString>("why");
    const auto row = [](const char* why, const Change& change, const char* modality = "MR") {
      QTest::newRow(why) << QByteArray(modality) << change << QString(why);
    };
    row("it states no unit", [](DcmDataset& d) { put_mapping(d, "1"); });
    row("its unit is none of UCUM", [](DcmDataset& d) { put_mapping(d, "<b>ms"); });
    row("it leaves stored values without meaning", [](DcmDataset& d) { put_mapping(d, "ms", 4095); });
    row(
        "it is used in MR only", [](DcmDataset& d) { put_mapping(d, "[hnsf'U]"); }, "CT");
    row("there are several", [](DcmDataset& d) {
      put_mapping(d, "ms");
      put_mapping(d, "s");
    });
    row("it is not linear", [](DcmDataset& d) {
      put_mapping(d, "ms");
      DcmItem* mapping = nullptr;
      d.findAndGetSequenceItem(DCM_RealWorldValueMappingSequence, mapping);
      mapping->findAndDeleteElement(DCM_RealWorldValueSlope);
    });
  }

  void a_mapping_that_is_not_sure_is_told_and_not_used() {
    QFETCH(QByteArray, modality);
    QFETCH(Change, change);
    QFETCH(QString, why);
    const Made made(modality.constData(), {change});
    const imaging::Series series = made.series();
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.unit, modality == "CT" ? std::string("HU") : std::string());
    QVERIFY2(told(series.changes, "is not used: " + why),
             series.changes.empty() ? "" : series.changes[0].c_str());
    const auto volume = imaging::load_series(series);
    QCOMPARE(test::failure(volume), QString());
    QCOMPARE(static_cast<double>(volume->value(std::int64_t{7})), made.stored(7));
  }

  void values_by_a_table_are_told_and_stay_as_stored_data() {
    QTest::addColumn<QByteArray>("modality");
    for (const char* modality : {"CT", "MR"}) QTest::newRow(modality) << QByteArray(modality);
  }

  void values_by_a_table_are_told_and_stay_as_stored() {
    QFETCH(QByteArray, modality);
    const Change put_table = [](DcmDataset& d) {
      for (const DcmTagKey& key : {DCM_RescaleSlope, DCM_RescaleIntercept, DCM_RescaleType})
        d.findAndDeleteElement(key);
      DcmItem* table = nullptr;
      d.findOrCreateSequenceItem(DCM_ModalityLUTSequence, table);
      table->putAndInsertString(DCM_ModalityLUTType, "HU");
    };
    const Made made(modality.constData(), {put_table});
    const imaging::Series series = made.series();
    QVERIFY2(series.loadable, series.reason.c_str());
    QCOMPARE(series.unit, std::string());
    QVERIFY(told(series.warnings, "stay as they are stored: the table in ModalityLUTSequence (0028,3000)"));
    const auto volume = imaging::load_series(series);
    QCOMPARE(test::failure(volume), QString());
    QCOMPARE(static_cast<double>(volume->value(std::int64_t{7})), made.stored(7));
    QVERIFY(!told(Made(modality.constData(), {}).series().warnings, "ModalityLUTSequence"));
  }

  void frames_say_in_their_groups_what_their_values_are() {
    const auto rescaled = [](const char* type) {
      return [=](DcmItem& groups, std::size_t) {
        DcmItem& values = test::group(groups, DCM_PixelValueTransformationSequence);
        values.putAndInsertString(DCM_RescaleSlope, "2");
        values.putAndInsertString(DCM_RescaleIntercept, "-7");
        values.putAndInsertString(DCM_RescaleType, type);
      };
    };
    QCOMPARE(Enhanced("CT", rescaled("HU")).series().unit, std::string("HU"));
    QCOMPARE(Enhanced("CT", rescaled("MGML")).series().unit, std::string());

    // A mapping takes the place of each frame's rescale, also where it is shared and read before that.
    const Enhanced mapped("MR", rescaled("US"), [](DcmDataset& dataset) {
      put_mapping(test::group(dataset, DCM_SharedFunctionalGroupsSequence), "mm2/s");
    });
    QCOMPARE(mapped.series().unit, std::string("mm2/s"));
    const auto volume = imaging::load_series(mapped.series());
    QCOMPARE(test::failure(volume), QString());
    QCOMPARE(volume->slope, 1e-6);
    QCOMPARE(volume->intercept, 0.25);

    const Enhanced some("MR", [](DcmItem& groups, std::size_t frame) {
      if (frame > 0) put_mapping(groups, "mm2/s");
    });
    QVERIFY(told({some.series().reason}, "the unit of the values is not the same"));
    const Enhanced plain("MR", [](DcmItem& groups, std::size_t) { put_mapping(groups, "1"); });
    QVERIFY(told(plain.series().changes, "is not used: it states no unit"));
  }
};

TIDEMARK_TEST(DicomQuantityTest)

}  // namespace tidemark::test::dicom_quantity_test

#include "dicom_quantity_test.moc"
