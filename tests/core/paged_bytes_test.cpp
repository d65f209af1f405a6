// Pages of bytes that copies share: what is changed in one is changed in no other.
#include "core/paged_bytes.h"
#include "core/index_walk.h"

#include <algorithm>
#include <random>

#include "core/region.h"
#include "tests/support/test_program.h"

namespace tidemark::test::paged_bytes_test {

namespace {

// Three, two and four pages along the axes, the last of each with room beyond the grid's end.
constexpr Index3 kSize{150, 13, 27};
constexpr std::int64_t kCount = kSize.x * kSize.y * kSize.z;
constexpr std::int64_t kPageVoxels = 64 * 8 * 8;

std::size_t offset(Index3 v) {
  return static_cast<std::size_t>(v.x + kSize.x * (v.y + kSize.y * v.z));
}

class Boxes {
 public:
  explicit Boxes(unsigned seed) : random_(seed) {}
  struct Box {
    Index3 first;
    Index3 shape;
  };
  Box next() {
    const Index3 first(number() % kSize.x, number() % kSize.y, number() % kSize.z);
    const Index3 room = kSize - first;
    return {first, Index3(1 + number() % room.x, 1 + number() % room.y, 1 + number() % room.z)};
  }
  std::int64_t number() { return static_cast<std::int64_t>(random_()); }

 private:
  std::mt19937 random_;
};

}  // namespace

class PagedBytesTest : public QObject {
  Q_OBJECT

 private slots:
  void pages_hold_what_was_put_in() {
    for (const std::uint8_t rest : {0, 3, 255}) {
      std::vector<std::uint8_t> voxels(static_cast<std::size_t>(kCount), rest);
      PagedBytes bytes(kSize, rest);
      QVERIFY(bytes.empty() && bytes.voxels() == voxels);
      Boxes boxes(1);
      for (int n = 0; n < 60; ++n) {
        const auto [first, shape] = boxes.next();
        std::vector<std::uint8_t> values(static_cast<std::size_t>(shape.x * shape.y * shape.z));
        std::size_t at = 0;
        if (n % 2 == 0) {
          const auto value = static_cast<std::uint8_t>(boxes.number() % 4);
          bytes.fill(first, shape, value);
          for_each_index(first, first + shape, [&](Index3 v) { voxels[offset(v)] = value; });
        } else {
          for (std::uint8_t& value : values) value = static_cast<std::uint8_t>(boxes.number() % 4);
          bytes.write(first, shape, values.data());
          for_each_index(first, first + shape, [&](Index3 v) { voxels[offset(v)] = values[at++]; });
        }
        QVERIFY(bytes.voxels() == voxels);
        std::array<std::int64_t, 256> counts{};
        for (const std::uint8_t value : voxels) ++counts[value];
        QVERIFY(bytes.counts() == counts);
        const auto [low, part] = boxes.next();
        std::vector<std::uint8_t> there(static_cast<std::size_t>(part.x * part.y * part.z));
        bytes.read(low, part, there.data());
        at = 0;
        for_each_index(low, low + part, [&](Index3 v) {
          if (there[at++] != voxels[offset(v)] || bytes.at(v) != voxels[offset(v)]) QFAIL("another value");
        });
        const Index3 high = low + part - Index3(1);
        const auto corners = bytes.corners(low, high);
        for (std::size_t corner = 0; corner < corners.size(); ++corner) {
          const Index3 v((corner & 1 ? high : low).x, (corner & 2 ? high : low).y,
                         (corner & 4 ? high : low).z);
          QCOMPARE(corners[corner], voxels[offset(v)]);
        }
        QVERIFY(PagedBytes(kSize, voxels, rest) == bytes);
        QVERIFY(PagedBytes(kSize, voxels, 7).voxels() == voxels);
      }
    }
  }

  void regions_are_found_in_all_pages() {
    std::vector<std::uint8_t> voxels(static_cast<std::size_t>(kCount));
    std::mt19937 random(3);
    for (std::uint8_t& value : voxels)
      value = static_cast<std::uint8_t>(random() % 3 == 0 ? random() % 256 : 0);
    const PagedBytes bytes(kSize, voxels);
    for (const std::uint8_t value : {1, 127, 128, 255}) {
      Region expected(VoxelRange{Index3(0), kSize});
      for_each_index(Index3(0), kSize, [&](Index3 v) {
        if (voxels[offset(v)] == value) expected.add(v);
      });
      const Region found(bytes, value);
      QVERIFY(expected.count() > 10 && found == expected && found.bounds() == expected.bounds());
    }
    QVERIFY(Region(PagedBytes(kSize), 1).empty());
  }

  void a_copy_keeps_what_it_was_and_shares_the_rest() {
    PagedBytes bytes(kSize);
    bytes.fill({0, 0, 8}, {128, 8, 8}, 2);
    const PagedBytes before = bytes;
    const std::vector<std::uint8_t> voxels = before.voxels();
    QVERIFY(bytes == before);
    bytes.fill({60, 5, 10}, {4, 1, 1}, 5);
    QVERIFY(before.voxels() == voxels && bytes != before);
    const std::int64_t changed = bytes.layout().translate({60, 5, 10}).page;
    for (std::int64_t page = 0; page < bytes.layout().page_count(); ++page)
      QCOMPARE(bytes.page(page) == before.page(page), page != changed);
    // What nobody else has is changed where it is.
    const std::uint8_t* const own = bytes.page(changed);
    bytes.fill({0, 0, 8}, {1, 1, 1}, 9);
    QVERIFY(bytes.page(changed) == own);
    // No memory for nothing.
    bytes.fill({0, 8, 0}, {10, 5, 3}, 0);
    QVERIFY(bytes.page(bytes.layout().translate({0, 8, 0}).page) == nullptr);
  }

  void differences_are_those_of_the_voxels() {
    Boxes boxes(5);
    PagedBytes a(kSize);
    for (int n = 0; n < 40; ++n) {
      PagedBytes b = a;
      const auto [first, shape] = boxes.next();
      b.fill(first, shape, static_cast<std::uint8_t>(boxes.number() % 3));
      if (n % 3 == 0) b.fill({0, 3, 9}, {150, 1, 1}, static_cast<std::uint8_t>(n));
      std::vector<std::uint8_t> now = a.voxels();
      PagedBytes::for_each_difference(
          a, b, [&](Index3 voxel, std::int64_t length, std::uint8_t before, std::uint8_t after) {
            QVERIFY(before != after && length > 0 && voxel.x + length <= kSize.x);
            for (std::int64_t i = 0; i < length; ++i) {
              QCOMPARE(now[offset(voxel + Index3(i, 0, 0))], before);
              now[offset(voxel + Index3(i, 0, 0))] = after;
            }
          });
      QVERIFY(now == b.voxels());
      a = b;
    }
  }

  void pages_of_one_value_share_their_memory() {
    PagedBytes bytes(kSize);
    const PagedBytes none = bytes;
    bytes.fill({0, 0, 0}, {128, 8, 16}, 4);
    bytes.fill({3, 3, 3}, {1, 1, 1}, 6);
    const std::vector<std::uint8_t> voxels = bytes.voxels();
    bytes.join_even_pages(none);
    QVERIFY(bytes.voxels() == voxels);
    QVERIFY(bytes.page(1) == bytes.page(bytes.layout().translate({64, 0, 8}).page));
    QVERIFY(bytes.page(0) != bytes.page(1));
    QVERIFY(bytes.even_value({64, 0, 0}, {64, 8, 16}) == 4 &&
            bytes.even_value({140, 3, 5}, {10, 2, 22}) == 0);
    QVERIFY(!bytes.even_value({63, 0, 0}, {2, 1, 1}) && !bytes.even_value({127, 0, 0}, {2, 1, 1}));
    // They are nobody's own.
    const PagedBytes joined = bytes;
    bytes.fill({64, 0, 0}, {1, 1, 1}, 1);
    QVERIFY(joined.voxels() == voxels && bytes.at({64, 0, 0}) == 1 && bytes.at({64, 0, 8}) == 4);
    // A page that is what it was at first takes none.
    const std::int64_t all = bytes.bytes();
    bytes.fill({0, 0, 8}, {64, 8, 8}, 0);
    QCOMPARE(bytes.bytes(), all);
    bytes.join_even_pages(joined);
    QCOMPARE(bytes.bytes(), all - kPageVoxels);
    bytes.fill(Index3(0), kSize, 0);
    bytes.join_even_pages(joined);
    QVERIFY(bytes.empty() && bytes == none);
  }

  void other_grids_differ() {
    QVERIFY(PagedBytes(kSize) != PagedBytes({150, 13, 26}));
    QVERIFY(PagedBytes() != PagedBytes(kSize));
    QVERIFY(PagedBytes().empty() && PagedBytes().voxels().empty());
  }
};

TIDEMARK_TEST(PagedBytesTest)

}  // namespace tidemark::test::paged_bytes_test

#include "paged_bytes_test.moc"
