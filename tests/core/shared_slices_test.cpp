// Slices that copies share: what is changed in one is changed in no other.
#include "core/shared_slices.h"

#include <algorithm>
#include <random>

#include "core/region.h"
#include "tests/support/test_program.h"

namespace tidemark::test::shared_slices_test {

namespace {

constexpr Index3 kSize{7, 5, 9};
constexpr std::int64_t kArea = kSize.x * kSize.y;

}  // namespace

class SharedSlicesTest : public QObject {
  Q_OBJECT

 private slots:
  void slices_hold_what_was_put_in() {
    std::vector<std::uint8_t> voxels(static_cast<std::size_t>(kArea * kSize.z));
    std::mt19937 random(1);
    for (std::int64_t i = 2 * kArea; i < 4 * kArea; ++i)
      voxels[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(random() % 4);
    const SharedSlices slices(kSize, voxels);
    QVERIFY(slices.voxels() == voxels);
    QCOMPARE(slices.bytes(), 2 * kArea);
    QVERIFY(slices.slice(1).empty() && slices.row(3, 4).empty() && slices.row(3, 3).size() == 7);
    for (std::int64_t i = 0; i < kArea * kSize.z; ++i)
      QCOMPARE(slices.at({i % 7, i / 7 % 5, i / kArea}), voxels[static_cast<std::size_t>(i)]);
    const SharedSlices full(kSize, 255);
    QVERIFY(full.empty() && full.at({1, 2, 3}) == 255);
    QVERIFY(SharedSlices(kSize, full.voxels(), 255).empty());
  }

  void runs_reach_over_the_ends_of_slices() {
    std::vector<std::uint8_t> voxels(static_cast<std::size_t>(kArea * kSize.z));
    SharedSlices slices(kSize);
    std::mt19937 random(2);
    for (int n = 0; n < 200; ++n) {
      const auto first = static_cast<std::int64_t>(random() % voxels.size());
      const auto length =
          std::min<std::int64_t>(random() % 90, static_cast<std::int64_t>(voxels.size()) - first);
      const auto value = static_cast<std::uint8_t>(random() % 3);
      std::fill_n(voxels.begin() + first, length, value);
      slices.fill(first, length, value);
      QVERIFY(slices.voxels() == voxels);
    }
  }

  void a_copy_keeps_what_it_was() {
    SharedSlices slices(kSize);
    slices.fill(3 * kArea, kArea, 2);
    const SharedSlices before = slices;
    const std::vector<std::uint8_t> voxels = before.voxels();
    QVERIFY(slices.differing_slices(before).empty());
    slices.fill(4 * kArea - 2, 4, 5);
    QVERIFY(before.voxels() == voxels);
    QVERIFY((slices.differing_slices(before) == std::vector<std::int64_t>{3, 4}));
    // No memory for nothing, and none that is not needed.
    slices.fill(6 * kArea, kArea, 0);
    QVERIFY(slices.slice(6).empty());
    QVERIFY(slices.slice(2).data() == before.slice(2).data());
    const std::uint8_t* const own = slices.slice(3).data();
    slices.change(3)[0] = 1;
    QVERIFY(slices.slice(3).data() == own);
    slices.clear(3);
    QCOMPARE(slices.at({0, 0, 3}), std::uint8_t{0});
    QCOMPARE(before.at({0, 0, 3}), std::uint8_t{2});
  }

  void others_differ_in_all_slices() {
    QCOMPARE(SharedSlices(kSize).differing_slices(SharedSlices({7, 5, 8})).size(), std::size_t{9});
    QVERIFY(SharedSlices().differing_slices(SharedSlices(kSize)).empty());
    QVERIFY(SharedSlices().empty() && SharedSlices().voxels().empty());
    QVERIFY(Region(SharedSlices(kSize), 1).empty());
  }
};

TIDEMARK_TEST(SharedSlicesTest)

}  // namespace tidemark::test::shared_slices_test

#include "shared_slices_test.moc"
