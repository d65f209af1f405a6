#include "ui/panels/statistics_panel.h"

#include <QAction>
#include <QClipboard>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableWidget>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/region_table.h"

namespace tidemark::test::statistics_panel_test {

class StatisticsPanelTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::StatisticsPanel>(*the_case_, 500);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void the_figures_are_those_of_the_surface() {
    QCOMPARE(figure(tr("Volume")), QStringLiteral("–"));
    the_case_->begin(8.0);
    const engine::CaseState& state = the_case_->state();
    QCOMPARE(figure(tr("Volume")),
             QLocale().toString(state.surface.volume_ml, 'f', 2) + QChar(QChar::Nbsp) + "ml");
    QCOMPARE(figure(tr("Voxels")), QString::number(state.surface.voxels_inside));
    // Inside the ball all is 100 HU with noise of +-5.
    QVERIFY(std::abs(state.inside.mean - 100.0) < 1.0);
    QCOMPARE(figure(tr("Mean")), QLocale().toString(state.inside.mean, 'f', 1) + QChar(QChar::Nbsp) + "HU");
    QVERIFY(figure(tr("Volume")).contains(','));  // as people here write it
  }

  void values_of_an_older_surface_are_not_shown_while_it_moves() {
    the_case_->begin(6.0);
    the_case_->proxy->set_pause_at_convergence(false);
    the_case_->proxy->play();
    QTRY_VERIFY(the_case_->state().surface.voxels_inside != the_case_->state().inside.voxels);
    QTRY_COMPARE(figure(tr("Mean")), QStringLiteral("–"));
    the_case_->proxy->pause();
    the_case_->wait_until_idle();
    QVERIFY(figure(tr("Mean")) != QStringLiteral("–"));
  }

  void the_file_has_points_and_names_for_programs_in_every_language() {
    the_case_->begin(8.0);
    the_case_->proxy->add_label(QStringLiteral("Liver, \"left\""));
    the_case_->wait_until_idle();
    the_case_->proxy->accept_surface(the_case_->state().labels.front().id);
    the_case_->wait_until_idle();
    measure();
    const QStringList lines = exported();
    QCOMPARE(lines.size(), 6);  // the last line ends, too
    QCOMPARE(lines[0],
             QStringLiteral("name,volume_ml,area_mm2,voxels,mean,sd,value_unit,measured,measured_unit"));
    const engine::CaseState& state = the_case_->state();
    const QString surface = QStringLiteral("Surface,%1,%2,%3,%4,%5,HU,,")
                                .arg(state.surface.volume_ml, 0, 'f', 3)
                                .arg(state.surface.surface_mm2, 0, 'f', 1)
                                .arg(state.surface.voxels_inside)
                                .arg(state.inside.mean, 0, 'f', 3)
                                .arg(state.inside.standard_deviation, 0, 'f', 3);
    QCOMPARE(lines[1], surface);
    QVERIFY2(lines[2].startsWith(QStringLiteral("\"Liver, \"\"left\"\"\",")), qPrintable(lines[2]));
    QVERIFY(lines[2].contains(QStringLiteral(",,%1,").arg(state.surface.voxels_inside)));  // no area
    QCOMPARE(lines[3], QStringLiteral("distance,,,,,,,5.00,mm"));
    QCOMPARE(lines[4], QStringLiteral("angle,,,,,,,90.00,degrees"));
  }

  void a_label_from_a_file_is_no_formula_in_the_file() {
    the_case_->proxy->add_label(QStringLiteral("=1+1"));
    the_case_->wait_until_idle();
    const QStringList lines = exported();
    QCOMPARE(lines.size(), 3);
    QVERIFY2(lines[1].startsWith(QStringLiteral("'=1+1,")), qPrintable(lines[1]));
  }

  void what_is_copied_has_tabs_and_the_users_numbers() {
    the_case_->begin(8.0);
    QTest::mouseClick(button<QPushButton>(*panel_, tr("Copy")), Qt::LeftButton);
    const QStringList lines = QGuiApplication::clipboard()->text().split('\n');
    QCOMPARE(lines[0].count('\t'), 6);
    QCOMPARE(lines[1].count('\t'), 6);
    QCOMPARE(lines[1].split('\t')[1], QLocale().toString(the_case_->state().surface.volume_ml, 'f', 3));
  }

  void measurements_are_listed_once_they_are_complete() {
    auto* table = named<QTableWidget>(*panel_, tr("Measurements"));
    QVERIFY(!table->isVisible());
    measure();
    QVERIFY(table->isVisible());
    QCOMPARE(table->rowCount(), 2);
    QCOMPARE(table->item(0, 1)->text(), QStringLiteral("5,0") + QChar(QChar::Nbsp) + "mm");
  }

  void labels_have_rows() {
    the_case_->begin(8.0);
    the_case_->proxy->add_label(QStringLiteral("Liver"));
    the_case_->wait_until_idle();
    the_case_->proxy->accept_surface(the_case_->state().labels.front().id);
    the_case_->wait_until_idle();
    auto* table = named<QTableWidget>(*panel_, tr("Figures of the labels"));
    QCOMPARE(table->rowCount(), 1);
    QCOMPARE(table->item(0, 0)->text(), QStringLiteral("Liver"));
    QCOMPARE(table->item(0, 1)->text(),
             QLocale().toString(the_case_->state().label_statistics.front().volume_ml, 'f', 1));
  }

  void the_button_asks_for_a_file() {
    QAction action;
    panel_->set_export_action(&action);
    const QSignalSpy asked(&action, &QAction::triggered);
    QTest::mouseClick(button<QPushButton>(*panel_, tr("Export CSV…")), Qt::LeftButton);
    QCOMPARE(asked.count(), 1);
  }

  void without_a_session_there_are_no_figures() {
    the_case_->begin(8.0);
    the_case_->proxy.reset();
    QCOMPARE(figure(tr("Volume")), QStringLiteral("–"));
    panel_->copy();  // copies nothing, and does not crash
  }

 private:
  QString figure(const QString& name) { return named<QLabel>(*panel_, name)->text(); }
  // A distance, an angle, and one that is not complete.
  void measure() {
    the_case_->proxy->display().change([](engine::DisplaySettings& settings) {
      using Kind = engine::Measurement::Kind;
      settings.measurements = {{Kind::distance, {{0.0, 0.0, 0.0}, {3.0, 4.0, 0.0}}},
                               {Kind::angle, {{1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}},
                               {Kind::distance, {{0.0, 0.0, 0.0}}}};
    });
  }
  QStringList exported() {
    return QString::fromStdString(ui::to_csv(*the_case_->proxy)).split(QStringLiteral("\r\n"));
  }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::StatisticsPanel> panel_;
};

TIDEMARK_TEST(StatisticsPanelTest)

}  // namespace tidemark::test::statistics_panel_test

#include "statistics_panel_test.moc"
