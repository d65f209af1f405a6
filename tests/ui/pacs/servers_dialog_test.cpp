// The servers, entered, tested, kept and removed by hand.
#include "ui/pacs/servers_dialog.h"

#include <fmt/format.h>

#include <QDialogButtonBox>
#include <QListWidget>
#include <QTest>
#include <QToolButton>

#include "core/atomic_file.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/support/test_program.h"

namespace tidemark::test::servers_dialog_test {

namespace {

constexpr int kPatience = 30'000;

QLineEdit* line(ui::ServersDialog& dialog, const QString& name) {
  for (QLineEdit* one : dialog.findChildren<QLineEdit*>()) {
    if (one->accessibleName() == name) return one;
  }
  qFatal("no line %s", qPrintable(name));
}

QComboBox* choice(ui::ServersDialog& dialog, const QString& name) {
  for (QComboBox* one : dialog.findChildren<QComboBox*>()) {
    if (one->accessibleName() == name) return one;
  }
  qFatal("no choice %s", qPrintable(name));
}

void click_test(ui::ServersDialog& dialog) {
  for (QPushButton* button : dialog.findChildren<QPushButton*>()) {
    if (button->text() == "&Test") QTest::mouseClick(button, Qt::LeftButton);
  }
}

void click_save(ui::ServersDialog& dialog) {
  QTest::mouseClick(dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save), Qt::LeftButton);
}

bool says(ui::ServersDialog& dialog, const QString& text) {
  const auto labels = dialog.findChildren<QLabel*>();
  return std::any_of(labels.begin(), labels.end(),
                     [&](const QLabel* label) { return label->text().contains(text); });
}

}  // namespace

class ServersDialogTest : public QObject {
  Q_OBJECT

 private slots:
  void a_server_is_entered_tested_and_kept() {
    const StoringPeer peer({"+xa"});
    const TemporaryFolder folder;
    const auto file = folder / "tidemark/pacs.json";
    ui::ServersDialog dialog(file);
    dialog.show();
    line(dialog, "Name")->setText("here");
    line(dialog, "Host")->setText("localhost");
    line(dialog, "AE title")->setText("STORESCP");
    for (auto* box : dialog.findChildren<QDoubleSpinBox*>()) {
      if (box->accessibleName() == "Port") box->setValue(peer.server().port);
    }
    click_test(dialog);
    QTRY_VERIFY_WITH_TIMEOUT(says(dialog, "The server answers in"), kPatience);
    if (const QString pictures = qEnvironmentVariable("TIDEMARK_SCREENSHOTS"); !pictures.isEmpty())
      QVERIFY(dialog.grab().save(pictures + "/servers.png"));
    click_save(dialog);
    QCOMPARE(dialog.result(), static_cast<int>(QDialog::Accepted));
    const auto read = imaging::read_pacs_configuration(file);
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->servers.size(), std::size_t{1});
    QCOMPARE(read->servers[0].name, std::string("here"));
    QCOMPARE(read->servers[0].port, peer.server().port);
    QVERIFY(!read->servers[0].tls);
  }

  void a_server_of_dicomweb_is_entered_tested_and_kept() {
    const WebArchive archive(nullptr, "reader");
    const imaging::WebAccess web = *archive.web_server().web;
    const TemporaryFolder folder;
    const auto file = folder / "pacs.json";
    ui::ServersDialog dialog(file);
    dialog.show();
    QVERIFY(line(dialog, "Host")->isVisible() && !line(dialog, "Address")->isVisible());
    line(dialog, "Name")->setText("web");
    choice(dialog, "Protocol")->setFocus();
    QTest::keyClick(choice(dialog, "Protocol"), Qt::Key_Down);
    QVERIFY(!line(dialog, "Host")->isVisible() && line(dialog, "Address")->isVisible());
    click_save(dialog);
    QVERIFY(says(dialog, "url: is no address"));
    QTest::keyClicks(line(dialog, "Address"), QString::fromStdString(web.url));
    QTest::keyClicks(line(dialog, "User"), QString::fromStdString(web.user));
    click_test(dialog);
    QTRY_VERIFY_WITH_TIMEOUT(says(dialog, "user: has no secret"), kPatience);
    QTest::keyClicks(line(dialog, "Secret"), QString::fromStdString(web.secret.string()));
    click_test(dialog);
    QTRY_VERIFY_WITH_TIMEOUT(says(dialog, "The server answers in"), kPatience);
    if (const QString pictures = qEnvironmentVariable("TIDEMARK_SCREENSHOTS"); !pictures.isEmpty())
      QVERIFY(dialog.grab().save(pictures + "/servers-web.png"));
    click_save(dialog);
    QCOMPARE(dialog.result(), static_cast<int>(QDialog::Accepted));
    const auto read = imaging::read_pacs_configuration(file);
    QCOMPARE(failure(read), QString());
    QVERIFY(read->servers.size() == 1 && read->servers[0].web == web);

    ui::ServersDialog again(file);
    again.show();
    QCOMPARE(line(again, "Address")->text(), QString::fromStdString(web.url));
    QVERIFY(!line(again, "Host")->isVisible());
  }

  void a_port_that_is_no_number_is_not_kept_as_another() {
    const TemporaryFolder folder;
    ui::ServersDialog dialog(folder / "pacs.json");
    dialog.show();
    line(dialog, "Name")->setText("here");
    line(dialog, "Host")->setText("localhost");
    line(dialog, "AE title")->setText("STORESCP");
    for (auto* box : dialog.findChildren<QDoubleSpinBox*>()) {
      if (box->accessibleName() != "Port") continue;
      box->setFocus();
      box->selectAll();
      QTest::keyClicks(box, "11.112");
    }
    click_save(dialog);
    QVERIFY(dialog.isVisible());
    QVERIFY(says(dialog, "11.112 is no whole number"));
    QVERIFY(!std::filesystem::exists(folder / "pacs.json"));
  }

  void what_makes_no_sense_is_said_and_not_kept() {
    const TemporaryFolder folder;
    ui::ServersDialog dialog(folder / "pacs.json");
    dialog.show();
    line(dialog, "Name")->setText("here");
    click_save(dialog);
    QVERIFY(dialog.isVisible());
    QVERIFY(says(dialog, "host: is neither a host name nor an IPv4 address"));
    QVERIFY(!std::filesystem::exists(folder / "pacs.json"));
  }

  void servers_are_removed_and_the_others_stay_as_they_were() {
    const TemporaryFolder folder;
    imaging::PacsConfiguration configuration;
    for (const char* name : {"a", "b", "c"})
      configuration.servers.push_back(
          {.name = name, .host = name, .ae_title = name, .tls = imaging::TlsFiles{"/ca.pem", {}, {}, true}});
    QCOMPARE(failure(imaging::write_pacs_configuration(configuration, folder / "pacs.json")), QString());
    ui::ServersDialog dialog(folder / "pacs.json");
    dialog.show();
    auto* list = dialog.findChild<QListWidget*>();
    auto* remove = dialog.findChild<QToolButton*>("remove-server");
    list->setCurrentRow(1);
    QCOMPARE(line(dialog, "Host")->text(), QString("b"));
    QTest::mouseClick(remove, Qt::LeftButton);
    QCOMPARE(list->count(), 2);
    list->setCurrentRow(0);
    QTest::mouseClick(remove, Qt::LeftButton);
    QCOMPARE(line(dialog, "Host")->text(), QString("c"));
    click_save(dialog);
    const auto read = imaging::read_pacs_configuration(folder / "pacs.json");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->servers.size(), std::size_t{1});
    QVERIFY(read->servers[0] == configuration.servers[2]);
  }

  void a_file_that_cannot_be_read_is_not_replaced() {
    const TemporaryFolder folder;
    const auto file = folder / "pacs.json";
    QCOMPARE(failure(write_file(file, R"({"servers": [{"name": "a", "hots": "b"}]})")), QString());
    ui::ServersDialog dialog(file);
    dialog.show();
    QVERIFY(says(dialog, "hots"));
    line(dialog, "Host")->setText("c");
    line(dialog, "AE title")->setText("C");
    QVERIFY(!dialog.findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save)->isEnabled());
    QTest::keyClick(&dialog, Qt::Key_Return);
    click_save(dialog);
    QVERIFY(dialog.isVisible());
    QVERIFY(!imaging::read_pacs_configuration(file));
  }

  void servers_that_the_site_has_locked_are_shown_and_not_changed() {
    const StoringPeer peer({"+xa"});
    const TemporaryFolder folder;
    const Variable site("TIDEMARK_SITE", QByteArray::fromStdString(folder.path().string()));
    const std::string locked = fmt::format(
        R"({{"locked": true, "servers": [{{"name": "ward", "host": "localhost", "port": {}, "ae_title": "STORESCP"}},
            {{"name": "other", "host": "o", "ae_title": "O", "retrieve": "move"}}]}})",
        peer.server().port);
    QCOMPARE(failure(write_file(folder / "pacs.json", locked)), QString());
    const auto own = folder / "own.json";
    QCOMPARE(failure(write_file(own, R"({"servers": []})")), QString());
    ui::ServersDialog dialog(own);
    dialog.show();
    QVERIFY(says(dialog, "The administrator of this machine has fixed the servers."));
    auto* list = dialog.findChild<QListWidget*>();
    for (int row = list->count() - 1; row >= 0; --row) {
      list->setCurrentRow(row);
      for (const QLineEdit* one : dialog.findChildren<QLineEdit*>()) QVERIFY(!one->isEnabled());
      for (const QComboBox* one : dialog.findChildren<QComboBox*>()) QVERIFY(!one->isEnabled());
    }
    QCOMPARE(line(dialog, "Name")->text(), QString("ward"));
    click_test(dialog);
    QTRY_VERIFY_WITH_TIMEOUT(says(dialog, "The server answers in"), kPatience);
    for (const char* name : {"add-server", "remove-server"})
      QTest::mouseClick(dialog.findChild<QToolButton*>(name), Qt::LeftButton);
    QCOMPARE(list->count(), 2);
    QTest::keyClick(&dialog, Qt::Key_Return);
    click_save(dialog);
    QVERIFY(dialog.isVisible());
    QCOMPARE(bytes_of(own), QByteArray(R"({"servers": []})"));
  }
};

TIDEMARK_TEST(ServersDialogTest)

}  // namespace tidemark::test::servers_dialog_test

#include "servers_dialog_test.moc"
