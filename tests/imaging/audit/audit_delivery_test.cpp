// The delivery of audit messages: to servers, to a file, and to servers that are away or misbehave.
#include <signal.h>
#include <sys/stat.h>

#include <QTest>
#include <algorithm>
#include <chrono>
#include <thread>

#include "core/atomic_file.h"
#include "core/stopwatch.h"
#include "core/user_folders.h"
#include "imaging/audit/audit_log.h"
#include "tests/imaging/audit/syslog_server.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/support/child_process.h"
#include "tests/support/test_program.h"

namespace tidemark::test::audit_delivery_test {

using imaging::AuditConfiguration;
using imaging::AuditEvent;
using imaging::AuditLog;
using imaging::AuditServer;
using Kind = imaging::AuditEvent::Kind;
using std::chrono::seconds;

namespace {

// What a log tells its user.
struct Notices {
  std::mutex mutex;
  QStringList said;

  AuditLog::Tell tell() {
    return [this](const Error& notice) {
      const std::lock_guard lock(mutex);
      said << QString::fromStdString(notice.message);
    };
  }
  QStringList all() {
    const std::lock_guard lock(mutex);
    return said;
  }
};

AuditConfiguration to(const AuditServer& server) {
  return {server, {}, "Hospital", "reading room", 1000};
}

std::shared_ptr<AuditLog> start(const AuditConfiguration& configuration, const AuditLog::Tell& tell = {}) {
  auto log = AuditLog::start(configuration, "tidemark-cli", tell);
  if (!log) qFatal("%s", log.error().message.c_str());
  return *log;
}

void open_study(AuditLog& log, int number) {
  log.take({.kind = Kind::accessed, .study = {std::to_string(number), "Doe, Jane", "1.2.3", {}}});
}

// The numbers of the studies that were opened, in the order of the messages.
std::vector<int> opened(const std::vector<std::string>& messages) {
  std::vector<int> numbers;
  for (const std::string& message : messages) {
    const auto objects = audit_in(message).all("ParticipantObjectIdentification");
    if (objects.size() == 2) numbers.push_back(objects[1]["ParticipantObjectID"].toInt());
  }
  return numbers;
}

std::vector<int> up_to(int count) {
  std::vector<int> numbers;
  for (int i = 0; i < count; ++i) numbers.push_back(i);
  return numbers;
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  for (const QByteArray& line : bytes_of(file).split('\n')) {
    if (!line.isEmpty()) lines.push_back(line.toStdString());
  }
  return lines;
}

}  // namespace

class AuditDeliveryTest : public QObject {
  Q_OBJECT

  std::unique_ptr<TemporaryFolder> folder_;
  [[nodiscard]] std::filesystem::path spool() const { return user_state_folder() / "audit"; }
  [[nodiscard]] std::size_t waiting() const {
    const auto opened_spool = imaging::AuditSpool::open(spool(), 1);
    return opened_spool ? opened_spool->waiting().size() : 0;
  }

 private slots:
  void init() {
    folder_ = std::make_unique<TemporaryFolder>();
    qputenv("XDG_STATE_HOME", QByteArray::fromStdString((*folder_ / "state").string()));
  }
  void cleanup() { qunsetenv("XDG_STATE_HOME"); }

  void messages_arrive_data() {
    QTest::addColumn<QString>("way");
    for (const char* way : {"udp", "tcp", "tls", "file"}) QTest::newRow(way) << way;
  }
  void messages_arrive() {
    QFETCH(QString, way);
    const SyslogServer server(way == "udp" ? SyslogServer::Way::udp : SyslogServer::Way::tcp);
    std::unique_ptr<Certificates> authority;
    std::unique_ptr<TlsFront> front;
    AuditConfiguration configuration = to(server.server());
    const auto file = *folder_ / "audit.log";
    if (way == "file") configuration = {std::nullopt, file, {}, {}, 1000};
    if (way == "tls") {
      authority = std::make_unique<Certificates>();
      front = std::make_unique<TlsFront>(server, authority->signed_for("localhost"));
      configuration = to(front->server(*authority));
    }
    Notices notices;
    const auto log = start(configuration, notices.tell());
    for (int i = 0; i < 5; ++i) open_study(*log, i);
    const auto left = log->finish(seconds(10));
    QCOMPARE(left.messages, std::size_t{0});
    QCOMPARE(notices.all(), QStringList());
    const auto messages = way == "file" ? lines_of(file) : server.wait_for(7);
    QCOMPARE(codes_in(messages), QString("110100 110103 110103 110103 110103 110103 110100"));
    QCOMPARE(opened(messages), up_to(5));
    for (const std::string& message : messages) QVERIFY2(message.starts_with("<85>1 "), message.c_str());
    struct stat found {};
    QCOMPARE(::stat(spool().c_str(), &found), 0);
    QCOMPARE(found.st_mode & 0777U, 0700U);
  }

  void what_concerns_nobody_is_no_message() {
    const SyslogServer server;
    const auto log = start(to(server.server()));
    log->take({.kind = Kind::accessed});
    log->take({.kind = Kind::exported, .files = {"/phantom.nii"}});
    log->finish(seconds(10));
    QCOMPARE(codes_in(server.wait_for(2)), QString("110100 110100"));
  }

  void without_a_server_they_wait_over_restarts() {
    const int port = free_port();
    AuditServer away{"localhost", port, AuditServer::Protocol::tcp, 2, {}};
    Notices notices;
    {
      const auto log = start(to(away), notices.tell());
      for (int i = 0; i < 3; ++i) open_study(*log, i);
      const auto left = log->finish(seconds(10));
      QCOMPARE(left.messages, std::size_t{5});
      QVERIFY2(left.reason.find("cannot be called") != std::string::npos, left.reason.c_str());
    }
    QCOMPARE(notices.all().size(), 1);
    QVERIFY2(notices.all().first().contains("audit messages wait: audit server localhost:"),
             qPrintable(notices.all().first()));
    const SyslogServer server(SyslogServer::Way::tcp, port);
    const auto log = start(to(away), notices.tell());
    for (int i = 3; i < 5; ++i) open_study(*log, i);
    QCOMPARE(log->finish(seconds(10)).messages, std::size_t{0});
    const auto messages = server.wait_for(9);
    QCOMPARE(messages.size(), std::size_t{9});
    QCOMPARE(opened(messages), up_to(5));
    QCOMPARE(notices.all().size(), 1);
  }

  void a_server_that_comes_back_gets_them_at_once_and_in_order() {
    auto first = std::make_unique<SyslogServer>();
    const int port = first->port();
    Notices notices;
    const auto log = start(to(first->server()), notices.tell());
    open_study(*log, 0);
    const auto before = first->wait_for(2);
    QCOMPARE(opened(before), up_to(1));
    first.reset();
    for (int i = 1; i < 40; ++i) open_study(*log, i);
    QTRY_COMPARE_WITH_TIMEOUT(notices.all().size(), 1, 10'000);
    const SyslogServer second(SyslogServer::Way::tcp, port);
    auto messages = second.wait_for(39);
    auto all = opened(before);
    const auto later = opened(messages);
    all.insert(all.end(), later.begin(), later.end());
    QCOMPARE(all, up_to(40));
    QCOMPARE(log->finish(seconds(10)).messages, std::size_t{0});
  }

  // What the server's machine has taken counts as delivered: syslog knows no receipts.
  void a_message_that_cannot_be_read_holds_no_other_up() {
    const SyslogServer server;
    std::filesystem::create_directories(spool());
    const auto damaged = spool() / "00000000000000000001-1.msg";
    QVERIFY(write_file(damaged, std::string(100'000, 'x')));  // longer than any message is
    Notices notices;
    const auto log = start(to(server.server()), notices.tell());
    for (int i = 0; i < 3; ++i) open_study(*log, i);
    log->finish(seconds(10));
    QCOMPARE(opened(server.wait_for(5)), up_to(3));
    // It is kept beside the others' way, and told once.
    QCOMPARE(waiting(), std::size_t{0});
    QVERIFY(std::filesystem::exists(damaged.string() + ".damaged"));
    QCOMPARE(notices.all().size(), 1);
    QVERIFY2(notices.all().front().contains("00000000000000000001-1.msg"), qPrintable(notices.all().front()));
  }

  void a_server_that_reads_nothing_holds_nobody_up() {
    auto silent =
        std::make_unique<SyslogServer>(SyslogServer::Way::tcp, 0, SyslogServer::Manner::never_reads);
    const int port = silent->port();
    Notices notices;
    const auto log = start(to(silent->server()), notices.tell());
    for (int i = 0; i < 60; ++i) {
      const Stopwatch stopwatch;
      open_study(*log, i);
      QVERIFY2(stopwatch.seconds() < 0.5, qPrintable(QString::number(stopwatch.seconds())));
    }
    QTRY_COMPARE_WITH_TIMEOUT(notices.all().size(), 1, 10'000);
    QVERIFY2(notices.all().first().contains(" within 2 s"), qPrintable(notices.all().first()));
    const Stopwatch stopwatch;
    const auto left = log->finish(std::chrono::milliseconds(500));
    QVERIFY(stopwatch.seconds() < 2.0);
    QVERIFY(left.messages > 30);
    silent.reset();
    const SyslogServer server(SyslogServer::Way::tcp, port);
    const auto again = start(to(server.server()));
    QCOMPARE(again->finish(seconds(10)).messages, std::size_t{0});
    const auto numbers = opened(server.messages());
    QVERIFY(!numbers.empty());
    std::vector<int> expected;
    for (int i = numbers.front(); i < 60; ++i) expected.push_back(i);
    QCOMPARE(numbers, expected);
  }

  void who_cannot_be_believed_gets_nothing() {
    const SyslogServer server;
    const Certificates authority;
    const Certificates stranger;
    const auto reason = [&](const AuditServer& other) {
      const auto log = start(to(other));
      return QString::fromStdString(log->finish(seconds(10)).reason);
    };
    const TlsFront of_stranger(server, stranger.signed_for("localhost"));
    QVERIFY2(reason(of_stranger.server(authority)).contains("certificate is not to be trusted"),
             qPrintable(reason(of_stranger.server(authority))));
    const TlsFront of_other(server, authority.signed_for("other.example"));
    QVERIFY2(reason(of_other.server(authority)).contains("certificate is not to be trusted"),
             qPrintable(reason(of_other.server(authority))));
    // Nor who does not encrypt.
    AuditServer plain = server.server();
    plain.protocol = AuditServer::Protocol::tls;
    plain.tls.ca = authority.authority();
    QVERIFY(!reason(plain).isEmpty());
    QCOMPARE(server.messages().size(), std::size_t{0});
    AuditServer unverified = of_stranger.server(authority);
    unverified.tls.verify = false;
    QCOMPARE(reason(unverified), QString());
    QCOMPARE(codes_in(server.wait_for(2)).left(13), QString("110100 110100"));
  }

  void what_is_not_usable_is_named_at_the_start() {
    const auto said = [](const AuditConfiguration& configuration) {
      return failure(AuditLog::start(configuration, "tidemark-cli", {}));
    };
    AuditServer server{"localhost", 6514, AuditServer::Protocol::tls, 2, {}};
    server.tls.ca = "/none/ca.pem";
    QVERIFY2(said(to(server)).startsWith("/none/ca.pem: no certificate"), qPrintable(said(to(server))));
    const Certificates authority;
    const auto own = authority.signed_for("a.example");
    const auto other = authority.signed_for("b.example");
    server.tls = {authority.authority(), own.certificate, other.key, true};
    QVERIFY2(said(to(server)).contains("is not the key of"), qPrintable(said(to(server))));
    QVERIFY2(said({std::nullopt, "/none/audit.log", {}, {}, 10}).startsWith("/none/audit.log: "),
             qPrintable(said({std::nullopt, "/none/audit.log", {}, {}, 10})));
    QCOMPARE(waiting(), std::size_t{0});
  }

  void more_than_may_wait_is_lost_and_said() {
    AuditConfiguration configuration = to({"localhost", free_port(), AuditServer::Protocol::tcp, 2, {}});
    configuration.waiting = 5;
    Notices notices;
    const auto log = start(configuration, notices.tell());
    for (int i = 0; i < 20; ++i) open_study(*log, i);
    QCOMPARE(log->finish(std::chrono::milliseconds(100)).messages, std::size_t{5});
    const QStringList lost = notices.all().filter("they are lost");
    QCOMPARE(lost.size(), 1);
    QVERIFY2(lost.first().contains("5 audit messages wait, and no more are kept"), qPrintable(lost.first()));
  }

  void the_end_is_quick_whatever_the_server_does() {
    const SyslogServer silent(SyslogServer::Way::tcp, 0, SyslogServer::Manner::never_reads);
    AuditServer server = silent.server();
    server.protocol = AuditServer::Protocol::tls;  // which waits for an answer
    server.timeout_seconds = 60;
    const auto log = start(to(server));
    QTest::qWait(300);
    std::stop_source interrupted;
    interrupted.request_stop();
    const Stopwatch stopwatch;
    const auto left = log->finish(seconds(60), interrupted.get_token());
    QVERIFY2(stopwatch.seconds() < 0.5, qPrintable(QString::number(stopwatch.seconds())));
    QCOMPARE(left.messages, std::size_t{2});
  }

  void a_killed_program_loses_nothing() {
    const SyslogServer server;
    for (const int port : {free_port(), server.port()}) {
      const int before = static_cast<int>(opened(server.messages()).size());
      const Ended ended = run_in_child([&]() -> Status {
        const auto log = start(to({"localhost", port, AuditServer::Protocol::tcp, 2, {}}));
        for (int i = 0; i < 30; ++i) open_study(*log, before + i);
        ::raise(SIGKILL);
        return {};
      });
      QVERIFY2(ended.was_killed, ended.failure.c_str());
      const auto log = start(to(server.server()));
      QCOMPARE(log->finish(seconds(10)).messages, std::size_t{0});
      auto numbers = opened(server.messages());
      // One message may have been on its way in the moment of the end.
      const auto twice = numbers.size() - static_cast<std::size_t>(before + 30);
      QVERIFY(numbers.size() >= static_cast<std::size_t>(before + 30) && twice <= 1);
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
      QCOMPARE(numbers, up_to(before + 30));
    }
  }

  void several_programs_and_threads_share_the_way() {
    const SyslogServer server;
    const auto one = start(to(server.server()));
    const auto other = start(to(server.server()));
    constexpr int kThreads = 4;
    constexpr int kEach = 25;
    std::vector<std::jthread> threads;
    for (int t = 0; t < kThreads; ++t) {
      threads.emplace_back([&, t] {
        for (int i = 0; i < kEach; ++i) open_study(t % 2 == 0 ? *one : *other, t * kEach + i);
      });
    }
    threads.clear();
    one->finish(seconds(10));
    QCOMPARE(other->finish(seconds(10)).messages, std::size_t{0});
    auto numbers = opened(server.wait_for(kThreads * kEach + 4));
    std::sort(numbers.begin(), numbers.end());
    QCOMPARE(numbers, up_to(kThreads * kEach));
  }
};

TIDEMARK_TEST(AuditDeliveryTest)

}  // namespace tidemark::test::audit_delivery_test

#include "audit_delivery_test.moc"
