// Copies of DICOM files without their patient, by the dialog.
#include <QAbstractSpinBox>
#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QLineEdit>
#include <QMessageBox>
#include <QRadioButton>
#include <QTimer>
#include <QTreeWidget>

#include "imaging/load_study.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/results/deidentify_dialog.h"

namespace tidemark::test::deidentify_story_test {
namespace {

namespace fs = std::filesystem;

constexpr int kManyCopies = 40;  // of the study: enough for a question to come in time

template <class Widget>
Widget& called(QWidget& in, const QString& name) {
  for (Widget* one : in.findChildren<Widget*>()) {
    if (one->accessibleName() == name) return *one;
  }
  qFatal("there is no %s", qPrintable(name));
}

QCheckBox& check(QWidget& in, const QString& text) {
  for (QCheckBox* one : in.findChildren<QCheckBox*>()) {
    if (one->text() == text) return *one;
  }
  qFatal("there is no %s", qPrintable(text));
}

// Where the box and its text are, not in the middle of what may be a wide widget.
void click(QAbstractButton& button) {
  QTest::mouseClick(&button, Qt::LeftButton, {}, QPoint(8, button.height() / 2));
}

void type(QLineEdit& line, const QString& text) {
  line.setFocus();
  line.selectAll();
  QTest::keyClicks(&line, text);
}

// The rows of a group of the outcome: what, and what became of it.
QStringList rows(QWidget& dialog, const QString& group) {
  const auto& tree = *dialog.findChild<QTreeWidget*>();
  for (int i = 0; i < tree.topLevelItemCount(); ++i) {
    const QTreeWidgetItem& item = *tree.topLevelItem(i);
    if (item.text(0) != group) continue;
    QStringList texts;
    for (int row = 0; row < item.childCount(); ++row)
      texts << item.child(row)->text(0) + ": " + item.child(row)->text(1);
    return texts;
  }
  return {};
}

// Of all bytes of all files in it.
bool holds(const fs::path& folder, const QByteArray& bytes) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() && bytes_of(entry.path()).contains(bytes)) return true;
  }
  return false;
}

}  // namespace

class DeidentifyStoryTest : public QObject, private ResultsDesktop {
  Q_OBJECT

 private slots:
  void init() { open(); }
  void cleanup() { close(); }
  void the_series_that_is_open_is_copied_without_its_patient();
  void what_is_left_out_of_a_folder_is_said();
  void nothing_is_overwritten();
  void days_that_are_refused_move_no_date();
  void quitting_asks_while_copies_are_made();

 private:
  ui::DeidentifyDialog& dialog();
  // Until it has ended.
  void make(ui::DeidentifyDialog& dialog);
};

ui::DeidentifyDialog& DeidentifyStoryTest::dialog() {
  desktop_->choose("File", desktop_->menu_entry("File", "Anonymous copies"));
  auto* dialog = desktop_->window().findChild<ui::DeidentifyDialog*>();
  if (!dialog || !QTest::qWaitForWindowExposed(dialog)) qFatal("there is no dialog");
  return *dialog;
}

void DeidentifyStoryTest::make(ui::DeidentifyDialog& dialog) {
  QPushButton* go = button(dialog, "Make copies");
  QTest::mouseClick(go, Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return go->isEnabled(); }, kPatience));
}

void DeidentifyStoryTest::the_series_that_is_open_is_copied_without_its_patient() {
  ui::DeidentifyDialog& made = dialog();
  QVERIFY(!made.isModal());
  QVERIFY(is_explained(made));
  auto& of_series = *made.findChildren<QRadioButton*>().first();
  QVERIFY2(of_series.isChecked() && of_series.text().contains("Paula"), qPrintable(of_series.text()));
  QVERIFY(!called<QLineEdit>(made, "Folder").isEnabled());
  type(called<QLineEdit>(made, "Copies to"), path("copies"));
  type(called<QLineEdit>(made, "New ID"), "CASE-07");
  click(check(made, "A list of what was changed (CSV)"));
  click(check(made, "A key to the old names (JSON)"));
  picture(made, "deidentify");
  make(made);
  QVERIFY(says(made, "copies: files 16, series 1, patients 1. Look at a sample"));
  QVERIFY(rows(made, "Attributes").contains("PatientName: replaced"));
  QVERIFY(rows(made, "Left out").isEmpty());
  picture(made, "deidentify-done");

  for (const char* secret : {"Paula", "Two balls"}) {
    QVERIFY2(holds(folder_ / "study", secret), secret);
    QVERIFY2(!holds(folder_ / "copies", secret), secret);
  }
  QVERIFY(holds(folder_ / "copies", "CASE-07"));
  QVERIFY(!bytes_of(folder_ / "copies-changes.csv").contains("Paula"));
  QVERIFY(bytes_of(folder_ / "copies-changes.csv").contains("PatientName,replaced"));
  QVERIFY(bytes_of(folder_ / "copies-key.json").contains("CASE-07"));
  QCOMPARE(fs::status(folder_ / "copies-key.json").permissions(),
           fs::perms::owner_read | fs::perms::owner_write);
  const auto before = imaging::load_volume(folder_ / "study");
  const auto after = imaging::load_volume(folder_ / "copies");
  QCOMPARE(failure(after), QString());
  QVERIFY(after->voxels == before->voxels);

  // The copies open beside the case, which stays what it was.
  QTest::mouseClick(button(made, "Look at the copies"), Qt::LeftButton);
  QVERIFY(Desktop::wait_for([&] { return desktop_->window().cases().size() == 2; }, kPatience));
  desktop_->wait_until_idle();
  QCOMPARE(desktop_->proxy().study().patient.id, std::string("CASE-07"));
  QVERIFY(window_->proxy().study().patient.name.find("Paula") != std::string::npos);
  // Asked for again, the dialog is about the case that is seen now.
  auto& again = *dialog().findChildren<QRadioButton*>().first();
  QVERIFY2(again.text().contains("CASE-07") && !again.text().contains("Paula"), qPrintable(again.text()));
}

void DeidentifyStoryTest::what_is_left_out_of_a_folder_is_said() {
  const fs::path source = folder_ / "source";
  fs::copy(folder_ / "study", source, fs::copy_options::recursive);
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  set_text(files.front(), 0x0028, 0x0301, "YES");  // BurnedInAnnotation
  const QString left_out = QString::fromStdString(files.front().filename().string());

  ui::DeidentifyDialog& made = dialog();
  click(*made.findChildren<QRadioButton*>().last());
  type(called<QLineEdit>(made, "Folder"), path("source"));
  type(called<QLineEdit>(made, "Copies to"), path("most"));
  make(made);
  QVERIFY(says(made, "most: files 15, series 1, patients 1. Files that were left out: 1."));
  QCOMPARE(rows(made, "Left out").size(), 1);
  QVERIFY2(rows(made, "Left out").first().startsWith(left_out), qPrintable(rows(made, "Left out").first()));
  picture(made, "deidentify-left-out");

  type(called<QLineEdit>(made, "Copies to"), path("all"));
  click(check(made, "Images that may show who it is, too"));
  make(made);
  QVERIFY(says(made, "all: files 16"));
  QCOMPARE(rows(made, "May show who it is").size(), 1);
}

void DeidentifyStoryTest::nothing_is_overwritten() {
  ui::DeidentifyDialog& made = dialog();
  type(called<QLineEdit>(made, "Copies to"), path("study"));
  make(made);
  QVERIFY(says(made, "is the source of the copies"));
  const QStringList files = QDir(path("study")).entryList();
  type(called<QLineEdit>(made, "Copies to"), path("new"));
  click(check(made, "A list of what was changed (CSV)"));
  QFile list(path("new-changes.csv"));
  QVERIFY(list.open(QIODevice::WriteOnly));
  list.write("mine");
  list.close();
  make(made);
  QVERIFY(says(made, "new-changes.csv is there"));
  QVERIFY(!fs::exists(folder_ / "new"));
  QCOMPARE(bytes_of(folder_ / "new-changes.csv"), QByteArray("mine"));
  QCOMPARE(QDir(path("study")).entryList(), files);
}

void DeidentifyStoryTest::days_that_are_refused_move_no_date() {
  ui::DeidentifyDialog& made = dialog();
  type(called<QLineEdit>(made, "Copies to"), path("moved"));
  called<QComboBox>(made, "Dates").setCurrentIndex(2);
  auto& days = called<QAbstractSpinBox>(made, "Days");
  const auto enter = [&](const char* text) {
    days.setFocus();
    days.selectAll();
    QTest::keyClicks(&days, text);
    QTest::keyClick(&days, Qt::Key_Return);
  };
  for (const char* refused : {"40000", "1 000", "1.000"}) {
    enter(refused);
    QVERIFY2(says(made, refused), refused);
    QVERIFY(!made.working() && days.hasFocus());
  }
  QVERIFY(!fs::exists(folder_ / "moved"));
  enter("200");
  QVERIFY(Desktop::wait_for([&] { return says(made, "moved: files 16"); }, kPatience));
}

// The question comes while the work goes on, and the answer counts for what is unfinished then.
void DeidentifyStoryTest::quitting_asks_while_copies_are_made() {
  const fs::path source = folder_ / "many";
  fs::create_directories(source);
  for (int copy = 0; copy < kManyCopies; ++copy)
    fs::copy(folder_ / "study", source / std::to_string(copy), fs::copy_options::recursive);
  ui::DeidentifyDialog& made = dialog();
  click(*made.findChildren<QRadioButton*>().last());
  type(called<QLineEdit>(made, "Folder"), path("many"));
  type(called<QLineEdit>(made, "Copies to"), path("finished"));
  QPushButton* go = button(made, "Make copies");

  const auto quit_and_say = [&](const QString& answer) {
    QString asked;
    QTimer::singleShot(0, &made, [&] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (!box) return;
      asked = box->text();
      QTest::mouseClick(button(*box, answer), Qt::LeftButton);
    });
    desktop_->window().actions().quit->trigger();
    return asked;
  };
  go->click();  // no event comes between that and the question
  QVERIFY(quit_and_say("Cancel").contains("Anonymous copies"));
  QVERIFY(desktop_->window().isVisible());
  QVERIFY(Desktop::wait_for([&] { return go->isEnabled(); }, kPatience));
  QVERIFY(says(made, QString("finished: files %1").arg(16 * kManyCopies)));

  type(called<QLineEdit>(made, "Copies to"), path("unfinished"));
  go->click();
  QVERIFY(quit_and_say("Give it up and quit").contains("Anonymous copies"));
  QVERIFY(Desktop::wait_for([&] { return !desktop_->window().isVisible(); }));
  desktop_.reset();
  QVERIFY(!fs::exists(folder_ / "unfinished"));
}

TIDEMARK_TEST(DeidentifyStoryTest)

}  // namespace tidemark::test::deidentify_story_test

#include "deidentify_story_test.moc"
