// Whose value counts: the user's, the site's, the program's.
#include "ui/settings.h"

#include <QDir>
#include <QFile>
#include <QScopeGuard>
#include <QTest>

#include "tests/support/support.h"
#include "tests/support/test_program.h"
#include "ui/look/theme.h"
#include "ui/main/case_window.h"

namespace tidemark::test::settings_test {

class SettingsTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    folder_ = std::make_unique<TemporaryFolder>();
    const QString path = QString::fromStdString(folder_->path().string());
    QSettings::setDefaultFormat(QSettings::IniFormat);
    QSettings::setPath(QSettings::IniFormat, QSettings::UserScope, path + "/user");
    qputenv("TIDEMARK_SITE", path.toUtf8());
  }
  void cleanup() { qunsetenv("TIDEMARK_SITE"); }

  void without_a_file_the_programs_value_counts_until_the_user_has_one() {
    QCOMPARE(ui::settings::layout().get(), ui::ViewLayout::paper);
    QVERIFY(!ui::settings::language().is_set());
    ui::settings::layout().set(ui::ViewLayout::single);
    QCOMPARE(ui::settings::layout().get(), ui::ViewLayout::single);
    QCOMPARE(QSettings().value("layout").toString(), QStringLiteral("single"));
  }

  void the_sites_value_comes_before_the_programs_and_behind_the_users() {
    site("[General]\ntheme=dark\n[pacs]\nfolder=/srv/studies\n");
    QCOMPARE(ui::settings::theme().get(), ui::Theme::dark);
    QCOMPARE(ui::settings::retrieval_folder().get(), QStringLiteral("/srv/studies"));
    ui::settings::theme().set(ui::Theme::light);
    QCOMPARE(ui::settings::theme().get(), ui::Theme::light);
    QCOMPARE(ui::origin_of("theme"), ui::SettingOrigin::user);
    QCOMPARE(ui::origin_of("pacs/folder"), ui::SettingOrigin::site);
  }

  void what_is_locked_is_the_sites() {
    QSettings().setValue("theme", "light");
    QSettings().setValue("pacs/folder", "/home");
    site("[General]\ntheme=dark\nlanguage=de\nlocked=theme, pacs/folder, pacs/server\n[pacs]\nfolder=/srv\n");
    QVERIFY(ui::is_locked("theme") && ui::is_locked("pacs/folder") && !ui::is_locked("language"));
    QCOMPARE(ui::settings::theme().get(), ui::Theme::dark);
    ui::settings::theme().set(ui::Theme::light);
    QCOMPARE(ui::settings::theme().get(), ui::Theme::dark);
    QCOMPARE(ui::settings::retrieval_folder().get(), QStringLiteral("/srv"));
    // The site says that it is locked, but not to what.
    QVERIFY(!ui::is_locked("pacs/server"));
    ui::settings::server().set("archive");
    QCOMPARE(ui::settings::server().get(), QStringLiteral("archive"));
  }

  void an_enumeration_is_a_word_or_the_number_that_it_once_was() {
    for (const auto& [kept, theme] :
         {std::pair("dark", ui::Theme::dark), std::pair("1", ui::Theme::light),
          std::pair("7", ui::Theme::system), std::pair("red", ui::Theme::system)}) {
      QSettings().setValue("theme", kept);
      QCOMPARE(ui::settings::theme().get(), theme);
    }
  }

  void dialogs_for_files_begin_in_the_users_documents() {
    const TemporaryFolder home;
    const auto back = qScopeGuard([before = qgetenv("HOME")] { qputenv("HOME", before); });
    qputenv("HOME", QByteArray::fromStdString(home.path().string()));
    const QString folder = QDir::homePath();
    QCOMPARE(folder, QString::fromStdString(home.path().string()));
    QCOMPARE(ui::settings::open_folder().get(), folder);  // without one
    QVERIFY(QDir(folder).mkdir("Documents"));
    QCOMPARE(ui::settings::open_folder().get(), folder + "/Documents");
    QCOMPARE(ui::settings::save_folder().get(), folder + "/Documents");
    ui::settings::save_folder().set("/elsewhere");
    QCOMPARE(ui::settings::save_folder().get(), QStringLiteral("/elsewhere"));
  }

  void what_is_printed_can_be_a_sites_file() {
    site("[General]\ntheme=dark\nlocked=theme\n");
    ui::settings::layout().set(ui::ViewLayout::two_two);
    ui::settings::save_folder().set("/home/masks, old; \"a\"\\b");
    const QString printed = ui::settings::print();
    QVERIFY2(printed.contains("; the site's, locked\ntheme=dark\n"), qPrintable(printed));
    QVERIFY2(printed.contains("; the user's\nlayout=two-two\n"), qPrintable(printed));
    QVERIFY2(printed.contains("; the program's\nlanguage=\n"), qPrintable(printed));
    site(printed.toUtf8());
    QSettings().clear();
    QCOMPARE(ui::settings::layout().get(), ui::ViewLayout::two_two);
    QCOMPARE(ui::settings::save_folder().get(), QStringLiteral("/home/masks, old; \"a\"\\b"));
    QVERIFY(ui::is_locked("theme"));
    QCOMPARE(ui::settings::theme().get(), ui::Theme::dark);
  }

 private:
  void site(const QByteArray& text) {
    QFile file(ui::settings::site_file());
    QVERIFY(file.open(QIODevice::WriteOnly | QIODevice::Truncate));
    file.write(text);
  }

  std::unique_ptr<TemporaryFolder> folder_;
};

TIDEMARK_TEST(SettingsTest)

}  // namespace tidemark::test::settings_test

#include "settings_test.moc"
