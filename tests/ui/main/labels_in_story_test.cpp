// Segmentations and structure sets of other systems become labels: dropped, or lying beside a study.
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QMimeData>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <span>

#include "document/zip_archive.h"
#include "imaging/files/volume_file.h"
#include "imaging/results/results.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/opening/load_report.h"

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
  void what_lies_beside_a_study_is_named_and_imported_by_a_click();
  void a_result_in_another_folder_is_offered_when_it_is_of_the_study();
  void results_in_the_archive_of_a_study_are_offered();

 private:
  [[nodiscard]] imaging::Segments block(const char* name);  // in two slices of the study
  void drop(const QString& file);
  ui::LoadReport& report_on(const char* name, int cases);
};

void LabelsInStoryTest::drop(const QString& file) {
  QMimeData data;
  data.setUrls({QUrl::fromLocalFile(file)});
  QDragEnterEvent enter({200, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
  QDropEvent drop({200, 300}, Qt::CopyAction, &data, Qt::LeftButton, {});
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
