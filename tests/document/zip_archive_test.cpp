// Archives: what is written in pieces is read in pieces.
#include "document/zip_archive.h"

#include <algorithm>
#include <array>
#include <random>
#include <vector>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::zip_archive_test {

class ZipArchiveTest : public QObject {
  Q_OBJECT

 private slots:
  void entries_are_the_same_however_they_are_cut_data() {
    QTest::addColumn<int>("bytes");
    QTest::addColumn<int>("a_piece");
    QTest::newRow("none") << 0 << 1;
    QTest::newRow("a byte at a time") << 3'000 << 1;
    QTest::newRow("uneven pieces") << 200'000 << 777;
    QTest::newRow("large pieces") << 1'000'000 << 400'000;
    QTest::newRow("one piece") << 100'000 << 100'000;
  }
  void entries_are_the_same_however_they_are_cut() {
    QFETCH(int, bytes);
    QFETCH(int, a_piece);
    std::vector<std::uint8_t> values(static_cast<std::size_t>(bytes));
    std::mt19937 random(1);
    for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(random() % 7);
    const auto all = std::as_bytes(std::span(values));
    const auto piece = [&](std::size_t number) {
      const std::size_t begin = std::min(number * static_cast<std::size_t>(a_piece), all.size());
      return all.subspan(begin, std::min(static_cast<std::size_t>(a_piece), all.size() - begin));
    };
    const std::array<document::ZipEntry, 2> entries{{{"whole", all}, {"pieces", all.size(), piece}}};
    const TemporaryFolder folder;
    const std::filesystem::path file = folder / "a.zip";
    QCOMPARE(failure(document::write_zip(file, entries)), QString());

    const std::array<std::string_view, 2> names{"whole", "pieces"};
    auto archive = document::ZipReader::open(file, names);
    QCOMPARE(failure(archive), QString());
    for (const std::string_view name : names) {
      QCOMPARE(archive->size(name), values.size());
      const auto read = archive->read<std::uint8_t>(name, values.size());
      QCOMPARE(failure(read), QString());
      QVERIFY(*read == values);
      std::vector<std::uint8_t> gathered;
      const Status unpacked =
          archive->unpack(name, values.size(), [&](std::span<const std::uint8_t> part) -> Status {
            gathered.insert(gathered.end(), part.begin(), part.end());
            return {};
          });
      QCOMPARE(failure(unpacked), QString());
      QVERIFY(gathered == values);
    }
    QVERIFY(!archive->read(names[0], values.size() + 1));
    QVERIFY(!archive->read("another", 1));
  }

  void who_reads_may_end_it() {
    const std::vector<std::byte> zeros(1'000'000);
    const std::array<document::ZipEntry, 1> entries{{{"zeros", zeros}}};
    const TemporaryFolder folder;
    QCOMPARE(failure(document::write_zip(folder / "a.zip", entries)), QString());
    const std::array<std::string_view, 1> names{"zeros"};
    auto archive = document::ZipReader::open(folder / "a.zip", names);
    int pieces = 0;
    const Status ended = archive->unpack("zeros", zeros.size(), [&](std::span<const std::uint8_t>) -> Status {
      ++pieces;
      return fail(ErrorKind::input, "enough");
    });
    QVERIFY(!ended && ended.error().message.ends_with("enough"));
    QCOMPARE(pieces, 1);
  }
};

TIDEMARK_TEST(ZipArchiveTest)

}  // namespace tidemark::test::zip_archive_test

#include "zip_archive_test.moc"
