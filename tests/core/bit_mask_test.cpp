// Masks of one bit a voxel hold what the masks and regions hold that they are made from.
#include "core/bit_mask.h"

#include "core/region.h"
#include "tests/support/test_program.h"

namespace tidemark::test::bit_mask_test {

class BitMaskTest : public QObject {
  Q_OBJECT

  // Its 385 voxels end within a byte, and its rows within words.
  const Geometry grid_{{5, 11, 7}, {1.0, 1.0, 2.0}, glm::dmat3(1.0), {}};

  [[nodiscard]] Mask every_third() const {
    Mask mask{grid_, {}};
    for (std::int64_t offset = 0; offset < grid_.voxel_count(); ++offset)
      mask.voxels.push_back(offset % 3 == 0 ? 7 : 0);
    return mask;
  }

 private slots:
  void it_holds_the_voxels_of_a_mask() {
    const BitMask bits(every_third());
    QCOMPARE(bits.count(), std::int64_t{129});
    for (std::int64_t offset = 0; offset < grid_.voxel_count(); ++offset)
      QCOMPARE(bits.contains(offset), offset % 3 == 0);
    // From the middle of a byte on.
    std::vector<std::uint8_t> read(20, 9);
    inside_of(bits).read(13, read);
    for (std::size_t n = 0; n < read.size(); ++n)
      QCOMPARE(read[n], static_cast<std::uint8_t>((n + 13) % 3 == 0 ? 1 : 0));
  }

  void it_holds_the_voxels_of_a_region() {
    const Region region(every_third());
    const BitMask bits(grid_, region);
    QCOMPARE(bits.count(), region.count());
    QVERIFY(Region(bits) == region);
    QCOMPARE(BitMask(grid_, Region()).count(), std::int64_t{0});
    QVERIFY(Region(BitMask(grid_)).empty());
  }

  void runs_of_a_region_begin_and_end_within_bytes() {
    const Geometry grid{{40, 3, 2}, glm::dvec3(1.0), glm::dmat3(1.0), {}};
    for (const VoxelRange& box : {VoxelRange{{3, 0, 0}, {37, 3, 2}},
                                  {{0, 1, 0}, {40, 2, 2}},
                                  {{8, 0, 1}, {16, 3, 2}},
                                  {{17, 0, 0}, {22, 3, 1}}}) {
      const BitMask bits(grid, whole(box));
      QCOMPARE(bits.count(), whole(box).count());
      QVERIFY(Region(bits) == whole(box));
    }
  }

  void its_bits_make_it_again() {
    const BitMask bits(every_third());
    QCOMPARE(bits.bits().size(), std::size_t{49});
    QVERIFY(Region(BitMask(grid_, bits.bits())) == Region(bits));
    // Ones behind the last voxel are nothing.
    const std::vector<std::byte> ones(49, std::byte{0xFF});
    QCOMPARE(BitMask(grid_, ones).count(), grid_.voxel_count());
  }
};

TIDEMARK_TEST(BitMaskTest)

}  // namespace tidemark::test::bit_mask_test

#include "bit_mask_test.moc"
