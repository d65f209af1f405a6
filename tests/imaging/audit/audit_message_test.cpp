// The text of audit messages, against what DICOM PS3.15 A.5 wants of each.
#include <QRegularExpression>
#include <QTest>

#include "imaging/audit/syslog_frame.h"
#include "tests/imaging/audit/syslog_server.h"
#include "tests/support/test_program.h"

namespace tidemark::test::audit_message_test {

using imaging::AuditEvent;
using Kind = imaging::AuditEvent::Kind;

class AuditMessageTest : public QObject {
  Q_OBJECT

  static imaging::AuditOrigin origin() {
    return {"tidemark-cli", "4711", "jane", "Jane Doe", "ward3", "Hospital", "reading room"};
  }
  static AuditEvent event(Kind kind) {
    AuditEvent event{.kind = kind,
                     .study = {"P-1", "Doe, Jane", "1.2.3", {{"1.2.840.10008.5.1.4.1.1.2", 3}}},
                     .peer = {"pacs.example", {}, "ARCHIVE", "TIDEMARK"}};
    event.time = std::chrono::system_clock::time_point(std::chrono::microseconds(1'234'567));
    return event;
  }
  static XmlElement message(const AuditEvent& event) {
    return audit_in(imaging::audit_message(event, origin()));
  }
  // The participant with this role (RoleIDCode), or the first without any.
  static XmlElement participant(const XmlElement& message, const QString& role) {
    for (const XmlElement& one : message.all("ActiveParticipant")) {
      const auto roles = one.all("RoleIDCode");
      if (roles.empty() ? role.isEmpty() : roles.front()["csd-code"] == role) return one;
    }
    qFatal("no participant %s", qPrintable(role));
  }

 private slots:
  void every_event_has_its_code_and_its_participants_data() {
    QTest::addColumn<Kind>("kind");
    QTest::addColumn<QString>("code");
    QTest::addColumn<QString>("meaning");
    QTest::addColumn<QString>("action");
    QTest::addColumn<QStringList>("roles");
    const QStringList transferred{"110153", "110152"};
    QTest::newRow("start") << Kind::started << "110100"
                           << "Application Activity"
                           << "E" << QStringList{"110151", "110150"};
    QTest::newRow("stop") << Kind::stopped << "110100"
                          << "Application Activity"
                          << "E" << QStringList{"110151", "110150"};
    QTest::newRow("accessed") << Kind::accessed << "110103"
                              << "DICOM Instances Accessed"
                              << "R" << QStringList{"", "110150"};
    QTest::newRow("received") << Kind::received << "110104"
                              << "DICOM Instances Transferred"
                              << "C" << QStringList{"110153", "", "110152"};
    QTest::newRow("sent") << Kind::sent << "110104"
                          << "DICOM Instances Transferred"
                          << "C" << QStringList{"", "110153", "110152"};
    QTest::newRow("exported") << Kind::exported << "110106"
                              << "Export"
                              << "R" << QStringList{"110153", "110153", "110154"};
    QTest::newRow("imported") << Kind::imported << "110107"
                              << "Import"
                              << "C" << QStringList{"110152", "110152", "110155"};
    QTest::newRow("queried") << Kind::queried << "110112"
                             << "Query"
                             << "E" << QStringList{"", "110153", "110152"};
  }
  void every_event_has_its_code_and_its_participants() {
    QFETCH(Kind, kind);
    const XmlElement root = message(event(kind));
    QCOMPARE(root.name, QString("AuditMessage"));
    const XmlElement id = root.one("EventIdentification");
    QTEST(id.one("EventID")["csd-code"], "code");
    QTEST(id.one("EventID")["originalText"], "meaning");
    QCOMPARE(id.one("EventID")["codeSystemName"], QString("DCM"));
    QTEST(id["EventActionCode"], "action");
    QCOMPARE(id["EventDateTime"], QString("1970-01-01T00:00:01.234567Z"));
    QCOMPARE(id["EventOutcomeIndicator"], QString("0"));
    QStringList roles;
    int requestors = 0;
    for (const XmlElement& one : root.all("ActiveParticipant")) {
      QVERIFY(!one["UserID"].isEmpty() || kind == Kind::exported || kind == Kind::imported);
      QVERIFY(one["UserIsRequestor"] == "true" || one["UserIsRequestor"] == "false");
      requestors += one["UserIsRequestor"] == "true" ? 1 : 0;
      roles << (one.all("RoleIDCode").empty() ? QString() : one.one("RoleIDCode")["csd-code"]);
    }
    QCOMPARE(requestors, 1);
    QTEST(roles, "roles");
    const XmlElement source = root.one("AuditSourceIdentification");
    QCOMPARE(source["AuditSourceID"], QString("reading room"));
    QCOMPARE(source["AuditEnterpriseSiteID"], QString("Hospital"));
  }

  void the_start_and_the_end_of_a_program_differ_in_their_type() {
    const auto type = [](Kind kind) {
      return message(event(kind)).one("EventIdentification").one("EventTypeCode")["csd-code"];
    };
    QCOMPARE(type(Kind::started), QString("110120"));
    QCOMPARE(type(Kind::stopped), QString("110121"));
    QCOMPARE(message(event(Kind::started)).all("ParticipantObjectIdentification").size(), std::size_t{0});
  }

  void the_user_and_the_other_side_are_named() {
    const XmlElement root = message(event(Kind::sent));
    const XmlElement user = participant(root, "");
    QCOMPARE(user["UserID"], QString("jane@ward3"));
    QCOMPARE(user["UserName"], QString("Jane Doe"));
    QCOMPARE(user["NetworkAccessPointID"], QString("ward3"));
    QCOMPARE(user["NetworkAccessPointTypeCode"], QString("1"));
    const XmlElement us = participant(root, "110153");
    QCOMPARE(us["UserID"], QString("4711"));
    QCOMPARE(us["AlternativeUserID"], QString("AETITLES=TIDEMARK"));
    const XmlElement peer = participant(root, "110152");
    QCOMPARE(peer["UserID"], QString("pacs.example"));
    QCOMPARE(peer["AlternativeUserID"], QString("AETITLES=ARCHIVE"));
  }

  void the_study_and_the_patient_are_named() {
    const auto objects = message(event(Kind::accessed)).all("ParticipantObjectIdentification");
    QCOMPARE(objects.size(), std::size_t{2});
    const XmlElement& study = objects[0];
    QCOMPARE(study["ParticipantObjectID"], QString("1.2.3"));
    QCOMPARE(study["ParticipantObjectTypeCode"], QString("2"));
    QCOMPARE(study["ParticipantObjectTypeCodeRole"], QString("3"));
    QCOMPARE(study.one("ParticipantObjectIDTypeCode")["csd-code"], QString("110180"));
    const XmlElement sop = study.one("ParticipantObjectDescription").one("SOPClass");
    QCOMPARE(sop["UID"], QString("1.2.840.10008.5.1.4.1.1.2"));
    QCOMPARE(sop["NumberOfInstances"], QString("3"));
    const XmlElement& patient = objects[1];
    QCOMPARE(patient["ParticipantObjectID"], QString("P-1"));
    QCOMPARE(patient["ParticipantObjectTypeCode"], QString("1"));
    QCOMPARE(patient["ParticipantObjectTypeCodeRole"], QString("1"));
    QCOMPARE(patient.one("ParticipantObjectIDTypeCode")["csd-code"], QString("2"));
    QCOMPARE(patient.one("ParticipantObjectName").text, QString("Doe, Jane"));
  }

  void an_export_says_where_to_and_that_it_is_anonymous() {
    AuditEvent exported = event(Kind::exported);
    exported.files = {"/home/jane/mask.nii.gz", "/home/jane/a & b.stl"};
    XmlElement root = message(exported);
    const XmlElement media = participant(root, "110154");
    QCOMPARE(media["UserID"], QString("file:///home/jane/mask.nii.gz; file:///home/jane/a & b.stl"));
    QCOMPARE(media.one("MediaIdentifier").one("MediaType")["csd-code"], QString("110037"));
    const auto description = [](const XmlElement& of) {
      return of.all("ParticipantObjectIdentification")[0].one("ParticipantObjectDescription");
    };
    QVERIFY(description(root).all("Anonymized").empty());
    exported.is_deidentified = true;
    exported.files.clear();
    root = message(exported);
    QCOMPARE(description(root).one("Anonymized").text, QString("true"));
    QCOMPARE(participant(root, "110154")["NetworkAccessPointID"], QString("pacs.example"));
  }

  void a_query_is_kept_byte_by_byte() {
    AuditEvent query = event(Kind::queried);
    query.query = std::string("\x08\0\x52\0CS", 6);
    query.query_class = "1.2.840.10008.5.1.4.1.2.2.1";
    const auto objects = message(query).all("ParticipantObjectIdentification");
    QCOMPARE(objects.size(), std::size_t{1});
    QCOMPARE(objects[0]["ParticipantObjectID"], QString("1.2.840.10008.5.1.4.1.2.2.1"));
    QCOMPARE(QByteArray::fromBase64(objects[0].one("ParticipantObjectQuery").text.toLatin1()),
             QByteArray::fromStdString(query.query));
    const XmlElement detail = objects[0].one("ParticipantObjectDetail");
    QCOMPARE(detail["type"], QString("TransferSyntax"));
    QCOMPARE(QByteArray::fromBase64(detail["value"].toLatin1()), QByteArray("1.2.840.10008.1.2.1"));
  }

  void a_failure_says_why() {
    AuditEvent failed = event(Kind::received);
    failed.failure = "the server <hangs> up";
    const XmlElement id = message(failed).one("EventIdentification");
    QCOMPARE(id["EventOutcomeIndicator"], QString("4"));
    QCOMPARE(id.one("EventOutcomeDescription").text, QString("the server <hangs> up"));
  }

  void names_of_any_script_arrive_data() {
    QTest::addColumn<QByteArray>("name");
    QTest::addColumn<QString>("arrives");
    QTest::newRow("umlauts") << QByteArray("Müller, Jürgen") << QStringLiteral("Müller, Jürgen");
    QTest::newRow("kanji") << QByteArray("山田 太郎") << QStringLiteral("山田 太郎");
    QTest::newRow("beyond the plane")
        << QByteArray("\xF0\xA0\xAE\xB7") << QString::fromUcs4(U"\U00020BB7", 1);
    QTest::newRow("markup") << QByteArray("<a b=\"c\">&'") << QStringLiteral("<a b=\"c\">&'");
    QTest::newRow("lines and tabs") << QByteArray("a\r\n\tb") << QStringLiteral("a\r\n\tb");
    QTest::newRow("control") << QByteArray("a\x01\x1b[2Jb") << QStringLiteral("a\uFFFD\uFFFD[2Jb");
    QTest::newRow("delete, and of C1") << QByteArray("a\x7f\xC2\x9f") << QStringLiteral("a\u007f\u009f");
    QTest::newRow("no UTF-8") << QByteArray("M\xFCller\xE5\xB1") << QStringLiteral("M\uFFFDller\uFFFD\uFFFD");
    QTest::newRow("overlong") << QByteArray("\xC0\xAF") << QStringLiteral("\uFFFD\uFFFD");
    QTest::newRow("surrogate") << QByteArray("\xED\xA0\x80") << QStringLiteral("\uFFFD\uFFFD\uFFFD");
    QTest::newRow("no character") << QByteArray("\xEF\xBF\xBF") << QStringLiteral("\uFFFD");
  }
  void names_of_any_script_arrive() {
    QFETCH(QByteArray, name);
    AuditEvent one = event(Kind::accessed);
    one.study.patient_name = name.toStdString();
    one.study.patient_id = name.toStdString();
    const std::string text = imaging::syslog_message(one, origin());
    QVERIFY2(text.find_first_of("\r\n\t\x01\x1b\x7f") == std::string::npos, text.c_str());
    const XmlElement patient = audit_in(text).all("ParticipantObjectIdentification")[1];
    QTEST(patient.one("ParticipantObjectName").text, "arrives");
    QTEST(patient["ParticipantObjectID"], "arrives");
  }

  void the_frame_is_that_of_rfc_5424() {
    AuditEvent one = event(Kind::accessed);
    const QByteArray text = QByteArray::fromStdString(imaging::syslog_message(one, origin()));
    QVERIFY2(text.startsWith("<85>1 1970-01-01T00:00:01.234567Z ward3 tidemark-cli 4711 DICOM+RFC3881 - "
                             "\xEF\xBB\xBF<?xml "),
             text);
    one.failure = "x";
    QVERIFY(imaging::syslog_message(one, origin()).starts_with("<84>1 "));
    imaging::AuditOrigin odd = origin();
    odd.host = "Jürgens PC";
    const QByteArray other = QByteArray::fromStdString(imaging::syslog_message(one, odd));
    QVERIFY2(other.contains("Z J__rgens_PC tidemark-cli "), other);
    QCOMPARE(imaging::counted_frame("ab c"), std::string("4 ab c"));
  }

  // DICOM PS3.15 A.6: repositories take at least 32768 bytes.
  void no_message_is_longer_than_repositories_take() {
    AuditEvent one = event(Kind::exported);
    one.study.patient_name = std::string(100'000, '&');
    one.study.patient_id = std::string(100'000, '\x7f');
    one.failure = std::string(100'000, '<');
    one.files.assign(100, "/" + std::string(3000, 'x'));
    for (int i = 0; i < 1000; ++i) one.study.objects[std::string(60, '1') + std::to_string(i)] = 1;
    QVERIFY(imaging::syslog_message(one, origin()).size() <= 32768);
    AuditEvent query = event(Kind::queried);
    query.query = std::string(100'000, 'x');
    QVERIFY(imaging::syslog_message(query, origin()).size() <= 32768);
  }
};

TIDEMARK_TEST(AuditMessageTest)

}  // namespace tidemark::test::audit_message_test

#include "audit_message_test.moc"
