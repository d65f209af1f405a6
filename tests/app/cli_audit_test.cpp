// The audit messages of commands, as a site's collector gets them.
#include <QTest>
#include <algorithm>
#include <chrono>

#include "core/atomic_file.h"
#include "core/stopwatch.h"
#include "imaging/pacs/configuration.h"
#include "tests/app/cli_runner.h"
#include "tests/imaging/audit/syslog_server.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/pacs/archives.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_audit_test {

namespace {

// A user with a home of its own, whose commands are audited into a file.
class AuditedUser {
 public:
  explicit AuditedUser(const QByteArray& configuration = R"({"file": "audit.log", "source": "ward"})") {
    std::filesystem::create_directories(folder_ / "config" / "tidemark");
    if (!configuration.isEmpty()) configure(configuration);
    options_.environment.insert("XDG_CONFIG_HOME", text(folder_ / "config"));
    options_.environment.insert("XDG_STATE_HOME", text(folder_ / "state"));
    options_.environment.insert("TIDEMARK_SITE", text(folder_ / "site"));
  }

  void configure(const QByteArray& configuration) const {
    if (!write_file(folder_ / "config" / "tidemark" / "audit.json", configuration.toStdString()))
      qFatal("cannot write");
  }
  Outcome run(const QStringList& arguments) const { return run_cli(arguments, options_); }
  // The messages since the last time.
  std::vector<std::string> messages() {
    const auto file = folder_ / "config" / "tidemark" / "audit.log";
    std::vector<std::string> lines;
    for (const QByteArray& line : bytes_of(file).split('\n')) {
      if (!line.isEmpty()) lines.push_back(line.toStdString());
    }
    std::filesystem::remove(file);
    return lines;
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  [[nodiscard]] const RunOptions& options() const { return options_; }

 private:
  TemporaryFolder folder_;
  RunOptions options_;
};

// The patient or the study that a message names.
QString patient_in(const std::string& message) {
  return audit_in(message).all("ParticipantObjectIdentification").back()["ParticipantObjectID"];
}

XmlElement study_in(const std::string& message) {
  return audit_in(message).all("ParticipantObjectIdentification").front();
}

QString outcome_in(const std::string& message) {
  return audit_in(message).one("EventIdentification")["EventOutcomeIndicator"];
}

}  // namespace

class CliAuditTest : public QObject {
  Q_OBJECT

  // A small CT of a patient.
  static std::filesystem::path study(const std::filesystem::path& folder, const char* patient,
                                     const char* study_uid) {
    for (const auto& file : write_series(sample_volume({16, 16, 4}), folder)) {
      set_text(file, 0x0010, 0x0020, patient);
      set_text(file, 0x0020, 0x000D, study_uid);
    }
    return folder;
  }

 private slots:
  void segment_opens_a_study_and_exports_results() {
    AuditedUser user;
    const auto input = study(user / "study", "P-7", "1.2.7");
    const Outcome outcome = user.run({"segment", text(input), "--seed", "8,8,2,3", "--target", "100",
                                      "--range", "50", "--alpha", "0.5", "--steps", "2", "--out",
                                      text(user / "mask.nii.gz"), "--out", text(user / "seg.dcm")});
    QVERIFY2(outcome.code == 0, outcome.told());
    const auto messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110103 110106 110100"));
    for (const std::string& message : {messages[1], messages[2]}) {
      QCOMPARE(patient_in(message), QString("P-7"));
      QCOMPARE(study_in(message)["ParticipantObjectID"], QString("1.2.7"));
      QCOMPARE(outcome_in(message), QString("0"));
    }
    QCOMPARE(study_in(messages[1]).one("ParticipantObjectDescription").one("SOPClass")["NumberOfInstances"],
             QString("4"));
    QVERIFY(messages[2].find("file://" + (user / "mask.nii.gz").string()) != std::string::npos);
    QVERIFY(messages[2].find("seg.dcm") != std::string::npos);

    // What others have segmented comes in from a file.
    const Outcome converted =
        user.run({"convert", text(user / "seg.dcm"), "--out", text(user / "again.nrrd")});
    QVERIFY2(converted.code == 0, converted.told());
    const auto of_convert = user.messages();
    QCOMPARE(codes_in(of_convert), QString("110100 110107 110106 110100"));
    QCOMPARE(patient_in(of_convert[1]), QString("P-7"));
    QCOMPARE(patient_in(of_convert[2]), QString("P-7"));
  }

  void files_without_a_patient_are_nobody_s() {
    AuditedUser user;
    QCOMPARE(user.run({"phantom", "sphere", "--out", text(user / "sphere")}).code, 0);
    QCOMPARE(
        user.run({"convert", text(user / "sphere/truth.nii.gz"), "--mask", "--out", text(user / "m.nrrd")})
            .code,
        0);
    QCOMPARE(codes_in(user.messages()), QString("110100 110100 110100 110100"));
  }

  void anonymous_copies_name_who_it_was() {
    AuditedUser user;
    const auto all = user / "all";
    study(all / "a", "P-1", "1.2.1");
    study(all / "b", "P-2", "1.2.2");
    const Outcome outcome = user.run({"deidentify", text(all), "--out", text(user / "anonymous")});
    QVERIFY2(outcome.code == 0, outcome.told());
    const auto messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110106 110106 110100"));
    QStringList patients{patient_in(messages[1]), patient_in(messages[2])};
    patients.sort();
    QCOMPARE(patients, QStringList({"P-1", "P-2"}));
    for (const std::string& message : {messages[1], messages[2]}) {
      QCOMPARE(study_in(message).one("ParticipantObjectDescription").one("Anonymized").text, QString("true"));
      QVERIFY(message.find("file://" + (user / "anonymous").string()) != std::string::npos);
    }
  }

  void a_server_is_asked_fetched_from_and_sent_to() {
    const auto archive = start_dcmqrscp();
    AuditedUser user;
    imaging::PacsConfiguration servers;
    servers.servers.push_back(archive->server());
    servers.limits.free_bytes = 1 << 20;
    QVERIFY(write_pacs_configuration(servers, user / "pacs.json").has_value());
    const QString name = QString::fromStdString(archive->server().name);
    const QStringList use{"--servers", text(user / "pacs.json")};
    const auto input = study(user / "study", "P-9", "1.2.9");
    const auto run = [&](const QStringList& arguments) {
      const Outcome outcome = user.run(QStringList{"pacs"} + arguments + use);
      if (outcome.code != 0) qWarning("%s", outcome.told().constData());
      return outcome.code;
    };
    QCOMPARE(run({"send", name, text(input)}), 0);
    auto messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110104 110100"));
    QCOMPARE(patient_in(messages[1]), QString("P-9"));
    QCOMPARE(study_in(messages[1]).one("ParticipantObjectDescription").one("SOPClass")["NumberOfInstances"],
             QString("4"));
    QVERIFY(messages[1].find("AETITLES=" + archive->server().ae_title) != std::string::npos);

    QCOMPARE(run({"find", name, "--patient-id", "P-9"}), 0);
    messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110112 110100"));
    const QByteArray query =
        QByteArray::fromBase64(study_in(messages[1]).one("ParticipantObjectQuery").text.toLatin1());
    QVERIFY2(query.contains("P-9") && query.contains("STUDY"), query.toHex());

    QCOMPARE(run({"get", name, "--study", "1.2.9", "--out", text(user / "back")}), 0);
    messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110104 110100"));
    QCOMPARE(patient_in(messages[1]), QString("P-9"));

    QVERIFY(run({"get", name, "--study", "1.2.999", "--out", text(user / "none")}) != 0);
    messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110104 110100"));
    QCOMPARE(outcome_in(messages[1]), QString("4"));
    QCOMPARE(study_in(messages[1])["ParticipantObjectID"], QString("1.2.999"));

    QCOMPARE(run({"send", name, text(input), "--deidentify"}), 0);
    messages = user.messages();
    QCOMPARE(codes_in(messages), QString("110100 110104 110106 110100"));
    QVERIFY(patient_in(messages[1]) != "P-9");
    QCOMPARE(patient_in(messages[2]), QString("P-9"));
    QCOMPARE(study_in(messages[2]).one("ParticipantObjectDescription").one("Anonymized").text,
             QString("true"));
  }

  // Each case is computed in a copy of the process.
  void cases_of_a_cohort_are_opened_and_exported() {
    AuditedUser user;
    for (const char* name : {"a", "b"}) {
      QCOMPARE(user.run({"phantom", "sphere", "--out", text(user / name)}).code, 0);
      std::filesystem::create_directories(user / "in");
      std::filesystem::rename(user / name / "series", user / "in" / name);
    }
    QCOMPARE(
        user.run({"cohort", "plan", text(user / "in"), "--out", text(user / "cohort"), "--auto-start"}).code,
        0);
    user.messages();
    const Outcome outcome = user.run({"cohort", "run", text(user / "cohort")});
    QVERIFY2(outcome.code == 0, outcome.told());
    const auto messages = user.messages();
    QStringList codes = codes_in(messages).split(' ');
    codes.sort();
    QCOMPARE(codes.join(' '), QString("110100 110100 110103 110103 110106 110106"));
    for (const std::string& message : messages) QCOMPARE(outcome_in(message), QString("0"));
    // By the names that they have in the end.
    for (const char* name : {"a", "b"}) {
      const std::string place = "file://" + (user / "cohort/cases" / name).string();
      const auto names_it = [&](const std::string& message) {
        return codes_in({message}) == "110106" && message.find(place) != std::string::npos;
      };
      QCOMPARE(std::count_if(messages.begin(), messages.end(), names_it), std::ptrdiff_t{1});
      QVERIFY(std::filesystem::is_directory(user / "cohort/cases" / name));
    }
  }

  void nothing_is_written_where_nothing_is_wanted() {
    AuditedUser user{QByteArray()};
    const auto input = study(user / "study", "P-7", "1.2.7");
    QCOMPARE(user.run({"convert", text(input), "--out", text(user / "x.nrrd")}).code, 0);
    QVERIFY(!std::filesystem::exists(user / "state"));
    QVERIFY(user.messages().empty());
  }

  void a_configuration_that_is_wrong_ends_every_command() {
    AuditedUser user("{\"server\": {\"host\": \"a b\"}}");
    const auto input = study(user / "study", "P-7", "1.2.7");
    const Outcome outcome = user.run({"convert", text(input), "--out", text(user / "x.nrrd")});
    QVERIFY2(outcome.failed_in_one_line(3), outcome.told());
    QVERIFY2(outcome.err.contains("audit.json: server.host: is neither"), outcome.err);
    QVERIFY(!std::filesystem::exists(user / "x.nrrd"));
    QCOMPARE(user.run({"--help"}).code, 0);
    user.configure(R"({"file": "/none/audit.log"})");
    const Outcome unwritable = user.run({"info", text(input)});
    QVERIFY2(unwritable.failed_in_one_line(5), unwritable.told());
  }

  void without_a_server_a_command_ends_as_it_would_and_says_so() {
    const int port = free_port();
    AuditedUser user(QStringLiteral(R"({"server": {"host": "localhost", "port": %1, "protocol": "tcp"}})")
                         .arg(port)
                         .toUtf8());
    const auto input = study(user / "study", "P-7", "1.2.7");
    const Stopwatch stopwatch;
    const Outcome outcome = user.run({"convert", text(input), "--out", text(user / "x.nrrd")});
    QVERIFY2(outcome.code == 0, outcome.told());
    QVERIFY(stopwatch.seconds() < 5.0);
    QCOMPARE(outcome.err.count('\n'), 1);
    QVERIFY2(outcome.err.contains("4 audit messages wait to be delivered: audit server localhost:"),
             outcome.err);
    const SyslogServer server(SyslogServer::Way::tcp, port);
    const Outcome again = user.run({"info", text(input)});
    QVERIFY2(again.code == 0 && again.err.isEmpty(), again.told());
    QCOMPARE(codes_in(server.wait_for(6)), QString("110100 110103 110106 110100 110100 110100"));
  }

  void a_signal_ends_a_command_within_a_second_all_the_same() {
    const SyslogServer silent(SyslogServer::Way::tcp, 0, SyslogServer::Manner::never_reads);
    const AuditedUser user(
        QStringLiteral(R"({"server": {"host": "localhost", "port": %1, "protocol": "tls"}})")
            .arg(silent.port())
            .toUtf8());
    const auto input = study(user / "study", "P-7", "1.2.7");
    QProcess process;
    process.setProcessEnvironment(user.options().environment);
    QVERIFY(start_cli(process,
                      {"segment", text(input), "--seed", "8,8,2,3", "--target", "100", "--range", "50",
                       "--alpha", "0.5", "--steps", "100000000", "--out", text(user / "m.nrrd")},
                      "Loaded"));
    const Stopwatch stopwatch;
    process.terminate();
    QVERIFY(process.waitForFinished(5000));
    QVERIFY2(stopwatch.seconds() < 1.0, qPrintable(QString::number(stopwatch.seconds())));
    QCOMPARE(process.exitCode(), 130);
    QVERIFY(!std::filesystem::is_empty(user / "state/tidemark/audit"));
  }
};

TIDEMARK_TEST(CliAuditTest)

}  // namespace tidemark::test::cli_audit_test

#include "cli_audit_test.moc"
