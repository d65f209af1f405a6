// Links from other programs: what each means, and what is refused with which sentence.
#include "ui/opening/study_link.h"

#include "tests/support/test_program.h"

namespace tidemark::test::study_link_test {

using ui::StudyLink;

class StudyLinkTest : public QObject {
  Q_OBJECT

 private slots:
  void a_file_or_folder() {
    const auto link = StudyLink::parse("tidemark://open?path=/data/M%C3%BCller%20%26%20co/ct");
    QVERIFY(link);
    QCOMPARE(link->path, QStringLiteral("/data/Müller & co/ct"));
    QVERIFY(link->query.uid.empty());
  }

  void a_study_of_a_server() {
    const auto link = StudyLink::parse("TIDEMARK://Study?UID=1.2.840.99.7&Server=main");
    QVERIFY(link);
    QVERIFY(link->path.isEmpty());
    QCOMPARE(link->server, QStringLiteral("main"));
    QCOMPARE(link->query.uid, std::string("1.2.840.99.7"));
    QVERIFY(StudyLink::parse("tidemark://study?uid=1.2")->server.isEmpty());
  }

  void as_ihe_writes_it() {
    const auto study = StudyLink::parse(
        "tidemark://"
        "IHEInvokeImageDisplay?requestType=STUDY&studyUID=1.2.3&viewerType=IHE_BIR&diagnosticQuality=true");
    QVERIFY(study);
    QCOMPARE(study->query.uid, std::string("1.2.3"));
    const auto patient = StudyLink::parse(
        "tidemark://"
        "IHEInvokeImageDisplay?requestType=PATIENT&patientID=4711%5E%5E%5EHOSPITAL&mostRecentResults=1");
    QVERIFY(patient);
    QCOMPARE(patient->query.patient_id, std::string("4711"));
    QVERIFY(patient->query.uid.empty());
  }

  void what_is_wrong_is_said_data() {
    QTest::addColumn<QString>("link");
    QTest::addColumn<QString>("why");
    QTest::newRow("no path") << "tidemark://open"
                             << "path";
    QTest::newRow("relative path") << "tidemark://open?path=data/ct"
                                   << "path";
    QTest::newRow("no UID") << "tidemark://study?uid="
                            << "uid";
    QTest::newRow("wildcard for a UID") << "tidemark://study?uid=1.2.*"
                                        << "uid";
    QTest::newRow("long UID") << "tidemark://study?uid=" + QString(65, u'1') << "uid";
    QTest::newRow("IHE without UID") << "tidemark://IHEInvokeImageDisplay?requestType=STUDY"
                                     << "studyUID";
    QTest::newRow("IHE without type") << "tidemark://IHEInvokeImageDisplay?studyUID=1.2"
                                      << "requestType";
    QTest::newRow("all patients") << "tidemark://IHEInvokeImageDisplay?requestType=PATIENT&patientID=*"
                                  << "patientID";
    QTest::newRow("no patient") << "tidemark://IHEInvokeImageDisplay?requestType=PATIENT&patientID=%5E4"
                                << "patientID";
    QTest::newRow("something else") << "tidemark://delete?path=/"
                                    << "a link begins with";
    QTest::newRow("nothing") << "tidemark:"
                             << "a link begins with";
    QTest::newRow("endless") << "tidemark://open?path=/" + QString(5000, u'a') << "too long";
  }
  void what_is_wrong_is_said() {
    QFETCH(QString, link);
    QFETCH(QString, why);
    QVERIFY(StudyLink::is_link(link));
    const auto parsed = StudyLink::parse(link);
    QVERIFY(!parsed);
    QVERIFY(parsed.error().kind == ErrorKind::usage);
    QVERIFY2(failure(parsed).contains(why), qPrintable(failure(parsed)));
  }

  void a_path_is_no_link() {
    for (const char* path : {"/data/tidemark", "tidemark", "study.tidemark", "C:/tidemark:1"})
      QVERIFY(!StudyLink::is_link(path));
  }
};

TIDEMARK_TEST(StudyLinkTest)

}  // namespace tidemark::test::study_link_test

#include "study_link_test.moc"
