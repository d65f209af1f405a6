// A file that is replaced after it was checked.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <filesystem>

#include "imaging/dicom/dicom_setup.h"
#include "imaging/dicom/element_text.h"
#include "imaging/dicom/parsed_dicom.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::parsed_dicom_test {

namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kInstance = 0x00080018;
constexpr std::uint32_t kComments = 0x00204000;

// Longer than what DCMTK reads when it parses.
const std::string kLongText(40'000, 'x');

std::string slice_named(const std::string& uid, const std::string& comments) {
  return file(Dataset::slice().put_text(kInstance, "UI", uid).put_text(kComments, "LT", comments));
}

// Under which DCMTK's stack ends.
std::string bottomless() {
  return file(Dataset::slice().put(0x00081140, nested(100'000, "SQ", kExplicit, false)));
}

// As whoever has a share mounted may do between two readings.
void replace(const fs::path& file, const std::string& bytes) {
  const fs::path other = file.string() + ".new";
  write_bytes(other, bytes);
  fs::rename(other, file);
}

}  // namespace

class ParsedDicomTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QCOMPARE(failure(imaging::set_up_dicom()), QString()); }

  void what_was_checked_is_what_is_parsed_data() {
    QTest::addColumn<QByteArray>("second");
    QTest::newRow("another slice") << QByteArray::fromStdString(slice_named("2.25.99", "short"));
    QTest::newRow("no DICOM") << QByteArray("hello");
    QTest::newRow("sequences without end") << QByteArray::fromStdString(bottomless());
  }
  void what_was_checked_is_what_is_parsed() {
    QFETCH(QByteArray, second);
    const TemporaryFolder folder;
    const fs::path file = folder / "slice.dcm";
    write_bytes(file, slice_named("2.25.1", kLongText));
    auto checked = imaging::check_dicom_to_parse(file);
    QCOMPARE(failure(checked), QString());
    replace(file, second.toStdString());
    const auto parsed = imaging::ParsedDicom::parse(std::move(*checked), file);
    QCOMPARE(failure(parsed), QString());
    QCOMPARE(imaging::element_text(parsed->dataset(), DCM_SOPInstanceUID), std::string("2.25.1"));
    QVERIFY(imaging::element_text(parsed->dataset(), DCM_ImageComments) == kLongText);
  }

  void long_values_come_from_the_file_that_was_opened() {
    const TemporaryFolder folder;
    const fs::path file = folder / "slice.dcm";
    write_bytes(file, slice_named("2.25.1", kLongText));
    auto parsed = imaging::ParsedDicom::open(file);
    QCOMPARE(failure(parsed), QString());
    replace(file, slice_named("2.25.1", std::string(40'000, 'y')));
    const auto moved = std::move(*parsed);
    QVERIFY(imaging::element_text(moved.dataset(), DCM_ImageComments) == kLongText);
  }

  void what_is_taken_needs_no_file() {
    const TemporaryFolder folder;
    const fs::path file = folder / "slice.dcm";
    write_bytes(file, slice_named("2.25.1", kLongText));
    auto parsed = imaging::ParsedDicom::open(file);
    QCOMPARE(failure(parsed), QString());
    const auto format = parsed->take();
    parsed = fail(ErrorKind::input, "closed");
    QVERIFY(imaging::element_text(*format->getDataset(), DCM_ImageComments) == kLongText);
  }

  void a_file_that_shrinks_meanwhile_has_only_what_is_left() {
    const TemporaryFolder folder;
    const fs::path file = folder / "slice.dcm";
    write_bytes(file, slice_named("2.25.1", kLongText));
    const auto parsed = imaging::ParsedDicom::open(file);
    QCOMPARE(failure(parsed), QString());
    fs::resize_file(file, 1000);
    QCOMPARE(imaging::element_text(parsed->dataset(), DCM_SOPInstanceUID), std::string("2.25.1"));
    // What is missing is nothing, and no memory of others.
    const std::string left = imaging::element_text(parsed->dataset(), DCM_ImageComments);
    QVERIFY(left.size() < 1000 && left.find_first_not_of('x') == std::string::npos);
  }

  void reading_ends_before_the_element_that_is_named() {
    const TemporaryFolder folder;
    const fs::path file = folder / "slice.dcm";
    write_bytes(file, slice_named("2.25.1", kLongText));
    const auto parsed = imaging::ParsedDicom::open(file, imaging::DicomTag{0x0028, 0x0010});
    QCOMPARE(failure(parsed), QString());
    QVERIFY(parsed->dataset().tagExists(DCM_ImageComments));
    QVERIFY(!parsed->dataset().tagExists(DCM_Rows));
  }
};

TIDEMARK_TEST(ParsedDicomTest)

}  // namespace tidemark::test::parsed_dicom_test

#include "parsed_dicom_test.moc"
