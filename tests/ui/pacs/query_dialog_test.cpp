// A user asks an archive for a study, unfolds it, and opens a series; or gives up.
#include "ui/pacs/query_dialog.h"

#include <QComboBox>
#include <QFile>
#include <QLabel>
#include <QSettings>
#include <QSignalSpy>
#include <QTreeWidget>

#include "imaging/load_study.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/support/test_program.h"
#include "ui/look/theme.h"

namespace tidemark::test::query_dialog_test {

namespace {

constexpr int kPatience = 30'000;

template <class Part>
Part* named(QWidget& whole, const QString& accessible_name) {
  for (Part* part : whole.findChildren<Part*>()) {
    if (part->accessibleName() == accessible_name) return part;
  }
  return nullptr;
}

QPushButton* button(QWidget& whole, const QString& text) {
  for (QPushButton* one : whole.findChildren<QPushButton*>()) {
    if (QString(one->text()).remove('&') == text) return one;
  }
  return nullptr;
}

// A dialog that knows servers and keeps what comes in a folder.
struct Asked {
  explicit Asked(const imaging::PacsServer& server) : Asked(std::vector{server}) {}
  explicit Asked(const std::vector<imaging::PacsServer>& servers) {
    QSettings().clear();
    imaging::PacsConfiguration configuration;
    configuration.servers = servers;
    configuration.limits.free_bytes = 1 << 20;
    const auto file = folder / "pacs.json";
    if (!imaging::write_pacs_configuration(configuration, file)) qFatal("cannot write the file of servers");
    dialog = std::make_unique<ui::QueryDialog>(file);
    dialog->set_folder(QString::fromStdString((folder / "kept").string()));
    dialog->show();
  }
  QTreeWidget& tree() const { return *named<QTreeWidget>(*dialog, "Studies found"); }

  TemporaryFolder folder;
  std::unique_ptr<ui::QueryDialog> dialog;
};

void picture(QWidget& widget, const char* name) {
  if (const QString folder = qEnvironmentVariable("TIDEMARK_SCREENSHOTS"); !folder.isEmpty())
    QVERIFY(widget.grab().save(folder + "/" + name + ".png"));
}

}  // namespace

class QueryDialogTest : public QObject {
  Q_OBJECT

 private slots:
  void a_series_is_found_and_opened() {
    const auto archive = start_dcmqrscp();
    const Volume volume = sample_volume({16, 16, 4});
    const TemporaryFolder sent;
    QCOMPARE(failure(imaging::send_files(archive->server(), write_series(volume, sent / "a"))), QString());
    QCOMPARE(failure(imaging::send_files(archive->server(), write_series(volume, sent / "b", "MR"))),
             QString());

    const Asked asked(archive->server());
    QSignalSpy retrieved(asked.dialog.get(), &ui::QueryDialog::retrieved);
    named<QLineEdit>(*asked.dialog, "Patient's name")->setText("Phan*");
    QVERIFY(!button(*asked.dialog, "Open")->isEnabled());
    QTest::mouseClick(button(*asked.dialog, "Search"), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(asked.tree().topLevelItemCount(), 2, kPatience);
    asked.tree().topLevelItem(0)->setExpanded(true);
    QTRY_COMPARE_WITH_TIMEOUT(asked.tree().topLevelItem(0)->childCount(), 1, kPatience);
    QTreeWidgetItem* series = asked.tree().topLevelItem(0)->child(0);
    QVERIFY(series->text(3) == "CT" || series->text(3) == "MR");
    asked.tree().setCurrentItem(series);
    picture(*asked.dialog, "query-found");
    QTRY_VERIFY_WITH_TIMEOUT(button(*asked.dialog, "Open")->isEnabled(), kPatience);
    QTest::mouseClick(button(*asked.dialog, "Open"), Qt::LeftButton);
    QVERIFY(retrieved.wait(kPatience));
    const auto loaded = imaging::load_volume(retrieved.front().front().toString().toStdString());
    QCOMPARE(failure(loaded), QString());
    QVERIFY(loaded->values() == volume.values());
  }

  void what_comes_goes_to_the_sites_folder_where_that_is_locked() {
    const TemporaryFolder site;
    const Variable variable("TIDEMARK_SITE", QByteArray::fromStdString(site.path().string()));
    const QString studies = QString::fromStdString((site / "studies").string());
    QFile file(QString::fromStdString((site / "tidemark.conf").string()));
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write("[General]\nlocked=pacs/folder\n[pacs]\nfolder=" + studies.toUtf8() + "\n");
    file.close();
    const auto archive = start_dcmqrscp();
    const TemporaryFolder sent;
    QCOMPARE(
        failure(imaging::send_files(archive->server(), write_series(sample_volume({4, 4, 2}), sent / "a"))),
        QString());

    const Asked asked(archive->server());
    auto* keep_in = named<QLineEdit>(*asked.dialog, "Folder for what comes");
    QVERIFY(!keep_in->isEnabled());
    QVERIFY(!keep_in->toolTip().isEmpty());
    QVERIFY(!button(*asked.dialog, "Choose…")->isEnabled());
    QSignalSpy retrieved(asked.dialog.get(), &ui::QueryDialog::retrieved);
    QTest::mouseClick(button(*asked.dialog, "Search"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(button(*asked.dialog, "Open")->isEnabled(), kPatience);
    QTest::mouseClick(button(*asked.dialog, "Open"), Qt::LeftButton);
    QVERIFY(retrieved.wait(kPatience));
    QVERIFY(retrieved.front().front().toString().startsWith(studies + "/"));
    QVERIFY(!std::filesystem::exists(asked.folder / "kept"));
  }

  void a_link_asks_for_its_study_and_brings_nothing() {
    const auto archive = start_dcmqrscp();
    const TemporaryFolder sent;
    for (const char* name : {"a", "b"}) {
      QCOMPARE(failure(imaging::send_files(archive->server(),
                                           write_series(sample_volume({4, 4, 2}), sent / name))),
               QString());
    }
    imaging::PacsServer other = archive->server();
    other.name = "another";
    other.port = 1;
    const Asked asked({other, archive->server()});
    QSignalSpy retrieved(asked.dialog.get(), &ui::QueryDialog::retrieved);
    const QString name = QString::fromStdString(archive->server().name);
    named<QLineEdit>(*asked.dialog, "Patient's name")->setText("Nobody");  // from a question before
    const auto all = imaging::find_studies(archive->server(), {}, {}, {});
    QVERIFY(all && all->entries.size() == 2);
    imaging::StudyQuery query;
    query.uid = all->entries[1].uid;
    QCOMPARE(failure(asked.dialog->ask(name, query)), QString());
    QVERIFY(failure(asked.dialog->ask(name, query)).contains("is being asked"));
    QTRY_COMPARE_WITH_TIMEOUT(asked.tree().topLevelItemCount(), 1, kPatience);
    QCOMPARE(asked.tree().topLevelItem(0)->data(0, Qt::UserRole).toString().toStdString(), query.uid);
    QCOMPARE(named<QComboBox>(*asked.dialog, "Server")->currentText(), name);
    QVERIFY(named<QLineEdit>(*asked.dialog, "Patient's name")->text().isEmpty());
    QTRY_VERIFY_WITH_TIMEOUT(button(*asked.dialog, "Open")->isEnabled(), kPatience);
    QCOMPARE(retrieved.count(), 0);
    QVERIFY(failure(asked.dialog->ask("nowhere", query)).contains("there is no server nowhere"));
  }

  void what_one_server_has_found_goes_when_another_is_chosen() {
    const auto archive = start_dcmqrscp();
    const TemporaryFolder sent;
    const Volume volume = sample_volume({4, 4, 2});
    QCOMPARE(failure(imaging::send_files(archive->server(), write_series(volume, sent / "a"))), QString());
    imaging::PacsServer other = archive->server();
    other.name = "another";
    const Asked asked({archive->server(), other});
    QTest::mouseClick(button(*asked.dialog, "Search"), Qt::LeftButton);
    QTRY_COMPARE_WITH_TIMEOUT(asked.tree().topLevelItemCount(), 1, kPatience);
    QTRY_VERIFY_WITH_TIMEOUT(button(*asked.dialog, "Open")->isEnabled(), kPatience);
    named<QComboBox>(*asked.dialog, "Server")->setCurrentIndex(1);
    QCOMPARE(asked.tree().topLevelItemCount(), 0);
    QVERIFY(!button(*asked.dialog, "Open")->isEnabled());
    QVERIFY(button(*asked.dialog, "Search")->isEnabled());
  }

  void a_server_that_is_not_there_is_told_of_and_one_may_ask_again() {
    const Asked asked(ScriptedPeer([](PeerEnd&) {}).server());
    QTest::mouseClick(button(*asked.dialog, "Search"), Qt::LeftButton);
    QTRY_VERIFY_WITH_TIMEOUT(button(*asked.dialog, "Search")->isEnabled(), kPatience);
    bool told = false;
    for (const QLabel* label : asked.dialog->findChildren<QLabel*>())
      told = told || label->text().contains("Connection refused");
    QVERIFY(told);
    picture(*asked.dialog, "query-refused");
  }

  void a_silent_server_is_given_up_by_a_click() {
    const ScriptedPeer peer([](PeerEnd& end) { end.say_nothing(); });
    imaging::PacsServer server = peer.server();
    server.timeout_seconds = 600;
    const Asked asked(server);
    QTest::mouseClick(button(*asked.dialog, "Search"), Qt::LeftButton);
    QVERIFY(button(*asked.dialog, "Cancel")->isVisible());
    QVERIFY(!button(*asked.dialog, "Search")->isEnabled());
    QTest::qWait(200);
    QTest::mouseClick(button(*asked.dialog, "Cancel"), Qt::LeftButton);
    QVERIFY(button(*asked.dialog, "Search")->isEnabled());
    QVERIFY(!button(*asked.dialog, "Cancel")->isVisible());
  }

  void it_is_closed_while_it_asks() {
    const ScriptedPeer peer([](PeerEnd& end) { end.say_nothing(); });
    imaging::PacsServer server = peer.server();
    server.timeout_seconds = 600;
    Asked asked(server);
    QTest::mouseClick(button(*asked.dialog, "Search"), Qt::LeftButton);
    asked.dialog.reset();
    QTest::qWait(100);
  }

  void without_a_server_it_says_how_to_name_one() {
    const TemporaryFolder folder;
    QVERIFY(imaging::write_pacs_configuration({}, folder / "all-removed.json"));
    for (const char* file : {"none.json", "all-removed.json"}) {
      ui::QueryDialog dialog(folder / file);
      dialog.show();
      QVERIFY(!button(dialog, "Search")->isEnabled());
      bool told = false;
      for (const QLabel* label : dialog.findChildren<QLabel*>())
        told = told || label->text().startsWith("There is no server yet");
      QVERIFY(told);
      picture(dialog, "query-no-server");
    }
  }
};

TIDEMARK_TEST(QueryDialogTest)

}  // namespace tidemark::test::query_dialog_test

#include "query_dialog_test.moc"
