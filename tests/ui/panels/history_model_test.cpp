// What rows of the history say of their states.
#include "ui/panels/history_model.h"

#include <QSignalSpy>

#include "tests/support/test_program.h"
#include "ui/look/language.h"

namespace tidemark::test::history_model_test {

class HistoryModelTest : public QObject {
  Q_OBJECT

  static QString said_of(const document::DriveSummary& drive) {
    engine::HistoryRow row;
    row.state.id = 1;
    row.state.steering.begun = true;
    row.state.steering.parameters.target = 150.0;
    row.state.steering.parameters.range = 80.0;
    row.state.steering.parameters.alpha = 0.5;
    row.state.steering.drive = drive;
    engine::CaseState state;
    state.history = std::make_shared<const engine::HistoryRows>(engine::HistoryRows{row});
    ui::HistoryModel model;
    model.show(state, std::nullopt);
    return model.item(model.index(0))->steering;
  }
  static document::DriveSummary by(const std::vector<std::string>& functions) {
    document::DriveSummary drive;
    drive.setting.terms.clear();
    for (const std::string& function : functions) drive.setting.terms.push_back({function, {}});
    return drive;
  }

 private slots:
  void cleanup() { ui::use_language("en"); }

  void what_drives_a_state_is_said_in_full() {
    QCOMPARE(said_of(by({"tent"})), "T 150  ε 80  α 0.5");
    QCOMPARE(said_of(by({"edges"})), "Edges  α 0.5");
    document::DriveSummary drive = by({"tent"});
    drive.has_walls = true;
    QCOMPARE(said_of(drive), "T 150  ε 80, Walls  α 0.5");
    drive = by({"tent", "edges"});
    drive.has_anchors = true;
    QCOMPARE(said_of(drive), "Least (T 150  ε 80, Edges), Anchors  α 0.5");
    drive = by({"edges", "regions"});
    drive.setting.combine = solver::Combine::product;
    QCOMPARE(said_of(drive), "Product (Edges, Regions)  α 0.5");
  }

  void it_is_said_in_the_language() {
    ui::use_language("de");
    document::DriveSummary drive = by({"tent", "edges"});
    drive.has_walls = drive.has_anchors = true;
    QCOMPARE(said_of(drive), "Minimum (T 150  ε 80, Kanten), Wände, Anker  α 0,5");
  }

  void a_figure_more_changes_its_row_alone() {
    constexpr std::uint64_t kTries = 300;
    engine::HistoryRows rows(kTries + 1);
    for (std::uint64_t n = 0; n <= kTries; ++n) {
      rows[n].state.id = n + 1;
      if (n > 0) rows[n].state.parent = 1;
      rows[n].state.steering.begun = true;
    }
    engine::CaseState state;
    const auto say = [&] { state.history = std::make_shared<const engine::HistoryRows>(rows); };
    say();
    state.history_state = 7;
    ui::HistoryModel model;
    model.show(state, std::nullopt);
    QCOMPARE(model.rowCount(), static_cast<int>(kTries) + 1);
    QCOMPARE(model.lanes(), ui::kMostLanes);
    const QSignalSpy changed(&model, &QAbstractItemModel::dataChanged);
    const QSignalSpy made_anew(&model, &QAbstractItemModel::modelReset);
    const auto changed_rows = [&] {
      QList<int> numbers;
      for (const QList<QVariant>& one : changed) {
        const int last = one[1].toModelIndex().row();
        for (int row = one[0].toModelIndex().row(); row <= last; ++row) numbers << row;
      }
      return numbers;
    };

    rows[20].figures = engine::StateFigures{3.4, {}};
    say();
    model.show(state, std::nullopt);
    const int row = model.index_of(21).row();
    QCOMPARE(changed_rows(), QList<int>{row});
    QVERIFY(model.item(model.index(row))->figures.contains("3.4"));

    state.history_state = 9;
    model.show(state, std::nullopt);
    QCOMPARE(changed_rows().mid(1), (QList<int>{model.index_of(9).row(), model.index_of(7).row()}));
    QVERIFY(model.item(model.index_of(9))->present && !model.item(model.index_of(7))->present);
    model.show(state, 30);
    QCOMPARE(changed_rows().mid(3), QList<int>{model.index_of(30).row()});
    QCOMPARE(made_anew.size(), 0);

    // What is being made.
    state.open_change = rows.back().state;
    state.open_change->id = kTries + 2;
    state.open_change->parent = 9;
    model.show(state, 30);
    QCOMPARE(made_anew.size(), 1);
    QVERIFY(model.item(model.index(0))->open && model.item(model.index(0))->present);
    QVERIFY(!model.item(model.index_of(9))->present);
    state.open_change->steering.step = 12;
    model.show(state, 30);
    QCOMPARE(changed_rows().mid(4), QList<int>{0});
  }
};

TIDEMARK_TEST(HistoryModelTest)

}  // namespace tidemark::test::history_model_test

#include "history_model_test.moc"
