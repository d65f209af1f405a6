#include "ui/panels/statistics_panel.h"

#include <QAction>
#include <QClipboard>
#include <QComboBox>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTableWidget>
#include <algorithm>

#include "engine/region_meter.h"
#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/look/language.h"
#include "ui/panels/labels_model.h"
#include "ui/panels/region_table.h"
#include "ui/widgets/number_text.h"

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
                                .arg(state.surface.volume_ml, 0, 'g', 10)
                                .arg(state.surface.surface_mm2, 0, 'g', 10)
                                .arg(state.surface.voxels_inside)
                                .arg(state.inside.mean, 0, 'g', 10)
                                .arg(state.inside.standard_deviation, 0, 'g', 10);
    QCOMPARE(lines[1], surface);
    QVERIFY2(lines[2].startsWith(QStringLiteral("\"Liver, \"\"left\"\"\",")), qPrintable(lines[2]));
    QVERIFY(lines[2].contains(QStringLiteral(",,%1,").arg(state.surface.voxels_inside)));  // no area
    QCOMPARE(lines[3], QStringLiteral("distance,,,,,,,5,mm"));
    QCOMPARE(lines[4], QStringLiteral("angle,,,,,,,90,degrees"));
  }

  void the_surface_has_one_name_in_files_in_every_language() {
    the_case_->begin(8.0);
    ui::use_language("de");
    const QStringList lines = exported();
    ui::use_language("en");
    QVERIFY2(lines[1].startsWith(QStringLiteral("Surface,")), qPrintable(lines[1]));
  }

  // As of a map of diffusion in mm2/s.
  void small_values_keep_their_digits_in_tables() {
    constexpr float kScale = 1.2e-5F;
    auto study = std::make_shared<engine::LoadedStudy>(*ball_study());
    auto volume = std::make_shared<Volume>(*study->volume);
    std::vector<float> values = volume->values();
    for (float& value : values) value *= kScale;
    volume->voxels = std::move(values);
    study->summary = engine::summarise(*volume);
    study->volume = std::move(volume);
    study->parameters.target *= kScale;
    study->parameters.range *= kScale;
    the_case_->proxy =
        std::make_unique<engine::CaseProxy>(the_case_->engine, study, solver::ExecutorKind::host);
    panel_->set_proxy(the_case_->proxy.get());
    the_case_->begin(8.0);
    const double mean = the_case_->state().inside.mean;
    QVERIFY(mean > 0.0011 && mean < 0.0013);
    QVERIFY(std::abs(exported()[1].split(',')[4].toDouble() - mean) < 1e-9);
    panel_->copy();
    const QString copied = QGuiApplication::clipboard()->text().split('\n')[1].split('\t')[4];
    QVERIFY2(std::abs(QLocale().toDouble(copied) - mean) < 1e-5, qPrintable(copied));
  }

  // Half of the ball lies beyond the image.
  void values_of_an_image_are_of_the_part_that_it_covers() {
    the_case_->begin(8.0);
    auto volume = std::make_shared<Volume>();
    volume->geometry = the_case_->proxy->volume().geometry;
    volume->geometry.size.z /= 2;
    std::vector<std::int16_t> voxels(static_cast<std::size_t>(volume->geometry.voxel_count()), 7);
    voxels.front() = -1000;
    volume->voxels = std::move(voxels);
    auto image = std::make_shared<document::CaseImage>();
    image->name = "Other";
    image->volume = volume;
    the_case_->proxy->display().change([&](engine::DisplaySettings& settings) {
      engine::ShownImage other;
      other.image = image;
      settings.images = {other};
    });
    the_case_->wait_until_idle();
    QTest::mouseClick(button<QPushButton>(*panel_, tr("Measure")), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(the_case_->proxy->region_meter().measures(), 60000);
    auto* images = named<QComboBox>(*panel_, tr("Values of"));
    QTRY_COMPARE(images->count(), 2);
    images->setFocus();
    QTest::keyClick(images, Qt::Key_Down);
    auto* table = named<QTableWidget>(*panel_, tr("Values inside"));
    QCOMPARE(table->item(0, 0)->text(), tr("Part that is covered"));
    QCOMPARE(table->item(0, 1)->text(), ui::share_text(0.5));
    QCOMPARE(table->item(3, 1)->text(), QStringLiteral("7,0"));  // the smallest
  }

  void a_small_label_is_not_told_as_nothing() {
    the_case_->begin(2.0);
    the_case_->proxy->add_label(QStringLiteral("Lesion"));
    the_case_->wait_until_idle();
    the_case_->proxy->accept_surface(the_case_->state().labels.front().id);
    the_case_->wait_until_idle();
    const double volume_ml = the_case_->state().label_statistics.front().volume_ml;
    QVERIFY(volume_ml > 0.0 && volume_ml < 0.05);
    const QString told = named<QTableWidget>(*panel_, tr("Figures of the labels"))->item(0, 1)->text();
    QVERIFY2(std::abs(QLocale().toDouble(told) / volume_ml - 1.0) < 0.1, qPrintable(told));
    ui::LabelsModel model;
    model.show(the_case_->state().labels, the_case_->state().label_statistics);
    QCOMPARE(model.data(model.index(0, ui::LabelsModel::volume), Qt::DisplayRole).toString(), told);
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

  void selected_measurements_are_removed_data() {
    QTest::addColumn<bool>("by_key");
    QTest::newRow("button") << false;
    QTest::newRow("Delete") << true;
  }
  void selected_measurements_are_removed() {
    QFETCH(bool, by_key);
    auto* remove = button<QPushButton>(*panel_, tr("Remove"));
    QVERIFY(!remove->isVisible());
    measure();
    QVERIFY(remove->isVisible() && !remove->isEnabled());
    auto* table = named<QTableWidget>(*panel_, tr("Measurements"));
    table->setFocus();
    table->selectRow(0);
    QVERIFY(remove->isEnabled());
    if (by_key) {
      QTest::keyClick(table, Qt::Key_Delete);
    } else {
      QTest::mouseClick(remove, Qt::LeftButton);
    }
    QCOMPARE(table->rowCount(), 1);
    const auto& left = the_case_->proxy->display().settings().measurements;
    QVERIFY(left.front().kind == engine::Measurement::Kind::angle);
    QCOMPARE(std::ranges::count_if(left, &engine::Measurement::complete), std::ptrdiff_t{1});
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
