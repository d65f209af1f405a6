// What drives the surface, in the panel Level set: maps from files, and further images.
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <algorithm>

#include "document/speed_map.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/panels/joint_plot.h"
#include "ui/panels/level_set_panel.h"

namespace tidemark::test::function_controls_test {

class FunctionControlsTest : public QObject {
  Q_OBJECT
 private slots:
  void init() {
    the_case_ = std::make_unique<PanelCase>();
    panel_ = shown<ui::LevelSetPanel>(*the_case_, 900);
  }
  void cleanup() {
    panel_.reset();
    the_case_.reset();
  }

  void a_map_is_chosen_from_a_file_and_drives_the_surface() {
    const Volume& study = the_case_->proxy->volume();
    Volume map;
    map.geometry = study.geometry;
    map.voxels = std::vector<float>(static_cast<std::size_t>(study.geometry.voxel_count()), 0.8F);
    const TemporaryFolder folder;
    QCOMPARE(failure(imaging::write_volume_file(map, folder / "sure.nii.gz")), QString());
    map.geometry.size = {3, 3, 3};
    map.voxels = std::vector<float>(27, 0.8F);
    QCOMPARE(failure(imaging::write_volume_file(map, folder / "other.nii.gz")), QString());

    auto* choose = button<QPushButton>(*panel_, tr("Choose a map…"));
    QVERIFY(!choose->isVisible());
    auto* function = named<QComboBox>(*panel_, tr("Driven by"));
    function->setFocus();
    QTest::keyClick(function, Qt::Key_M);  // "Map"
    QTRY_VERIFY(choose->isVisible());
    QVERIFY(the_case_->proxy->drive().setting.is_tent());

    give_map(folder / "other.nii.gz");
    QTRY_VERIFY(choose->isEnabled() && says("other.nii.gz"));
    QVERIFY(the_case_->proxy->drive().setting.is_tent());

    give_map(folder / "sure.nii.gz");
    QTRY_VERIFY(the_case_->proxy->drive().map);
    the_case_->wait_until_idle();
    QCOMPARE(the_case_->proxy->drive().setting.terms.front().function, std::string("image"));
    QCOMPARE(named<QComboBox>(*panel_, tr("Driven by"))->currentData().toString(), QString("image"));
    QVERIFY(choose->isVisible() && says("sure.nii.gz"));
    QVERIFY(!says("other.nii.gz"));

    // What the map holds is chosen by words, and kept as a number.
    auto* values = named<QComboBox>(*panel_, tr("Values"));
    QVERIFY(values && values->isVisible());
    QCOMPARE(values->currentText(), QString("By its values"));
    values->setFocus();
    QTest::keyClick(values, Qt::Key_Down);
    the_case_->wait_until_idle();
    QCOMPARE(values->currentText(), QString("Probability, 0 to 1"));
    QCOMPARE(the_case_->proxy->drive().setting.terms.front().values.at("form"), 1.0);
    the_case_->proxy->undo();
    the_case_->wait_until_idle();
    QCOMPARE(values->currentText(), QString("By its values"));

    // A DICOM segmentation of a part of the study is a map, too.
    imaging::Segment segment;
    const Index3 size = study.geometry.size;
    segment.slices[size.z / 2] = std::vector<std::uint8_t>(static_cast<std::size_t>(size.x * size.y), 1);
    QCOMPARE(failure(imaging::write_segmentation({study.geometry, {segment}, {}}, {}, folder / "seg.dcm")),
             QString());
    give_map(folder / "seg.dcm");
    QTRY_VERIFY(says("seg.dcm"));
    the_case_->wait_until_idle();
    const Volume& placed = *the_case_->proxy->drive().map->volume;
    QCOMPARE(placed.value(Index3(1, 1, size.z / 2)), 1.0F);
    QCOMPARE(placed.value(Index3(1, 1, 0)), 0.0F);
    the_case_->proxy->undo();
    the_case_->proxy->undo();
    the_case_->wait_until_idle();
    QVERIFY(the_case_->proxy->drive().setting.is_tent());
    QTRY_VERIFY(!choose->isVisible());
  }

  void a_map_of_another_frame_of_reference_is_remarked() {
    const auto study = std::make_shared<engine::LoadedStudy>(*ball_study());
    study->frame_of_reference_uid = "1.2.3";
    PanelCase framed(study);
    panel_->set_proxy(framed.proxy.get());
    const Geometry& grid = study->volume->geometry;
    imaging::Segment segment;
    segment.slices[12] = std::vector<std::uint8_t>(static_cast<std::size_t>(grid.size.x * grid.size.y), 1);
    const TemporaryFolder folder;
    QCOMPARE(failure(imaging::write_segmentation({grid, {segment}, {}}, {}, folder / "seg.dcm")), QString());
    const auto map = document::load_speed_map(folder / "seg.dcm", grid);
    QCOMPARE(failure(map), QString());
    document::Drive drive;
    drive.setting.terms = {{"image", {}}};
    drive.map = *map;
    framed.proxy->set_drive(drive);
    QTRY_VERIFY(says("another frame of reference"));
    auto own = std::make_shared<document::SpeedMap>(**map);
    own->frame_of_reference_uid = "1.2.3";
    drive.map = own;
    framed.proxy->set_drive(drive);
    QTRY_VERIFY(!says("another frame of reference"));
    panel_->set_proxy(nullptr);
  }

  // A second image that tells the ball's two halves apart.
  void with_two_images_their_joint_histogram_shows_the_strokes() {
    const Volume& study = the_case_->proxy->volume();
    const Geometry& grid = study.geometry;
    auto second = std::make_shared<Volume>();
    second->geometry = grid;
    std::vector<float> values;
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i)
      values.push_back(i % grid.size.x < grid.size.x / 2 ? 0.0F : 1.0F);
    second->voxels = std::move(values);
    document::CaseImage image;
    image.name = "PET";
    image.volume = second;
    auto strokes = std::make_shared<solver::Strokes>();
    const Index3 middle = grid.size / std::int64_t{2};
    for (std::int64_t i = 2; i < 6; ++i) {
      strokes->inside.push_back(grid.offset(middle + Index3(i, 0, 0)));
      strokes->outside.push_back(grid.offset({i, 2, middle.z}));
    }
    std::ranges::sort(strokes->outside);
    document::Drive drive;
    drive.setting.terms = {{"examples", {}}};
    drive.strokes = strokes;
    auto* joint = panel_->findChild<ui::JointPlot*>();
    QVERIFY(joint && !joint->isVisible());
    the_case_->proxy->set_drive(drive);
    the_case_->wait_until_idle();
    QVERIFY(!joint->isVisible());  // one image alone
    engine::ShownImage shown;
    shown.image = std::make_shared<const document::CaseImage>(image);
    the_case_->proxy->display().change([&](engine::DisplaySettings& settings) { settings.images = {shown}; });
    QTRY_VERIFY(joint->isVisible());
    QTRY_VERIFY(joint->histogram());
    const engine::JointHistogram& counted = *joint->histogram();
    QCOMPARE(counted.inside.size(), std::size_t{4});
    QCOMPARE(counted.inside.front()[1], 1.0F);
    QCOMPARE(counted.outside.front()[1], 0.0F);
    const QImage picture = joint->grab().toImage();
    const auto colour_at = [&](QPointF place) {
      const double scale = picture.devicePixelRatio();
      return picture.pixelColor((place * scale).toPoint());
    };
    const QColor inside = colour_at(joint->position_of(counted.inside.front()));
    QVERIFY(inside.red() > inside.blue() + 100);
    const QColor outside = colour_at(joint->position_of(counted.outside.front()));
    QVERIFY(outside.blue() > outside.red() + 60);
    // Another stroke, another count.
    auto more = std::make_shared<solver::Strokes>(*strokes);
    more->inside.insert(more->inside.begin(), grid.offset(middle - Index3(3, 0, 0)));
    drive.strokes = more;
    the_case_->proxy->set_drive(drive);
    QTRY_COMPARE(joint->histogram()->inside.size(), std::size_t{5});
    drive.setting = {};
    the_case_->proxy->set_drive(drive);
    QTRY_VERIFY(!joint->isVisible());
  }

  void a_map_that_is_being_chosen_is_for_no_other_case() {
    PanelCase other;
    auto* function = named<QComboBox>(*panel_, tr("Driven by"));
    function->setFocus();
    QTest::keyClick(function, Qt::Key_M);  // "Map"
    auto* choose = button<QPushButton>(*panel_, tr("Choose a map…"));
    QTRY_VERIFY(choose->isVisible());
    QTest::mouseClick(choose, Qt::LeftButton);
    const QPointer<QFileDialog> dialog = panel_->findChild<QFileDialog*>();
    QVERIFY(dialog && dialog->isVisible());
    panel_->set_proxy(the_case_->proxy.get());  // still the same
    QVERIFY(dialog->isVisible());
    panel_->set_proxy(other.proxy.get());
    QTRY_VERIFY(!dialog);
    panel_->set_proxy(nullptr);
  }

 private:
  void give_map(const std::filesystem::path& file) {
    QTest::mouseClick(button<QPushButton>(*panel_, tr("Choose a map…")), Qt::LeftButton);
    auto* dialog = panel_->findChild<QFileDialog*>();
    QVERIFY(dialog);
    name_file(*dialog, QString::fromStdString(file.string()));
    QTRY_VERIFY(!panel_->findChild<QFileDialog*>());
  }
  [[nodiscard]] bool says(const QString& text) const {
    for (const QLabel* label : panel_->findChildren<QLabel*>()) {
      if (label->isVisible() && label->text().contains(text)) return true;
    }
    return false;
  }

  std::unique_ptr<PanelCase> the_case_;
  std::unique_ptr<ui::LevelSetPanel> panel_;
};

TIDEMARK_TEST(FunctionControlsTest)

}  // namespace tidemark::test::function_controls_test

#include "function_controls_test.moc"
