// Where the lines of a tree run between the rows of its list.
#include "ui/panels/history_lanes.h"

#include "tests/support/test_program.h"

namespace tidemark::test::history_lanes_test {

using namespace tidemark::ui;

class HistoryLanesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_line_has_one_lane() {
    const auto lanes = lanes_of({{3, 2}, {2, 1}, {1, std::nullopt}});
    QVERIFY((lanes == std::vector<RowLanes>{{0, true, {}, {}}, {0, true, {0}, {}}, {0, false, {0}, {}}}));
  }

  // 1 - 2 - 4
  //      \- 3 - 5
  void branches_run_beside_each_other_to_their_fork() {
    const auto lanes = lanes_of({{5, 3}, {4, 2}, {3, 2}, {2, 1}, {1, std::nullopt}});
    QVERIFY((lanes[0] == RowLanes{0, true, {}, {}}));
    QVERIFY((lanes[1] == RowLanes{1, true, {}, {0}}));
    QVERIFY((lanes[2] == RowLanes{0, true, {0}, {1}}));
    QVERIFY((lanes[3] == RowLanes{0, true, {0, 1}, {}}));
    QVERIFY((lanes[4] == RowLanes{0, false, {0}, {}}));
  }

  void a_lane_that_has_ended_is_used_again() {
    const auto lanes = lanes_of({{6, 4}, {5, 4}, {4, 1}, {3, 1}, {1, std::nullopt}});
    QCOMPARE(lanes[1].lane, 1);
    QCOMPARE(lanes[3].lane, 1);
    QVERIFY((lanes[4] == RowLanes{0, false, {0, 1}, {}}));
  }

  void a_line_stays_in_its_lane_beside_a_free_one() {
    const auto lanes = lanes_of({{6, 4}, {5, 2}, {4, std::nullopt}, {2, 1}, {1, std::nullopt}});
    QVERIFY((lanes[2] == RowLanes{0, false, {0}, {1}}));
    QVERIFY((lanes[3] == RowLanes{1, true, {1}, {}}));
    QVERIFY((lanes[4] == RowLanes{1, false, {1}, {}}));
  }

  // Another try, again and again: more lines than there is room for.
  void lines_without_room_share_the_last_lane() {
    constexpr std::uint64_t kTries = 5000;
    std::vector<TreeRow> rows;
    for (std::uint64_t id = kTries + 1; id > 1; --id) rows.push_back({id, 1});
    rows.push_back({1, std::nullopt});
    const auto lanes = lanes_of(rows);
    const std::vector<int> all{0, 1, 2, 3, 4};
    static_assert(kMostLanes == 5);
    QVERIFY((lanes[2] == RowLanes{2, true, {}, {0, 1}}));
    QVERIFY((lanes[4] == RowLanes{4, true, {}, {0, 1, 2, 3}}));
    for (std::size_t row = 5; row < kTries; ++row) QVERIFY((lanes[row] == RowLanes{4, true, {}, all}));
    QVERIFY((lanes[kTries] == RowLanes{0, false, all, {}}));
    // One of them ends, and the others go on.
    const auto some = lanes_of({{9, 1}, {8, 1}, {7, 1}, {6, 1}, {5, 3}, {4, 1}, {3, 1}, {1, std::nullopt}});
    QVERIFY((some[6] == RowLanes{4, true, {4}, all}));
  }

  void a_parent_that_was_forgotten_has_no_line() {
    QVERIFY((lanes_of({{7, 2}}) == std::vector<RowLanes>{{0, false, {}, {}}}));
  }
};

TIDEMARK_TEST(HistoryLanesTest)

}  // namespace tidemark::test::history_lanes_test

#include "history_lanes_test.moc"
