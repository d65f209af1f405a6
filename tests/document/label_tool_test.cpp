// The tools that finish labels: what each makes of which, as one entry of the history, and what they refuse.
#include "document/label_tool.h"
#include "cases.h"
#include "imaging/regions/margin.h"
#include "solver/distance_transform.h"
#include "solver/model.h"
#include "tests/support/test_program.h"

namespace tidemark::test::label_tool_test {

using document::LabelTool;

namespace {

Region box(Index3 first, Index3 last) {
  return whole({first, last + Index3(1)});
}

// Two labels over a grid of 40 x 30 x 20: one of two islands, the larger with a bubble; a small one beside.
class LabelledCase {
 public:
  LabelledCase() : labels_(grid(), &history_) {
    liver_ = labels_.add("Liver").value();
    spleen_ = labels_.add("Spleen").value();
    give(liver_, united(difference(box({2, 2, 2}, {15, 15, 12}), box({6, 6, 6}, {7, 7, 7})),
                        box({25, 2, 2}, {27, 4, 4})));
    give(spleen_, box({17, 2, 2}, {20, 10, 10}));
  }

  static Geometry grid() {
    Geometry grid = lumpy_volume({40, 30, 20})->geometry;
    grid.spacing_mm = {1.0, 1.0, 2.0};
    return grid;
  }
  [[nodiscard]] document::Labels& labels() { return labels_; }
  [[nodiscard]] document::History& history() { return history_; }
  [[nodiscard]] std::uint8_t liver() const { return liver_; }
  [[nodiscard]] std::uint8_t spleen() const { return spleen_; }
  [[nodiscard]] document::LabelVoxels values() const {
    return {labels_.geometry(), labels_.list(), std::make_shared<const PagedBytes>(labels_.voxels()),
            nullptr};
  }
  // The tool's outcome of the liver, applied.
  Status apply(const document::LabelToolUse& use, document::Take take = document::Take::free_voxels) {
    const auto regions = document::use_tool(use, {liver_}, values());
    if (!regions) return pass_on(regions);
    const auto finished = labels_.finish(*regions, take);
    if (!finished) return pass_on(finished);
    return {};
  }

 private:
  void give(std::uint8_t label, const Region& region) {
    if (!labels_.accept(region, label)) qFatal("the label takes nothing");
  }

  document::History history_;
  document::Labels labels_;
  std::uint8_t liver_ = 0;
  std::uint8_t spleen_ = 0;
};

document::LabelToolUse with(LabelTool tool, double amount = 1.0) {
  document::LabelToolUse use;
  use.tool = tool;
  use.amount = amount;
  return use;
}

}  // namespace

class LabelToolTest : public QObject {
  Q_OBJECT

 private slots:
  void islands_are_kept_and_removed() {
    {
      LabelledCase one;
      QCOMPARE(failure(one.apply(with(LabelTool::largest_island))), QString());
      QVERIFY(!one.labels().region(one.liver()).contains({26, 3, 3}));
      QVERIFY(one.labels().region(one.liver()).contains({3, 3, 3}));
    }
    {
      LabelledCase one;
      document::LabelToolUse use = with(LabelTool::island_here);
      use.voxel = {26, 3, 3};
      QCOMPARE(failure(one.apply(use)), QString());
      QCOMPARE(one.labels().region(one.liver()).count(), std::int64_t{27});
      use.voxel = {3, 3, 3};
      QVERIFY(!one.apply(use));
    }
    // 27 voxels of 2 mm^3 are 0.054 ml.
    for (const double ml : {0.053, 0.055}) {
      LabelledCase one;
      QCOMPARE(failure(one.apply(with(LabelTool::small_islands, ml))), QString());
      QCOMPARE(one.labels().region(one.liver()).contains({26, 3, 3}), ml < 0.054);
    }
  }

  void holes_are_filled() {
    LabelledCase one;
    const std::int64_t before = one.labels().region(one.liver()).count();
    QCOMPARE(failure(one.apply(with(LabelTool::holes))), QString());
    QCOMPARE(one.labels().region(one.liver()).count(), before + 8);
    LabelledCase other;
    QCOMPARE(failure(other.apply(with(LabelTool::slice_holes))), QString());
    QCOMPARE(other.labels().region(other.liver()).count(), before + 8);
  }

  void what_grows_leaves_other_labels_alone_unless_it_may_take_them() {
    for (const document::Take take : {document::Take::free_voxels, document::Take::others_too}) {
      LabelledCase one;
      const Region before = one.labels().region(one.liver());
      const Region spleen = one.labels().region(one.spleen());
      const Region wanted = imaging::grown(before, LabelledCase::grid(), 4.0).value();
      QVERIFY(common_count(wanted, spleen) > 0);
      QCOMPARE(failure(one.apply(with(LabelTool::grow, 4.0), take)), QString());
      const bool takes = take == document::Take::others_too;
      QVERIFY(one.labels().region(one.liver()) == (takes ? wanted : difference(wanted, spleen)));
      QVERIFY(one.labels().region(one.spleen()) == (takes ? difference(spleen, wanted) : spleen));
      // One entry, taken back in one.
      QCOMPARE(failure(one.history().undo()), QString());
      QVERIFY(one.labels().region(one.liver()) == before);
      QVERIFY(one.labels().region(one.spleen()) == spleen);
      QCOMPARE(failure(one.history().redo()), QString());
      QVERIFY(one.labels().region(one.spleen()) == (takes ? difference(spleen, wanted) : spleen));
    }
  }

  void a_plane_makes_a_label_of_what_it_cuts_off() {
    LabelledCase one;
    const Region before = one.labels().region(one.liver());
    document::LabelToolUse use = with(LabelTool::split);
    use.normal = {1.0, 0.0, 0.0};
    use.point_mm = one.labels().geometry().to_patient({9.5, 0.0, 0.0});
    QCOMPARE(failure(one.apply(use)), QString());
    QCOMPARE(one.labels().list().size(), std::size_t{3});
    const document::Label& cut = one.labels().list().back();
    QCOMPARE(cut.name, std::string("Liver 2"));
    QVERIFY(!one.labels().region(one.liver()).contains({9, 3, 3}));
    QVERIFY(one.labels().region(cut.id).contains({9, 3, 3}));
    QVERIFY(united(one.labels().region(cut.id), one.labels().region(one.liver())) == before);
    QCOMPARE(failure(one.history().undo()), QString());
    QCOMPARE(one.labels().list().size(), std::size_t{2});
    QVERIFY(one.labels().region(one.liver()) == before);
    use.point_mm = one.labels().geometry().to_patient({-5.0, 0.0, 0.0});
    QVERIFY(!one.apply(use));  // it does not cut
  }

  void a_label_is_divided_between_the_seeds_of_another() {
    LabelledCase one;
    const Region before = one.labels().region(one.liver());
    // Two seeds in the larger island, one of them beside it, and one far from all.
    const Region inside = box({3, 3, 4}, {4, 4, 5});
    const Region beside = box({16, 14, 10}, {16, 15, 11});
    const Region apart = box({35, 25, 15}, {36, 26, 16});
    const std::uint8_t seeds = one.labels().add("Seeds").value();
    QVERIFY(one.labels().accept(united(united(inside, beside), apart), seeds, document::Take::others_too));
    document::LabelToolUse use = with(LabelTool::watershed);
    use.other = seeds;
    QCOMPARE(failure(one.apply(use)), QString());
    const document::Label& cut = one.labels().list().back();
    QCOMPARE(cut.name, std::string("Liver 2"));
    const Region first = one.labels().region(one.liver());
    const Region second = one.labels().region(cut.id);
    QVERIFY(united(first, second) == united(before, beside));
    QVERIFY(intersection(first, second).empty());
    QVERIFY(first.count() >= second.count());
    QVERIFY(first.contains({3, 3, 4}) != second.contains({3, 3, 4}));
    QVERIFY(first.contains({3, 3, 4}) == second.contains({16, 14, 10}));
    // The other island stays with the label, the seed far away with its own.
    QVERIFY(first.contains({26, 3, 3}));
    QVERIFY(one.labels().region(seeds) == apart);
    QCOMPARE(failure(one.history().undo()), QString());
    QVERIFY(one.labels().region(one.liver()) == difference(before, inside));

    use.other = document::kTheSurface;
    QVERIFY(failure(one.apply(use)).contains("another label"));
    use.other = one.liver();
    QVERIFY(failure(one.apply(use)).contains("another label"));
    use.other = one.spleen();  // one island, beside
    QVERIFY2(failure(one.apply(use)).contains("label Liver is divided by two islands"),
             qPrintable(failure(one.apply(use))));
    document::Label locked = *one.labels().find(seeds);
    locked.locked = true;
    QVERIFY(one.labels().set(locked));
    use.other = seeds;
    QVERIFY(failure(one.apply(use)).contains("label Seeds is locked"));
  }

  void more_parts_than_there_are_labels_are_refused() {
    // Voxels that touch each other nowhere across a face.
    const auto scattered = [](const VoxelRange& range, std::int64_t most) {
      Region seeds(range);
      std::int64_t count = 0;
      whole(range).for_each_run([&](Index3 first, std::int64_t length) {
        for (std::int64_t i = 0; i < length && count < most; ++i) {
          const Index3 voxel = first + Index3(i, 0, 0);
          if ((voxel.x + voxel.y + voxel.z) % 2 != 0) continue;
          seeds.add(voxel);
          ++count;
        }
      });
      return seeds;
    };
    LabelledCase one;
    document::LabelToolUse use = with(LabelTool::watershed);
    use.other = one.labels().add("Seeds").value();
    const Region apart = scattered({{30, 10, 2}, {40, 20, 10}}, 300);
    const Region two = united(box({3, 3, 4}, {3, 3, 4}), box({14, 14, 10}, {14, 14, 10}));
    QVERIFY(one.labels().accept(united(apart, two), use.other, document::Take::others_too));
    // Those that touch the label count alone.
    QCOMPARE(failure(one.apply(use)), QString());
    QVERIFY(one.labels().region(use.other) == apart);

    LabelledCase other;
    use.other = other.labels().add("Seeds").value();
    const Region inside = scattered({{2, 2, 2}, {16, 16, 13}}, 300);
    QVERIFY(other.labels().accept(inside, use.other, document::Take::others_too));
    const auto refused = document::use_tool(use, {other.liver()}, other.values());
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::usage);
    QVERIFY2(failure(refused).contains("300 seeds"), qPrintable(failure(refused)));
  }

  void labels_are_combined_with_the_surface_and_each_other() {
    LabelledCase one;
    const Region liver = one.labels().region(one.liver());
    const Region ball = box({10, 10, 8}, {30, 20, 15});
    document::LabelVoxels from = one.values();
    from.phi = std::make_shared<const solver::Field>(
        solver::distance_transform(mask_of(ball, from.geometry), solver::default_band(from.geometry)));
    const auto made = [&](LabelTool tool) {
      return document::use_tool(with(tool), {one.liver()}, from).value().front().region;
    };
    QVERIFY(made(LabelTool::add) == united(liver, ball));
    QVERIFY(made(LabelTool::subtract) == difference(liver, ball));
    QVERIFY(made(LabelTool::intersect) == intersection(liver, ball));
    document::LabelToolUse use = with(LabelTool::add);
    use.other = one.spleen();
    const Region both = united(liver, one.labels().region(one.spleen()));
    QCOMPARE(failure(one.apply(use, document::Take::others_too)), QString());
    QVERIFY(one.labels().region(one.liver()) == both);
    QVERIFY(one.labels().region(one.spleen()).empty());
  }

  void several_labels_are_finished_at_once() {
    LabelledCase one;
    const auto regions =
        document::use_tool(with(LabelTool::shrink, 1.0), {one.liver(), one.spleen()}, one.values());
    QCOMPARE(failure(regions), QString());
    QCOMPARE(regions->size(), std::size_t{2});
    const Region liver = one.labels().region(one.liver());
    const Region spleen = one.labels().region(one.spleen());
    const auto finished = one.labels().finish(*regions);
    QCOMPARE(failure(finished), QString());
    QCOMPARE(finished->label, std::string("Liver, Spleen"));
    QVERIFY(one.labels().region(one.spleen()).count() < spleen.count());
    QCOMPARE(failure(one.history().undo()), QString());
    QVERIFY(one.labels().region(one.liver()) == liver && one.labels().region(one.spleen()) == spleen);
  }

  void what_cannot_be_done_is_refused_and_changes_nothing() {
    LabelledCase one;
    const std::vector<std::uint8_t> before = one.labels().voxels().voxels();
    const auto refused = [&](const document::LabelToolUse& use, const std::vector<std::uint8_t>& labels) {
      const auto result = document::use_tool(use, labels, one.values());
      return !result && result.error().kind == ErrorKind::usage;
    };
    QVERIFY(refused(with(LabelTool::grow, -1.0), {one.liver()}));
    QVERIFY(refused(with(LabelTool::grow), {77}));
    QVERIFY(refused(with(LabelTool::slices), {one.liver()}));
    QVERIFY(refused(with(LabelTool::subtract), {one.liver()}));  // there is no surface
    document::LabelToolUse other = with(LabelTool::add);
    other.other = 77;
    QVERIFY(refused(other, {one.liver()}));
    const std::uint8_t empty = one.labels().add("Empty").value();
    QVERIFY(refused(with(LabelTool::holes), {empty}));
    document::Label locked = *one.labels().find(one.liver());
    locked.locked = true;
    QCOMPARE(failure(one.labels().set(locked)), QString());
    QVERIFY(refused(with(LabelTool::grow), {one.liver()}));
    QVERIFY(!one.labels().finish({{one.spleen(), {}, {}}, {one.liver(), {}, {}}}));
    QVERIFY(one.labels().voxels().voxels() == before);
  }
};

TIDEMARK_TEST(LabelToolTest)

}  // namespace tidemark::test::label_tool_test

#include "label_tool_test.moc"
