// What stands in "About", and that the list of third-party parts is one and the same everywhere.
#include "ui/look/about_dialog.h"

#include <QFile>
#include <QLabel>
#include <QTableWidget>
#include <QTest>

#include "tests/support/test_program.h"
#include "ui/look/theme.h"

namespace tidemark::test::about_dialog_test {

class AboutDialogTest : public QObject {
  Q_OBJECT
 private slots:
  void initTestCase() { ui::apply_theme(*qApp, ui::Theme::dark); }

  void it_says_what_it_must_not_be_used_for() {
    ui::AboutDialog about;
    QCOMPARE(about.findChild<QLabel*>(QStringLiteral("claim"))->text(),
             QStringLiteral("Research use only. Not for diagnostic use."));
  }

  void it_has_the_version_and_the_methods_reference() {
    ui::AboutDialog about;
    QVERIFY(about.findChild<QLabel*>(QStringLiteral("version"))
                ->text()
                .contains(QStringLiteral(TIDEMARK_VERSION)));
    QString all;
    for (const QLabel* label : about.findChildren<QLabel*>()) all += label->text();
    QVERIFY(all.contains(QStringLiteral("A Streaming Narrow-Band Algorithm")));
    QVERIFY(all.contains(QStringLiteral("Apache License 2.0")));
  }

  void every_part_is_listed_in_the_table_and_in_the_documentation() {
    QFile page(QStringLiteral(TIDEMARK_SOURCE "/docs/third-party.md"));
    QVERIFY(page.open(QIODevice::ReadOnly));
    const QString text = QString::fromUtf8(page.readAll());
    ui::AboutDialog about;
    const auto* table = about.findChild<QTableWidget*>(QStringLiteral("parts"));
    const auto parts = ui::third_party_parts();
    QCOMPARE(table->rowCount(), static_cast<int>(parts.size()));
    for (int row = 0; row < table->rowCount(); ++row) {
      const ui::ThirdPartyPart& part = parts[static_cast<std::size_t>(row)];
      QCOMPARE(table->item(row, 0)->text(), QString::fromLatin1(part.name));
      QVERIFY2(text.contains(QStringLiteral("| %1 |").arg(QLatin1String(part.name))), part.name);
    }
  }

  void it_fits_on_a_small_screen_and_closes_with_a_key() {
    ui::AboutDialog about;
    about.show();
    QVERIFY(QTest::qWaitForWindowExposed(&about));
    QVERIFY(about.width() <= 800);
    QVERIFY(about.height() <= 700);
    // TIDEMARK_CONTACT_SHEETS=folder keeps the picture, to be looked at.
    const QString folder = qEnvironmentVariable("TIDEMARK_CONTACT_SHEETS");
    if (!folder.isEmpty()) QVERIFY(about.grab().save(folder + QStringLiteral("/about.png")));
    QTest::keyClick(&about, Qt::Key_Escape);
    QTRY_VERIFY(!about.isVisible());
  }
};

TIDEMARK_TEST(AboutDialogTest)

}  // namespace tidemark::test::about_dialog_test

#include "about_dialog_test.moc"
