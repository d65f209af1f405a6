// From a path to a study, with what is shown on the way.
#include "ui/opening/study_opener.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QSignalSpy>
#include <QStackedWidget>
#include <QTableView>
#include <algorithm>

#include "engine/background_job.h"
#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "ui/opening/load_report.h"
#include "ui/opening/preview_page.h"
#include "ui/opening/series_browser.h"
#include "ui/widgets/status_progress.h"

namespace tidemark::test::study_opener_test {

namespace {

constexpr int kPatience = 60'000;

// A series of slices of that width.
Status write_series(const std::filesystem::path& folder, std::int64_t width, std::int64_t slices = 3) {
  Volume volume;
  volume.geometry.size = {width, 24, slices};
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = static_cast<std::int16_t>(v % 500);
  volume.voxels = std::move(voxels);
  imaging::DicomSeriesHeader header;
  header.series_description = fmt::format("{} wide", width);
  header.window = {250.0, 500.0};
  return imaging::write_dicom_series(volume, header, folder);
}

QString text(const std::filesystem::path& path) {
  return QString::fromStdString(path.string());
}

}  // namespace

class StudyOpenerTest : public QObject {
  Q_OBJECT

  test::TemporaryFolder folder_;
  QWidget* window_ = nullptr;
  ui::StudyOpener* opener_ = nullptr;
  std::unique_ptr<QSignalSpy> began_, opened_, failed_, ended_;

  std::shared_ptr<const engine::LoadedStudy> study() const {
    return opened_->first()[0].value<std::shared_ptr<const engine::LoadedStudy>>();
  }

 private slots:
  void initTestCase() {
    QCOMPARE(test::failure(write_series(folder_ / "two/a", 20)), QString());
    QCOMPARE(test::failure(write_series(folder_ / "two/b", 30)), QString());
  }
  void init() {
    window_ = new QWidget;
    opener_ = new ui::StudyOpener(window_);
    began_ = std::make_unique<QSignalSpy>(opener_, &ui::StudyOpener::began);
    opened_ = std::make_unique<QSignalSpy>(opener_, &ui::StudyOpener::opened);
    failed_ = std::make_unique<QSignalSpy>(opener_, &ui::StudyOpener::failed);
    ended_ = std::make_unique<QSignalSpy>(opener_, &ui::StudyOpener::ended);
  }
  void cleanup() {
    delete window_;
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
  }

  void the_only_series_is_opened_at_once() {
    opener_->open(text(folder_ / "two/a"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QVERIFY(opener_->browser() == nullptr);
    QCOMPARE(study()->name, QString("20 wide"));
    QCOMPARE(began_->first()[0].toString(), QString("a"));
    QCOMPARE(began_->last()[0].toString(), QString("20 wide"));
    QCOMPARE(ended_->size(), 1);
  }

  void a_name_is_said_as_it_is_while_several_are_opened() {
    QCOMPARE(test::failure(write_series(folder_ / "dose %2 %L3", 20)), QString());
    opener_->open(text(folder_ / "two/a"));
    opener_->open(text(folder_ / "dose %2 %L3"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 2, kPatience);
    QStringList said;
    for (const QList<QVariant>& one : *began_) said << one[0].toString();
    QVERIFY2(said.contains("dose %2 %L3 (2 of 2)"), qPrintable(said.join(", ")));
  }

  void it_is_asked_for_on_demand() {
    opener_->open(text(folder_ / "two/a"), ui::StudyOpener::Ask::always);
    QTRY_VERIFY_WITH_TIMEOUT(opener_->browser() != nullptr, kPatience);
    QCOMPARE(opened_->size(), 0);
  }

  void of_several_series_the_chosen_one_is_opened() {
    opener_->open(text(folder_ / "two"));
    QTRY_VERIFY_WITH_TIMEOUT(opener_->browser() != nullptr, kPatience);
    QVERIFY(!opener_->browser()->isModal());
    QVERIFY(QTest::qWaitForWindowExposed(opener_->browser()));
    QCOMPARE(ended_->size(), 1);  // it is the user's turn
    auto* table = opener_->browser()->findChild<QTableView*>();
    QTest::keyClick(table, Qt::Key_Down);
    QTest::keyClick(table, Qt::Key_Return);
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QCOMPARE(study()->name, QString("20 wide"));
    QTRY_VERIFY(opener_->browser() == nullptr);
  }

  void a_series_is_opened_by_its_uid() {
    opener_->open(text(folder_ / "two/b"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    const std::string uid = study()->origin.series_uid;
    opened_->clear();
    opener_->open_series(text(folder_ / "two"), QString::fromStdString(uid));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QCOMPARE(study()->name, QString("30 wide"));
  }

  void gaps_are_filled_when_the_user_says_so() {
    QCOMPARE(test::failure(write_series(folder_ / "gap", 20, 5)), QString());
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "gap")) files.push_back(entry);
    std::sort(files.begin(), files.end());
    QVERIFY(std::filesystem::remove(files[1]));
    QString uid;
    for (const bool by_uid : {false, true}) {
      for (const bool fills : {false, true}) {
        opened_->clear();
        ended_->clear();
        if (by_uid) {
          opener_->open_series(text(folder_ / "gap"), uid);
        } else {
          opener_->open(text(folder_ / "gap"));
        }
        QTRY_VERIFY_WITH_TIMEOUT(opener_->question() != nullptr, kPatience);
        QVERIFY(opener_->question()->text().startsWith("1 slice is missing between"));
        QVERIFY(opener_->question()->text().endsWith("Fill it by interpolation?"));
        QVERIFY(opener_->question()->checkBox() == nullptr);  // no gantry was tilted
        QVERIFY(QTest::qWaitForWindowExposed(opener_->question()));
        QCOMPARE(ended_->size(), 1);  // it is the user's turn
        const auto buttons = opener_->question()->buttons();
        const auto wanted = std::find_if(buttons.begin(), buttons.end(), [&](QAbstractButton* button) {
          return (button->text() == "&Interpolate") == fills;
        });
        QVERIFY(wanted != buttons.end());
        (*wanted)->click();
        QTRY_COMPARE_WITH_TIMEOUT(ended_->size(), 2, kPatience);
        QTRY_VERIFY(opener_->question() == nullptr);
        QCOMPARE(opened_->size(), fills ? 1 : 0);
        QCOMPARE(failed_->size(), 0);
        if (!fills) continue;
        QCOMPARE(study()->volume->geometry.size, Index3(20, 24, 5));
        QVERIFY(study()->origin.policy.gaps == imaging::GridPolicy::Gaps::fill);
        uid = QString::fromStdString(study()->origin.series_uid);
      }
    }
    // Opening something else fills nothing.
    opened_->clear();
    opener_->open(text(folder_ / "gap"));
    QTRY_VERIFY_WITH_TIMEOUT(opener_->question() != nullptr, kPatience);
    opener_->open(text(folder_ / "two/a"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QCOMPARE(study()->name, QString("20 wide"));
    QTRY_VERIFY(opener_->question() == nullptr);
  }

  void gaps_that_were_filled_before_are_filled_without_a_question() {
    const imaging::GridPolicy filled{imaging::GridPolicy::Tilt::correct, imaging::GridPolicy::Gaps::fill};
    const auto files = test::write_series(test::sample_volume({12, 10, 6}), folder_ / "known gap");
    const QString uid = QString::fromStdString(test::only_series(folder_ / "known gap").uid);
    QVERIFY(std::filesystem::remove(files[2]));
    opener_->open_series(text(folder_ / "known gap"), uid, filled);
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QCOMPARE(study()->volume->geometry.size, Index3(12, 10, 6));
    QVERIFY(study()->origin.policy == filled);
  }

  void slices_of_a_tilted_gantry_can_stay_as_they_lie_data() {
    QTest::addColumn<bool>("has_gap");
    QTest::newRow("whole") << false;
    QTest::newRow("with a gap") << true;
  }
  void slices_of_a_tilted_gantry_can_stay_as_they_lie() {
    QFETCH(bool, has_gap);
    const auto folder = folder_ / (has_gap ? "tilted, gap" : "tilted");
    const Volume whole = test::sample_volume({12, 10, 6});
    const auto files = test::write_series(whole, folder);
    test::tilt(files, whole.geometry, 0.9);
    if (has_gap) QVERIFY(std::filesystem::remove(files[2]));
    for (const bool keeps : {false, true}) {
      opened_->clear();
      opener_->open(text(folder));
      QTRY_VERIFY_WITH_TIMEOUT(opener_->question() != nullptr, kPatience);
      QMessageBox& question = *opener_->question();
      QVERIFY(QTest::qWaitForWindowExposed(&question));
      QCOMPARE(question.text().startsWith("The gantry was tilted by "), !has_gap);
      QCheckBox* correct = question.checkBox();
      QVERIFY(correct != nullptr && correct->isChecked());
      correct->setChecked(!keeps);
      // Enter moves slices back, but makes none up.
      QCOMPARE(question.defaultButton()->text(), has_gap ? QString("Cancel") : QString("&Open"));
      for (QAbstractButton* button : question.buttons()) {
        if (button->text() == (has_gap ? "&Interpolate" : "&Open")) button->click();
      }
      QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
      QTRY_VERIFY(opener_->question() == nullptr);
      // Moved back they take more room.
      QCOMPARE(study()->volume->geometry.size, keeps ? Index3(12, 10, 6) : Index3(12, 15, 6));
      const imaging::GridPolicy policy = study()->origin.policy;
      QVERIFY(policy.tilt == (keeps ? imaging::GridPolicy::Tilt::keep : imaging::GridPolicy::Tilt::correct));
      QVERIFY(policy.gaps == (has_gap ? imaging::GridPolicy::Gaps::fill : imaging::GridPolicy::Gaps::refuse));
    }
  }

  void whoever_answers_no_question_about_a_tilt_opens_nothing() {
    const Volume whole = test::sample_volume({12, 10, 4});
    test::tilt(test::write_series(whole, folder_ / "unanswered"), whole.geometry, 0.9);
    opener_->open(text(folder_ / "unanswered"));
    QTRY_VERIFY_WITH_TIMEOUT(opener_->question() != nullptr, kPatience);
    QVERIFY(QTest::qWaitForWindowExposed(opener_->question()));
    QTest::keyClick(opener_->question(), Qt::Key_Escape);
    QTRY_VERIFY(opener_->question() == nullptr);
    QCOMPARE(ended_->size(), 2);
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QCoreApplication::processEvents();
    QCOMPARE(opened_->size() + failed_->size(), 0);
  }

  void a_tilt_that_was_answered_before_is_not_asked_for() {
    const Volume whole = test::sample_volume({12, 10, 5});
    test::tilt(test::write_series(whole, folder_ / "known tilt"), whole.geometry, 0.9);
    const QString uid = QString::fromStdString(test::only_series(folder_ / "known tilt").uid);
    for (const auto tilt : {imaging::GridPolicy::Tilt::correct, imaging::GridPolicy::Tilt::keep}) {
      opened_->clear();
      opener_->open_series(text(folder_ / "known tilt"), uid, {tilt, imaging::GridPolicy::Gaps::refuse});
      QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
      QVERIFY(opener_->question() == nullptr);
      QVERIFY(study()->origin.policy.tilt == tilt);
    }
  }

  void a_phantom_is_opened() {
    opener_->open_phantom("sphere");
    QCOMPARE(began_->first()[0].toString(), QString("Sphere"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QCOMPARE(study()->origin.phantom, std::string("sphere"));
    QCOMPARE(study()->name, began_->first()[0].toString());
  }

  void opening_can_be_given_up() {
    opener_->open_phantom("sphere");
    opener_->cancel();
    QCOMPARE(ended_->size(), 1);
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QCoreApplication::processEvents();
    QCOMPARE(opened_->size() + failed_->size(), 0);
  }

  void what_is_being_loaded_is_seen_before_it_is_loaded() {
    constexpr int kPixels = 1024;
    QCOMPARE(test::failure(write_series(folder_ / "many", 20, 300)), QString());
    QSignalSpy previewed(opener_, &ui::StudyOpener::previewed);
    // Whether one slice is there before all of them, other programs on this machine have a say in.
    for (int attempt = 0; attempt < 5 && previewed.isEmpty(); ++attempt) {
      opened_->clear();
      opener_->open(text(folder_ / "many"));
      QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    }
    QCOMPARE(previewed.size(), 1);
    const auto picture = previewed.first()[0].value<QImage>();
    QCOMPARE(picture.height(), kPixels);
    QCOMPARE(picture.width(), kPixels * 20 / 24);
    // It counts from 0 to 499 again and again in a window from 0 to 500.
    QVERIFY(picture.pixelColor(kPixels / 2, kPixels / 2).red() > 0);
    opened_->clear();
    opener_->set_previews_wanted(false);
    opener_->open(text(folder_ / "many"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QCoreApplication::processEvents();
    QCOMPARE(previewed.size(), 1);
  }

  void the_preview_takes_no_place_but_the_start_pages() {
    QStackedWidget pages;
    pages.addWidget(new QWidget);  // where nothing is open
    pages.addWidget(new QWidget);  // with cases
    auto* preview = new ui::PreviewPage(pages, *opener_);
    QImage picture(10, 20, QImage::Format_Grayscale8);
    picture.fill(200);
    pages.resize(300, 200);
    pages.show();
    QVERIFY(QTest::qWaitForWindowExposed(&pages));
    emit opener_->previewed(picture);
    QCOMPARE(pages.currentWidget(), preview);
    const QImage seen = preview->grab().toImage();
    QCOMPARE(seen.pixelColor(seen.width() / 2, seen.height() / 2), QColor(200, 200, 200));
    QCOMPARE(seen.pixelColor(seen.width() / 5, seen.height() / 2), QColor(Qt::black));  // in proportion
    emit opener_->began(QStringLiteral("another one"));  // the first was given up
    QCOMPARE(pages.currentIndex(), 0);
    emit opener_->previewed(picture);
    QCOMPARE(pages.currentWidget(), preview);
    emit opener_->ended();
    QCOMPARE(pages.currentIndex(), 0);
    pages.setCurrentIndex(1);
    emit opener_->previewed(picture);
    QCOMPARE(pages.currentIndex(), 1);
    emit opener_->ended();
    QCOMPARE(pages.currentIndex(), 1);
  }

  void several_studies_are_opened_one_after_the_other() {
    opener_->open(text(folder_ / "two/a"));
    opener_->open(text(folder_ / "nowhere"));
    opener_->open_phantom("sphere");
    opener_->open(text(folder_ / "two/b"));
    QTRY_COMPARE_WITH_TIMEOUT(ended_->size(), 1, kPatience);
    QStringList names;
    for (const auto& one : *opened_)
      names << one[0].value<std::shared_ptr<const engine::LoadedStudy>>()->name;
    QCOMPARE(names.size(), 3);
    QCOMPARE(names.first(), QString("20 wide"));
    QCOMPARE(names.last(), QString("30 wide"));
    // The first one began before the others were asked for.
    QStringList said;
    for (const auto& one : *began_) said << one[0].toString();
    QCOMPARE(said, QStringList({"a", "20 wide (1 of 4)", "nowhere (2 of 4)", "Sphere (3 of 4)", "b (4 of 4)",
                                "30 wide (4 of 4)"}));
    QCOMPARE(failed_->size(), 1);
    QVERIFY(failed_->first()[0].toString().contains("nowhere"));
    opener_->open(text(folder_ / "two/a"));
    QCOMPARE(began_->last()[0].toString(), QString("a"));  // it counts anew
    opener_->cancel();
  }

  void those_that_wait_go_on_once_a_series_is_chosen_or_none() {
    for (const bool chooses : {true, false}) {
      opened_->clear();
      opener_->open(text(folder_ / "two"));
      opener_->open(text(folder_ / "two/b"));
      QTRY_VERIFY_WITH_TIMEOUT(opener_->browser() != nullptr, kPatience);
      QVERIFY(QTest::qWaitForWindowExposed(opener_->browser()));
      QTest::qWait(100);
      QCOMPARE(opened_->size(), 0);
      QTest::keyClick(opener_->browser(), chooses ? Qt::Key_Return : Qt::Key_Escape);
      QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), chooses ? 2 : 1, kPatience);
      QTRY_VERIFY(opener_->browser() == nullptr);
    }
  }

  void whoever_opens_something_else_chooses_no_series() {
    opener_->open(text(folder_ / "two"));
    QTRY_VERIFY_WITH_TIMEOUT(opener_->browser() != nullptr, kPatience);
    opener_->open(text(folder_ / "two/a"));
    QTRY_COMPARE_WITH_TIMEOUT(opened_->size(), 1, kPatience);
    QCOMPARE(study()->name, QString("20 wide"));
    QTRY_VERIFY(opener_->browser() == nullptr);
  }

  void giving_up_one_gives_up_those_that_wait() {
    opener_->open_phantom("sphere");
    opener_->open(text(folder_ / "two/a"));
    opener_->open(text(folder_ / "two/b"));
    opener_->cancel();
    QCOMPARE(ended_->size(), 1);
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QTest::qWait(50);
    QCOMPARE(opened_->size() + failed_->size(), 0);
    QCOMPARE(began_->size(), 1);
  }

  void the_status_bar_shows_how_far_it_is() {
    QStatusBar bar;
    auto* line = new ui::StatusProgress(bar);
    opener_->show_in(*line);
    bar.show();
    QVERIFY(!line->isVisible());
    auto* progress = line->findChild<QProgressBar*>();
    const auto says = [&](const QString& part) {
      const auto labels = line->findChildren<QLabel*>();
      return std::any_of(labels.begin(), labels.end(),
                         [&](QLabel* one) { return one->text().contains(part); });
    };
    opener_->open(text(folder_ / "nowhere"));
    QVERIFY(line->isVisible());
    QVERIFY(says("Opening nowhere"));
    QCOMPARE(progress->maximum(), 0);  // not known yet
    line->set_progress(0.25, "Decoding slices");
    QCOMPARE(progress->value() * 4, progress->maximum());
    QVERIFY(says("Decoding slices"));
    QTRY_COMPARE_WITH_TIMEOUT(failed_->size(), 1, kPatience);
    QVERIFY(!line->isVisible());
    QCOMPARE(ended_->size(), 1);

    opener_->open_phantom("sphere");
    QVERIFY(line->isVisible());
    QVERIFY(says("Opening Sphere"));
    auto* cancel = line->findChild<QPushButton*>();
    cancel->setFocus();
    QTest::keyClick(cancel, Qt::Key_Escape);
    QCOMPARE(ended_->size(), 2);
    QVERIFY(!line->isVisible());
  }

  void the_report_lists_what_was_changed() {
    engine::LoadedStudy study;
    auto volume = std::make_shared<Volume>();
    volume->geometry.size = {256, 256, 100};
    volume->geometry.spacing_mm = {1.0, 1.0, 2.5};
    volume->changes = {"slices sorted by position", "<b>odd</b> description"};
    study.name = "T1 head";
    study.volume = volume;
    ui::LoadReport report(study);
    QSignalSpy dismissed(&report, &ui::LoadReport::dismissed);
    const auto* what = report.findChild<QLabel*>("what");
    QVERIFY(what->text().contains("slices sorted by position"));
    QVERIFY(what->text().contains("&lt;b&gt;odd"));
    const auto press = [&report](const QString& name) {
      for (QPushButton* button : report.findChildren<QPushButton*>()) {
        if (button->text() == name) return QTest::mouseClick(button, Qt::LeftButton);
      }
      QFAIL("no such button");
    };
    // One line, until the user asks for more.
    report.resize(700, report.sizeHint().height());
    report.show();
    QVERIFY(!what->isVisible());
    const int line = report.sizeHint().height();
    QVERIFY2(line < 3 * report.fontMetrics().height(), qPrintable(QString::number(line)));
    press("Details");
    QVERIFY(what->isVisible());
    QVERIFY(report.sizeHint().height() > line);
    press("Details");
    QVERIFY(!what->isVisible());
    press("Dismiss");
    QCOMPARE(dismissed.size(), 1);
    QVERIFY(!report.isVisible());

    volume->changes.clear();
    const ui::LoadReport nothing(study);
    QVERIFY(nothing.findChild<QLabel*>("what")->text().contains("Nothing was changed"));
  }
};

TIDEMARK_TEST(StudyOpenerTest)

}  // namespace tidemark::test::study_opener_test

#include "study_opener_test.moc"
