// What was segmented goes to other systems, as files and to a server, and comes back.
#include <QAction>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QToolButton>
#include <fstream>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "imaging/pacs/services.h"
#include "imaging/results/results.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/look/theme.h"
#include "ui/main/panel_docks.h"
#include "ui/opening/load_report.h"
#include "ui/panels/labels_model.h"
#include "ui/panels/meaning_picker.h"
#include "ui/results/send_result_dialog.h"
#include "ui/results/write_result_dialog.h"

namespace tidemark::test {
namespace {

namespace fs = std::filesystem;

constexpr int kPatience = 60'000;
const glm::dvec3 kLeft{34.0, 20.0, 16.0};
const glm::dvec3 kRight{14.0, 20.0, 16.0};

// Two bright balls in the dark.
void write_study(const fs::path& folder) {
  Volume volume;
  volume.geometry.size = {48, 40, 16};
  volume.geometry.spacing_mm = {1.0, 1.0, 2.0};
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    const glm::dvec3 point(offset % 48, offset / 48 % 40, 2.0 * (offset / 1920));
    const bool inside = glm::distance(point, kLeft) < 9.0 || glm::distance(point, kRight) < 8.0;
    voxels.push_back(inside ? 100 : 0);
  }
  volume.voxels = std::move(voxels);
  imaging::DicomSeriesHeader header;
  header.modality = "CT";
  header.patient_name = "Phantom^Paula";
  header.patient_id = "P1";
  header.series_description = "Two balls: 1/2";
  const Status written = imaging::write_dicom_series(volume, header, folder);
  if (!written) qFatal("%s", written.error().message.c_str());
}

QPushButton* button(QWidget& in, const QString& text) {
  for (QPushButton* one : in.findChildren<QPushButton*>()) {
    if (QString(one->text()).remove('&') == text) return one;
  }
  qFatal("there is no button %s", qPrintable(text));
}

// Every control has a tip, and a name or a text.
bool is_explained(QWidget& dialog) {
  for (const QWidget* widget : dialog.findChildren<QWidget*>()) {
    const auto* button = qobject_cast<const QAbstractButton*>(widget);
    const bool is_control =
        button || qobject_cast<const QComboBox*>(widget) || qobject_cast<const QLineEdit*>(widget);
    if (!is_control || (button && button->text().endsWith("Close"))) continue;
    if (!widget->toolTip().isEmpty() && (button || !widget->accessibleName().isEmpty())) continue;
    qWarning("%s “%s”", widget->metaObject()->className(), button ? qPrintable(button->text()) : "");
    return false;
  }
  return true;
}

bool says(QWidget& dialog, const QString& text) {
  const auto labels = dialog.findChildren<QLabel*>();
  return std::any_of(labels.begin(), labels.end(),
                     [&](const QLabel* label) { return label->text().contains(text); });
}

// In both themes, into the folder of TIDEMARK_SCREENSHOTS.
void picture(QWidget& widget, const QString& name) {
  const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS");
  if (folder.isEmpty()) return;
  for (const ui::Theme theme : {ui::Theme::dark, ui::Theme::light}) {
    ui::apply_theme(*qApp, theme);
    QTest::qWait(30);
    const char* end = theme == ui::Theme::light ? "light" : "dark";
    QVERIFY(widget.grab().save(QStringLiteral("%1/%2-%3.png").arg(folder, name, end)));
  }
}

Mask mask_of(const std::vector<std::uint8_t>& voxels, std::uint8_t id, const Geometry& geometry) {
  Mask mask{geometry, voxels};
  for (std::uint8_t& voxel : mask.voxels) voxel = voxel == id ? 1 : 0;
  return mask;
}

}  // namespace

class ResultsStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void cleanup() { desktop_.reset(); }
  void labels_go_out_as_dicom_and_come_back();
  void a_dropped_segmentation_becomes_labels_and_a_dropped_volume_a_study();
  void what_lies_beside_a_study_is_named_and_imported_by_a_click();
  void labels_go_out_as_polygons();
  void the_surface_alone_is_a_result_too();
  void a_study_that_is_no_dicom_says_what_that_means();
  void a_file_of_the_study_is_never_written_to();
  void labels_are_sent_to_a_server();
  void a_server_that_keeps_silent_is_given_up_by_a_click();

 private:
  [[nodiscard]] QString path(const char* name) const {
    return QString::fromStdString((folder_ / name).string());
  }
  [[nodiscard]] imaging::Segments block(const char* name);  // in two slices of the study
  [[nodiscard]] const Geometry& grid() { return desktop_->proxy().volume().geometry; }
  [[nodiscard]] std::vector<std::uint8_t> voxels() { return *desktop_->state().label_voxels; }
  void begin(glm::dvec3 middle);
  void segment(glm::dvec3 middle, const char* name, const char* meaning);
  void segment_both();
  void write_by_the_menu(QAction* action, const QString& file);
  void import_by_the_menu(const QString& file);
  ui::SendResultDialog* send_to(const imaging::PacsServer& server);
  void drop(const QString& file);

  TemporaryFolder folder_;
  std::unique_ptr<Desktop> desktop_;
  ui::CaseWindow* window_ = nullptr;
};

void ResultsStoryTest::init() {
  qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString((folder_ / "config").string()));
  if (!fs::exists(folder_ / "study")) write_study(folder_ / "study");
  desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(900, 620));
  window_ = desktop_->open(path("study"));
  QVERIFY(window_);
  window_->set_layout(ui::ViewLayout::single);  // no story about pictures
  desktop_->window().panels().show("labels");
  desktop_->wait_until_idle();
}

void ResultsStoryTest::begin(glm::dvec3 middle) {
  document::Start start;
  start.seeds.push_back({middle, 5.0});
  desktop_->proxy().begin(start);
  desktop_->wait_until_idle();
}

// A surface that fills a ball becomes a new label, with that name and a meaning that is typed.
void ResultsStoryTest::segment(glm::dvec3 middle, const char* name, const char* meaning) {
  solver::Parameters parameters = desktop_->proxy().parameters();
  parameters.target = 100.0;
  parameters.range = 60.0;
  parameters.alpha = 0.9;
  desktop_->proxy().set_parameters(parameters);
  begin(middle);
  desktop_->proxy().step(40);
  desktop_->wait_until_idle();
  auto& window = desktop_->window();
  auto& model = *window.findChild<ui::LabelsModel*>();
  for (QToolButton* add : window.findChildren<QToolButton*>()) {
    if (add->text() == "Add" && add->isVisible()) QTest::mouseClick(add, Qt::LeftButton);
  }
  desktop_->wait_until_idle();
  QTest::mouseClick(button(window, "Accept surface into label"), Qt::LeftButton);
  desktop_->wait_until_idle();
  model.setData(model.index(model.rowCount() - 1, ui::LabelsModel::name), name, Qt::EditRole);
  desktop_->wait_until_idle();
  auto& picker = *window.findChild<ui::MeaningPicker*>();
  picker.setFocus();
  picker.lineEdit()->selectAll();
  QTest::keyClicks(&picker, meaning);
  QTest::keyClick(&picker, Qt::Key_Return);
  desktop_->wait_until_idle();
}

void ResultsStoryTest::segment_both() {
  segment(kLeft, "Left one", "kidn");
  segment(kRight, "Right one", "cyst");
  QCOMPARE(desktop_->state().labels.size(), std::size_t{2});
  QVERIFY(desktop_->state().labels[0].meaning == imaging::find_segment_meaning("kidney").value());
  QVERIFY(desktop_->state().labels[1].meaning == imaging::find_segment_meaning("cyst").value());
  for (const document::RegionStatistics& label : desktop_->state().label_statistics)
    QVERIFY(label.voxels > 500);
}

void ResultsStoryTest::write_by_the_menu(QAction* action, const QString& file) {
  QVERIFY(action->isEnabled());
  action->trigger();
  QPointer<ui::WriteResultDialog> dialog = window_->findChild<ui::WriteResultDialog*>();
  QVERIFY(dialog && dialog->isVisible());
  QVERIFY(!dialog->isModal());
  QVERIFY(is_explained(*dialog));
  auto& line = *dialog->findChild<QLineEdit*>();
  QVERIFY2(!line.text().contains("Paula") && !line.text().contains("1/2"), qPrintable(line.text()));
  line.setText(file);
  picture(*dialog, "write-" + action->objectName());
  QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return dialog.isNull(); }, kPatience));
  QVERIFY(QFile::exists(file));
}

void ResultsStoryTest::import_by_the_menu(const QString& file) {
  const auto before = desktop_->state().labels.size();
  desktop_->window().actions().import_labels->trigger();
  auto* dialog = desktop_->window().findChild<QFileDialog*>();
  QVERIFY(dialog);
  dialog->selectFile(file);
  static_cast<QDialog*>(dialog)->accept();
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().labels.size() > before; }, kPatience));
  desktop_->wait_until_idle();
}

void ResultsStoryTest::labels_go_out_as_dicom_and_come_back() {
  segment_both();
  const auto labels = desktop_->state().labels;
  const auto before = voxels();
  ui::Actions& actions = desktop_->window().actions();
  write_by_the_menu(actions.export_segmentation, path("labels.dcm"));
  write_by_the_menu(actions.export_structure_set, path("contours.dcm"));
  write_by_the_menu(actions.export_level_set, path("surface.vdb"));

  const auto segments = imaging::read_segmentation((folder_ / "labels.dcm"), &grid());
  QCOMPARE(failure(segments), QString());
  QVERIFY(imaging::label_map_of(*segments)->voxels == before);
  for (std::size_t n = 0; n < labels.size(); ++n) {
    QCOMPARE(segments->list[n].name, labels[n].name);
    QVERIFY(segments->list[n].meaning == labels[n].meaning);
  }

  import_by_the_menu(path("labels.dcm"));
  QCOMPARE(desktop_->state().labels.size(), std::size_t{4});
  QCOMPARE(desktop_->state().labels[2].name, std::string("Left one"));
  QVERIFY(desktop_->state().labels[3].meaning == labels[1].meaning);
  const auto after = voxels();
  for (std::size_t v = 0; v < before.size(); ++v) QCOMPARE(int(after[v]), before[v] ? before[v] + 2 : 0);
  desktop_->screenshot("results-imported");

  QCOMPARE(actions.undo->text(), QStringLiteral("&Undo: import of Left one, Right one"));
  actions.undo->trigger();
  desktop_->wait_until_idle();
  QVERIFY(desktop_->state().labels == labels);
  QVERIFY(voxels() == before);

  import_by_the_menu(path("contours.dcm"));
  QCOMPARE(desktop_->state().labels.size(), std::size_t{4});
  for (std::uint8_t id = 1; id <= 2; ++id) {
    const double same =
        dice(mask_of(before, id, grid()), mask_of(voxels(), static_cast<std::uint8_t>(id + 2), grid()));
    QVERIFY2(same >= 0.98, qPrintable(QString::number(same)));
  }
}

void ResultsStoryTest::drop(const QString& file) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(file)});
  QDragEnterEvent enter({200, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
  QDropEvent drop({200, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
  desktop_->in_an_event([&] {
    QCoreApplication::sendEvent(&desktop_->window(), &enter);
    QCoreApplication::sendEvent(&desktop_->window(), &drop);
  });
}

void ResultsStoryTest::a_dropped_segmentation_becomes_labels_and_a_dropped_volume_a_study() {
  imaging::Segments one;
  one.geometry = grid();
  imaging::Segment segment;
  segment.name = "Spleen";
  segment.colour = imaging::SegmentColour{10, 200, 40};
  segment.slices[3].resize(static_cast<std::size_t>(grid().size.x * grid().size.y));
  segment.slices[3][777] = 1;
  one.list.push_back(segment);
  QCOMPARE(failure(imaging::write_segmentation(one, {}, folder_ / "dropped.dcm")), QString());
  drop(path("dropped.dcm"));
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().labels.size() == 1; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().labels[0].name, std::string("Spleen"));
  QVERIFY(desktop_->state().labels[0].coded() == imaging::find_segment_meaning("spleen").value());
  QCOMPARE(desktop_->state().label_statistics[0].voxels, std::int64_t{1});
  QCOMPARE(desktop_->window().cases().size(), 1);

  QCOMPARE(failure(imaging::write_volume_file(desktop_->proxy().volume(), folder_ / "study.nrrd")),
           QString());
  drop(path("study.nrrd"));
  QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().size() == 2; }, kPatience));
  desktop_->wait_until_idle();
}

imaging::Segments ResultsStoryTest::block(const char* name) {
  imaging::Segments segments;
  segments.geometry = grid();
  imaging::Segment segment;
  segment.name = name;
  segment.colour = imaging::SegmentColour{10, 200, 40};
  for (const std::int64_t k : {3, 4}) {
    auto& slice = segment.slices[k];
    slice.resize(static_cast<std::size_t>(grid().size.x * grid().size.y));
    for (std::int64_t j = 10; j < 20; ++j) {
      std::fill_n(slice.begin() + j * grid().size.x + 10, 10, std::uint8_t{1});
    }
  }
  segments.list.push_back(segment);
  return segments;
}

void ResultsStoryTest::what_lies_beside_a_study_is_named_and_imported_by_a_click() {
  const fs::path root = folder_ / "patients";
  fs::create_directories(root / "one" / "results");
  fs::create_directories(root / "other" / "results");
  write_study(root / "one" / "images");
  const auto& source = desktop_->proxy().study().dicom_files;
  for (const char* whose : {"one", "other"}) {
    const fs::path file = root / whose / "results" / "labels.dcm";
    QCOMPARE(failure(imaging::write_segmentation(block("Spleen"), source, file)), QString());
  }
  const fs::path contours = root / "one" / "images" / "contours.dcm";
  QCOMPARE(failure(imaging::write_structure_set(block("Liver"), source, contours)), QString());
  std::ofstream(root / "one" / "notes.txt") << "no image";

  window_ = desktop_->open(path("patients"));
  QVERIFY(window_);
  QCOMPARE(desktop_->window().cases().size(), 2);
  QVERIFY(Desktop::wait_for([&] { return desktop_->window().findChild<ui::LoadReport*>() != nullptr; }));
  auto& report = *desktop_->window().findChild<ui::LoadReport*>();
  QVERIFY(says(report, "Beside it: 2 segmentations or structure sets"));
  QTest::mouseClick(button(report, "Details"), Qt::LeftButton);
  QVERIFY(says(report, "contours.dcm is a structure set"));
  QVERIFY(says(report, "labels.dcm is a DICOM segmentation"));
  QVERIFY(!says(report, "notes.txt"));
  desktop_->wait_until_idle();
  picture(desktop_->window(), "results-beside-a-study");

  QPushButton* accept = button(report, "Import labels");
  QTest::mouseClick(accept, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().labels.size() == 2; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().labels[0].name, std::string("Liver"));
  QCOMPARE(desktop_->state().labels[1].name, std::string("Spleen"));
  QCOMPARE(desktop_->state().label_statistics[1].voxels, std::int64_t{200});
  QVERIFY(!accept->isVisible());  // a second time would double them
  desktop_->screenshot("results-beside-imported");
}

void ResultsStoryTest::labels_go_out_as_polygons() {
  QAction* action = desktop_->window().actions().export_label_meshes;
  QVERIFY(!action->isEnabled());
  segment_both();
  document::Label right = desktop_->state().labels[1];
  right.visible = false;
  desktop_->proxy().set_label(right);
  desktop_->wait_until_idle();
  const auto write = [&](const QString& what) {
    action->trigger();
    QPointer<ui::WriteResultDialog> dialog = window_->findChild<ui::WriteResultDialog*>();
    QVERIFY(dialog && dialog->isVisible());
    QVERIFY(is_explained(*dialog));
    QVERIFY2(dialog->findChild<QLineEdit*>()->text().endsWith(".stl"),
             qPrintable(dialog->findChild<QLineEdit*>()->text()));
    for (QRadioButton* choice : dialog->findChildren<QRadioButton*>()) {
      if (QString(choice->text()).remove('&').startsWith(what))
        QTest::mouseClick(choice, Qt::LeftButton, {}, {10, choice->height() / 2});
    }
    dialog->findChild<QLineEdit*>()->setText(path("organs"));  // the usual ending is added
    picture(*dialog, "write-" + action->objectName());
    QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return dialog.isNull(); }, kPatience));
  };
  const fs::path left_file = folder_ / "organs-Left one.stl";
  const fs::path right_file = folder_ / "organs-Right one.stl";
  write("Visible labels");
  QVERIFY(fs::exists(left_file));
  QVERIFY(!fs::exists(right_file));
  const auto first = fs::last_write_time(left_file);
  Desktop::answer(QMessageBox::Yes);  // the left one is there already
  write("All labels");
  QVERIFY(fs::exists(right_file));
  QVERIFY(fs::last_write_time(left_file) > first);
  QVERIFY(fs::file_size(left_file) > fs::file_size(right_file));  // the larger ball
  QVERIFY(fs::file_size(right_file) > 10'000);
}

void ResultsStoryTest::the_surface_alone_is_a_result_too() {
  ui::Actions& actions = desktop_->window().actions();
  for (QAction* action : {actions.export_segmentation, actions.export_structure_set, actions.export_level_set,
                          actions.send_result})
    QVERIFY(!action->isEnabled());
  begin(kLeft);
  write_by_the_menu(actions.export_segmentation, path("surface.dcm"));
  const auto segments = imaging::read_segmentation(folder_ / "surface.dcm", &grid());
  QCOMPARE(failure(segments), QString());
  QCOMPARE(segments->list.size(), std::size_t{1});
  QCOMPARE(segments->list.front().count(), desktop_->state().surface.voxels_inside);
}

void ResultsStoryTest::a_study_that_is_no_dicom_says_what_that_means() {
  window_ = desktop_->open_phantom("sphere");
  QVERIFY(window_);
  desktop_->begin(8.0);
  desktop_->window().actions().export_segmentation->trigger();
  auto* dialog = window_->findChild<ui::WriteResultDialog*>();
  QVERIFY(dialog);
  QVERIFY(says(*dialog, "anonymous patient"));
  QVERIFY(dialog->findChild<QLineEdit*>()->text().endsWith("Sphere segmentation.dcm"));
  picture(*dialog, "write-of-no-dicom");
}

void ResultsStoryTest::a_file_of_the_study_is_never_written_to() {
  begin(kLeft);
  desktop_->window().actions().export_segmentation->trigger();
  auto* dialog = window_->findChild<ui::WriteResultDialog*>();
  QVERIFY(dialog);
  const fs::path slice = desktop_->proxy().study().dicom_files.front();
  const auto size = fs::file_size(slice);
  dialog->findChild<QLineEdit*>()->setText(QString::fromStdString(slice.string()));
  QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
  QVERIFY(says(*dialog, "never written to"));
  QCOMPARE(fs::file_size(slice), size);
}

ui::SendResultDialog* ResultsStoryTest::send_to(const imaging::PacsServer& server) {
  imaging::PacsConfiguration configuration;
  configuration.servers.push_back(server);
  if (!imaging::write_pacs_configuration(configuration, imaging::pacs_configuration_file()))
    qFatal("cannot name the server");
  desktop_->window().actions().send_result->trigger();
  auto* dialog = window_->findChild<ui::SendResultDialog*>();
  if (!dialog) qFatal("there is no dialog");
  return dialog;
}

void ResultsStoryTest::labels_are_sent_to_a_server() {
  const auto archive = start_dcmqrscp();
  segment_both();
  ui::SendResultDialog& dialog = *send_to(archive->server());
  QVERIFY(is_explained(dialog));
  for (QCheckBox* form : dialog.findChildren<QCheckBox*>()) form->setChecked(true);
  picture(dialog, "send");
  QVERIFY(button(dialog, "Send")->isEnabled());
  QTest::mouseClick(button(dialog, "Send"), Qt::LeftButton);
  QVERIFY2(Desktop::wait_for([&] { return says(dialog, "as two new series of this study"); }, kPatience),
           qPrintable(dialog.findChild<ui::WorkLine*>()->text()));
  picture(dialog, "sent");

  const auto studies = imaging::find_studies(archive->server(), {});
  QCOMPARE(failure(studies), QString());
  QCOMPARE(studies->entries.size(), std::size_t{1});
  QCOMPARE(studies->entries.front().patient_id, std::string("P1"));
  for (const char* modality : {"SEG", "RTSTRUCT"}) {
    const auto series =
        imaging::find_pacs_series(archive->server(), {studies->entries.front().uid, modality, {}});
    QCOMPARE(failure(series), QString());
    QCOMPARE(series->entries.size(), std::size_t{1});
  }
}

void ResultsStoryTest::a_server_that_keeps_silent_is_given_up_by_a_click() {
  const ScriptedPeer peer([](PeerEnd& end) { end.say_nothing(); });
  imaging::PacsServer server = peer.server();
  server.timeout_seconds = 600;
  begin(kLeft);
  ui::SendResultDialog& dialog = *send_to(server);
  QTest::mouseClick(button(dialog, "Send"), Qt::LeftButton);
  QVERIFY(button(dialog, "Cancel")->isVisible());
  QVERIFY(!button(dialog, "Send")->isEnabled());
  QTest::qWait(300);
  QTest::mouseClick(button(dialog, "Cancel"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return button(dialog, "Send")->isEnabled(); }));
  QVERIFY(says(dialog, "Cancelled"));
}

}  // namespace tidemark::test

TIDEMARK_TEST(tidemark::test::ResultsStoryTest)
#include "results_story_test.moc"
