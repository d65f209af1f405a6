// The commands under tidemark-cli pacs, with a real archive.
#include <QFile>
#include <QJsonArray>
#include <QTest>
#include <algorithm>

#include "core/atomic_file.h"
#include "imaging/pacs/configuration.h"
#include "imaging/phantom/phantom.h"
#include "tests/app/cli_runner.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/imaging/pacs/scripted_peer.h"
#include "tests/imaging/pacs/wire.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_pacs_test {

class CliPacsTest : public QObject {
  Q_OBJECT

  // The file of servers, for one server.
  static QString servers(const TemporaryFolder& folder, const imaging::PacsServer& server) {
    imaging::PacsConfiguration configuration;
    configuration.servers.push_back(server);
    configuration.limits.free_bytes = 1 << 20;
    const auto file = folder / "pacs.json";
    if (!imaging::write_pacs_configuration(configuration, file)) qFatal("cannot write the file of servers");
    return text(file);
  }

 private slots:
  void a_phantom_goes_there_and_back_data() {
    QTest::addColumn<bool>("by_web");
    QTest::newRow("dcmqrscp") << false;
    QTest::newRow("DICOMweb") << true;
  }
  void a_phantom_goes_there_and_back() {
    QFETCH(bool, by_web);
    const auto archive = by_web ? nullptr : start_dcmqrscp();
    const auto web_archive = by_web ? std::make_unique<WebArchive>(nullptr, "reader") : nullptr;
    const imaging::PacsServer server = by_web ? web_archive->web_server() : archive->server();
    const QString name = QString::fromStdString(server.name);
    const TemporaryFolder folder;
    const QStringList use{"--servers", servers(folder, server), "--json"};
    const Outcome echo = run_cli(QStringList{"pacs", "echo", name} + use);
    QVERIFY2(echo.code == 0, echo.told());
    QVERIFY(json_of(echo.out)["seconds"].toDouble() > 0.0);

    QCOMPARE(run_cli({"phantom", "sphere", "--out", text(folder / "sphere")}).code, 0);
    const Outcome send = run_cli(QStringList{"pacs", "send", name, text(folder / "sphere/series")} + use);
    QVERIFY2(send.code == 0, send.told());
    const int objects = json_of(send.out)["objects"].toInt();
    QVERIFY(objects > 10);

    const Outcome find = run_cli(QStringList{"pacs", "find", name, "--patient-name", "Phan*"} + use);
    QVERIFY2(find.code == 0, find.told());
    const QJsonArray studies = json_of(find.out)["studies"].toArray();
    QCOMPARE(studies.size(), 1);
    QCOMPARE(json_of(find.out)["more"].toBool(true), false);
    const QString study = studies[0].toObject()["uid"].toString();
    const Outcome find_series = run_cli(QStringList{"pacs", "find", name, "--study", study} + use);
    QVERIFY2(find_series.code == 0, find_series.told());
    const QString series = json_of(find_series.out)["series"].toArray()[0].toObject()["uid"].toString();

    const Outcome get = run_cli(QStringList{"pacs", "get", name, "--study", study, "--series", series,
                                            "--out", text(folder / "back")} +
                                use);
    QVERIFY2(get.code == 0, get.told());
    QCOMPARE(json_of(get.out)["objects"].toInt(), objects);
    QCOMPARE(names_in(folder / "back").first(), QString("000001.dcm"));
    const Outcome segment = run_cli(
        {"segment", text(folder / "back"), "--auto-start", "--steps", "1", "--out", text(folder / "m.nrrd")});
    QVERIFY2(segment.code == 0, segment.told());
  }

  void anonymous_copies_are_sent_and_not_kept() {
    const auto archive = start_dcmqrscp();
    const TemporaryFolder folder;
    const QStringList use{"--servers", servers(folder, archive->server()), "--json"};
    QCOMPARE(run_cli({"phantom", "sphere", "--out", text(folder / "sphere")}).code, 0);
    std::filesystem::create_directory(folder / "temporary");
    RunOptions options;
    options.environment.insert("TMPDIR", text(folder / "temporary"));
    const Outcome send =
        run_cli(QStringList{"pacs", "send", "dcmqrscp", text(folder / "sphere/series"), "--deidentify"} + use,
                options);
    QVERIFY2(send.code == 0, send.told());
    const QJsonObject told = json_of(send.out);
    QVERIFY(told["objects"].toInt() > 10);
    QCOMPARE(told["deidentified"].toObject()["files"].toInt(), told["objects"].toInt());
    QCOMPARE(names_in(folder / "temporary"), QStringList());
    const Outcome find = run_cli(QStringList{"pacs", "find", "dcmqrscp"} + use);
    QVERIFY2(find.code == 0, find.told());
    QCOMPARE(json_of(find.out)["studies"].toArray().size(), 1);
    QVERIFY2(!find.out.contains("Phantom") && !find.out.contains("PHANTOM"), find.told());
  }

  void words_for_people_name_the_patient_on_standard_output_alone() {
    const auto archive = start_dcmqrscp();
    const TemporaryFolder folder;
    const QStringList use{"--servers", servers(folder, archive->server()), "--verbose"};
    QCOMPARE(run_cli({"phantom", "sphere", "--out", text(folder / "sphere")}).code, 0);
    const Outcome send =
        run_cli(QStringList{"pacs", "send", "dcmqrscp", text(folder / "sphere/series")} + use);
    QVERIFY2(send.code == 0, send.told());
    const Outcome find = run_cli(QStringList{"pacs", "find", "dcmqrscp"} + use);
    QVERIFY2(find.out.contains("Phantom") && find.out.contains("1 studies"), find.told());
    for (const Outcome& outcome : {send, find}) {
      QVERIFY2(!outcome.err.contains("PHANTOM") && !outcome.err.contains("Phantom"), outcome.told());
    }
  }

  void failures_end_with_their_code_and_one_line_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("code");
    QTest::addColumn<QByteArray>("said");
    QTest::newRow("no command") << QStringList{} << 2 << QByteArray("pacs --help");
    QTest::newRow("unknown command") << QStringList{"fetch"} << 2 << QByteArray();
    QTest::newRow("unknown server")
        << QStringList{"echo", "nobody"} << 2
        << QByteArray("there is no PACS server 'nobody': those that are configured are peer");
    QTest::newRow("nobody answers") << QStringList{"echo", "peer"} << 3 << QByteArray("Connection refused");
    QTest::newRow("no date") << QStringList{"find", "peer", "--from", "yesterday"} << 2
                             << QByteArray("'yesterday' is no date");
    QTest::newRow("name of a study") << QStringList{"find", "peer", "--study", "1.2", "--patient-name", "x"}
                                     << 2 << QByteArray("excludes");
    QTest::newRow("no UID") << QStringList{"get", "peer", "--study", "../x", "--out", "new"} << 2
                            << QByteArray("'../x' is no UID");
    QTest::newRow("no study") << QStringList{"get", "peer", "--out", "new"} << 2 << QByteArray("--study");
    QTest::newRow("nothing to send") << QStringList{"send", "peer", "none.dcm"} << 3
                                     << QByteArray("no such file");
  }
  void failures_end_with_their_code_and_one_line() {
    QFETCH(QStringList, arguments);
    QFETCH(int, code);
    QFETCH(QByteArray, said);
    const TemporaryFolder folder;
    const QString file = servers(folder, ScriptedPeer([](PeerEnd&) {}).server());
    if (!arguments.isEmpty()) arguments += {"--servers", file};
    const Outcome outcome = run_cli(QStringList{"pacs"} + arguments, {.folder = text(folder.path())});
    QVERIFY2(outcome.failed_in_one_line(code), outcome.told());
    QVERIFY2(outcome.err.contains(said), outcome.told());
    QCOMPARE(names_in(folder.path()), QStringList{"pacs.json"});
  }

  void files_that_may_not_be_opened_are_named() {
    const TemporaryFolder folder;
    const QString file = servers(folder, ScriptedPeer([](PeerEnd&) {}).server());
    std::filesystem::create_directory(folder / "series");
    QVERIFY(write_file(folder / "series/closed.dcm", "x"));
    std::filesystem::permissions(folder / "series/closed.dcm", std::filesystem::perms::none);
    const Outcome outcome = run_cli({"pacs", "send", "peer", text(folder / "series"), "--servers", file},
                                    {.is_privileged = false});
    QVERIFY2(outcome.code == 3, outcome.told());
    QVERIFY2(outcome.err.contains("closed.dcm: was not sent: cannot be read: Permission denied"),
             outcome.told());
    QVERIFY2(outcome.err.contains("1 of 1 files were not sent"), outcome.told());
  }

  void the_usual_file_of_servers_is_taken() {
    const TemporaryFolder folder;
    RunOptions options;
    options.environment.insert("XDG_CONFIG_HOME", text(folder.path()));
    const Outcome none = run_cli({"pacs", "echo", "peer"}, options);
    QVERIFY2(none.failed_in_one_line(3) && none.err.contains("tidemark/pacs.json: no such file"),
             none.told());
    imaging::PacsConfiguration configuration;
    configuration.servers.push_back(ScriptedPeer([](PeerEnd&) {}).server());
    QCOMPARE(failure(imaging::write_pacs_configuration(configuration, folder / "tidemark/pacs.json")),
             QString());
    const Outcome refused = run_cli({"pacs", "echo", "peer"}, options);
    QVERIFY2(refused.failed_in_one_line(3) && refused.err.contains("Connection refused"), refused.told());

    // A site that locks its servers leaves no other.
    options.environment.insert("TIDEMARK_SITE", text(folder / "site"));
    std::filesystem::create_directories(folder / "site");
    QCOMPARE(failure(write_file(folder / "site/pacs.json", R"({"servers": [], "locked": true})")), QString());
    const Outcome not_there = run_cli({"pacs", "echo", "peer"}, options);
    QVERIFY2(not_there.failed_in_one_line(2) && not_there.err.contains("none is configured"),
             not_there.told());
    const Outcome locked =
        run_cli({"pacs", "echo", "peer", "--servers", text(folder / "tidemark/pacs.json")}, options);
    QVERIFY2(locked.failed_in_one_line(2) && locked.err.contains("the site has locked its servers"),
             locked.told());
  }

  void what_did_not_come_ends_with_3_and_what_came_stays() {
    const ScriptedPeer peer([](PeerEnd& end) {
      end.accept_call();
      end.read_command();
      const int ct = end.context(kCt);
      end.send_command(ct, store_request(1, kCt, "1.2.5"));
      end.send_data(ct, object(kCt, "1.2.5", "1.2.3", "1.2.3.4"));
      end.read_command();
      const std::string counts = short_attribute(0, 0x1021, 1) + short_attribute(0, 0x1022, 2);
      end.send_command(1, response(kGetResponse, 1, 0xb000, false, counts));
      end.read_command();
    });
    const TemporaryFolder folder;
    const Outcome get = run_cli({"pacs", "get", "peer", "--study", "1.2.3", "--out", text(folder / "in"),
                                 "--json", "--servers", servers(folder, peer.server())});
    QVERIFY2(get.failed_in_one_line(3) && get.err.contains("2 objects could not be sent"), get.told());
    QCOMPARE(json_of(get.out)["missing"].toInt(), 2);
    QCOMPARE(names_in(folder / "in"), QStringList{"000001.dcm"});
  }

  void an_interrupt_ends_a_retrieval_with_130_and_leaves_nothing() {
    std::atomic<bool> is_waiting = false;
    const ScriptedPeer peer([&](PeerEnd& end) {
      end.accept_call();
      end.read_command();
      end.send_command(end.context(kCt), store_request(1, kCt, "1.2.5"));
      end.send_data(end.context(kCt), std::string(100'000, '\0'), false);
      is_waiting = true;
      end.say_nothing();
    });
    imaging::PacsServer server = peer.server();
    server.timeout_seconds = 600;
    const TemporaryFolder folder;
    QProcess process;
    process.start(cli_program(), {"pacs", "get", "peer", "--study", "1.2.3", "--out", text(folder / "in"),
                                  "--servers", servers(folder, server)});
    QTRY_VERIFY_WITH_TIMEOUT(is_waiting.load(), 60'000);
    QTest::qWait(200);
    const auto collected = [&] {  // beside the folder, under a temporary name
      const auto entries = std::filesystem::directory_iterator(folder.path());
      return std::count_if(begin(entries), end(entries), [](const auto& entry) {
        return std::filesystem::exists(entry.path() / "000001.dcm");
      });
    };
    QCOMPARE(collected(), 1);
    QVERIFY(!std::filesystem::exists(folder / "in"));
    process.terminate();
    QVERIFY(process.waitForFinished(2000));
    QCOMPARE(process.exitCode(), 130);
    QCOMPARE(collected(), 0);
    QCOMPARE(names_in(folder.path()), QStringList{"pacs.json"});
  }
};

TIDEMARK_TEST(CliPacsTest)

}  // namespace tidemark::test::cli_pacs_test

#include "cli_pacs_test.moc"
