// What was segmented goes to other systems, as files and to a server.
#include <QAction>
#include <QFileDialog>
#include <QLineEdit>
#include <QPushButton>
#include <QToolButton>
#include <fstream>

#include "imaging/pacs/services.h"
#include "imaging/results/results.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/main/message_bar.h"
#include "ui/panels/labels_model.h"
#include "ui/panels/meaning_picker.h"
#include "ui/results/send_result_dialog.h"
#include "ui/results/write_result_dialog.h"

namespace tidemark::test::results_story_test {
namespace {

namespace fs = std::filesystem;

Mask mask_of(const std::vector<std::uint8_t>& voxels, std::uint8_t id, const Geometry& geometry) {
  Mask mask{geometry, voxels};
  for (std::uint8_t& voxel : mask.voxels) voxel = voxel == id ? 1 : 0;
  return mask;
}

}  // namespace

class ResultsStoryTest : public QObject, private ResultsDesktop {
  Q_OBJECT

 private slots:
  void init() { open(); }
  void cleanup() { close(); }
  void labels_go_out_as_dicom_and_come_back();
  void labels_of_another_frame_of_reference_are_told();
  void labels_go_out_as_polygons();
  void the_surface_alone_is_a_result_too();
  void a_study_that_is_no_dicom_says_what_that_means();
  void a_file_of_the_study_is_never_written_to();
  void what_a_dialog_asks_goes_with_its_case();
  void labels_are_sent_to_a_server();
  void a_server_that_keeps_silent_is_given_up_by_a_click();

 private:
  [[nodiscard]] std::vector<std::uint8_t> voxels() { return desktop_->state().label_voxels->voxels(); }
  void begin(glm::dvec3 middle);
  void segment(glm::dvec3 middle, const char* name, const char* meaning);
  void segment_both();
  void write_by_the_menu(QAction* action, const QString& file);
  void import_by_the_menu(const QString& file);
  ui::SendResultDialog* send_to(const imaging::PacsServer& server);
};

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
  name_file(*dialog, file);
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

void ResultsStoryTest::labels_of_another_frame_of_reference_are_told() {
  Mask mask{grid(), std::vector<std::uint8_t>(static_cast<std::size_t>(grid().voxel_count()))};
  mask.voxels[5000] = mask.voxels[5001] = 1;
  const imaging::Segments segments = imaging::segments_of(mask, "Two voxels");
  const auto& files = desktop_->proxy().study().dicom_files;
  QCOMPARE(failure(imaging::write_segmentation(segments, files, folder_ / "same.dcm")), QString());
  QCOMPARE(failure(imaging::write_segmentation(segments, {}, folder_ / "other.dcm")), QString());
  const auto& messages = *desktop_->window().findChild<ui::MessageBar*>();
  import_by_the_menu(path("same.dcm"));
  QVERIFY2(!messages.text().contains("frame of reference"), qPrintable(messages.text()));
  import_by_the_menu(path("other.dcm"));
  QVERIFY2(messages.text().contains("other.dcm: it names another frame of reference than the study"),
           qPrintable(messages.text()));
}

void ResultsStoryTest::labels_go_out_as_polygons() {
  QAction* action = desktop_->window().actions().export_label_meshes;
  QVERIFY(!action->isEnabled());
  segment_both();
  document::Label right = desktop_->state().labels[1];
  right.visible = false;
  desktop_->proxy().set_label(right);
  desktop_->wait_until_idle();
  const fs::path left_file = folder_ / "organs-Left one.stl";
  const fs::path right_file = folder_ / "organs-Right one.stl";
  const auto write = [&](const QString& what, const QList<QMessageBox::StandardButton>& replies) {
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
    for (const QMessageBox::StandardButton reply : replies) {
      const auto asked = Desktop::answer(reply);
      QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
      QVERIFY(Desktop::wait_for([&] { return *asked; }));
      if (reply == QMessageBox::Yes) continue;
      desktop_->wait_until_idle();
      QVERIFY(dialog && dialog->isVisible());
      QVERIFY(bytes_of(left_file) == "kept");
      QVERIFY(!fs::exists(right_file));
    }
    if (replies.isEmpty()) QTest::mouseClick(button(*dialog, "Write"), Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return dialog.isNull(); }, kPatience));
  };
  write("Visible labels", {});
  QVERIFY(fs::exists(left_file));
  QVERIFY(!fs::exists(right_file));
  { std::ofstream(left_file) << "kept"; }
  write("All labels", {QMessageBox::No, QMessageBox::Yes});  // the left one is there already
  QVERIFY(fs::exists(right_file));
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

// The case closes while a question, or the list of servers, is open.
void ResultsStoryTest::what_a_dialog_asks_goes_with_its_case() {
  { std::ofstream(folder_ / "there.dcm") << "kept"; }
  ui::Actions& actions = desktop_->window().actions();
  for (QAction* action : {actions.export_segmentation, actions.send_result}) {
    begin(kLeft);
    action->trigger();
    const QPointer<ui::ResultDialog> dialog = window_->findChild<ui::ResultDialog*>();
    QVERIFY(dialog);
    const bool writes = action == actions.export_segmentation;
    if (writes) dialog->findChild<QLineEdit*>()->setText(path("there.dcm"));
    bool closes = false;
    QTimer timer;
    connect(&timer, &QTimer::timeout, this, [&] {
      if (QApplication::activeModalWidget() && !std::exchange(closes, true)) window_->close_saved();
    });
    timer.start(20);
    QTest::mouseClick(button(*dialog, writes ? "Write" : "Servers…"), Qt::LeftButton);
    QVERIFY(Desktop::wait_for([&] { return dialog.isNull(); }, kPatience));
    QVERIFY(closes);
    QVERIFY(!QApplication::activeModalWidget());
    window_ = desktop_->open(path("study"));
    QVERIFY(window_);
  }
  QCOMPARE(bytes_of(folder_ / "there.dcm"), QByteArray("kept"));
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
  QVERIFY2(Desktop::wait_for([&] { return says(dialog, "as 5 new series of this study"); }, kPatience),
           qPrintable(dialog.findChild<ui::WorkLine*>()->text()));
  picture(dialog, "sent");

  const auto studies = imaging::find_studies(archive->server(), {});
  QCOMPARE(failure(studies), QString());
  QCOMPARE(studies->entries.size(), std::size_t{1});
  QCOMPARE(studies->entries.front().patient_id, std::string("P1"));
  for (const char* modality : {"SEG", "RTSTRUCT", "SR", "KO", "PR"}) {
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

TIDEMARK_TEST(ResultsStoryTest)

}  // namespace tidemark::test::results_story_test

#include "results_story_test.moc"
