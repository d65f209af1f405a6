// Who goes back and on otherwise finds both ways in the panel History, goes to either and compares them, by
// mouse and keys.
#include <QListView>
#include <QObject>
#include <QPushButton>
#include <cmath>

#include "core/volume.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/case_files.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/history_model.h"
#include "ui/panels/history_panel.h"

namespace tidemark::test::history_story_test {
namespace {

// The panel, by hand.
class History {
 public:
  explicit History(Desktop& desktop) : desktop_(desktop) {
    desktop.window().panels().show("history");
    panel_ = desktop.window().findChild<ui::HistoryPanel*>();
    if (!panel_ || !Desktop::wait_for([&] { return panel_->isVisible(); })) qFatal("no panel History");
    list_ = panel_->findChild<QListView*>();
    model_ = qobject_cast<ui::HistoryModel*>(list_->model());
  }

  [[nodiscard]] QListView& list() { return *list_; }
  [[nodiscard]] int rows() const { return model_->rowCount(); }
  [[nodiscard]] ui::HistoryItem row(int number) const { return *model_->item(model_->index(number)); }
  [[nodiscard]] ui::HistoryItem of(std::uint64_t id) const { return *model_->item(model_->index_of(id)); }
  [[nodiscard]] QPushButton& button(const QString& text) {
    for (auto* button : panel_->findChildren<QPushButton*>()) {
      if (button->text() == text) return *button;
    }
    qFatal("no button %s", qPrintable(text));
  }
  void click(std::uint64_t id, Qt::KeyboardModifiers modifiers = {}) {
    const QModelIndex index = model_->index_of(id);
    list_->scrollTo(index);
    QTest::mouseClick(list_->viewport(), Qt::LeftButton, modifiers, list_->visualRect(index).center());
    desktop_.wait_until_idle();
  }

 private:
  Desktop& desktop_;
  ui::HistoryPanel* panel_ = nullptr;
  QListView* list_ = nullptr;
  ui::HistoryModel* model_ = nullptr;
};

// Whether the overlay's turquoise is somewhere in a view.
bool shows_turquoise(QWidget& view) {
  const QImage seen = view.grab().toImage();
  int count = 0;
  for (int y = 0; y < seen.height(); ++y) {
    for (int x = 0; x < seen.width(); ++x) {
      const QColor colour = seen.pixelColor(x, y);
      count += colour.red() < 60 && colour.green() > 170 && colour.blue() > 130 ? 1 : 0;
    }
  }
  return count > 20;
}

}  // namespace

class HistoryStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void two_ways_are_kept_visited_and_compared();
  void a_session_brings_both_ways_back();
  void an_arrangement_from_before_the_panel_opens();
};

void HistoryStoryTest::two_ways_are_kept_visited_and_compared() {
  const solver::ExecutorKind executor = story_executor();
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(executor));
  Desktop desktop(executor, {1366, 768});
  desktop.open_phantom(executor == solver::ExecutorKind::host ? "tumour" : "sphere");
  desktop.proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = desktop.seed_mm(); });
  desktop.begin(6.0);
  History history(desktop);
  desktop.wait_until_idle();
  const int rows = history.rows();
  const std::uint64_t start = history.row(0).id;
  QVERIFY(history.row(0).present);
  QVERIFY(!history.row(0).picture.isNull());
  QVERIFY(history.row(rows - 1).picture.isNull());  // before there was a surface

  // Steps by hand are one entry.
  for (int i = 0; i < 4; ++i) {
    desktop.press(Qt::Key_Period);
    desktop.wait_until_idle();
  }
  QCOMPARE(history.rows(), rows + 1);
  QCOMPARE(history.row(0).change, QStringLiteral("Evolution, 4 steps"));
  QVERIFY(history.row(0).open);

  // The first way, to its rest.
  const auto run_to_rest = [&] {
    const std::int64_t from = desktop.state().step;
    desktop.press(Qt::Key_P);
    QVERIFY(Desktop::wait_for(
        [&] { return desktop.state().step > from && desktop.state().converged && !desktop.state().playing; },
        120000));
    desktop.wait_until_idle();
  };
  run_to_rest();
  const std::uint64_t first = history.row(0).id;
  const std::int64_t first_step = desktop.state().step;
  const double first_ml = desktop.state().surface.volume_ml;
  const Mask first_mask = desktop.state().phi->mask();
  QVERIFY(!history.of(first).picture.isNull());
  QVERIFY(history.of(first).figures.contains(QString::number(first_ml, 'f', 1)));

  // Back to the start by a click, and on with another T and alpha.
  history.click(start);
  QCOMPARE(desktop.state().step, std::int64_t{0});
  QVERIFY(history.of(start).present);
  solver::Parameters other = desktop.state().parameters;
  other.alpha += 0.1;
  other.range *= 1.2;
  desktop.proxy().set_parameters(other);
  run_to_rest();
  const std::uint64_t second = history.row(0).id;
  const Mask second_mask = desktop.state().phi->mask();
  QVERIFY(second != first);
  QVERIFY(history.of(first).lanes.lane != history.of(second).lanes.lane);
  desktop.screenshot(QStringLiteral("history-1-two-ways"));

  // Ctrl+click compares.
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial && !shows_turquoise(*axial));
  history.click(first, Qt::ControlModifier);
  QCOMPARE(desktop.proxy().comparison().state(), std::optional(first));
  const auto known = [&] { return desktop.proxy().comparison().agreement().has_value(); };
  QVERIFY(Desktop::wait_for(known));
  QVERIFY(history.of(second).present);
  QVERIFY(history.of(first).compared);
  QVERIFY(history.button("Compare").isChecked());
  const double expected = dice(first_mask, second_mask);
  QVERIFY(expected > 0.5 && expected < 1.0);
  QVERIFY(std::abs(desktop.proxy().comparison().agreement()->dice - expected) < 1e-12);
  QVERIFY(desktop.proxy().comparison().agreement()->distance->largest_mm > 0.0);
  QVERIFY(shows_turquoise(*axial));
  desktop.screenshot(QStringLiteral("history-2-compared"));

  // The other way again, to the same surface, which then agrees with itself.
  history.click(first);
  QCOMPARE(desktop.state().step, first_step);
  QVERIFY(desktop.state().phi->mask().voxels == first_mask.voxels);
  QVERIFY(std::abs(desktop.state().surface.volume_ml - first_ml) < 1e-9);
  QVERIFY(
      Desktop::wait_for([&] { return known() && desktop.proxy().comparison().agreement()->dice == 1.0; }));
  QCOMPARE(desktop.proxy().comparison().agreement()->distance->largest_mm, 0.0);

  // By keys alone: from row to row, and there.
  history.list().setFocus();
  history.list().setCurrentIndex(history.list().model()->index(1, 0));
  QTest::keyClick(&history.list(), Qt::Key_Up);
  QVERIFY(history.of(first).present);  // who only looks goes nowhere
  QTest::keyClick(&history.list(), Qt::Key_Return);
  desktop.wait_until_idle();
  QVERIFY(history.of(second).present);
  QVERIFY(desktop.state().phi->mask().voxels == second_mask.voxels);
  QVERIFY(desktop.state().parameters == other);
  history.list().setCurrentIndex(history.list().model()->index(1, 0));
  QTest::keyClick(&history.list(), Qt::Key_Space);
  QVERIFY(desktop.proxy().comparison().state() != std::optional(first));
  // Undo and redo follow the branch.
  desktop.press(Qt::Key_Z, Qt::ControlModifier);
  desktop.wait_until_idle();
  desktop.press(Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
  desktop.wait_until_idle();
  QVERIFY(history.of(second).present);
  // No comparison any more.
  history.list().setCurrentIndex(history.list().model()->index(1, 0));
  QVERIFY(history.button("Compare").isChecked());
  history.button("Compare").click();
  QVERIFY(!desktop.proxy().comparison().state());
  QVERIFY(Desktop::wait_for([&] { return !shows_turquoise(*axial); }));
}

// Closed and opened again, the panel has the same rows, with their pictures, and the way between them.
void HistoryStoryTest::a_session_brings_both_ways_back() {
  const solver::ExecutorKind executor = story_executor();
  const Variable renderer("TIDEMARK_RENDERER", renderer_beside(executor));
  const TemporaryFolder folder;
  Desktop desktop(executor, {1366, 768});
  ui::apply_theme(*qApp, ui::Theme::dark);
  desktop.open_phantom("sphere");
  desktop.begin(6.0);
  desktop.proxy().step(20);
  desktop.wait_until_idle();
  desktop.proxy().step_back(15);
  desktop.proxy().step(30);
  desktop.wait_until_idle();
  const std::int64_t step = desktop.state().step;
  int written = 0;
  QObject::connect(&desktop.window().files(), &ui::CaseFiles::written, qApp, [&] { ++written; });
  const QString file = QString::fromStdString((folder / "case.tidemark").string());
  desktop.window().active_case()->session_file = file;
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return written == 1; }));
  desktop.wait_until_idle();
  QStringList before;
  {
    History history(desktop);
    desktop.wait_until_idle();
    for (int row = 0; row < history.rows(); ++row)
      before << history.row(row).change + QLatin1Char(' ') + history.row(row).figures;
  }
  QCOMPARE(before.size(), 5);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QVERIFY(desktop.open(file));
  History history(desktop);
  desktop.wait_until_idle();
  QStringList after;
  for (int row = 0; row < history.rows(); ++row)
    after << history.row(row).change + QLatin1Char(' ') + history.row(row).figures;
  QCOMPARE(after, before);
  QVERIFY(history.row(0).present && !desktop.state().modified);
  desktop.screenshot(QStringLiteral("history-4-session-dark"));
  const std::uint64_t twenty = history.row(2).id;  // before the steps back
  QVERIFY(!history.of(twenty).picture.isNull());
  history.click(twenty);
  QCOMPARE(desktop.state().step, std::int64_t{20});
  history.click(history.row(0).id);
  QCOMPARE(desktop.state().step, step);
  ui::apply_theme(*qApp, ui::Theme::light);
}

// The new panel has its tab among the others, and those are where they were.
void HistoryStoryTest::an_arrangement_from_before_the_panel_opens() {
  QMainWindow before;
  QList<QDockWidget*> docks;
  for (const char* name :
       {"initialise", "level-set", "paint", "display", "transfer", "labels", "statistics"}) {
    auto* dock = new QDockWidget(QString::fromLatin1(name), &before);
    dock->setObjectName(QString::fromLatin1(name));
    before.addDockWidget(Qt::LeftDockWidgetArea, dock);
    if (!docks.isEmpty()) before.tabifyDockWidget(docks.last(), dock);
    docks << dock;
  }
  before.show();
  const QByteArray arrangement = before.saveState(1);
  Desktop desktop(solver::ExecutorKind::host);
  desktop.open_phantom("sphere");
  desktop.window().panels().restore(arrangement);
  const auto area = [&](const char* name) {
    return desktop.window().dockWidgetArea(desktop.window().findChild<QDockWidget*>(name));
  };
  QCOMPARE(area("labels"), Qt::LeftDockWidgetArea);
  QCOMPARE(area("history"), Qt::LeftDockWidgetArea);
  History history(desktop);
  QVERIFY(history.list().isVisible());
  // What is saved from then on is restored as it is.
  const QByteArray now = desktop.window().panels().arrangement();
  desktop.window().panels().restore(now);
  QCOMPARE(area("history"), Qt::LeftDockWidgetArea);
  desktop.screenshot(QStringLiteral("history-3-old-arrangement"));
}

TIDEMARK_TEST(HistoryStoryTest)

}  // namespace tidemark::test::history_story_test

#include "history_story_test.moc"
