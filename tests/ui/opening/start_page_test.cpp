// The start page, the list of recent studies and the menu of phantoms.
#include "ui/opening/start_page.h"

#include <sys/stat.h>

#include <QDialog>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileInfo>
#include <QImageReader>
#include <QMimeData>
#include <QScopeGuard>
#include <QSettings>
#include <QSignalSpy>
#include <QToolButton>
#include <algorithm>

#include "engine/background_job.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "ui/opening/card_button.h"
#include "ui/opening/dropped_paths.h"
#include "ui/opening/phantom_menu.h"
#include "ui/opening/recent_pictures.h"
#include "ui/opening/recent_studies.h"

namespace tidemark::test::start_page_test {

class StartPageTest : public QObject {
  Q_OBJECT

  test::TemporaryFolder settings_;

 private slots:
  void initTestCase() {
    QCoreApplication::setOrganizationName("tidemark-test");
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope,
                       QString::fromStdString(settings_.path().string()));
  }
  void init() { QSettings().clear(); }
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60))); }

  void a_card_is_lit_only_while_the_mouse_is_on_it() {
    ui::RecentStudies recent;
    ui::StartPage page(recent);
    page.resize(1000, 800);
    page.show();
    QVERIFY(QTest::qWaitForWindowExposed(&page));
    page.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&page));
    auto* card = page.findChild<ui::CardButton*>("open_folder");
    const auto fill = [card] { return card->grab().toImage().pixelColor(card->width() - 8, 8); };
    const auto enter = [&] {
      QTest::mouseMove(&page, QPoint(2, 2));
      QTest::mouseMove(card, card->rect().center());
      QTest::mouseMove(card, card->rect().center() + QPoint(1, 0));
    };
    const QColor rest = fill();
    enter();
    QTRY_VERIFY(fill() != rest);
    QTest::mouseMove(&page, QPoint(2, 2));
    QTRY_COMPARE(fill(), rest);
    // A dialog opens, which a card is for: no mouse leaves the card.
    enter();
    QTRY_VERIFY(fill() != rest);
    QDialog dialog(&page);
    dialog.open();
    QVERIFY(QTest::qWaitForWindowActive(&dialog));
    QTRY_COMPARE(fill(), rest);
    dialog.close();
    // The page goes, because a study is open, and comes back.
    QVERIFY(QTest::qWaitForWindowActive(&page));
    enter();
    QTRY_VERIFY(fill() != rest);
    page.hide();
    page.show();
    QVERIFY(QTest::qWaitForWindowExposed(&page));
    QCOMPARE(fill(), rest);
  }

  void every_card_can_be_reached_and_pressed_by_keyboard() {
    ui::RecentStudies recent;
    recent.add({QString::fromStdString(settings_.path().string()), "1.2.3", "T1 head", {}});
    ui::StartPage page(recent);
    page.resize(1000, 800);
    page.show();
    QVERIFY(QTest::qWaitForWindowExposed(&page));
    page.activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&page));
    QSignalSpy folder(&page, &ui::StartPage::open_folder);
    QSignalSpy file(&page, &ui::StartPage::open_file);
    QSignalSpy again(&page, &ui::StartPage::recent_chosen);
    QSignalSpy phantom(&page, &ui::StartPage::phantom_chosen);
    int pressed = 0;
    for (int tab = 0; tab < 20; ++tab) {
      QTest::keyClick(page.focusWidget() != nullptr ? page.focusWidget() : &page, Qt::Key_Tab);
      auto* card = qobject_cast<ui::CardButton*>(page.focusWidget());
      if (card == nullptr) continue;
      QVERIFY(!card->accessibleName().isEmpty() && !card->accessibleDescription().isEmpty());
      QTest::keyClick(card, tab % 2 == 0 ? Qt::Key_Return : Qt::Key_Space);
      ++pressed;
    }
    QVERIFY(pressed >= 11);
    QVERIFY(folder.size() >= 1);
    QVERIFY(file.size() >= 1);
    QVERIFY(again.size() >= 1);
    QCOMPARE(again[0][0].value<ui::RecentStudy>().uid, QString("1.2.3"));
    QStringList kinds;
    for (const auto& one : phantom) kinds.push_back(one[0].toString());
    for (const std::string_view kind : imaging::phantom_kinds()) {
      QVERIFY2(kinds.contains(QString::fromUtf8(kind.data(), qsizetype(kind.size()))), kind.data());
    }
  }

  void folders_and_files_can_be_dropped() {
    ui::RecentStudies recent;
    ui::StartPage page(recent);
    QSignalSpy dropped(&page, &ui::StartPage::dropped);
    QMimeData data;
    data.setUrls({QUrl("file:///data/study"), QUrl("https://example.org/x"), QUrl("file:///data/a%20b.nii")});
    QDragEnterEvent enter({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(&page, &enter);
    QVERIFY(enter.isAccepted());
    QDropEvent drop({10, 10}, Qt::CopyAction, &data, Qt::LeftButton, {});
    QCoreApplication::sendEvent(&page, &drop);
    QCOMPARE(dropped.size(), 1);
    QCOMPARE(dropped[0][0].toStringList(), (QStringList{"/data/study", "/data/a b.nii"}));
    QMimeData text;
    text.setText("nothing to open");
    QDragEnterEvent other({10, 10}, Qt::CopyAction, &text, Qt::LeftButton, {});
    other.ignore();
    QCoreApplication::sendEvent(&page, &other);
    QVERIFY(!other.isAccepted());
  }

  void nothing_is_cut_off_when_the_window_is_small_data() {
    QTest::addColumn<double>("type");
    QTest::newRow("normal") << 1.0;
    QTest::newRow("for a projector") << 1.5;
  }
  void nothing_is_cut_off_when_the_window_is_small() {
    QFETCH(double, type);
    const QFont normal = QApplication::font();
    QFont large = normal;
    large.setPointSizeF(type * normal.pointSizeF());
    QApplication::setFont(large);
    const auto back_to_normal = qScopeGuard([&] { QApplication::setFont(normal); });
    ui::RecentStudies recent;
    ui::StartPage page(recent);
    // Room for the longest word of a card beside its picture and its margins.
    const auto has_room = [](const ui::CardButton& card) {
      QFont bold = card.font();
      bold.setWeight(QFont::DemiBold);
      const int room = card.width() - (card.has_picture() ? 92 : 24);
      const auto fits = [room](const QFont& font, const QString& text) {
        const QFontMetrics metrics(font);
        const QStringList words = text.split(' ');
        return std::all_of(words.begin(), words.end(),
                           [&](const QString& word) { return metrics.horizontalAdvance(word) <= room; });
      };
      return fits(bold, card.text()) && fits(card.font(), card.accessibleDescription());
    };
    const auto cut_off = [&] {
      QStringList titles;
      for (const auto* card : page.findChildren<ui::CardButton*>()) {
        const QRect seen(card->mapTo(&page, QPoint(0, 0)), card->size());
        const bool is_whole = seen.left() >= 0 && seen.right() <= page.width() &&
                              card->height() >= card->heightForWidth(card->width()) && has_room(*card);
        if (!is_whole) titles.push_back(card->text());
      }
      return titles;
    };
    page.show();
    for (const int width : {420, 760, 1600}) {
      page.resize(width, 500);
      QVERIFY(QTest::qWaitForWindowExposed(&page));
      QTRY_COMPARE(cut_off(), QStringList());
    }
  }

  void ten_studies_are_remembered_the_latest_first() {
    {
      ui::RecentStudies recent;
      for (int number = 0; number < 12; ++number) {
        recent.add({QString("/data/%1").arg(number), "uid", QString("Study %1").arg(number), {}});
      }
      recent.add({"/data/5", "uid", "Study 5 again", {}});
    }
    const ui::RecentStudies again;
    QCOMPARE(again.list().size(), 10);
    QCOMPARE(again.list()[0].name, QString("Study 5 again"));
    QCOMPARE(again.list()[1].path, QString("/data/11"));
    QCOMPARE(again.list()[9].path, QString("/data/2"));
    QCOMPARE(again.list()[9].uid, QString("uid"));
  }

  // A picture of pixels is sensitive: nobody else reads it, and it goes with its entry.
  void pictures_of_recent_studies_are_private_and_go_with_them() {
    ui::keep_recent_pictures({});
    auto volume = std::make_shared<Volume>();
    volume->geometry.size = {40, 30, 3};
    std::vector<float> values(40 * 30 * 3);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i % 40);
    volume->voxels = std::move(values);
    const ui::RecentStudy study{"/data/DOE^JOHN", "1.2.3", "T1", {}};
    ui::RecentStudies recent;
    QVERIFY(ui::RecentStudies::picture_of(study).isNull());
    recent.add(study);
    recent.add_picture(study, volume, {20.0, 40.0}, 1);
    QTRY_VERIFY_WITH_TIMEOUT(!ui::RecentStudies::picture_of(study).isNull(), 60'000);
    const QImage picture = ui::RecentStudies::picture_of(study);
    QCOMPARE(picture.width(), 128);
    QCOMPARE(picture.height(), 96);
    QVERIFY(picture.pixelColor(2, 50).lightness() + 100 < picture.pixelColor(120, 50).lightness());

    const QDir folder(ui::recent_picture_folder());
    QCOMPARE(folder.entryList(QDir::Files).size(), 1);
    const QFileInfo file(folder.filePath(folder.entryList(QDir::Files).first()));
    QVERIFY(!file.fileName().contains("DOE"));
    struct stat found {};
    QCOMPARE(::stat(QFile::encodeName(file.filePath()).constData(), &found), 0);
    QCOMPARE(found.st_mode & 0777U, 0600U);
    QCOMPARE(::stat(QFile::encodeName(folder.path()).constData(), &found), 0);
    QCOMPARE(found.st_mode & 0777U, 0700U);
    QVERIFY(QImageReader(file.filePath()).textKeys().isEmpty());

    ui::StartPage page(recent);
    const auto cards = page.findChildren<ui::CardButton*>();
    const auto shows_it = [](const ui::CardButton* card) {
      return card->text() == "T1" && card->has_picture();
    };
    QVERIFY(std::any_of(cards.begin(), cards.end(), shows_it));

    recent.clear();
    QCOMPARE(folder.entryList(QDir::Files).size(), 0);
    // Ten others push it out of the list.
    recent.add(study);
    recent.add_picture(study, volume, {20.0, 40.0}, 1);
    QTRY_VERIFY_WITH_TIMEOUT(!ui::RecentStudies::picture_of(study).isNull(), 60'000);
    for (int number = 0; number < 10; ++number) recent.add({QString("/data/%1").arg(number), "u", "S", {}});
    QVERIFY(ui::RecentStudies::picture_of(study).isNull());
    // One that left the list before its picture was made has none.
    recent.add(study);
    recent.add_picture(study, volume, {20.0, 40.0}, 1);
    recent.clear();
    QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
    QCoreApplication::processEvents();
    QCOMPARE(folder.entryList(QDir::Files).size(), 0);
  }

  void how_slices_became_a_grid_is_remembered() {
    const imaging::GridPolicy filled{imaging::GridPolicy::Tilt::keep, imaging::GridPolicy::Gaps::fill};
    {
      ui::RecentStudies recent;
      recent.add({"/data/gaps", "1", "Gaps", filled});
      recent.add({"/data/whole", "2", "Whole", {}});
    }
    ui::RecentStudies again;
    QVERIFY(again.list()[0].policy == imaging::GridPolicy());
    QVERIFY(again.list()[1].policy == filled);
    const std::unique_ptr<QMenu> menu(again.make_menu(nullptr));
    QSignalSpy chosen(&again, &ui::RecentStudies::chosen);
    menu->actions()[1]->trigger();
    QVERIFY(chosen[0][0].value<ui::RecentStudy>().policy == filled);
  }

  void a_study_that_is_gone_is_greyed_and_the_list_can_be_cleared() {
    ui::RecentStudies recent;
    const QString here = QString::fromStdString(settings_.path().string());
    recent.add({here, "1", "Here & now", {}});
    recent.add({"/nowhere/study", "2", "Gone", {}});
    ui::StartPage page(recent);
    page.show();
    const std::unique_ptr<QMenu> menu(recent.make_menu(nullptr));
    QVERIFY(menu->actions()[0]->isEnabled());  // not looked for yet
    emit menu->aboutToShow();
    QTRY_VERIFY_WITH_TIMEOUT(recent.list()[0].missing, 60'000);
    QVERIFY(!recent.list()[1].missing);
    QVERIFY(!menu->actions()[0]->isEnabled());
    QVERIFY(menu->actions()[0]->text().contains("not found"));
    QVERIFY(menu->actions()[1]->text().contains("Here && now"));
    QSignalSpy chosen(&recent, &ui::RecentStudies::chosen);
    menu->actions()[1]->trigger();
    QCOMPARE(chosen.size(), 1);
    QCOMPARE(chosen[0][0].value<ui::RecentStudy>().path, here);
    QCOMPARE(chosen[0][0].value<ui::RecentStudy>().uid, QString("1"));

    auto* clear_all = page.findChild<QToolButton*>("clear_recent");
    QVERIFY(clear_all->isVisible());
    QTest::mouseClick(clear_all, Qt::LeftButton);
    QVERIFY(recent.list().isEmpty());
    QVERIFY(!clear_all->isVisible());
    QCOMPARE(menu->actions().size(), 3);  // "No studies yet", a line, "Clear"
    QVERIFY(!menu->actions()[2]->isEnabled());
    QVERIFY(ui::RecentStudies().list().isEmpty());
  }

  void the_menu_offers_each_phantom_with_a_sentence() {
    ui::PhantomMenu menu;
    QSignalSpy chosen(&menu, &ui::PhantomMenu::chosen);
    QCOMPARE(menu.actions().size(), static_cast<qsizetype>(imaging::phantom_kinds().size()));
    for (const std::string_view kind : imaging::phantom_kinds()) {
      const QString name = QString::fromUtf8(kind.data(), static_cast<qsizetype>(kind.size()));
      auto* action = menu.findChild<QAction*>(name);
      QVERIFY2(action != nullptr, kind.data());
      QVERIFY(action->toolTip().endsWith('.'));
      QVERIFY(action->text() != name);  // a title, not the kind itself
      action->trigger();
      QCOMPARE(chosen.takeFirst()[0].toString(), name);
    }
  }
};

TIDEMARK_TEST(StartPageTest)

}  // namespace tidemark::test::start_page_test

#include "start_page_test.moc"
