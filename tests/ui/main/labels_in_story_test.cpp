// Segmentations and structure sets of other systems become labels: dropped, or lying beside a study.
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QMimeData>
#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <span>

#include "document/zip_archive.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/main/case_results.h"
#include "ui/main/image_adder.h"
#include "ui/main/message_bar.h"
#include "ui/main/panel_docks.h"
#include "ui/main/truth_reader.h"
#include "ui/opening/load_report.h"
#include "ui/panels/display_panel.h"

namespace tidemark::test::labels_in_story_test {

namespace {

namespace fs = std::filesystem;

// All files below a folder.
void write_archive(const fs::path& folder, const fs::path& file) {
  std::vector<std::pair<std::string, std::string>> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    contents.emplace_back(entry.path().lexically_relative(folder).string(),
                          std::string(std::istreambuf_iterator<char>(stream), {}));
  }
  std::vector<document::ZipEntry> entries;
  for (const auto& [name, bytes] : contents) entries.push_back({name, std::as_bytes(std::span(bytes))});
  if (const Status written = document::write_zip(file, entries); !written)
    qFatal("%s", written.error().message.c_str());
}

}  // namespace

class LabelsInStoryTest : public QObject, private ResultsDesktop {
  Q_OBJECT

 private slots:
  void init() { open(); }
  void cleanup() { close(); }
  void a_dropped_segmentation_becomes_labels_and_a_dropped_volume_a_study();
  void what_is_dropped_on_a_case_becomes_labels_of_that_one();
  void labels_of_another_case_leave_the_panels_alone();
  void what_goes_wrong_in_another_case_bears_its_mark();
  void what_lies_beside_a_study_is_named_and_imported_by_a_click();
  void a_result_in_another_folder_is_offered_when_it_is_of_the_study();
  void results_in_the_archive_of_a_study_are_offered();

 private:
  [[nodiscard]] imaging::Segments block(const char* name);  // in two slices of the study
  void drop(const QString& file, QPoint at = {200, 300});   // in the main window
  // Of the same size, side by side with the study: the active case from now on.
  ui::CaseWindow& open_another();
  ui::LoadReport& report_on(const char* name, int cases);
};

void LabelsInStoryTest::drop(const QString& file, QPoint at) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(file)});
  QDragEnterEvent enter(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  QDropEvent drop(at, Qt::CopyAction, &data, Qt::LeftButton, {});
  desktop_->in_an_event([&] {
    QCoreApplication::sendEvent(&desktop_->window(), &enter);
    QCoreApplication::sendEvent(&desktop_->window(), &drop);
  });
}

void LabelsInStoryTest::a_dropped_segmentation_becomes_labels_and_a_dropped_volume_a_study() {
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

imaging::Segments LabelsInStoryTest::block(const char* name) {
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

ui::CaseWindow& LabelsInStoryTest::open_another() {
  write_balls(folder_ / "another");
  ui::CaseWindow* another = desktop_->open(path("another"));
  if (!another) qFatal("the other study was not opened");
  desktop_->window().resize(1300, 700);  // room for both
  desktop_->window().actions().tile->trigger();
  desktop_->wait_until_idle();
  return *another;
}

void LabelsInStoryTest::what_is_dropped_on_a_case_becomes_labels_of_that_one() {
  ui::MainWindow& main = desktop_->window();
  ui::CaseWindow& another = open_another();
  QCOMPARE(main.active_case(), &another);
  QCOMPARE(failure(imaging::write_segmentation(block("Spleen"), {}, folder_ / "dropped.dcm")), QString());
  const QWidget* view = window_->views().first();
  const QPoint inside = view->mapTo(&main, view->rect().center());
  QVERIFY(window_->isAncestorOf(main.childAt(inside)));
  drop(path("dropped.dcm"), inside);
  QVERIFY(Desktop::wait_for([&] { return window_->proxy().state().labels.size() == 1; }, kPatience));
  QCOMPARE(main.active_case(), window_);
  QVERIFY(another.proxy().state().labels.empty());

  // The title is a part of the case.
  const QWidget* child = another.parentWidget();
  drop(path("dropped.dcm"), child->mapTo(&main, QPoint(child->width() / 2, 8)));
  QVERIFY(Desktop::wait_for([&] { return another.proxy().state().labels.size() == 1; }, kPatience));
  QCOMPARE(main.active_case(), &another);

  // Beside all cases it is the active one.
  drop(path("dropped.dcm"), {2, 2});
  QVERIFY(Desktop::wait_for([&] { return another.proxy().state().labels.size() == 2; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(window_->proxy().state().labels.size(), std::size_t{1});
}

void LabelsInStoryTest::labels_of_another_case_leave_the_panels_alone() {
  ui::MainWindow& main = desktop_->window();
  ui::CaseWindow& another = open_another();
  main.panels().show("display");
  desktop_->wait_until_idle();
  const auto* display = main.findChild<ui::DisplayPanel*>();
  QVERIFY(display->isVisible());
  QCOMPARE(failure(imaging::write_segmentation(block("Spleen"), {}, folder_ / "labels.dcm")), QString());
  main.results().import_labels(*window_, path("labels.dcm"));
  QVERIFY(Desktop::wait_for([&] { return window_->proxy().state().labels.size() == 1; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(main.active_case(), &another);
  QVERIFY(display->isVisible());
  main.results().import_labels(another, path("labels.dcm"));
  QVERIFY(Desktop::wait_for([&] { return !display->isVisible(); }, kPatience));
  desktop_->wait_until_idle();
}

void LabelsInStoryTest::what_goes_wrong_in_another_case_bears_its_mark() {
  ui::MainWindow& main = desktop_->window();
  QCOMPARE(window_->number(), 1);
  const ui::CaseWindow& another = open_another();
  std::ofstream(folder_ / "notes.txt") << "no image";
  auto& bar = *main.findChild<ui::MessageBar*>();
  const auto fails = [&](const std::function<void(const QString& file)>& read) {
    bar.dismiss();
    read(path("notes.txt"));
    QVERIFY(Desktop::wait_for([&] { return !bar.text().isEmpty(); }, kPatience));
    QVERIFY2(find_seen<QLabel>(bar, "Case 1"), qPrintable(bar.text()));
  };
  fails([&](const QString& file) { main.results().import_labels(*window_, file); });
  fails([&](const QString& file) { main.images().add_file(*window_, file); });
  fails([&](const QString& file) { main.findChild<ui::TruthReader*>()->read(*window_, file); });
  QCOMPARE(main.active_case(), &another);
}

void LabelsInStoryTest::what_lies_beside_a_study_is_named_and_imported_by_a_click() {
  const fs::path root = folder_ / "patients";
  fs::create_directories(root / "one" / "results");
  fs::create_directories(root / "other" / "results");
  write_balls(root / "one" / "images");
  std::vector<fs::path> source;
  for (const auto& entry : fs::directory_iterator(root / "one" / "images")) source.push_back(entry.path());
  std::ranges::sort(source);
  const auto& other_study = desktop_->proxy().study().dicom_files;
  QCOMPARE(
      failure(imaging::write_segmentation(block("Spleen"), source, root / "one" / "results" / "labels.dcm")),
      QString());
  QCOMPARE(failure(imaging::write_segmentation(block("Spleen"), other_study,
                                               root / "other" / "results" / "labels.dcm")),
           QString());
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

// Opens what lies under that name, and waits for what is told of it.
ui::LoadReport& LabelsInStoryTest::report_on(const char* name, int cases) {
  window_ = desktop_->open(path(name));
  if (window_ == nullptr || desktop_->window().cases().size() != cases) qFatal("%s was not opened", name);
  const auto report = [&] { return desktop_->window().findChild<ui::LoadReport*>(); };
  if (!Desktop::wait_for([&] { return report() != nullptr; })) qFatal("nothing is told of %s", name);
  desktop_->wait_until_idle();
  return *report();
}

// The standard of folders on media: a folder a series, all of them by number.
void LabelsInStoryTest::a_result_in_another_folder_is_offered_when_it_is_of_the_study() {
  const fs::path root = folder_ / "medium";
  write_balls(root / "1" / "1" / "images");
  std::vector<fs::path> images;
  for (const auto& entry : fs::directory_iterator(root / "1" / "1" / "images"))
    images.push_back(entry.path());
  std::sort(images.begin(), images.end());
  fs::create_directories(root / "2" / "7");
  fs::create_directories(root / "3" / "9");
  QCOMPARE(failure(imaging::write_segmentation(block("Spleen"), images, root / "2" / "7" / "a.dcm")),
           QString());
  QCOMPARE(failure(imaging::write_structure_set(block("Liver"), images, root / "2" / "7" / "b.dcm")),
           QString());
  const auto& other_study = desktop_->proxy().study().dicom_files;
  QVERIFY(imaging::study_uid_of(other_study.front()) != imaging::study_uid_of(images.front()));
  QCOMPARE(failure(imaging::write_segmentation(block("Heart"), other_study, root / "3" / "9" / "c.dcm")),
           QString());

  ui::LoadReport& report = report_on("medium", 2);
  QVERIFY(says(report, "Beside it: 2 segmentations or structure sets"));
  QTest::mouseClick(button(report, "Import labels"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().labels.size() == 2; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().labels[0].name, std::string("Spleen"));
  QCOMPARE(desktop_->state().labels[1].name, std::string("Liver"));
}

void LabelsInStoryTest::results_in_the_archive_of_a_study_are_offered() {
  const fs::path root = folder_ / "packed";
  write_balls(root / "images");
  const auto& source = desktop_->proxy().study().dicom_files;
  fs::create_directories(root / "results");
  QCOMPARE(failure(imaging::write_segmentation(block("Spleen"), source, root / "results" / "labels.dcm")),
           QString());
  QCOMPARE(failure(imaging::write_structure_set(block("Liver"), source, root / "results" / "contours.dcm")),
           QString());
  write_archive(root, folder_ / "packed.zip");

  ui::LoadReport& report = report_on("packed.zip", 2);
  QVERIFY(says(report, "Beside it: 2 segmentations or structure sets"));
  QTest::mouseClick(button(report, "Details"), Qt::LeftButton);
  QVERIFY(says(report, "contours.dcm is a structure set"));
  QVERIFY(says(report, "labels.dcm is a DICOM segmentation"));
  QTest::mouseClick(button(report, "Import labels"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().labels.size() == 2; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().label_statistics[1].voxels, std::int64_t{200});  // both are of the same voxels
}

TIDEMARK_TEST(LabelsInStoryTest)

}  // namespace tidemark::test::labels_in_story_test

#include "labels_in_story_test.moc"
