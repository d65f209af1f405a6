// gzip that comes from a server: whole, cut, too long, and what is neither.
#include "imaging/ai/packed_bytes.h"

#include <QTest>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::packed_bytes_test {

class PackedBytesTest : public QObject {
  Q_OBJECT

  // Packed by the code that packs images: 4 bytes a voxel.
  static std::string packed(const std::vector<float>& values) {
    const TemporaryFolder folder;
    Volume volume;
    volume.geometry.size = {static_cast<std::int64_t>(values.size()), 1, 1};
    volume.voxels = values;
    if (!imaging::pack_values(volume, folder / "a.gz", {})) qFatal("cannot pack");
    return bytes_of(folder / "a.gz").toStdString();
  }

 private slots:
  void what_is_packed_comes_back() {
    const std::vector<float> values{0.0F, -1.5F, 1e6F, 3.25F};
    const auto back = imaging::unpacked(packed(values), 16);
    QVERIFY(back.has_value());
    std::vector<float> same(4);
    std::memcpy(same.data(), back->data(), 16);
    QVERIFY(same == values);
  }

  void another_length_is_refused_and_nothing_beyond_is_unpacked() {
    const std::string bomb = packed(std::vector<float>(1 << 20));
    QVERIFY(bomb.size() < 64'000);  // of 4 MiB
    for (const std::int64_t wanted : {0, 1, 15, (1 << 22) - 1, (1 << 22) + 1}) {
      QVERIFY2(!imaging::unpacked(bomb, wanted), qPrintable(QString::number(wanted)));
    }
    QVERIFY(imaging::unpacked(bomb, 1 << 22).has_value());
  }

  void what_is_no_whole_stream_is_refused() {
    const std::string good = packed({1.0F, 2.0F, 3.0F, 4.0F});
    for (std::size_t size = 0; size < good.size(); ++size)
      QVERIFY(!imaging::unpacked(good.substr(0, size), 16));
    for (std::size_t at = 0; at < good.size(); ++at) {
      std::string damaged = good;
      damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
      static_cast<void>(imaging::unpacked(damaged, 16));  // ends, whatever it says
    }
    QVERIFY(!imaging::unpacked("<html>", 16));
  }
};

TIDEMARK_TEST(PackedBytesTest)

}  // namespace tidemark::test::packed_bytes_test

#include "packed_bytes_test.moc"
