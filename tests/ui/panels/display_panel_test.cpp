#include "ui/panels/display_panel.h"

#include <QCheckBox>
#include <QColorDialog>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QPointer>
#include <QPushButton>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/widgets/colour_button.h"

namespace tidemark::test::display_panel_test {

class DisplayPanelTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::DisplayPanel>(*the_case_, 1100);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void presets_set_the_window_and_are_recognised() {
    choose(tr("Preset"), tr("Lung"));
    QCOMPARE(settings().window, (WindowLevel{-600.0, 1500.0}));
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Width"))->value(), 1500.0);
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Level"))->value(), -600.0);
    choose(tr("Preset"), tr("As in the file"));
    QCOMPARE(settings().window, (WindowLevel{50.0, 300.0}));
    the_case_->proxy->display().change([](engine::DisplaySettings& s) { s.window = {40.0, 80.0}; });
    QCOMPARE(preset(), tr("Brain"));
    type(tr("Width"), "81");
    QCOMPARE(settings().window, (WindowLevel{40.0, 81.0}));
    QCOMPARE(preset(), tr("Own"));
  }

  // As of a map of diffusion in m2/s.
  void windows_of_very_small_values_are_those_that_are_shown() {
    auto study = std::make_shared<engine::LoadedStudy>(*ball_study());
    auto volume = std::make_shared<Volume>(*study->volume);
    std::vector<float> values = volume->values();
    for (float& value : values) value *= 2e-11F;
    volume->voxels = std::move(values);
    volume->modality = "MR";
    volume->window.reset();
    study->summary = engine::summarise(*volume);
    study->volume = volume;
    engine::CaseProxy proxy(the_case_->engine, study, solver::ExecutorKind::host);
    panel_->set_proxy(&proxy);
    choose(tr("Preset"), tr("Full range"));
    const WindowLevel window = proxy.display().settings().window;
    const auto [lowest, highest] = volume->range();
    QCOMPARE(window.width, double{highest} - double{lowest});
    const auto* width = named<QDoubleSpinBox>(*panel_, tr("Width"));
    QVERIFY(std::abs(width->value() / window.width - 1.0) < 0.01);
    panel_->set_proxy(the_case_->proxy.get());
  }

  void presets_of_tissues_are_for_ct_alone() {
    auto study = std::make_shared<engine::LoadedStudy>(*ball_study());
    auto volume = std::make_shared<Volume>(*study->volume);
    volume->modality = "MR";
    volume->unit.clear();
    volume->window.reset();
    study->volume = volume;
    engine::CaseProxy proxy(the_case_->engine, study, solver::ExecutorKind::host);
    panel_->set_proxy(&proxy);
    auto* presets = named<QComboBox>(*panel_, tr("Preset"));
    QCOMPARE(presets->findText(tr("Lung")), -1);
    QCOMPARE(presets->findText(tr("As in the file")), -1);
    choose(tr("Preset"), tr("Full range"));
    const auto [lowest, highest] = volume->range();
    const WindowLevel window = proxy.display().settings().window;
    QCOMPARE(window.centre - window.width / 2.0, double{lowest});
    QCOMPARE(window.centre + window.width / 2.0, double{highest});
    QVERIFY(named<QDoubleSpinBox>(*panel_, tr("Width"))->suffix().isEmpty());  // no HU
    panel_->set_proxy(nullptr);
  }

  void slices_can_be_set() {
    choose(tr("Voxels"), tr("Squares"));
    QVERIFY(settings().nearest);
    choose(tr("Sides"), tr("Neurological"));
    QVERIFY(!settings().radiological);
    choose(tr("Speed map"), tr("Curvature"));
    QCOMPARE(settings().speed_term, renderer::SpeedTerm::curvature);
    type(tr("Labels"), "80");
    QCOMPARE(settings().label_opacity, 0.8);
    type(tr("Line width"), QLocale().toString(3.5).toUtf8());
    QCOMPARE(settings().line_pixels, 3.5);
    click(tr("Crosshair"));
    QVERIFY(!settings().crosshair);
    click(tr("Patient's name and dates"));
    QVERIFY(!settings().patient_text);
    click(tr("Outline of the surface"));
    QVERIFY(!settings().outline);
    QVERIFY(!named<QDoubleSpinBox>(*panel_, tr("Line width"))->isEnabled());
  }

  void the_3d_view_can_be_set() {
    choose(tr("Drawn by"), tr("Slices"));
    QCOMPARE(settings().mode, renderer::Mode::slices);
    type(tr("Opacity"), "50");
    QCOMPARE(settings().surface_colour.a, 0.5F);
    type(tr("Hollows"), "30");
    QCOMPARE(settings().occlusion, 0.3);
    choose(tr("Coloured by"), tr("Mean curvature"));
    QCOMPARE(settings().colouring, renderer::SurfaceColouring::curvature);
    QVERIFY(!named<QComboBox>(*panel_, tr("Where"))->isEnabled());
    click(tr("Source"));
    QVERIFY(settings().show_source);
    choose(tr("Where"), tr("Inside the surface"));
    QCOMPARE(settings().region, renderer::Region::inside);
    QVERIFY(settings().orientation_cube && settings().volume_box);
    click(tr("Orientation cube"));
    QVERIFY(!settings().orientation_cube);
    click(tr("Edges of the volume"));
    QVERIFY(!settings().volume_box);
    click(tr("Surface"));
    QVERIFY(!settings().surface);
  }

  void a_colour_keeps_the_opacity() {
    type(tr("Opacity"), "50");
    auto* colour = panel_->findChild<ui::ColourButton*>();
    QTest::mouseClick(colour, Qt::LeftButton);
    auto* dialog = colour->findChild<QColorDialog*>();
    QVERIFY(dialog);
    dialog->setCurrentColor(QColor(255, 0, 51));
    dialog->accept();
    QCOMPARE(settings().surface_colour, glm::vec4(1.0F, 0.0F, 0.2F, 0.5F));
  }

  void a_colour_that_is_being_chosen_is_for_no_other_case() {
    PanelCase other;
    auto* colour = panel_->findChild<ui::ColourButton*>();
    QTest::mouseClick(colour, Qt::LeftButton);
    const QPointer<QColorDialog> dialog = colour->findChild<QColorDialog*>();
    QVERIFY(dialog && dialog->isVisible());
    panel_->set_proxy(other.proxy.get());
    QTRY_VERIFY(!dialog);
    panel_->set_proxy(nullptr);
  }

  void the_clip_plane_lies_across_the_crosshair_and_hides_the_viewers_side() {
    the_case_->proxy->display().change([](engine::DisplaySettings& s) {
      s.camera.azimuth = 0.0;  // from the front: the viewer is anterior
      s.camera.elevation = 0.0;
    });
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Coronal")), Qt::LeftButton);
    QVERIFY(settings().clip_on);
    QCOMPARE(settings().clip.normal, glm::dvec3(0.0, -1.0, 0.0));
    QCOMPARE(settings().clip.offset_mm, -the_case_->middle().y);
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Distance"))->value(), 0.0);
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Facing me")), Qt::LeftButton);
    QVERIFY(glm::distance(settings().clip.normal, glm::dvec3(0.0, -1.0, 0.0)) < 1e-9);
  }

  void the_clip_plane_moves_flips_and_can_be_told_what_to_cut() {
    QTest::mouseClick(button<QToolButton>(*panel_, tr("Axial")), Qt::LeftButton);
    const renderer::ClipPlane before = settings().clip;
    type(tr("Distance"), "7");
    QCOMPARE(settings().clip.offset_mm, before.offset_mm + 7.0);
    QTest::mouseClick(button<QPushButton>(*panel_, tr("Flip")), Qt::LeftButton);
    QCOMPARE(settings().clip.normal, -before.normal);
    QCOMPARE(settings().clip.offset_mm, -(before.offset_mm + 7.0));  // the same plane
    click(tr("Cuts the source"));
    click(tr("Cuts the surface"));
    click(tr("Shows the slice"));
    QVERIFY(!settings().clip.clips_source);
    QVERIFY(!settings().clip.clips_surface);
    QVERIFY(!settings().clip.picture);
    click(tr("Clip plane in 3D"));
    QVERIFY(!settings().clip_on);
    QVERIFY(!named<QDoubleSpinBox>(*panel_, tr("Distance"))->isEnabled());
  }

  void what_is_changed_in_a_view_shows() {
    the_case_->proxy->display().change([](engine::DisplaySettings& s) {
      s.window = {12.0, 345.0};
      s.radiological = false;
      s.clip_on = true;
      s.region = renderer::Region::tinted;
    });
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Width"))->value(), 345.0);
    QCOMPARE(named<QComboBox>(*panel_, tr("Sides"))->currentText(), tr("Neurological"));
    QVERIFY(button<QCheckBox>(*panel_, tr("Clip plane in 3D"))->isChecked());
    QCOMPARE(named<QComboBox>(*panel_, tr("Where"))->currentText(), tr("Everywhere, inside tinted"));
  }

  void a_panel_behind_another_one_catches_up_when_it_is_seen() {
    panel_->hide();
    the_case_->proxy->display().change([](engine::DisplaySettings& s) { s.window.width = 222.0; });
    show(*panel_);
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Width"))->value(), 222.0);
  }

  void the_session_may_die() {
    the_case_->proxy.reset();
    QVERIFY(!named<QComboBox>(*panel_, tr("Preset"))->isEnabled());
    panel_->grab();
  }

 private:
  const engine::DisplaySettings& settings() { return panel_->proxy()->display().settings(); }
  QString preset() { return named<QComboBox>(*panel_, tr("Preset"))->currentText(); }
  // As from the list that opens.
  void choose(const QString& name, const QString& text) {
    auto* box = named<QComboBox>(*panel_, name);
    const int index = box->findText(text);
    QVERIFY2(index >= 0, qPrintable(text));
    box->setFocus();
    box->setCurrentIndex(index);
    emit box->activated(index);
  }
  void type(const QString& name, const char* text) {
    auto* number = named<QDoubleSpinBox>(*panel_, name);
    number->setFocus();
    number->selectAll();
    QTest::keyClicks(number, text);
    QTest::keyClick(number, Qt::Key_Return);
  }
  void click(const QString& text) {
    auto* check = button<QCheckBox>(*panel_, text);
    QTest::mouseClick(check, Qt::LeftButton, {}, {8, check->height() / 2});
  }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::DisplayPanel> panel_;
};

TIDEMARK_TEST(DisplayPanelTest)

}  // namespace tidemark::test::display_panel_test

#include "display_panel_test.moc"
