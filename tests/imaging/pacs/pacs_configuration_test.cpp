// The file of servers: what is read is what was written, and what is wrong is named by file and field.
#include <QFile>
#include <QTest>

#include "imaging/pacs/configuration.h"
#include "imaging/pacs/services.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::pacs_configuration_test {

class PacsConfigurationTest : public QObject {
  Q_OBJECT

  static void write(const std::filesystem::path& file, const QByteArray& text) {
    QFile opened(QString::fromStdString(file.string()));
    QVERIFY(opened.open(QIODevice::WriteOnly));
    QCOMPARE(opened.write(text), text.size());
  }

 private slots:
  void what_was_written_is_read() {
    const TemporaryFolder folder;
    imaging::PacsConfiguration configuration;
    configuration.servers.push_back({.name = "main",
                                     .host = "pacs.example",
                                     .port = 11112,
                                     .ae_title = "ARCHIVE",
                                     .own_ae_title = "US",
                                     .retrieve = imaging::PacsServer::Retrieve::move,
                                     .move_port = 4242,
                                     .timeout_seconds = 7,
                                     .tls = imaging::TlsFiles{"/ca.pem", "/own.pem", "/key.pem", false}});
    configuration.servers.push_back({.name = "other", .host = "10.0.0.1", .ae_title = "OTHER", .tls = {}});
    imaging::PacsServer& web = configuration.servers.emplace_back();
    web.name = "web";
    web.timeout_seconds = 9;
    web.tls = imaging::TlsFiles{"/ca.pem", {}, {}, true};
    web.web = imaging::WebAccess{"https://pacs.example:8043/dicom-web", "reader", "/secret.txt"};
    configuration.limits = {std::int64_t{1} << 20, std::int64_t{2} << 20, 3, std::int64_t{4} << 20, 5};
    const auto file = folder / "new/folder/pacs.json";
    QCOMPARE(failure(imaging::write_pacs_configuration(configuration, file)), QString());
    const auto read = imaging::read_pacs_configuration(file);
    QCOMPARE(failure(read), QString());
    QVERIFY(read->servers == configuration.servers);
    QVERIFY(read->limits == configuration.limits);
    QCOMPARE(read->server("other")->ae_title, std::string("OTHER"));
    const auto unknown = read->server("none");
    QVERIFY(!unknown);
    QCOMPARE(unknown.error().kind, ErrorKind::usage);
    QVERIFY(unknown.error().message.find("main, other, web") != std::string::npos);
    QCOMPARE(read->server("web")->address(), std::string("https://pacs.example:8043/dicom-web"));
  }

  void certificates_lie_beside_the_file_and_verification_is_on() {
    const TemporaryFolder folder;
    write(folder / "pacs.json",
          R"({"servers": [{"name": "a", "host": "h", "ae_title": "A", "tls": {"ca": "ca.pem"}}]})");
    const auto read = imaging::read_pacs_configuration(folder / "pacs.json");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->servers[0].tls->ca, folder / "ca.pem");
    QVERIFY(read->servers[0].tls->verify);
    QVERIFY(read->servers[0].retrieve == imaging::PacsServer::Retrieve::get);
  }

  void what_is_wrong_is_named_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("said");
    const auto server = [](const QByteArray& fields) {
      return R"({"servers": [{"name": "a", "host": "h", "ae_title": "A")" + fields + "}]}";
    };
    QTest::newRow("empty") << QByteArray() << "not JSON";
    QTest::newRow("no object") << QByteArray("[]") << "not an object";
    QTest::newRow("no servers") << QByteArray("{}") << "servers: is missing";
    QTest::newRow("not a list") << QByteArray(R"({"servers": 1})") << "servers: not a list";
    QTest::newRow("deep") << QByteArray(100'000, '[') << "nested more than 8 deep";
    QTest::newRow("large") << QByteArray(2 << 20, ' ') << "bytes, more than 1048576 are not read";
    QTest::newRow("no host") << QByteArray(R"({"servers": [{"name": "a", "ae_title": "A"}]})")
                             << "servers[0].host: is missing";
    QTest::newRow("two of a name")
        << QByteArray(
               R"({"servers": [{"name": "a", "host": "h", "ae_title": "A"}, {"name": "a", "host": "h", "ae_title": "A"}]})")
        << "servers[1].name: another server has the same";
    QTest::newRow("misspelt") << server(R"(, "TLS": {})")
                              << "servers[0]: 'TLS' is no field that is known here";
    QTest::newRow("misspelt in tls") << server(R"(, "tls": {"verfy": true})")
                                     << "servers[0].tls: 'verfy' is no field";
    QTest::newRow("port of 0") << server(R"(, "port": 0)") << "servers[0].port: 0 is not within 1 to 65535";
    QTest::newRow("port of text") << server(R"(, "port": "104")") << "servers[0].port: not a whole number";
    QTest::newRow("unknown retrieval")
        << server(R"(, "retrieve": "push")") << "servers[0].retrieve: 'push' is unknown";
    QTest::newRow("long title") << server(R"(, "own_ae_title": "12345678901234567")")
                                << "own_ae_title: more than 16 bytes are not read";
    QTest::newRow("title with a backslash") << server(R"(, "own_ae_title": "A\\B")")
                                            << "servers[0]: own_ae_title: is not 1 to 16 ASCII characters";
    const auto web = [](const QByteArray& url, const QByteArray& more = {}) {
      return "{\"servers\": [{\"name\": \"a\", \"url\": \"" + url + "\"" + more + "}]}";
    };
    QTest::newRow("both ways") << server(R"(, "url": "x")")
                               << "servers[0]: 'host' is no field that is known here";
    QTest::newRow("no address") << web("pacs") << "servers[0]: url: is no address";
    QTest::newRow("another protocol") << web("ftp://h/web") << "url: begins with neither";
    QTest::newRow("a password in the address") << web("https://u:p@h/web") << "url: holds a user";
    QTest::newRow("a question in the address") << web("https://h/web?x=1") << "url: holds a question";
    QTest::newRow("a slash at the end") << web("https://h/web/") << "url: ends with a slash";
    QTest::newRow("a user without a secret")
        << web("https://h/web", R"(, "user": "u")") << "user: has no secret";
    QTest::newRow("a secret in the clear")
        << web("http://h/web", R"(, "secret": "s.txt")") << "secret: would cross the network in the clear";
    QTest::newRow("TLS in the clear")
        << web("http://h/web", R"(, "tls": {})") << "tls: the url begins with http://";
    QTest::newRow("host with a blank")
        << QByteArray(R"({"servers": [{"name": "a", "host": "h x", "ae_title": "A"}]})")
        << "servers[0]: host: is neither a host name nor an IPv4 address";
    QTest::newRow("certificate without a key") << server(R"(, "tls": {"certificate": "c.pem"})")
                                               << "servers[0]: tls: certificate and key go together";
    QTest::newRow("move without a certificate")
        << server(R"(, "tls": {}, "retrieve": "move")") << "retrieving by move needs a certificate";
    QTest::newRow("no time") << server(R"(, "timeout_seconds": 0)") << "timeout_seconds: 0 is not within";
    QTest::newRow("limit of 0") << QByteArray(R"({"servers": [], "limits": {"objects": 0}})")
                                << "limits.objects: 0 is not within";
    QTest::newRow("locked is text") << QByteArray(R"({"servers": [], "locked": "yes"})")
                                    << "locked: neither true nor false";
    QTest::newRow("verify is text") << server(R"(, "tls": {"verify": "no"})") << "neither true nor false";
  }
  void what_is_wrong_is_named() {
    QFETCH(QByteArray, text);
    QFETCH(QString, said);
    const TemporaryFolder folder;
    write(folder / "pacs.json", text);
    const auto read = imaging::read_pacs_configuration(folder / "pacs.json");
    QVERIFY(!read);
    QCOMPARE(read.error().kind, ErrorKind::input);
    const QString message = QString::fromStdString(read.error().message);
    QVERIFY2(message.startsWith(QString::fromStdString((folder / "pacs.json").string()) + ": "),
             qPrintable(message));
    QVERIFY2(message.contains(said), qPrintable(message));
  }

  void a_file_that_is_not_there_is_named() {
    const TemporaryFolder folder;
    const auto read = imaging::read_pacs_configuration(folder / "none.json");
    QVERIFY(!read);
    QVERIFY(read.error().message.find("none.json: no such file") != std::string::npos);
  }

  void the_usual_file_is_in_the_users_configuration() {
    qputenv("XDG_CONFIG_HOME", "/somewhere");
    QCOMPARE(imaging::pacs_configuration_file(), std::filesystem::path("/somewhere/tidemark/pacs.json"));
    qunsetenv("XDG_CONFIG_HOME");
    qputenv("HOME", "/home/somebody");
    QCOMPARE(imaging::pacs_configuration_file(),
             std::filesystem::path("/home/somebody/.config/tidemark/pacs.json"));
  }

  void names_are_readable_data() {
    QTest::addColumn<QString>("dicom_name");
    QTest::addColumn<QString>("readable");
    QTest::newRow("family alone") << "Doe"
                                  << "Doe";
    QTest::newRow("given") << "Doe^Jane"
                           << "Doe, Jane";
    QTest::newRow("middle, prefix, suffix") << "Doe^Jane^Ann^Dr^MD"
                                            << "Doe, Jane Ann";
    QTest::newRow("scripts") << "Yamada^Tarou=山田^太郎=やまだ^たろう"
                             << "Yamada, Tarou / 山田, 太郎 / やまだ, たろう";
    QTest::newRow("nothing") << "^^^=="
                             << "";
  }
  // A site that locks its servers leaves its users no others.
  void a_locked_file_of_the_site_comes_first() {
    const TemporaryFolder folder;
    const Variable site("TIDEMARK_SITE", QByteArray::fromStdString((folder / "site").string()));
    std::filesystem::create_directories(folder / "site");
    const auto own = folder / "own.json";
    const auto of_site = folder / "site/pacs.json";
    const QByteArray server = R"({"servers": [{"name": "s", "host": "h", "ae_title": "A"}])";
    write(own, R"({"servers": []})");
    write(of_site, server + "}");
    QCOMPARE(imaging::pacs_configuration_to_read(own), own);
    QCOMPARE(imaging::read_chosen_pacs_configuration(own)->servers.size(), std::size_t{0});

    for (const QByteArray& said : {server + R"(, "locked": true})", server + R"(, "locked": 1})", server}) {
      write(of_site, said);
      QCOMPARE(imaging::pacs_configuration_to_read(own), of_site);
      const auto chosen = imaging::read_chosen_pacs_configuration(own);
      QVERIFY(!chosen);
      QCOMPARE(chosen.error().kind, ErrorKind::usage);
      QCOMPARE(failure(chosen),
               QString("%1: is not read: the site has locked its servers, %2")
                   .arg(QString::fromStdString(own.string()), QString::fromStdString(of_site.string())));
    }
    write(of_site, server + R"(, "locked": true})");
    const auto read = imaging::read_chosen_pacs_configuration({});
    QCOMPARE(failure(read), QString());
    QVERIFY(read->locked);
    write(of_site, server + R"(, "locked": false})");
    QCOMPARE(imaging::pacs_configuration_to_read(own), own);
  }

  void names_are_readable() {
    QFETCH(QString, dicom_name);
    QFETCH(QString, readable);
    QCOMPARE(QString::fromStdString(imaging::readable_name(dicom_name.toStdString())), readable);
  }
};

TIDEMARK_TEST(PacsConfigurationTest)

}  // namespace tidemark::test::pacs_configuration_test

#include "pacs_configuration_test.moc"
