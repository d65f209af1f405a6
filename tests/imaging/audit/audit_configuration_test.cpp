// The file of the audit log's configuration: what is read from it, and what is refused.
#include <QTest>

#include "core/atomic_file.h"
#include "imaging/audit/configuration.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::audit_configuration_test {

class AuditConfigurationTest : public QObject {
  Q_OBJECT

  static Result<imaging::AuditConfiguration> read(const TemporaryFolder& folder, const QByteArray& text) {
    const auto file = folder / "audit.json";
    if (!write_file(file, text.toStdString())) qFatal("cannot write");
    return imaging::read_audit_configuration(file);
  }

 private slots:
  void a_server_is_read() {
    const TemporaryFolder folder;
    const auto read_one = read(folder, R"({"server": {"host": "audit.example", "tls": {"ca": "ca.pem"}},
      "site": "Hospital", "source": "reading room", "waiting": 7})");
    QCOMPARE(failure(read_one), QString());
    QCOMPARE(read_one->server->address(), std::string("audit.example:6514"));
    QVERIFY(read_one->server->protocol == imaging::AuditServer::Protocol::tls);
    QCOMPARE(read_one->server->tls.ca, folder / "ca.pem");
    QCOMPARE(read_one->site, std::string("Hospital"));
    QCOMPARE(read_one->waiting, std::size_t{7});
    const auto udp = read(folder, R"({"server": {"host": "10.0.0.1", "protocol": "udp"}})");
    QCOMPARE(failure(udp), QString());
    QCOMPARE(udp->server->port, 514);
    const auto into_file = read(folder, R"({"file": "audit.log"})");
    QCOMPARE(failure(into_file), QString());
    QCOMPARE(into_file->file, folder / "audit.log");
  }

  void what_is_wrong_is_named_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("said");
    const auto row = [](const char* name, const QByteArray& text, const char* said) {
      QTest::newRow(name) << text << QString(said);
    };
    row("nothing", "{}", "one of the fields server and file is needed, and not both");
    row("both", R"({"server": {"host": "a"}, "file": "b"})",
        "one of the fields server and file is needed, and not both");
    row("no JSON", "{", "");
    row("a misspelt field", R"({"server": {"host": "a", "prot": 1}})", "server");
    row("no host", R"({"server": {}})", "server.host");
    row("a bad host", R"({"server": {"host": "a b"}})", "server.host: is neither");
    row("a bad port", R"({"server": {"host": "a", "port": 0}})", "server.port");
    row("an unknown protocol", R"({"server": {"host": "a", "protocol": "smtp"}})", "server.protocol");
    row("TLS by UDP", R"({"server": {"host": "a", "protocol": "udp", "tls": {}}})", "server.tls");
    row("half a certificate", R"({"server": {"host": "a", "tls": {"key": "k.pem"}}})",
        "server.tls: certificate and key go together");
    row("waiting", R"({"file": "a", "waiting": 0})", "waiting");
  }
  void what_is_wrong_is_named() {
    QFETCH(QByteArray, text);
    QFETCH(QString, said);
    const TemporaryFolder folder;
    const auto read_one = read(folder, text);
    QVERIFY(!read_one);
    QVERIFY(read_one.error().kind == ErrorKind::input);
    const QString message = QString::fromStdString(read_one.error().message);
    QVERIFY2(message.startsWith(QString::fromStdString((folder / "audit.json").string())),
             qPrintable(message));
    QVERIFY2(message.contains(said) && !message.contains('\n'), qPrintable(message));
  }

  void the_site_s_file_comes_first() {
    const TemporaryFolder folder;
    const Variable site("TIDEMARK_SITE", QByteArray::fromStdString((folder / "site").string()));
    const Variable own("XDG_CONFIG_HOME", QByteArray::fromStdString((folder / "own").string()));
    QVERIFY(!imaging::audit_configuration_to_read());
    const auto of_user = folder / "own" / "tidemark" / "audit.json";
    std::filesystem::create_directories(of_user.parent_path());
    QVERIFY(write_file(of_user, "{}").has_value());
    QCOMPARE(*imaging::audit_configuration_to_read(), of_user);
    std::filesystem::create_directories(folder / "site");
    QVERIFY(write_file(folder / "site" / "audit.json", "{}").has_value());
    QCOMPARE(*imaging::audit_configuration_to_read(), folder / "site" / "audit.json");
  }
};

TIDEMARK_TEST(AuditConfigurationTest)

}  // namespace tidemark::test::audit_configuration_test

#include "audit_configuration_test.moc"
