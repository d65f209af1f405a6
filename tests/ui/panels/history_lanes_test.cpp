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

  void a_parent_that_was_forgotten_has_no_line() {
    QVERIFY((lanes_of({{7, 2}}) == std::vector<RowLanes>{{0, false, {}, {}}}));
  }
};

TIDEMARK_TEST(HistoryLanesTest)

}  // namespace tidemark::test::history_lanes_test

#include "history_lanes_test.moc"
