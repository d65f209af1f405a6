// Several readers' segmentations are compared each with each, and the estimate of the truth is kept.
#include <QCheckBox>
#include <QComboBox>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <array>
#include <fstream>

#include "core/csv.h"
#include "core/text_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/regions/staple.h"
#include "imaging/results/results.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/readers/reader_list.h"
#include "ui/readers/reader_table.h"
#include "ui/readers/readers_dialog.h"
#include "ui/widgets/work_line.h"

namespace tidemark::test::readers_story_test {
namespace {

constexpr double kRadius = 8.0;               // mm, of each ball
constexpr std::array kShifts{0.0, 2.0, 6.0};  // mm along x, of Anna's, Ben's and Cleo's
constexpr std::array kNames{"anna.nii.gz", "ben.nrrd", "cleo.mha"};

enum PairColumn { kFirst, kSecond, kDice, kJaccard, kFirstMl, kSecondMl, kMean, kMost, kLargest };

Region ball(const Geometry& grid, double shift_mm) {
  Mask mask{grid, std::vector<std::uint8_t>(static_cast<std::size_t>(grid.voxel_count()))};
  std::size_t voxel = 0;
  for (std::int64_t k = 0; k < grid.size.z; ++k) {
    for (std::int64_t j = 0; j < grid.size.y; ++j) {
      for (std::int64_t i = 0; i < grid.size.x; ++i) {
        const glm::dvec3 middle = kRight + glm::dvec3(shift_mm, 0.0, 0.0);
        mask.voxels[voxel++] = glm::distance(grid.to_patient({i, j, k}), middle) <= kRadius ? 1 : 0;
      }
    }
  }
  return Region(mask);
}

// Of two balls of one radius: their lens by one of them.
double dice_of_balls(double shift_mm) {
  const double lens = (4.0 * kRadius + shift_mm) * (2.0 * kRadius - shift_mm) * (2.0 * kRadius - shift_mm);
  return lens / (16.0 * kRadius * kRadius * kRadius);
}

imaging::Segment segment(const Geometry& grid, const char* name, double shift_mm) {
  const Mask mask = mask_of(ball(grid, shift_mm), grid);
  imaging::Segment one;
  one.name = name;
  one.slices = imaging::slices_of(grid, mask.voxels);
  return one;
}

}  // namespace

class ReadersStoryTest : public QObject, ResultsDesktop {
  Q_OBJECT

 private slots:
  void init();
  void cleanup();
  void three_readers_are_compared_each_with_each();
  void the_estimate_is_kept_in_its_own_case_and_undone();
  void labels_of_the_case_are_readers_too();
  void regions_of_one_name_are_compared();
  void what_is_no_segmentation_is_named_and_the_others_stay();
  void the_table_goes_out_with_points_where_the_language_has_commas();
  void a_comparison_is_given_up();
  void a_comparison_right_after_an_edit_is_of_the_surface_after_it();
  void the_dialog_closes_with_its_case();

 private:
  void import_ball();  // as a label of the case
  ui::ReadersDialog* open_dialog();
  void add(ui::ReadersDialog& dialog, const QStringList& files);
  void add_three(ui::ReadersDialog& dialog);
  void compare(ui::ReadersDialog& dialog);
  void tick(ui::ReadersDialog& dialog, const QString& name);
  [[nodiscard]] QString said(ui::ReadersDialog& dialog) { return dialog.findChild<ui::WorkLine*>()->text(); }
  ui::ReaderTable& pairs(ui::ReadersDialog& dialog) {
    return *seen<ui::ReaderTable>(dialog, "Comparison of each with each");
  }
  ui::ReaderTable& estimates(ui::ReadersDialog& dialog) {
    return *seen<ui::ReaderTable>(dialog, "Readers and the estimate");
  }
};

void ReadersStoryTest::init() {
  open();
  for (std::size_t n = 0; n < kNames.size(); ++n) {
    const Mask mask = mask_of(ball(grid(), kShifts[n]), grid());
    QCOMPARE(failure(imaging::write_mask_file(mask, folder_ / kNames[n])), QString());
  }
}

void ReadersStoryTest::cleanup() {
  QLocale::setDefault(QLocale::c());
  close();
}

ui::ReadersDialog* ReadersStoryTest::open_dialog() {
  desktop_->choose("File", desktop_->menu_entry("File", "Compare readers"));
  auto* dialog = window_->findChild<ui::ReadersDialog*>();
  if (dialog == nullptr || !QTest::qWaitForWindowExposed(dialog)) qFatal("there is no dialog");
  return dialog;
}

void ReadersStoryTest::add(ui::ReadersDialog& dialog, const QStringList& files) {
  QTest::mouseClick(button(dialog, "Add files…"), Qt::LeftButton);
  auto* choice = dialog.findChild<QFileDialog*>();
  QVERIFY(choice);
  QStringList quoted;
  for (const QString& file : files) quoted << u'"' + file + u'"';
  choice->findChild<QLineEdit*>("fileNameEdit")->setText(quoted.join(u' '));
  static_cast<QDialog*>(choice)->accept();
  QVERIFY(Desktop::wait_for([&] { return button(dialog, "Add files…")->isEnabled(); }, kPatience));
}

void ReadersStoryTest::add_three(ui::ReadersDialog& dialog) {
  add(dialog, {path(kNames[0]), path(kNames[1]), path(kNames[2])});
  QCOMPARE(dialog.findChild<ui::ReaderList*>()->chosen().size(), kNames.size());
}

void ReadersStoryTest::compare(ui::ReadersDialog& dialog) {
  QPushButton* go = button(dialog, "Compare");
  QVERIFY(go->isEnabled());
  QTest::mouseClick(go, Qt::LeftButton);
  QVERIFY(!go->isEnabled());
  QVERIFY(Desktop::wait_for([&] { return go->isEnabled(); }, kPatience));
}

// By a click into the box.
void ReadersStoryTest::tick(ui::ReadersDialog& dialog, const QString& name) {
  auto& list = *dialog.findChild<ui::ReaderList*>();
  const auto items = list.findItems(name, Qt::MatchExactly);
  QCOMPARE(items.size(), 1);
  const Qt::CheckState before = items.front()->checkState();
  const QRect row = list.visualItemRect(items.front());
  QTest::mouseClick(list.viewport(), Qt::LeftButton, {}, {row.left() + 10, row.center().y()});
  QVERIFY(items.front()->checkState() != before);
}

void ReadersStoryTest::three_readers_are_compared_each_with_each() {
  ui::ReadersDialog& dialog = *open_dialog();
  QVERIFY(is_explained(dialog));
  QVERIFY2(dialog.windowTitle().contains("Paula"), qPrintable(dialog.windowTitle()));
  QVERIFY(!button(dialog, "Compare")->isEnabled());
  QCOMPARE(said(dialog), QString("Tick two segmentations or more."));
  add_three(dialog);
  compare(dialog);

  // The pair that agrees least stands first.
  ui::ReaderTable& table = pairs(dialog);
  QCOMPARE(table.rowCount(), 3);
  const std::array<std::array<std::size_t, 2>, 3> expected{{{0, 2}, {1, 2}, {0, 1}}};
  const double voxel_ml = grid().voxel_volume_ml();
  for (int row = 0; row < 3; ++row) {
    const auto number = [&](PairColumn column) { return table.item(row, column)->text().toDouble(); };
    const auto [a, b] = expected[static_cast<std::size_t>(row)];
    QCOMPARE(table.item(row, kFirst)->text(), QString(kNames[a]));
    QCOMPARE(table.item(row, kSecond)->text(), QString(kNames[b]));
    const double shift = kShifts[b] - kShifts[a];
    const double exact = dice(ball(grid(), kShifts[a]), ball(grid(), kShifts[b]));
    QVERIFY(std::abs(number(kDice) - exact) < 6e-4);
    QVERIFY2(std::abs(exact - dice_of_balls(shift)) < 0.02, qPrintable(QString::number(exact)));
    QVERIFY(std::abs(number(kJaccard) - exact / (2.0 - exact)) < 6e-4);
    QCOMPARE(number(kLargest), shift);
    QVERIFY(number(kMean) > 0.0 && number(kMean) < number(kMost) && number(kMost) <= shift);
    const double ml = static_cast<double>(ball(grid(), 0.0).count()) * voxel_ml;
    QVERIFY(std::abs(number(kFirstMl) - ml) < 6e-3 && std::abs(number(kSecondMl) - ml) < 6e-3);
  }
  QVERIFY2(said(dialog).startsWith("Least alike: anna.nii.gz and cleo.mha"), qPrintable(said(dialog)));

  // A click on the heading sorts by numbers, not by their texts.
  QHeaderView* header = table.horizontalHeader();
  const QPoint largest(header->sectionViewportPosition(kLargest) + 10, header->height() / 2);
  QTest::mouseClick(header->viewport(), Qt::LeftButton, {}, largest);
  QCOMPARE(table.item(0, kLargest)->text(), QString("2.00"));
  QTest::mouseClick(header->viewport(), Qt::LeftButton, {}, largest);
  QCOMPARE(table.item(0, kLargest)->text(), QString("6.00"));

  // Ben, between both, is nearest to the estimate.
  ui::ReaderTable& of_estimate = estimates(dialog);
  QCOMPARE(of_estimate.rowCount(), 3);
  const auto dice_of = [&](int row) { return of_estimate.item(row, 3)->text().toDouble(); };
  QCOMPARE(of_estimate.item(1, 0)->text(), QString(kNames[1]));
  QVERIFY(dice_of(1) > dice_of(0) && dice_of(1) > dice_of(2));
  for (int row = 0; row < 3; ++row) {
    for (const int column : {1, 2}) {
      const double share = of_estimate.item(row, column)->text().toDouble();
      QVERIFY(share > 0.5 && share <= 1.0);
    }
  }
  QVERIFY(is_explained(dialog));
  picture(dialog, "readers");

  // What is shown belongs to what is ticked.
  tick(dialog, kNames[2]);
  QCOMPARE(table.rowCount(), 0);
  QVERIFY(!button(dialog, "Keep as label")->isEnabled());
  compare(dialog);
  QCOMPARE(table.rowCount(), 1);
}

void ReadersStoryTest::the_estimate_is_kept_in_its_own_case_and_undone() {
  engine::CaseProxy& proxy = window_->proxy();
  ui::ReadersDialog& dialog = *open_dialog();
  add_three(dialog);
  compare(dialog);
  std::vector<Region> regions;
  for (const double shift : kShifts) regions.push_back(ball(grid(), shift));
  const auto expected = imaging::estimate_truth(regions, grid());
  QVERIFY(expected.has_value());

  // Another case is the active one by now.
  QVERIFY(desktop_->open_phantom("sphere"));
  engine::CaseProxy& other = desktop_->proxy();
  QVERIFY(&other != &proxy);
  QTest::mouseClick(button(dialog, "Keep as label"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return !proxy.state().labels.empty(); }, kPatience));
  desktop_->wait_until_idle();
  QVERIFY(other.state().labels.empty());
  QCOMPARE(proxy.state().labels.size(), std::size_t{1});
  QCOMPARE(proxy.state().labels[0].name, std::string("Estimate of 3 readers"));
  const document::LabelVoxels labels{proxy.volume().geometry, proxy.state().labels,
                                     proxy.state().label_voxels, proxy.state().phi};
  QVERIFY(labels.region(proxy.state().labels[0].id) == expected->region);
  QVERIFY2(said(dialog).startsWith("Estimate of 3 readers took "), qPrintable(said(dialog)));
  QCOMPARE(pairs(dialog).rowCount(), 3);  // another label changes nothing of what was found
  QVERIFY(dialog.findChild<ui::ReaderList*>()->findItems("Estimate of 3 readers", Qt::MatchExactly).size() ==
          1);

  proxy.undo();
  QVERIFY(Desktop::wait_for([&] { return proxy.state().labels.empty(); }, kPatience));
  QCOMPARE(pairs(dialog).rowCount(), 3);
}

void ReadersStoryTest::import_ball() {
  auto segments = std::make_shared<imaging::Segments>();
  segments->geometry = grid();
  segments->list.push_back(segment(grid(), "Ball", 4.0));
  desktop_->proxy().import_labels(segments);
  desktop_->wait_until_idle();
}

void ReadersStoryTest::labels_of_the_case_are_readers_too() {
  document::Start start;
  start.seeds.push_back({kRight, kRadius});
  desktop_->proxy().begin(start);
  import_ball();
  ui::ReadersDialog& dialog = *open_dialog();
  QVERIFY(!button(dialog, "Compare")->isEnabled());  // the surface alone has a tick
  tick(dialog, "Ball");
  compare(dialog);
  ui::ReaderTable& table = pairs(dialog);
  QCOMPARE(table.rowCount(), 1);
  const Region surface(desktop_->state().phi->mask());
  const double exact = dice(surface, ball(grid(), 4.0));
  QVERIFY(std::abs(table.item(0, kDice)->text().toDouble() - exact) < 6e-4);
  QCOMPARE(table.item(0, kFirst)->text(), QString("Surface"));
  picture(dialog, "readers-in-the-case");

  // The estimate takes no voxel of the label before it is asked to.
  QTest::mouseClick(button(dialog, "Keep as label"), Qt::LeftButton);
  QVERIFY(
      Desktop::wait_for([&] { return said(dialog).contains("All of it lies in other labels"); }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->state().labels.size(), std::size_t{1});
  const std::int64_t before = desktop_->state().label_statistics[0].voxels;
  QCOMPARE(before, ball(grid(), 4.0).count());
  QTest::mouseClick(dialog.findChild<QCheckBox*>(), Qt::LeftButton, {}, {8, 8});
  QTest::mouseClick(button(dialog, "Keep as label"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return said(dialog).contains("had another label"); }, kPatience));
  desktop_->wait_until_idle();
  QVERIFY(desktop_->state().label_statistics[0].voxels < before);
}

void ReadersStoryTest::regions_of_one_name_are_compared() {
  imaging::Segments both{grid(), {segment(grid(), "Cyst", 20.0), segment(grid(), "Liver", 0.0)}, {}};
  QCOMPARE(failure(imaging::write_segmentation(both, {}, folder_ / "one.dcm")), QString());
  both.list[1] = segment(grid(), "Liver", 2.0);
  both.list[0] = segment(grid(), "Heart", 22.0);
  std::swap(both.list[0], both.list[1]);
  const auto source = desktop_->proxy().study().dicom_files;
  QCOMPARE(failure(imaging::write_structure_set(both, source, folder_ / "two.dcm")), QString());

  ui::ReadersDialog& dialog = *open_dialog();
  add(dialog, {path("one.dcm"), path("two.dcm"), path(kNames[0])});
  auto& region = *seen<QComboBox>(dialog, "Region of the files");
  QStringList names;
  for (int n = 0; n < region.count(); ++n) names << region.itemText(n);
  QCOMPARE(names, (QStringList{"All of them together", "Cyst", "Liver", "Heart"}));
  compare(dialog);
  const auto first_dice = [&](int row) { return pairs(dialog).item(row, kDice)->text().toDouble(); };
  QVERIFY(first_dice(0) < 0.75);  // two balls and one
  for (int n = 0; n < 2; ++n) QTest::keyClick(&region, Qt::Key_Down);
  QCOMPARE(region.currentText(), QString("Liver"));
  QCOMPARE(pairs(dialog).rowCount(), 0);
  compare(dialog);
  const double exact = dice(ball(grid(), 0.0), ball(grid(), 2.0));
  QVERIFY2(std::abs(first_dice(0) - exact) < 0.02, qPrintable(QString::number(first_dice(0))));
  QCOMPARE(first_dice(2), 1.0);  // the file with one region counts with it
}

void ReadersStoryTest::what_is_no_segmentation_is_named_and_the_others_stay() {
  std::ofstream(folder_ / "notes.nii") << "not a volume";
  QCOMPARE(failure(imaging::write_volume_file(desktop_->proxy().volume(), folder_ / "other.nii.gz")),
           QString());
  Geometry elsewhere = grid();
  elsewhere.origin_mm.x += 0.4;
  const Mask shifted = mask_of(ball(elsewhere, 0.0), elsewhere);
  QCOMPARE(failure(imaging::write_mask_file(shifted, folder_ / "elsewhere.nii.gz")), QString());
  ui::ReadersDialog& dialog = *open_dialog();
  add(dialog, {path(kNames[0]), path("notes.nii"), path("elsewhere.nii.gz"), path(kNames[1])});
  QVERIFY2(said(dialog).contains("notes.nii") && said(dialog).contains("elsewhere.nii.gz"),
           qPrintable(said(dialog)));
  QCOMPARE(dialog.findChild<ui::ReaderList*>()->chosen().size(), std::size_t{2});
  picture(dialog, "readers-problem");
  compare(dialog);
  QCOMPARE(pairs(dialog).rowCount(), 1);

  // A file of the same name in another folder is told apart; one that was chosen by mistake goes again.
  std::filesystem::create_directories(folder_ / "second");
  std::filesystem::copy_file(folder_ / kNames[0], folder_ / "second" / kNames[0]);
  add(dialog, {QString::fromStdString((folder_ / "second" / kNames[0]).string())});
  auto& list = *dialog.findChild<ui::ReaderList*>();
  QCOMPARE(list.findItems("second/anna.nii.gz", Qt::MatchExactly).size(), 1);
  QVERIFY(list.findItems(kNames[0], Qt::MatchExactly).empty());
  list.setCurrentItem(list.findItems("second/anna.nii.gz", Qt::MatchExactly).front());
  QTest::mouseClick(button(dialog, "Remove"), Qt::LeftButton);
  QCOMPARE(list.findItems(kNames[0], Qt::MatchExactly).size(), 1);
}

void ReadersStoryTest::the_table_goes_out_with_points_where_the_language_has_commas() {
  QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
  ui::ReadersDialog& dialog = *open_dialog();
  add_three(dialog);
  compare(dialog);
  QCOMPARE(pairs(dialog).item(0, kLargest)->text(), QString("6,00"));
  const QString file = path("readers.csv");
  name_file_when_asked(file);
  QTest::mouseClick(button(dialog, "Export CSV…"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return QFile::exists(file); }, kPatience));
  const auto text = read_text_file(folder_ / "readers.csv", 1 << 20);
  QCOMPARE(failure(text), QString());
  const auto table = CsvTable::parse(*text, "readers.csv");
  QCOMPARE(failure(table), QString());
  const auto column = [&](const char* name) {
    const auto found = std::find(table->header.begin(), table->header.end(), name);
    return static_cast<std::size_t>(found - table->header.begin());
  };
  QCOMPARE(table->rows.size(), std::size_t{6});  // three pairs, and three readers with the estimate
  QCOMPARE(table->rows[1].fields[column("a")], std::string(kNames[0]));
  QCOMPARE(table->rows[1].fields[column("b")], std::string(kNames[2]));
  QCOMPARE(table->rows[1].fields[column("hausdorff_mm")], std::string("6.0000"));
  const double exact = dice(ball(grid(), 0.0), ball(grid(), 6.0));
  QVERIFY(std::abs(std::stod(table->rows[1].fields[column("dice")]) - exact) < 1e-4);
  QCOMPARE(table->rows[5].fields[column("b")], std::string("STAPLE"));
  QVERIFY(std::stod(table->rows[4].fields[column("sensitivity")]) > 0.9);
  QVERIFY(table->rows[5].fields[column("hausdorff_mm")].empty());
}

// By a click, and where what it finds would be of readers that are not there any more.
void ReadersStoryTest::a_comparison_is_given_up() {
  import_ball();
  ui::ReadersDialog& dialog = *open_dialog();
  add_three(dialog);
  tick(dialog, "Ball");
  QTest::mouseClick(button(dialog, "Compare"), Qt::LeftButton);
  desktop_->proxy().undo();
  QVERIFY(Desktop::wait_for([&] { return desktop_->state().labels.empty(); }, kPatience));
  desktop_->wait_until_idle();
  QVERIFY(Desktop::wait_for([&] { return button(dialog, "Compare")->isEnabled(); }, kPatience));
  QCOMPARE(pairs(dialog).rowCount(), 0);

  QTest::mouseClick(button(dialog, "Compare"), Qt::LeftButton);
  QTest::mouseClick(button(dialog, "Cancel"), Qt::LeftButton);
  QCOMPARE(said(dialog), QString("Cancelled."));
  QVERIFY(pairs(dialog).rowCount() < 3);
  compare(dialog);
  QCOMPARE(pairs(dialog).rowCount(), 3);
}

void ReadersStoryTest::a_comparison_right_after_an_edit_is_of_the_surface_after_it() {
  engine::CaseProxy& proxy = window_->proxy();
  document::Start start;
  start.seeds.push_back({kRight, 3.0});
  proxy.begin(start);
  desktop_->wait_until_idle();
  ui::ReadersDialog& dialog = *open_dialog();
  add(dialog, {path(kNames[0])});
  proxy.paint({kRight, kRadius}, solver::Brush::add, engine::CaseProxy::new_gesture());
  compare(dialog);
  QCOMPARE(pairs(dialog).rowCount(), 1);
  const double ml = proxy.state().surface.volume_ml;
  const double dice = pairs(dialog).item(0, kDice)->text().toDouble();
  QVERIFY2(dice > 0.95, qPrintable(QStringLiteral("%1, of %2 ml").arg(dice).arg(ml)));
}

void ReadersStoryTest::the_dialog_closes_with_its_case() {
  const QPointer<ui::ReadersDialog> dialog = open_dialog();
  add_three(*dialog);
  QTest::mouseClick(button(*dialog, "Compare"), Qt::LeftButton);
  window_->close_saved();
  QVERIFY(Desktop::wait_for([&] { return dialog.isNull(); }, kPatience));
}

TIDEMARK_TEST(ReadersStoryTest)

}  // namespace tidemark::test::readers_story_test

#include "readers_story_test.moc"
