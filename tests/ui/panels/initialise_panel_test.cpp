#include "ui/panels/initialise_panel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>

#include "engine/background_job.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "solver/speed/motion_limit.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/start_files.h"

namespace tidemark::test::initialise_panel_test {

class InitialisePanelTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::InitialisePanel>(*the_case_, 700);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void a_sphere_by_numbers_lies_around_the_crosshair() {
    choose(tr("Spheres"));
    type(tr("Radius"), "8");
    QVERIFY(says(QLocale().toString(8.0, 'f', 1)));
    start();
    const double ml = 4.0 / 3.0 * M_PI * 512.0 / 1000.0;
    QVERIFY(std::abs(the_case_->state().surface.volume_ml - ml) < 0.05 * ml);
  }

  void the_tool_that_draws_spheres_is_chosen_here_and_shown_when_chosen_elsewhere() {
    choose(tr("Spheres"));
    auto* draw = button<QToolButton>(*panel_, tr("Draw in a view"));
    QTest::mouseClick(draw, Qt::LeftButton);
    QCOMPARE(the_case_->proxy->display().settings().tool, engine::Tool::seed);
    the_case_->proxy->display().choose_tool(engine::Tool::window);
    QVERIFY(!draw->isChecked());
    the_case_->proxy->display().choose_tool(engine::Tool::seed);
    QVERIFY(draw->isChecked());
  }

  void a_threshold_starts_with_as_many_voxels_as_it_says() {
    choose(tr("Threshold"));
    type(tr("From"), "60");
    type(tr("To"), "105");
    const Volume& volume = the_case_->proxy->volume();
    double count = 0.0;
    for (const float value : volume.values()) count += value >= 60.0F && value <= 105.0F ? 1.0 : 0.0;
    const double share = 100.0 * count / static_cast<double>(volume.geometry.voxel_count());
    QVERIFY2(says(QLocale().toString(share, 'f', 1) + QChar(QChar::Nbsp) + '%'), qPrintable(sentence()));
    start();
    QVERIFY(std::abs(the_case_->state().surface.volume_ml - ball_ml()) < 0.08 * ball_ml());
  }

  void limits_in_the_wrong_order_cannot_start() {
    choose(tr("Threshold"));
    type(tr("From"), "90");
    type(tr("To"), "10");
    QVERIFY(!start_button()->isEnabled());
  }

  void a_flood_begins_at_the_crosshair_and_says_when_it_cannot() {
    choose(tr("Flood fill"));
    type(tr("From"), "60");
    type(tr("To"), "105");
    QVERIFY(start_button()->isEnabled());
    start();
    QVERIFY(std::abs(the_case_->state().surface.volume_ml - ball_ml()) < 0.08 * ball_ml());
    the_case_->proxy->display().change(
        [](engine::DisplaySettings& settings) { settings.cursor_mm = glm::dvec3(1.0); });
    QVERIFY(!start_button()->isEnabled());
    QVERIFY(says(tr("The value at the crosshair is not")));
    the_case_->proxy->display().change(
        [](engine::DisplaySettings& settings) { settings.cursor_mm = glm::dvec3(-500.0); });
    QVERIFY(says(tr("outside the study")));
  }

  // A dark voxel of the ball is none of the smoothed study, in which the flood begins.
  void a_flood_is_judged_by_the_smoothed_study() {
    const Volume& volume = the_case_->proxy->volume();
    const Index3 middle(glm::round(volume.geometry.to_voxel(the_case_->middle())));
    Index3 dark = middle;
    for (Index3 voxel = middle - Index3(3, 0, 0); voxel.x <= middle.x + 3; ++voxel.x) {
      if (volume.value(voxel) < volume.value(dark)) dark = voxel;
    }
    QVERIFY(volume.value(dark) < 98.0F);
    the_case_->proxy->display().change([&](engine::DisplaySettings& settings) {
      settings.cursor_mm = volume.geometry.to_patient(glm::dvec3(dark));
    });
    choose(tr("Flood fill"));
    type(tr("From"), "98");
    type(tr("To"), "105");
    QVERIFY(!start_button()->isEnabled());
    the_case_->proxy->smooth_source(2.0);
    QTRY_COMPARE(the_case_->state().smoothed_mm, 2.0);
    QVERIFY(start_button()->isEnabled());
    QVERIFY2(!says(tr("The value at the crosshair is not")), qPrintable(sentence()));
    start();
    QVERIFY(the_case_->state().surface.volume_ml > 0.1 * ball_ml());
    // How many of its voxels a threshold takes is not known before.
    choose(tr("Threshold"));
    QVERIFY2(!says(QChar(QChar::Nbsp) + QStringLiteral("%")), qPrintable(sentence()));
  }

  void it_begins_where_the_speed_is_above_0() {
    solver::Parameters parameters = the_case_->proxy->parameters();
    parameters.target = 82.5;
    parameters.range = 22.5;
    the_case_->proxy->set_parameters(parameters);
    choose(tr("Speed above 0"));
    QVERIFY(start_button()->isEnabled());
    start();
    std::int64_t inside = 0;
    for (const float value : the_case_->proxy->volume().values())
      inside += std::abs(value - parameters.target) < parameters.range ? 1 : 0;
    QCOMPARE(the_case_->state().surface.voxels_inside, inside);
    document::Drive drive = the_case_->proxy->drive();
    drive.setting.terms = {solver::SpeedTerm{"regions", {}}};
    the_case_->proxy->set_drive(drive);
    QVERIFY(!start_button()->isEnabled());
    QVERIFY(says(tr("depends on where it is")));
  }

  void a_mask_file_is_read_away_from_the_interface() {
    Mask mask{the_case_->proxy->volume().geometry, {}};
    mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxel_count()), 0);
    for (std::int64_t k = 8; k < 14; ++k) {
      for (std::int64_t j = 10; j < 30; ++j) {
        for (std::int64_t i = 10; i < 20; ++i)
          mask.voxels[static_cast<std::size_t>(mask.geometry.offset({i, j, k}))] = 1;
      }
    }
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "box.nii.gz")), QString());
    choose(tr("Mask file"));
    QVERIFY(!start_button()->isEnabled());
    type_path("box.nii.gz");
    QVERIFY(says("box.nii.gz"));
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QVERIFY(!start_button()->isEnabled());  // while it is read
    QTRY_VERIFY(the_case_->state().begun);
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->state().surface.voxels_inside, mask.count());
    QVERIFY(start_button()->isEnabled());
  }

  // As other programs write it: rows and columns from the other side.
  void a_mask_on_flipped_axes_is_taken() {
    const Geometry grid = the_case_->proxy->volume().geometry;
    Mask mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxel_count()))};
    mask.geometry.direction[0] = -grid.direction[0];
    mask.geometry.direction[1] = -grid.direction[1];
    mask.geometry.origin_mm =
        grid.to_patient({static_cast<double>(grid.size.x - 1), static_cast<double>(grid.size.y - 1), 0.0});
    for (std::int64_t i = 5; i < 15; ++i) {
      for (std::int64_t j = 10; j < 20; ++j) {
        for (std::int64_t k = 8; k < 14; ++k)
          mask.voxels[static_cast<std::size_t>(mask.geometry.offset({i, j, k}))] = 1;
      }
    }
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "flipped.nrrd")), QString());
    choose(tr("Mask file"));
    type_path("flipped.nrrd");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QTRY_VERIFY(the_case_->state().begun);
    the_case_->wait_until_idle();
    const auto inside = the_case_->state().phi->mask();
    QCOMPARE(inside.count(), mask.count());
    const Index3 mirrored(grid.size.x - 1 - 5, grid.size.y - 1 - 10, 8);
    QCOMPARE(inside.voxels[static_cast<std::size_t>(grid.offset(mirrored))], std::uint8_t{1});
  }

  void a_mask_of_another_grid_is_refused_with_the_reason() {
    Geometry other = the_case_->proxy->volume().geometry;
    other.size.x -= 1;
    Mask mask{other, std::vector<std::uint8_t>(static_cast<std::size_t>(other.voxel_count()), 1)};
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "other.nii.gz")), QString());
    choose(tr("Mask file"));
    type_path("other.nii.gz");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QTRY_VERIFY(says("other.nii.gz: its grid"));
    QVERIFY(!the_case_->state().begun);
  }

  void what_reading_a_mask_found_comes_with_the_start() {
    const Geometry grid = the_case_->proxy->volume().geometry;
    write_slice(grid, "seg.dcm");
    set_text(folder_ / "seg.dcm", 0x0062, 0x0001, "FRACTIONAL");
    ui::StartRequest request;
    request.path = folder_ / "seg.dcm";
    request.grid = grid;
    const auto wanted = imaging::load_any_mask(request.path, &grid);
    QCOMPARE(failure(wanted), QString());
    QVERIFY(!wanted->changes.empty());
    auto loaded = ui::load_start(request);
    QCOMPARE(failure(loaded), QString());
    QVERIFY(loaded->remarks == wanted->changes);
    request.frame_of_reference_uid = "1.2.3";
    loaded = ui::load_start(request);
    QCOMPARE(failure(loaded), QString());
    QCOMPARE(loaded->remarks.size(), wanted->changes.size() + 1);
  }

  void a_mask_of_another_frame_of_reference_starts_and_is_remarked() {
    panel_.reset();
    const auto study = std::make_shared<engine::LoadedStudy>(*ball_study());
    study->frame_of_reference_uid = "1.2.3";
    the_case_ = std::make_unique<PanelCase>(study);
    panel_ = shown<ui::InitialisePanel>(*the_case_, 700);
    write_slice(study->volume->geometry, "seg.dcm");
    choose(tr("Mask file"));
    type_path("seg.dcm");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QTRY_VERIFY(the_case_->state().begun);
    the_case_->wait_until_idle();
    QVERIFY2(says("seg.dcm: it names another frame of reference"), qPrintable(sentence()));
  }

  void a_saved_level_set_goes_on() {
    the_case_->begin(7.0);
    const double before = the_case_->state().surface.volume_ml;
    QCOMPARE(failure(imaging::write_volume_file(the_case_->state().phi->to_volume(), folder_ / "phi.nrrd")),
             QString());
    the_case_->begin(4.0);
    choose(tr("Saved level set"));
    type_path("phi.nrrd");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QTRY_VERIFY(std::abs(the_case_->state().surface.volume_ml - before) < 1e-6);
  }

  void a_label_can_be_gone_on_with() {
    choose(tr("Label"));
    QVERIFY(!start_button()->isEnabled());
    the_case_->begin(7.0);
    the_case_->proxy->add_label(QStringLiteral("Liver"));
    the_case_->wait_until_idle();
    the_case_->proxy->accept_surface(the_case_->state().labels.front().id);
    const auto voxels = the_case_->state().surface.voxels_inside;
    the_case_->begin(3.0);
    QVERIFY(says(QStringLiteral("Liver")));
    start();
    QCOMPARE(the_case_->state().surface.voxels_inside, voxels);
  }

  void a_label_or_a_mask_file_can_be_refined_alone() {
    the_case_->begin(5.0);
    the_case_->proxy->add_label(QStringLiteral("Liver"));
    the_case_->wait_until_idle();
    the_case_->proxy->accept_surface(the_case_->state().labels.front().id);
    the_case_->wait_until_idle();
    const Mask mask = the_case_->state().phi->mask();
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "old.nii.gz")), QString());
    for (const QString& method : {tr("Label"), tr("Mask file")}) {
      choose(method);
      if (method == tr("Mask file")) type_path("old.nii.gz");
      start();
      QVERIFY(!the_case_->state().limit);
      refine_check()->setFocus();
      QTest::keyClick(refine_check(), Qt::Key_Space);
      type(tr("Stay within"), "2.5");
      QTRY_VERIFY(says(tr("stays within %1").arg(QLocale().toString(2.5, 'f', 1))));
      QTest::mouseClick(start_button(), Qt::LeftButton);
      QTRY_VERIFY(the_case_->state().limit);
      QCOMPARE(the_case_->state().limit->within_mm(), 2.5);
      the_case_->wait_until_idle();
      QCOMPARE(the_case_->state().phi->mask().voxels, mask.voxels);
      the_case_->proxy->undo();
      the_case_->wait_until_idle();
      QVERIFY(!the_case_->state().limit);
    }
  }

  void smoothing_is_said_and_can_be_taken_back() {
    auto* apply = button<QPushButton>(*panel_, tr("Smooth"));
    QVERIFY(!apply->isEnabled());
    type(tr("Smoothing σ"), "1.5");
    QTest::mouseClick(apply, Qt::LeftButton);
    QTRY_COMPARE(the_case_->state().smoothed_mm, 1.5);
    QVERIFY(says(QLocale().toString(1.5, 'f', 2)));
    type(tr("Smoothing σ"), "0");
    QTest::mouseClick(apply, Qt::LeftButton);
    QTRY_COMPARE(the_case_->state().smoothed_mm, 0.0);
  }

  void smoothing_beyond_the_slider_is_shown_as_it_is() {
    the_case_->proxy->smooth_source(8.0);
    QTRY_COMPARE(the_case_->state().smoothed_mm, 8.0);
    panel_ = shown<ui::InitialisePanel>(*the_case_, 700);
    QCOMPARE(named<QDoubleSpinBox>(*panel_, tr("Smoothing σ"))->value(), 8.0);
    QVERIFY(!button<QPushButton>(*panel_, tr("Smooth"))->isEnabled());
  }

  void a_file_that_is_read_for_one_case_holds_up_no_other() {
    Mask mask{the_case_->proxy->volume().geometry, {}};
    mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxel_count()), 1);
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "all.nii.gz")), QString());
    PanelCase other;
    choose(tr("Mask file"));
    type_path("all.nii.gz");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QVERIFY(!start_button()->isEnabled());
    panel_->set_proxy(other.proxy.get());
    QVERIFY(start_button()->isEnabled());
    QVERIFY2(!says(tr("Reading the file")), qPrintable(sentence()));
    QTRY_VERIFY(the_case_->state().begun);
    other.wait_until_idle();
    QVERIFY(!other.state().begun);
    panel_->set_proxy(the_case_->proxy.get());
    QVERIFY(start_button()->isEnabled());
  }

  void what_is_wrong_with_a_file_is_said_where_its_case_is_shown() {
    Geometry small = the_case_->proxy->volume().geometry;
    small.size.x -= 1;
    Mask mask{small, std::vector<std::uint8_t>(static_cast<std::size_t>(small.voxel_count()), 1)};
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "other.nii.gz")), QString());
    PanelCase other;
    choose(tr("Mask file"));
    type_path("other.nii.gz");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    panel_->set_proxy(other.proxy.get());
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QCoreApplication::processEvents();
    QVERIFY2(!says("its grid"), qPrintable(sentence()));
    panel_->set_proxy(the_case_->proxy.get());
    QVERIFY2(says("other.nii.gz: its grid"), qPrintable(sentence()));
  }

  void the_reading_of_a_file_can_be_given_up() {
    Mask mask{the_case_->proxy->volume().geometry, {}};
    mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxel_count()), 1);
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "all.nii.gz")), QString());
    choose(tr("Mask file"));
    type_path("all.nii.gz");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    QPushButton* cancel = nullptr;
    for (auto* one : panel_->findChildren<QPushButton*>()) {
      if (one->text() == tr("Cancel") && one->isVisible()) cancel = one;
    }
    QVERIFY(cancel);
    cancel->click();
    QVERIFY(!cancel->isVisible());
    QVERIFY(start_button()->isEnabled());
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    the_case_->wait_until_idle();
    QVERIFY(!the_case_->state().begun);
  }

  void a_session_may_die_while_a_file_is_read() {
    Mask mask{the_case_->proxy->volume().geometry, {}};
    mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxel_count()), 1);
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / "all.nii.gz")), QString());
    choose(tr("Mask file"));
    type_path("all.nii.gz");
    QTest::mouseClick(start_button(), Qt::LeftButton);
    the_case_->proxy.reset();
    QTest::qWait(200);
    QVERIFY(!start_button()->isEnabled());
    QVERIFY(says(tr("Open a study to")));
  }

 private:
  void choose(const QString& method) {
    auto* from = named<QComboBox>(*panel_, tr("Begin with"));
    const int index = from->findText(method);
    QVERIFY(index >= 0);
    from->setCurrentIndex(index);
  }
  // The number of that name that is seen.
  void type(const QString& name, const char* text) {
    for (auto* number : panel_->findChildren<QDoubleSpinBox*>()) {
      if (number->accessibleName() != name || !number->isVisible()) continue;
      number->setFocus();
      number->selectAll();
      QTest::keyClicks(number, text);
      QTest::keyClick(number, Qt::Key_Return);
      return;
    }
    QFAIL(qPrintable(name));
  }
  // A segmentation with a frame of reference of its own: a block in one slice.
  void write_slice(const Geometry& grid, const std::string& name) {
    std::vector<std::uint8_t> slice(static_cast<std::size_t>(grid.size.x * grid.size.y));
    for (std::int64_t j = 10; j < 30; ++j) {
      for (std::int64_t i = 10; i < 20; ++i) slice[static_cast<std::size_t>(grid.offset({i, j, 0}))] = 1;
    }
    imaging::Segment segment;
    segment.slices[12] = slice;
    QCOMPARE(failure(imaging::write_segmentation({grid, {segment}, {}}, {}, folder_ / name)), QString());
  }
  void type_path(const std::string& name) {
    for (auto* path : panel_->findChildren<QLineEdit*>()) {
      if (path->accessibleName() == tr("File") && path->isVisible()) {
        path->setText(QString::fromStdString((folder_ / name).string()));
      }
    }
  }
  QCheckBox* refine_check() {
    for (auto* check : panel_->findChildren<QCheckBox*>()) {
      if (check->isVisible() && check->text() == tr("Refine it alone")) return check;
    }
    qFatal("no mask is refined");
  }
  QPushButton* start_button() { return button<QPushButton>(*panel_, tr("Place surface")); }
  void start() {
    QVERIFY(start_button()->isEnabled());
    QTest::mouseClick(start_button(), Qt::LeftButton);
    the_case_->wait_until_idle();
    QVERIFY(the_case_->state().begun);
  }
  // All texts that are seen.
  QString sentence() {
    QString all;
    for (auto* label : panel_->findChildren<QLabel*>()) {
      if (label->isVisible()) all += label->text() + '\n';
    }
    return all;
  }
  bool says(const QString& text) { return sentence().contains(text); }
  static double ball_ml() { return 4.0 / 3.0 * M_PI * std::pow(kBallRadius, 3) / 1000.0; }

  TemporaryFolder folder_;
  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::InitialisePanel> panel_;
};

TIDEMARK_TEST(InitialisePanelTest)

}  // namespace tidemark::test::initialise_panel_test

#include "initialise_panel_test.moc"
