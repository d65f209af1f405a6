// A case that learns from two images: strokes, the choice of what is used, and the way through session,
// recipe and command line.
#include <QCheckBox>
#include <QFileDialog>
#include <QListWidget>
#include <QProcess>
#include <QScrollArea>
#include <QToolButton>
#include <glm/geometric.hpp>

#include "core/atomic_file.h"
#include "document/session_file.h"
#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/message_bar.h"
#include "ui/main/panel_docks.h"
#include "ui/main/session_reader.h"
#include "ui/panels/image_controls.h"
#include "ui/panels/joint_plot.h"

namespace tidemark::test::image_examples_story_test {

class ImageExamplesStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void two_images_teach_are_replayed_and_come_back();
  void images_keep_their_looks_though_the_first_is_not_used();
  void a_case_from_a_session_knows_its_frame_of_reference();

 private:
  static constexpr int kPatience = 60000;
  static constexpr double kRadius = 11.0;

  [[nodiscard]] QString path(const char* name) const {
    return QString::fromStdString((folder_ / name).string());
  }
  void make_images();
  void add_image(const QString& file);
  void paint_examples();
  void choose_what_is_used();
  void replay_on_the_command_line();
  void reopen();
  void reopen_without_the_image();
  [[nodiscard]] bool is_told(const QString& text) const;
  const std::vector<engine::ShownImage>& images() { return desktop_->proxy().display().settings().images; }
  const document::Drive& drive() { return desktop_->proxy().drive(); }
  // Their names, colours, and whether they are used, in their order; behind them those that drive the
  // surface.
  QStringList looks() {
    QStringList all;
    for (const engine::ShownImage& shown : images()) {
      all << QStringLiteral("%1, %2, %3")
                 .arg(QString::fromStdString(shown.image->name))
                 .arg(static_cast<int>(shown.colours))
                 .arg(shown.used ? "used" : "not used");
    }
    for (const auto& image : drive().images) all << QString::fromStdString(image->name);
    return all;
  }
  bool is_driven() {
    return Desktop::wait_for([&] { return desktop_->state().speed && !desktop_->state().speed_waits; },
                             kPatience);
  }
  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  Mask truth_;
  glm::dvec3 middle_{24.0, 24.0, 24.0};
};

// Nothing is to be seen in the first but noise; the others, on coarser voxels, have a ball.
void ImageExamplesStoryTest::make_images() {
  truth_ = {};
  std::uint32_t random = 11;
  const auto noise = [&random] {
    random = random * 1664525U + 1013904223U;
    return static_cast<double>(random >> 16U) / 65536.0;
  };
  const auto make = [&](const char* name, Index3 size, double spacing, double contrast, Mask* truth) {
    Volume volume;
    volume.geometry.size = size;
    volume.geometry.spacing_mm = glm::dvec3(spacing);
    std::vector<float> values;
    for (std::int64_t n = 0; n < volume.geometry.voxel_count(); ++n) {
      const Index3 voxel = volume.geometry.voxel_at(n);
      const bool inside = glm::distance(volume.geometry.to_patient(glm::dvec3(voxel)), middle_) < kRadius;
      values.push_back(static_cast<float>(100.0 * noise() + (inside ? contrast : 0.0)));
      if (truth) truth->voxels.push_back(inside ? 1 : 0);
    }
    volume.voxels = std::move(values);
    if (truth) truth->geometry = volume.geometry;
    QCOMPARE(failure(imaging::write_volume_file(volume, folder_ / name)), QString());
  };
  make("noise.nrrd", Index3(48), 1.0, 0.0, &truth_);
  make("second.nrrd", Index3(33), 1.5, 200.0, nullptr);
  make("third.nrrd", Index3(33), 1.5, 150.0, nullptr);
}

void ImageExamplesStoryTest::add_image(const QString& file) {
  desktop_->window().actions().add_image->trigger();
  auto* dialog = desktop_->window().findChild<QFileDialog*>();
  QVERIFY(dialog);
  name_file(*dialog, file);
}

bool ImageExamplesStoryTest::is_told(const QString& text) const {
  const auto* messages = desktop_->window().findChild<ui::MessageBar*>();
  return Desktop::wait_for([&] { return messages->text().contains(text); }, kPatience);
}

void ImageExamplesStoryTest::paint_examples() {
  auto* axial = desktop_->view<ui::SliceViewWidget>("Axial");
  QVERIFY(axial);
  desktop_->press(Qt::Key_M);
  const auto stroke = [&](glm::dvec3 from, glm::dvec3 to, Qt::MouseButton button) {
    Desktop::drag(*axial, {middle_ + from, middle_ + 0.5 * (from + to), middle_ + to}, button);
  };
  stroke({-7.0, -3.0, 0.0}, {7.0, -3.0, 0.0}, Qt::LeftButton);
  stroke({-6.0, 5.0, 0.0}, {6.0, 5.0, 0.0}, Qt::LeftButton);
  QVERIFY(drive().images.empty());  // nothing learns from it yet
  stroke({-20.0, -17.0, 0.0}, {20.0, -17.0, 0.0}, Qt::RightButton);
  stroke({-18.0, 10.0, 0.0}, {-15.0, 18.0, 0.0}, Qt::RightButton);
  stroke({17.0, -8.0, 0.0}, {17.0, 16.0, 0.0}, Qt::RightButton);
  QCOMPARE(drive().images.size(), std::size_t{1});
  QCOMPARE(drive().images.front(), images().front().image);
  QCOMPARE(images().front().image->checksum.size(), std::size_t{64});
}

void ImageExamplesStoryTest::choose_what_is_used() {
  desktop_->window().panels().show("level-set");
  auto* joint = desktop_->window().findChild<ui::JointPlot*>();
  QVERIFY(joint && Desktop::wait_for([&] { return joint->isVisible() && joint->histogram(); }, kPatience));
  QVERIFY(!joint->histogram()->inside.empty() && !joint->histogram()->outside.empty());
  for (QWidget* around = joint->parentWidget(); around != nullptr; around = around->parentWidget()) {
    if (auto* area = qobject_cast<QScrollArea*>(around)) area->ensureWidgetVisible(joint);
  }
  desktop_->screenshot("image-examples-2-joint");
  ui::apply_theme(*qApp, ui::Theme::dark);
  desktop_->screenshot("image-examples-2-dark");
  ui::apply_theme(*qApp, ui::Theme::light);
  desktop_->window().panels().show("display");
  desktop_->wait_until_idle();
  auto* used = find_seen<QCheckBox>(desktop_->window(), "Used by the speed function");
  QVERIFY(used && used->isChecked());
  desktop_->screenshot("image-examples-2-panel");
  QTest::mouseClick(used, Qt::LeftButton, {}, {8, used->height() / 2});
  desktop_->wait_until_idle();
  QVERIFY(!used->isChecked());
  QVERIFY(drive().images.empty() && images().size() == 1);
  QVERIFY(is_driven());
  // Undo uses it again, and the box says so.
  desktop_->press(Qt::Key_Z, Qt::ControlModifier);
  desktop_->wait_until_idle();
  QVERIFY(used->isChecked());
  QCOMPARE(drive().images.size(), std::size_t{1});
  // Taken out of the case it teaches no more; undo brings it back.
  auto* remove = find_seen<QToolButton>(desktop_->window(), "Remove image");
  QVERIFY(remove);
  QTest::mouseClick(remove, Qt::LeftButton);
  desktop_->wait_until_idle();
  QVERIFY(drive().images.empty() && images().empty());
  desktop_->press(Qt::Key_Z, Qt::ControlModifier);
  desktop_->wait_until_idle();
  QCOMPARE(images().size(), std::size_t{1});
  QCOMPARE(drive().images.front(), images().front().image);
  QVERIFY(is_driven());
}

void ImageExamplesStoryTest::replay_on_the_command_line() {
  const auto contents = document::load_session(folder_ / "two.tidemark");
  QCOMPARE(failure(contents), QString());
  const auto text = contents->recipe.to_text();
  QCOMPARE(failure(text), QString());
  QCOMPARE(failure(write_file(folder_ / "recipe.json", *text)), QString());
  const QStringList replay{"replay", path("recipe.json"), path("noise.nrrd"), "--out-phi", path("phi.nrrd")};
  const auto run = [](const QStringList& arguments, int code) {
    QProcess process;
    process.start(QStringLiteral(TIDEMARK_CLI), arguments);
    QVERIFY(process.waitForFinished(kPatience));
    QVERIFY2(process.exitStatus() == QProcess::NormalExit && process.exitCode() == code,
             process.readAllStandardError().constData());
  };
  run(replay, 2);  // it needs the image
  run(replay + QStringList{"--image", path("second.nrrd")}, 0);
  const auto phi = imaging::load_volume(folder_ / "phi.nrrd");
  QCOMPARE(failure(phi), QString());
  QVERIFY(phi->values() == desktop_->state().phi->dense());
}

void ImageExamplesStoryTest::reopen() {
  desktop_->window().active_case()->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().empty(); }));
  desktop_->window().session_reader().open(path("two.tidemark"));
  QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().size() == 1; }, kPatience));
  desktop_->wait_until_idle();
}

void ImageExamplesStoryTest::reopen_without_the_image() {
  std::filesystem::rename(folder_ / "second.nrrd", folder_ / "elsewhere.nrrd");
  reopen();
  QVERIFY(is_told("the image \"second.nrrd\" is missing"));
  desktop_->window().panels().show("display");
  desktop_->wait_until_idle();
  desktop_->screenshot("image-examples-3-missing");
  auto* list = find_seen<QListWidget>(desktop_->window(), "Images over the slices");
  QVERIFY(list);
  QCOMPARE(list->item(0)->text(), QString("second.nrrd (not found)"));
  QVERIFY(desktop_->state().begun && drive().strokes);
  QCOMPARE(drive().images.size(), std::size_t{1});
  // The same voxels under another name take its place.
  add_image(path("elsewhere.nrrd"));
  QVERIFY(
      Desktop::wait_for([&] { return images().size() == 1 && images().front().image->volume; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(drive().images.front(), images().front().image);
  QVERIFY(is_driven());
}

void ImageExamplesStoryTest::two_images_teach_are_replayed_and_come_back() {
  make_images();
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(1382, 858));
  QVERIFY(desktop_->open(path("noise.nrrd")));
  add_image(path("second.nrrd"));
  QVERIFY(Desktop::wait_for([&] { return images().size() == 1; }, kPatience));
  desktop_->proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = middle_; });
  desktop_->wait_until_idle();
  WatchedApplication::instance().restart();
  paint_examples();
  QVERIFY(is_driven());
  qInfo("while strokes were painted: %s", qPrintable(WatchedApplication::instance().longest()));
  desktop_->screenshot("image-examples-1-strokes");
  choose_what_is_used();

  desktop_->press(Qt::Key_P);
  QVERIFY(
      Desktop::wait_for([&] { return desktop_->state().step > 5 && !desktop_->state().playing; }, kPatience));
  desktop_->wait_until_idle();
  const double overlap = tidemark::dice(desktop_->state().phi->mask(), truth_);
  qInfo("Dice %.3f after %lld steps", overlap, static_cast<long long>(desktop_->state().step));
  QVERIFY2(overlap > 0.8, qPrintable(QString::number(overlap)));

  desktop_->window().active_case()->session_file = path("two.tidemark");
  desktop_->press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !desktop_->state().modified; }, kPatience));
  replay_on_the_command_line();

  reopen();
  QCOMPARE(images().size(), std::size_t{1});
  QVERIFY(images().front().image->volume);
  QCOMPARE(drive().images.front(), images().front().image);
  QVERIFY(is_driven());
  QVERIFY(!desktop_->state().modified);
  reopen_without_the_image();
}

void ImageExamplesStoryTest::images_keep_their_looks_though_the_first_is_not_used() {
  make_images();
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(1382, 858));
  QVERIFY(desktop_->open(path("noise.nrrd")));
  add_image(path("second.nrrd"));
  QVERIFY(Desktop::wait_for([&] { return images().size() == 1; }, kPatience));
  desktop_->proxy().display().change([&](engine::DisplaySettings& s) { s.cursor_mm = middle_; });
  desktop_->wait_until_idle();
  paint_examples();
  desktop_->window().panels().show("display");
  desktop_->wait_until_idle();
  auto* used = find_seen<QCheckBox>(desktop_->window(), "Used by the speed function");
  QVERIFY(used);
  QTest::mouseClick(used, Qt::LeftButton, {}, {8, used->height() / 2});
  desktop_->wait_until_idle();
  auto* controls = desktop_->window().findChild<ui::ImageControls*>();
  QVERIFY(controls);
  Desktop::choose_in(*controls, "Colours", "Cool");
  add_image(path("third.nrrd"));
  const QStringList wanted{"second.nrrd, 3, not used", "third.nrrd, 2, used", "third.nrrd"};
  Desktop::wait_for([&] { return looks() == wanted; }, kPatience);
  QCOMPARE(looks(), wanted);
  QVERIFY(is_driven());

  desktop_->window().active_case()->session_file = path("two.tidemark");
  desktop_->press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !desktop_->state().modified; }, kPatience));
  reopen();
  QVERIFY(is_driven());
  QCOMPARE(looks(), wanted);
  QVERIFY(!desktop_->state().modified);

  desktop_->window().actions().duplicate_case->trigger();
  const auto is_there = [&] {
    const QList<ui::CaseWindow*> all = desktop_->window().cases();
    return all.size() == 2 && desktop_->window().active_case() == all.back();
  };
  QVERIFY(Desktop::wait_for(is_there, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(looks(), wanted);
}

void ImageExamplesStoryTest::a_case_from_a_session_knows_its_frame_of_reference() {
  Volume volume;
  volume.geometry.size = Index3(24);
  std::vector<std::int16_t> values;
  for (std::int64_t n = 0; n < volume.geometry.voxel_count(); ++n)
    values.push_back(static_cast<std::int16_t>(n % 500));
  volume.voxels = std::move(values);
  for (const char* name : {"one", "other"}) {
    imaging::DicomSeriesHeader header;
    header.series_description = name;
    QCOMPARE(failure(imaging::write_dicom_series(volume, header, folder_ / name)), QString());
  }
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(1000, 700));
  QVERIFY(desktop_->open(path("one")));
  const std::string frame = desktop_->proxy().study().frame_of_reference_uid;
  QVERIFY(!frame.empty());
  desktop_->window().active_case()->session_file = path("two.tidemark");
  desktop_->press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return std::filesystem::exists(folder_ / "two.tidemark"); }, kPatience));
  desktop_->wait_until_idle();
  reopen();
  QCOMPARE(desktop_->proxy().study().frame_of_reference_uid, frame);
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "other", none)) {
    add_image(QString::fromStdString(entry.path().string()));
    break;
  }
  QVERIFY(is_told("another frame of reference"));
}

TIDEMARK_TEST(ImageExamplesStoryTest)

}  // namespace tidemark::test::image_examples_story_test

#include "image_examples_story_test.moc"
