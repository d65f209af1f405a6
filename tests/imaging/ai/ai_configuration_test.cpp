// The file of servers with models: where it lies, what it says, and what is wrong in it.
#include <QTest>
#include <algorithm>

#include "core/atomic_file.h"
#include "imaging/ai/ai_server.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::ai_configuration_test {

namespace {

// With the quotes of JSON instead of single ones.
std::string json(std::string text) {
  std::ranges::replace(text, '\'', '"');
  return text;
}

}  // namespace

class AiConfigurationTest : public QObject {
  Q_OBJECT

 private slots:
  void all_fields_are_read() {
    const TemporaryFolder folder;
    QCOMPARE(
        failure(write_file(
            folder / "ai.json",
            json("{'servers': [ "
                 "{'name': 'ward', 'protocol': 'monai-label', 'url': 'https://ai.example:8000', 'user': 'u', "
                 "'secret': 'secret.txt', 'timeout_seconds': 900, 'tls': {'ca': 'ca.pem'}}, "
                 "{'name': 'here', 'protocol': 'dls', 'url': 'http://localhost:8911'}]}"))),
        QString());
    const auto read = imaging::read_ai_configuration(folder / "ai.json");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->servers.size(), std::size_t{2});
    const imaging::AiServer& ward = read->servers[0];
    QCOMPARE(ward.protocol, imaging::AiServer::Protocol::monai_label);
    QCOMPARE(ward.access.secret, folder / "secret.txt");
    QCOMPARE(ward.tls->ca, folder / "ca.pem");
    QCOMPARE(ward.timeout_seconds, 900);
    QVERIFY(ward.is_encrypted() && !ward.is_on_this_machine());
    const imaging::AiServer& here = read->servers[1];
    QCOMPARE(here.protocol, imaging::AiServer::Protocol::dls);
    QCOMPARE(here.timeout_seconds, 300);
    QVERIFY(!here.is_encrypted() && here.is_on_this_machine());
    const auto unknown = read->server("nobody");
    QCOMPARE(failure(unknown),
             QString("there is no AI server 'nobody': those that are configured are ward, here"));
  }

  void what_is_wrong_is_named_data() {
    QTest::addColumn<QByteArray>("server");
    QTest::addColumn<QString>("said");
    QTest::newRow("no protocol") << QByteArray("'url': 'https://h'") << "servers[0].protocol: is missing";
    QTest::newRow("another protocol")
        << QByteArray("'url': 'https://h', 'protocol': 'dss'") << "servers[0].protocol: 'dss' is unknown";
    QTest::newRow("no address") << QByteArray("'protocol': 'dls'") << "servers[0].url: is missing";
    QTest::newRow("a wrong address") << QByteArray("'protocol': 'dls', 'url': 'h'") << "url: is no address";
    QTest::newRow("misspelt") << QByteArray("'protocol': 'dls', 'url': 'https://h', 'port': 1")
                              << "'port' is no field";
    QTest::newRow("a secret in the clear")
        << QByteArray("'protocol': 'dls', 'url': 'http://h', 'secret': 's'")
        << "secret: would cross the network in the clear";
    QTest::newRow("no time") << QByteArray("'protocol': 'dls', 'url': 'https://h', 'timeout_seconds': 0")
                             << "timeout_seconds: 0 is not within";
  }
  void what_is_wrong_is_named() {
    QFETCH(QByteArray, server);
    QFETCH(QString, said);
    const TemporaryFolder folder;
    const std::string text = json("{'servers': [{'name': 'a', " + server.toStdString() + "}]}");
    QCOMPARE(failure(write_file(folder / "ai.json", text)), QString());
    const auto read = imaging::read_ai_configuration(folder / "ai.json");
    QVERIFY2(failure(read).contains(said), qPrintable(failure(read)));
    QCOMPARE(read.error().kind, ErrorKind::input);
  }

  void the_users_own_file_goes_before_the_sites() {
    const TemporaryFolder folder;
    const Variable own("XDG_CONFIG_HOME", QByteArray::fromStdString((folder / "own").string()));
    const Variable site("TIDEMARK_SITE", QByteArray::fromStdString((folder / "site").string()));
    QCOMPARE(imaging::ai_configuration_file(), folder / "own/tidemark/ai.json");
    const auto none = imaging::read_ai_configuration(imaging::ai_configuration_file());
    QVERIFY2(failure(none).endsWith("ai.json: no such file: it says which AI servers there are"),
             qPrintable(failure(none)));
    std::filesystem::create_directories(folder / "site");
    QCOMPARE(failure(write_file(folder / "site/ai.json", json("{'servers': []}"))), QString());
    QCOMPARE(imaging::ai_configuration_file(), folder / "site/ai.json");
    std::filesystem::create_directories(folder / "own/tidemark");
    QCOMPARE(failure(write_file(folder / "own/tidemark/ai.json", json("{'servers': []}"))), QString());
    QCOMPARE(imaging::ai_configuration_file(), folder / "own/tidemark/ai.json");
    // A locked one comes first, and leaves no choice.
    QCOMPARE(failure(write_file(folder / "site/ai.json", json("{'servers': [], 'locked': true}"))),
             QString());
    QCOMPARE(imaging::ai_configuration_file(), folder / "site/ai.json");
    QVERIFY(imaging::read_chosen_ai_configuration({}));
    const auto chosen = imaging::read_chosen_ai_configuration(folder / "own/tidemark/ai.json");
    QVERIFY2(failure(chosen).contains("the site has locked its servers"), qPrintable(failure(chosen)));
  }
};

TIDEMARK_TEST(AiConfigurationTest)

}  // namespace tidemark::test::ai_configuration_test

#include "ai_configuration_test.moc"
