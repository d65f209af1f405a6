// A surface is measured, its diameters are drawn into the slices, and an end of one is moved, by mouse and
// keys.
#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QRegularExpression>
#include <glm/geometric.hpp>

#include "imaging/files/volume_file.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/figure_table.h"
#include "ui/panels/statistics_panel.h"
#include "ui/widgets/number_text.h"

namespace tidemark::test::measure_story_test {

class MeasureStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_surface_is_measured_and_its_diameters_are_drawn();
  void area_and_sphericity_are_of_one_form();
  void measures_are_of_the_case_and_the_surface_that_are_seen();
  void small_values_are_told_with_their_digits();
  void a_report_is_of_one_moment();

 private:
  static void click(Desktop& desktop, QWidget& in, const QString& text) {
    auto* button = seen<QAbstractButton>(in, text);
    QVERIFY2(button->isEnabled(), qPrintable(text));
    QTest::mouseClick(button, Qt::LeftButton);
    desktop.wait_until_idle();
  }
  static ui::StatisticsPanel* shown_panel(Desktop& desktop) {
    desktop.window().panels().show("statistics");
    desktop.wait_until_idle();
    auto* panel = desktop.window().findChild<ui::StatisticsPanel*>();
    if (!panel || !panel->isVisible()) qFatal("there is no panel");
    return panel;
  }
  static bool wait_for_measures(QWidget& panel) {
    return Desktop::wait_for([&] { return find_seen<QAbstractButton>(panel, "Draw diameters") != nullptr; });
  }
  static double first_number(const QString& text) {
    return QLocale().toDouble(text.section(QRegularExpression("[\\s\\x{a0}]"), 0, 0));
  }
  static const std::vector<engine::Measurement>& lines(Desktop& desktop) {
    return desktop.proxy().display().settings().measurements;
  }
};

void MeasureStoryTest::a_surface_is_measured_and_its_diameters_are_drawn() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::StatisticsPanel& panel = *shown_panel(desktop);
  desktop.begin(10.0);
  click(desktop, panel, "Measure");
  QVERIFY(wait_for_measures(panel));
  desktop.screenshot("measure-0-figures");
  // A ball of 20 mm; its voxels are not finer than this.
  const glm::dvec3 spacing = desktop.proxy().volume().geometry.spacing_mm;
  const double voxel_mm = std::max({spacing.x, spacing.y, spacing.z});
  const double longest = first_number(seen<QLabel>(panel, "Longest")->text());
  QVERIFY2(std::abs(longest - 20.0) <= voxel_mm, qPrintable(QString::number(longest)));
  QVERIFY(first_number(seen<QLabel>(panel, "Sphericity")->text()) > 0.95);
  auto* values = seen<ui::FigureTable>(panel, "Values inside");
  QCOMPARE(values->rowCount(), 9);

  click(desktop, panel, "Draw diameters");
  click(desktop, panel, "Draw diameters");  // they are there already
  QCOMPARE(lines(desktop).size(), std::size_t{3});
  QVERIFY(std::abs(lines(desktop)[1].value() - 20.0) <= voxel_mm);
  desktop.screenshot("measure-1-lines");

  // An end goes where it is dragged to; all else stays.
  desktop.proxy().display().choose_tool(engine::Tool::measure_distance);
  const engine::Measurement before = lines(desktop)[1];
  const glm::dvec3 end = before.points_mm[1];
  auto* axial = desktop.view<ui::SliceViewWidget>("Axial");
  const glm::dvec3 to = end + glm::normalize(end - before.points_mm[0]) * 6.0;
  Desktop::drag(*axial, {end, 0.5 * (end + to), to});
  desktop.wait_until_idle();
  desktop.screenshot("measure-2-moved");
  QCOMPARE(lines(desktop).size(), std::size_t{3});
  QVERIFY(lines(desktop)[1].points_mm[0] == before.points_mm[0]);
  QVERIFY(std::abs(lines(desktop)[1].value() - before.value() - 6.0) < 1.0);
  // Elsewhere a drag is a new one.
  const glm::dvec3 away = before.points_mm[0] + glm::dvec3(0.0, -14.0, 0.0);
  Desktop::drag(*axial, {away, away + glm::dvec3(4.0, 0.0, 0.0), away + glm::dvec3(8.0, 0.0, 0.0)});
  QCOMPARE(lines(desktop).size(), std::size_t{4});
}

// Half a ball, whose other half lies beyond the study: its cut face belongs to both or to none.
void MeasureStoryTest::area_and_sphericity_are_of_one_form() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::StatisticsPanel& panel = *shown_panel(desktop);
  const glm::dvec3 middle(desktop.proxy().volume().geometry.size / std::int64_t{2});
  const glm::dvec3 place = desktop.proxy().volume().geometry.to_patient({middle.x, middle.y, -0.5});
  constexpr double kRadius = 15.0;
  desktop.proxy().paint({place, kRadius}, solver::Brush::add, engine::CaseProxy::new_gesture());
  desktop.wait_until_idle();
  click(desktop, panel, "Measure");
  QVERIFY(wait_for_measures(panel));
  const double curved = 2.0 * std::numbers::pi * kRadius * kRadius;
  const double volume = 2.0 / 3.0 * std::numbers::pi * std::pow(kRadius, 3);
  const double whole = 1.5 * curved;
  const auto is_near = [](double is, double wanted) { return std::abs(is / wanted - 1.0) < 0.05; };
  QVERIFY(is_near(desktop.state().surface.surface_mm2, curved));
  const auto* area = seen<QLabel>(panel, "Surface area");
  QVERIFY2(is_near(first_number(area->text().remove(QLocale().groupSeparator())), whole),
           qPrintable(area->text()));
  QVERIFY(is_near(first_number(seen<QLabel>(panel, "Sphericity")->text()),
                  std::cbrt(36.0 * std::numbers::pi * volume * volume) / whole));
}

void MeasureStoryTest::measures_are_of_the_case_and_the_surface_that_are_seen() {
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  ui::StatisticsPanel& panel = *shown_panel(desktop);
  desktop.begin(8.0);
  click(desktop, panel, "Measure");
  QVERIFY(wait_for_measures(panel));
  // The surface moves: what was measured is no longer so.
  desktop.proxy().step(5);
  desktop.wait_until_idle();
  QVERIFY(Desktop::wait_for([&] { return find_seen<QAbstractButton>(panel, "Draw diameters") == nullptr; }));
  click(desktop, panel, "Measure");
  QVERIFY(wait_for_measures(panel));
  // Another case has another surface, and this one none.
  ui::CaseWindow* const sphere = desktop.window().active_case();
  QVERIFY(desktop.open_phantom("dumbbell"));
  QVERIFY(find_seen<QAbstractButton>(panel, "Draw diameters") == nullptr);
  QVERIFY(!seen<QAbstractButton>(panel, "Measure")->isEnabled());
  QVERIFY(lines(desktop).empty());
  desktop.screenshot("measure-3-another-case");
  // Measures stay with their case.
  desktop.window().bring_to_front(*sphere);
  QVERIFY(wait_for_measures(panel));
  QVERIFY(first_number(seen<QLabel>(panel, "Longest")->text()) > 0.0);
  sphere->proxy().paint({desktop.seed_mm(), 9.0}, solver::Brush::add, engine::CaseProxy::new_gesture());
  QVERIFY(Desktop::wait_for([&] { return find_seen<QAbstractButton>(panel, "Draw diameters") == nullptr; }));
}

// A map from 0 to 1, and a ball of 0.45 in it.
void MeasureStoryTest::small_values_are_told_with_their_digits() {
  const TemporaryFolder folder;
  Volume volume;
  volume.geometry.size = Index3(32);
  const glm::dvec3 middle = volume.geometry.to_patient(glm::dvec3(16.0));
  std::vector<float> values;
  for (std::int64_t n = 0; n < volume.geometry.voxel_count(); ++n) {
    const glm::dvec3 place = volume.geometry.to_patient(glm::dvec3(volume.geometry.voxel_at(n)));
    const bool inside = glm::distance(place, middle) < 8.0;
    values.push_back(inside ? 0.45F : static_cast<float>(n % 1000) / 1000.0F);
  }
  volume.voxels = std::move(values);
  QCOMPARE(failure(imaging::write_volume_file(volume, folder / "map.nrrd")), QString());
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open(QString::fromStdString((folder / "map.nrrd").string())));
  ui::StatisticsPanel& panel = *shown_panel(desktop);
  solver::Parameters parameters = desktop.proxy().parameters();
  parameters.target = 0.44;
  parameters.range = 0.05;
  desktop.proxy().set_parameters(parameters);
  document::Start start;
  start.seeds.push_back({middle, 6.0});
  desktop.proxy().begin(start);
  desktop.wait_until_idle();
  QTRY_COMPARE(seen<QLabel>(panel, "Mean")->text(), QString("0.450"));
  click(desktop, panel, "Measure");
  QVERIFY(wait_for_measures(panel));
  QCOMPARE(seen<ui::FigureTable>(panel, "Values inside")->item(0, 1)->text(), QString("0.450"));

  bool done = false;
  QObject scope;
  connect(&desktop.window().files(), &ui::CaseFiles::written, &scope, [&] { done = true; });
  const auto file = folder / "report.html";
  desktop.window().exports().write_report(*desktop.window().active_case(),
                                          QString::fromStdString(file.string()));
  QVERIFY(Desktop::wait_for([&] { return done; }));
  const QByteArray report = bytes_of(file);
  for (const char* words : {"0.440", "0.050", "0.450 ± 0.000"}) QVERIFY2(report.contains(words), words);
}

void MeasureStoryTest::a_report_is_of_one_moment() {
  const TemporaryFolder folder;
  Desktop desktop(story_executor(), {1366, 768});
  QVERIFY(desktop.open_phantom("sphere"));
  desktop.begin(6.0);
  desktop.proxy().set_pause_at_convergence(false);
  desktop.proxy().play();
  QVERIFY(Desktop::wait_for([&] { return desktop.state().step >= 5; }));
  bool done = false;
  QObject scope;
  connect(&desktop.window().files(), &ui::CaseFiles::written, &scope, [&] { done = true; });
  const auto file = folder / "report.html";
  desktop.window().exports().write_report(*desktop.window().active_case(),
                                          QString::fromStdString(file.string()));
  QVERIFY(Desktop::wait_for([&] { return done; }));
  const engine::CaseState& state = desktop.state();
  QVERIFY(!state.playing);
  const QString cell = QStringLiteral("<td align='left'>%1</td>");
  const QByteArray report = bytes_of(file);
  for (const QString& words : {cell.arg("Steps") + cell.arg(ui::count_text(state.step)),
                               cell.arg(ui::size_text(state.surface.volume_ml, 2, "ml"))})
    QVERIFY2(report.contains(words.toUtf8()), qPrintable(words));
}

TIDEMARK_TEST(MeasureStoryTest)

}  // namespace tidemark::test::measure_story_test

#include "measure_story_test.moc"
