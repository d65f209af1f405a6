// Text of very many values. DCMTK takes time with the square of their number.
#include <QElapsedTimer>

#include "imaging/dicom/dicom.h"
#include "imaging/guard/dicom/tag_walk.h"
#include "tests/imaging/dicom/bad_dicom.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::long_text_test {

namespace {

constexpr std::uint32_t kCharacterSet = 0x00080005;
constexpr std::uint32_t kReferencedImages = 0x00081140;
constexpr std::size_t kKiB = 1024;

// That many bytes of values, with backslashes between them.
std::string values(const std::string& one, std::size_t bytes) {
  const std::string value = one + '\\';
  std::string all;
  all.reserve(bytes + value.size());
  while (all.size() + value.size() < bytes) all += value;
  return all + one;
}

std::string at_top(const std::string& character_sets, Coding coding) {
  return file(Dataset::slice(coding).put_text(kCharacterSet, "CS", character_sets));
}

std::string in_items(const std::string& character_sets, int items, Coding coding) {
  std::string all;
  for (int n = 0; n < items; ++n) all += item(text(kCharacterSet, "CS", character_sets, coding), coding);
  return file(Dataset::slice(coding).put(kReferencedImages, element(kReferencedImages, "SQ", all, coding)));
}

}  // namespace

class LongTextTest : public QObject {
  Q_OBJECT

 private slots:
  void character_sets_without_end_are_refused_data() {
    const std::string field = "SpecificCharacterSet (0008,0005)";
    std::vector<BadDicom> files;
    for (const char* one : {"", "A", "ISO 2022 IR 100"}) {
      for (const std::size_t kib : {65, 300, 4096}) {
        const std::string sets = values(one, kib * kKiB);
        const std::string what = std::to_string(kib) + " KiB of '" + one + "'";
        files.push_back({what, at_top(sets, kImplicit), field});
        files.push_back({what + ", nested", in_items(sets, 1, kImplicit), field});
      }
      const std::string most = values(one, 63 * kKiB);  // that an explicit length can say
      files.push_back({std::string("explicit '") + one + "'", at_top(most, kExplicit), field});
      files.push_back({std::string("explicit, nested '") + one + "'", in_items(most, 1, kExplicit), field});
    }
    files.push_back({"33 values", at_top(std::string(32, '\\'), kExplicit), field + " has 33 values"});
    files.push_back({"10,000 items with a character set of their own",
                     in_items("ISO_IR 100", 10'000, kExplicit), field + " is one of very many"});
    add_rows(files);
  }
  void character_sets_without_end_are_refused() { verify_refused(); }

  void every_character_set_that_there_is_may_be_named() {
    const TemporaryFolder folder;
    std::string sets = "ISO 2022 IR 6";
    for (const char* set : {"100", "101", "109", "110", "144", "127", "126", "138", "148", "166", "13", "87",
                            "159", "149", "58"}) {
      sets += std::string("\\ISO 2022 IR ") + set;
    }
    write_bytes(folder / "slice.dcm", at_top(sets, kExplicit));
    write_bytes(folder / "nested.dcm", in_items(sets, 100, kExplicit));
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(failure(found), QString());
    QVERIFY(found->skipped.empty());
  }

  // Whatever becomes of the file.
  void text_of_very_many_values_is_read_at_once_data() {
    QTest::addColumn<quint32>("tag");
    QTest::addColumn<QByteArray>("one");
    for (const std::uint32_t tag :
         {0x00080008U, 0x00080016U, 0x00080020U, 0x00080031U, 0x00080060U, 0x00080070U,
          0x0008103eU, 0x00100010U, 0x00100020U, 0x00101010U, 0x00180050U, 0x00180081U,
          0x0020000eU, 0x00200011U, 0x00200013U, 0x00200032U, 0x00200037U, 0x00280004U,
          0x00280008U, 0x00280030U, 0x00281050U, 0x00281053U, 0x00540081U}) {
      for (const char* one : {"", "1"}) {
        QTest::addRow("%08x of '%s'", tag, one) << quint32{tag} << QByteArray(one);
      }
    }
  }
  void text_of_very_many_values_is_read_at_once() {
    QFETCH(quint32, tag);
    QFETCH(QByteArray, one);
    const TemporaryFolder folder;
    for (const std::size_t kib : {1000, 4000}) {
      write_bytes(folder / (std::to_string(kib) + ".dcm"),
                  file(Dataset::slice(kImplicit).put_text(tag, "LO", values(one.toStdString(), kib * kKiB))));
    }
    QElapsedTimer timer;
    timer.start();
    const auto found = imaging::scan_dicom(folder.path());
    QVERIFY2(timer.elapsed() < 2000, qPrintable(QString("%1 ms").arg(timer.elapsed())));
    QCOMPARE(failure(found), QString());
    for (const imaging::Series& series : found->series) QVERIFY(series.reason.size() < 400);
    for (const imaging::SkippedFile& skipped : found->skipped) QVERIFY(skipped.reason.size() < 400);
  }
};

TIDEMARK_TEST(LongTextTest)

}  // namespace tidemark::test::long_text_test

#include "long_text_test.moc"
