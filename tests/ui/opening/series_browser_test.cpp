// The series browser, used as a person would.
#include "ui/opening/series_browser.h"

#include <QDialogButtonBox>
#include <QSignalSpy>

#include "engine/background_job.h"
#include "engine/study_loader.h"
#include "imaging/dicom/dicom.h"
#include "imaging/load_study.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "ui/look/language.h"
#include "ui/opening/series_model.h"

namespace tidemark::test::series_browser_test {

namespace fs = std::filesystem;

namespace {

imaging::Series series(const std::string& description, Index3 size, bool loadable = true) {
  imaging::Series one;
  one.uid = "1.2." + std::to_string(size.x);
  one.modality = "MR";
  one.description = description;
  one.date = "2004-07-31";
  one.files = {"/data/" + description + "/1.dcm", "/data/" + description + "/2.dcm"};
  one.transfer_syntaxes = {"1.2.840.10008.1.2"};
  one.geometry.size = size;
  one.geometry.spacing_mm = {1.0, 1.0, 2.5};
  one.loadable = loadable;
  if (!loadable) one.reason = "2.dcm: is <damaged>";
  return one;
}

std::shared_ptr<const imaging::Catalogue> sample() {
  auto catalogue = std::make_shared<imaging::Catalogue>();
  catalogue->series = {series("Localizer", {500, 500, 500}, false), series("Small T2", {64, 64, 20}),
                       series("Large T1", {256, 256, 100}), series("Middle FLAIR", {128, 128, 60})};
  catalogue->series[2].warnings = {"10 slices lack a window", "text may be burned in"};
  catalogue->series[3].changes = {"slices sorted by position"};
  catalogue->skipped = {{"/data/notes.txt", "is not a DICOM file"}};
  return catalogue;
}

}  // namespace

class SeriesBrowserTest : public QObject {
  Q_OBJECT

  ui::SeriesBrowser* browser_ = nullptr;
  QTableView* table_ = nullptr;
  QLineEdit* filter_ = nullptr;
  QTextBrowser* details_ = nullptr;
  QPushButton* open_ = nullptr;

  QString cell(int row, int column) const { return table_->model()->index(row, column).data().toString(); }

 private slots:
  void initTestCase() { ui::use_language("en"); }
  void init() {
    browser_ = new ui::SeriesBrowser;
    browser_->show_catalogue(sample(), "/data");
    table_ = browser_->findChild<QTableView*>();
    filter_ = browser_->findChild<QLineEdit*>();
    details_ = browser_->findChild<QTextBrowser*>();
    for (auto* button : browser_->findChildren<QPushButton*>()) {
      if (button->text() == "&Open") open_ = button;
    }
    browser_->show();
    QVERIFY(QTest::qWaitForWindowExposed(browser_));
    browser_->activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(browser_));
  }
  void cleanup() {
    delete browser_;
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
  }

  void the_largest_that_can_be_loaded_is_on_top_and_chosen() {
    QCOMPARE(table_->model()->rowCount(), 4);
    QCOMPARE(cell(0, ui::SeriesModel::kSeries), QString("Large T1"));
    QCOMPARE(cell(1, ui::SeriesModel::kSeries), QString("Middle FLAIR"));
    QCOMPARE(cell(2, ui::SeriesModel::kSeries), QString("Small T2"));
    QCOMPARE(cell(3, ui::SeriesModel::kSeries), QString("Localizer"));
    QVERIFY(browser_->selected() != nullptr);
    QCOMPARE(browser_->selected()->description, std::string("Large T1"));
    QVERIFY(table_->hasFocus());
    QCOMPARE(cell(0, ui::SeriesModel::kSize), QString::fromUtf8("256 × 256 × 100"));
    QCOMPARE(cell(0, ui::SeriesModel::kDate), QString("2004-07-31"));
    QCOMPARE(cell(0, ui::SeriesModel::kFiles), QString("2"));
  }

  void patients_are_named_where_they_are_known() {
    QVERIFY(table_->isColumnHidden(ui::SeriesModel::kPatient));
    auto catalogue = std::make_shared<imaging::Catalogue>(*sample());
    catalogue->series[2].patient.name = "山田 太郎 (Yamada, Tarou)";
    browser_->show_catalogue(catalogue, "/data");
    QVERIFY(!table_->isColumnHidden(ui::SeriesModel::kPatient));
    QCOMPARE(cell(0, ui::SeriesModel::kPatient), QString::fromUtf8("山田 太郎 (Yamada, Tarou)"));
    QCOMPARE(cell(1, ui::SeriesModel::kPatient), QString());
  }

  void series_on_one_frame_of_reference_have_one_letter() {
    QVERIFY(table_->isColumnHidden(ui::SeriesModel::kFrame));
    auto catalogue = std::make_shared<imaging::Catalogue>(*sample());
    catalogue->series[1].frame_of_reference_uid = "1.2.7";  // Small T2
    catalogue->series[2].frame_of_reference_uid = "1.2.7";  // Large T1
    catalogue->series[3].frame_of_reference_uid = "1.2.8";  // Middle FLAIR: alone on it
    browser_->show_catalogue(catalogue, "/data");
    QVERIFY(!table_->isColumnHidden(ui::SeriesModel::kFrame));
    QCOMPARE(cell(0, ui::SeriesModel::kFrame), QString("A"));
    QCOMPARE(cell(1, ui::SeriesModel::kFrame), QString());
    QCOMPARE(cell(2, ui::SeriesModel::kFrame), QString("A"));
    QCOMPARE(cell(3, ui::SeriesModel::kFrame), QString());
    QVERIFY(details_->toPlainText().contains("frame of reference"));
    QVERIFY(details_->toPlainText().contains("Small T2"));
    table_->selectRow(1);
    QVERIFY(!details_->toPlainText().contains("frame of reference"));
  }

  void notes_say_in_words_what_the_icon_means() {
    QCOMPARE(cell(0, ui::SeriesModel::kNotes), QString("2 warnings"));
    QCOMPARE(cell(1, ui::SeriesModel::kNotes), QString("1 change"));
    QCOMPARE(cell(2, ui::SeriesModel::kNotes), QString("Ready"));
    QCOMPARE(cell(3, ui::SeriesModel::kNotes), QString("Cannot be loaded"));
    for (int row = 0; row < 4; ++row) {
      const QVariant icon = table_->model()->index(row, ui::SeriesModel::kNotes).data(Qt::DecorationRole);
      QVERIFY(!icon.value<QIcon>().isNull());
    }
    QVERIFY(details_->toPlainText().contains("text may be burned in"));
  }

  void a_series_that_cannot_be_loaded_says_why_and_is_not_opened() {
    QSignalSpy chosen(browser_, &ui::SeriesBrowser::chosen);
    QTest::keyClick(table_, Qt::Key_End, Qt::ControlModifier);
    QCOMPARE(browser_->selected()->description, std::string("Localizer"));
    QVERIFY(details_->toPlainText().contains("2.dcm: is <damaged>"));
    QVERIFY(!open_->isEnabled());
    QTest::keyClick(table_, Qt::Key_Return);
    QCOMPARE(chosen.size(), 0);
    QVERIFY(browser_->isVisible());
  }

  void enter_opens() {
    QSignalSpy chosen(browser_, &ui::SeriesBrowser::chosen);
    QTest::keyClick(table_, Qt::Key_Down);
    QTest::keyClick(table_, Qt::Key_Return);
    QCOMPARE(chosen.size(), 1);
    QCOMPARE(chosen[0][0].value<imaging::Series>().description, std::string("Middle FLAIR"));
    QVERIFY(!browser_->isVisible());
  }

  void a_double_click_opens() {
    QSignalSpy chosen(browser_, &ui::SeriesBrowser::chosen);
    const QPoint place = table_->visualRect(table_->model()->index(2, 0)).center();
    QTest::mouseClick(table_->viewport(), Qt::LeftButton, {}, place);
    QTest::mouseDClick(table_->viewport(), Qt::LeftButton, {}, place);
    QCOMPARE(chosen.size(), 1);
    QCOMPARE(chosen[0][0].value<imaging::Series>().description, std::string("Small T2"));
  }

  void escape_opens_nothing() {
    QSignalSpy chosen(browser_, &ui::SeriesBrowser::chosen);
    QTest::keyClick(table_, Qt::Key_Escape);
    QVERIFY(!browser_->isVisible());
    QCOMPARE(chosen.size(), 0);
  }

  void the_filter_keeps_what_holds_the_text_in_any_column() {
    QTest::keySequence(browser_, QKeySequence::Find);
    QVERIFY(filter_->hasFocus());
    QTest::keyClicks(filter_, "flair");
    QCOMPARE(table_->model()->rowCount(), 1);
    QCOMPARE(browser_->selected()->description, std::string("Middle FLAIR"));
    QVERIFY(open_->isEnabled());
    filter_->setText("cannot");
    QCOMPARE(table_->model()->rowCount(), 1);
    QCOMPARE(browser_->selected()->description, std::string("Localizer"));
    filter_->setText("nothing like it");
    QVERIFY(browser_->selected() == nullptr);
    QVERIFY(!open_->isEnabled());
    filter_->clear();
    QCOMPARE(table_->model()->rowCount(), 4);
  }

  void columns_sort_by_number_not_by_text() {
    table_->sortByColumn(ui::SeriesModel::kSize, Qt::AscendingOrder);
    QCOMPARE(cell(0, ui::SeriesModel::kSeries), QString("Small T2"));
    QCOMPARE(cell(3, ui::SeriesModel::kSeries), QString("Localizer"));
  }

  void a_series_of_images_gets_its_picture() {
    const test::TemporaryFolder folder;
    Volume volume;
    volume.geometry.size = {32, 32, 3};
    volume.voxels = std::vector<std::int16_t>(32 * 32 * 3, 900);
    imaging::DicomSeriesHeader header;
    header.window = {450.0, 900.0};
    QCOMPARE(test::failure(imaging::write_dicom_series(volume, header, folder / "series")), QString());
    auto found = imaging::find_series(folder.path());
    QCOMPARE(test::failure(found), QString());
    browser_->show_catalogue(std::make_shared<const imaging::Catalogue>(std::move(*found)), "series");
    const QModelIndex first = table_->model()->index(0, 0);
    const auto middle = [&] {
      const QImage picture = first.data(Qt::DecorationRole).value<QIcon>().pixmap(64).toImage();
      return picture.pixelColor(picture.width() / 2, picture.height() / 2);
    };
    QTRY_COMPARE_WITH_TIMEOUT(middle(), QColor(Qt::white), 60'000);
  }

  void everything_has_a_name_for_those_who_do_not_see_it() {
    for (QWidget* widget :
         {static_cast<QWidget*>(table_), static_cast<QWidget*>(filter_), static_cast<QWidget*>(details_)}) {
      QVERIFY(!widget->accessibleName().isEmpty());
    }
  }
};

TIDEMARK_TEST(SeriesBrowserTest)

}  // namespace tidemark::test::series_browser_test

#include "series_browser_test.moc"
