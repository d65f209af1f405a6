// The names that files of a case get: whole characters, nothing that names have no place for, and no patient.
#include "ui/results/file_name.h"

#include "engine/study_loader.h"
#include "tests/support/test_program.h"
#include "ui/widgets/path_text.h"

namespace tidemark::test::file_name_test {

class FileNameTest : public QObject {
  Q_OBJECT
 private slots:
  void a_name_ends_with_a_whole_character() {
    const QString beyond_16_bits = QString::fromUcs4(U"\U00020BB7", 1);
    const QString name = ui::file_name_of(QString(59, u'a') + beyond_16_bits + QStringLiteral("/x"));
    QCOMPARE(name, QString(59, u'a'));
    QCOMPARE(ui::file_name_of(QString(58, u'a') + beyond_16_bits + u'x'), QString(58, u'a') + beyond_16_bits);
    QCOMPARE(ui::file_name_of(QString(70, u'/')), QString(60, u'-'));
  }

  void no_text_is_without_a_path() {
    const QString half(QChar(0xD842));
    QVERIFY(!ui::path_of(half).empty());
    QVERIFY(ui::path_of(QStringLiteral("/tmp/山田.nii")) == std::filesystem::path("/tmp/山田.nii"));
  }

  void a_name_does_not_tell_the_patient_data() {
    QTest::addColumn<QString>("patient");
    QTest::addColumn<QString>("series");
    QTest::addColumn<bool>("tells");
    QTest::newRow("Latin") << "Smith, Jo"
                           << "SMITH CT" << true;
    QTest::newRow("initials") << "S, J"
                              << "Series J" << false;
    QTest::newRow("Japanese") << "山田 太郎 (Yamada, Tarou)"
                              << "山田太郎 胸部CT" << true;
    QTest::newRow("Chinese") << "王 伟"
                             << "王伟 CT平扫" << true;
    QTest::newRow("Korean") << "홍 길동"
                            << "길동 CT" << true;
    QTest::newRow("half-width kana") << "ﾔﾏﾀﾞ ﾀﾛｳ"
                                     << "ヤマダ CT" << true;
    QTest::newRow("another one") << "山田 太郎"
                                 << "胸部CT" << false;
  }
  void a_name_does_not_tell_the_patient() {
    QFETCH(QString, patient);
    QFETCH(QString, series);
    QFETCH(bool, tells);
    engine::LoadedStudy study;
    auto volume = std::make_shared<Volume>();
    volume->modality = "CT";
    study.volume = volume;
    study.date = "2026-11-02";
    study.name = series;
    study.patient.name = patient.toStdString();
    QCOMPARE(ui::file_name_of(study), tells ? QStringLiteral("CT 2026-11-02") : series);
  }
};

TIDEMARK_TEST(FileNameTest)

}  // namespace tidemark::test::file_name_test

#include "file_name_test.moc"
