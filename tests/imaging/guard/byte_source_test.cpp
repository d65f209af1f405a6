// Deflated bytes as they are inflated piece by piece.
#include "imaging/guard/byte_source.h"

#include <zlib.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::byte_source_test {

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t kWindow = 4096;  // what measure() takes at a time

// As raw deflate stream, in few bits: zeros are references to the zeros before them.
Bytes deflate_zeros(std::size_t count, int strategy) {
  const Bytes zeros(count);
  Bytes packed(count + 64);
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, -MAX_WBITS, 8, strategy) != Z_OK) qFatal("zlib");
  stream.next_in = const_cast<std::uint8_t*>(zeros.data());
  stream.avail_in = static_cast<uInt>(zeros.size());
  stream.next_out = packed.data();
  stream.avail_out = static_cast<uInt>(packed.size());
  if (deflate(&stream, Z_FINISH) != Z_STREAM_END) qFatal("zlib");
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

}  // namespace

class ByteSourceTest : public QObject {
  Q_OBJECT
 private slots:
  // Where a piece ends within the last reference, and its last bits share a byte with the stream's end,
  // nothing is left to read but something to come.
  void all_of_a_stream_comes_out_however_its_end_lies() {
    for (const int strategy : {Z_DEFAULT_STRATEGY, Z_FIXED}) {
      for (std::size_t count = kWindow - 10; count < kWindow + 600; ++count) {
        const Bytes packed = deflate_zeros(count, strategy);
        imaging::MemoryBytes source(packed);
        const auto size = imaging::InflatedBytes::measure(source, 0, 1 << 20);
        QVERIFY2(size, qPrintable(QString::number(count)));
        QCOMPARE(static_cast<std::size_t>(*size), count);
        imaging::InflatedBytes inflated(source, 0, *size);
        Bytes piece(kWindow, 1);
        QCOMPARE(inflated.read(0, piece), std::min(count, kWindow));
        QCOMPARE(inflated.read(kWindow, piece), count - std::min(count, kWindow));
      }
    }
  }

  void a_stream_that_is_cut_anywhere_ends_early() {
    const Bytes packed = deflate_zeros(3 * kWindow, Z_FIXED);
    for (std::size_t count = 0; count < packed.size(); ++count) {
      imaging::MemoryBytes source(std::span<const std::uint8_t>(packed).first(count));
      const auto size = imaging::InflatedBytes::measure(source, 0, 1 << 20);
      QVERIFY(!size);
      QVERIFY(size.error().message.find("ends within") != std::string::npos);
    }
  }
};

TIDEMARK_TEST(ByteSourceTest)

}  // namespace tidemark::test::byte_source_test

#include "byte_source_test.moc"
