// Whose images they are: names in the scripts of the world, and ages.
#include "imaging/patient.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_patient_test {

namespace fs = std::filesystem;

class DicomPatientTest : public QObject {
  Q_OBJECT

  test::TemporaryFolder folder_;
  fs::path file_;

  void set(unsigned group, unsigned element, const char* text) const {
    test::set_text(file_, group, element, text);
  }
  imaging::Patient patient() const { return test::only_series(file_).patient; }

 private slots:
  void initTestCase() {
    file_ = test::write_series(test::sample_volume({4, 3, 2}), folder_ / "series").front();
    fs::remove(folder_ / "series/slice-00002.dcm");
  }

  // The examples of DICOM PS3.5, annexes H to K, and what is seen besides.
  void a_name_is_read_in_its_own_script_data() {
    QTest::addColumn<QByteArray>("character_set");
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<QString>("name");
    const auto row = [](const char* title, const char* character_set, const char* bytes, const char* name) {
      QTest::newRow(title) << QByteArray(character_set) << QByteArray(bytes) << QString::fromUtf8(name);
    };
    row("plain", "", "Doe^John", "Doe, John");
    row("all components", "", "Adams^John Robert^Quincy^Rev.^B.A. ", "Adams, John Robert Quincy Rev. B.A.");
    row("family name alone", "", "Doe^^^^", "Doe");
    row("given name alone", "", "^John", "John");
    row("nothing", "", "^^=^", "");
    row("Latin 1", "ISO_IR 100", "Buc^J\xe9r\xf4me", "Buc, Jérôme");
    row("Greek", "ISO_IR 126", "\xc4\xe9\xef\xed\xf5\xf3\xe9\xef\xf2", "Διονυσιος");
    row("Russian", "ISO_IR 144", "\xbb\xee\xda", "Люк");
    row("Hebrew", "ISO_IR 138", "\xf9\xf8\xe5\xef^\xe3\xe1\xe5\xf8\xe4", "שרון, דבורה");
    row("UTF-8", "ISO_IR 192", "Wang^XiaoDong=王^小東=", "王 小東 (Wang, XiaoDong)");
    row("GB18030", "GB18030", "Wang^XiaoDong=\xcd\xf5^\xd0\xa1\xb6\xab", "王 小东 (Wang, XiaoDong)");
    row("Korean", "\\ISO 2022 IR 149",
        "Hong^Gildong=\x1b$)C\xfb\xf3^\x1b$)C\xd1\xce\xd4\xd7=\x1b$)C\xc8\xab^\x1b$)C\xb1\xe6\xb5\xbf",
        "洪 吉洞 (Hong, Gildong)");
    row("Japanese", "\\ISO 2022 IR 87",
        "Yamada^Tarou=\x1b$B;3ED\x1b(B^\x1b$BB@O:\x1b(B=\x1b$B$d$^$@\x1b(B^\x1b$B$?$m$&\x1b(B",
        "山田 太郎 (Yamada, Tarou)");
    row("Japanese with katakana", "ISO 2022 IR 13\\ISO 2022 IR 87",
        "\xd4\xcf\xc0\xde^\xc0\xdb\xb3=\x1b$B;3ED\x1b(J^\x1b$BB@O:\x1b(J", "山田 太郎 (ﾔﾏﾀﾞ, ﾀﾛｳ)");
    row("katakana alone", "ISO_IR 13", "\xd4\xcf\xc0\xde^\xc0\xdb\xb3", "ﾔﾏﾀﾞ, ﾀﾛｳ");
    row("supplementary kanji", "\\ISO 2022 IR 87\\ISO 2022 IR 159", "=\x1b$(D0!\x1b(B", "丂");
    row("Japanese that is cut off", "\\ISO 2022 IR 87", "A=\x1b$B;", "?$B; (A)");
    row("an unknown character set", "KLINGON", "K\xe9hlar", "K?hlar");
    row("bytes without a character set", "", "M\xfcller^Eva", "M?ller, Eva");
    row("a line break", "", "Doe\n^John", "Doe, John");
  }

  void a_name_is_read_in_its_own_script() {
    QFETCH(QByteArray, character_set);
    QFETCH(QByteArray, bytes);
    set(0x0008, 0x0005, character_set);
    set(0x0010, 0x0010, bytes);
    QTEST(QString::fromStdString(patient().name), "name");
  }

  void a_name_without_end_is_cut() {
    set(0x0008, 0x0005, "ISO_IR 192");
    std::string endless;
    for (int i = 0; i < 5000; ++i) endless += "é";
    set(0x0010, 0x0010, endless.c_str());
    const QString name = QString::fromStdString(patient().name);
    QVERIFY(name.size() > 100 && name.size() < 1000);
    QVERIFY(!name.contains(QChar::ReplacementCharacter));
  }

  void an_age_is_the_files_or_that_at_the_study_data() {
    QTest::addColumn<QByteArray>("age");
    QTest::addColumn<QByteArray>("birth");
    QTest::addColumn<QByteArray>("study");
    QTest::addColumn<QString>("shown");
    const auto row = [](const char* title, const char* age, const char* birth, const char* study,
                        const char* shown) {
      QTest::newRow(title) << QByteArray(age) << QByteArray(birth) << QByteArray(study) << QString(shown);
    };
    row("the file's", "045Y", "19000101", "20040731", "45Y");
    row("weeks", "006W", "", "", "6W");
    row("the day before a birthday", "", "19590801", "20040731", "44Y");
    row("on a birthday", "", "19590731", "20040731", "45Y");
    row("a small child", "", "20030115", "20040731", "18M");
    row("a newborn", "", "20040701", "20040731", "30D");
    row("an age that is not known", "000Y", "19590731", "20040731", "45Y");
    row("an age that is none", "old", "19590731", "20040731", "45Y");
    row("born after the study", "", "20050101", "20040731", "");
    row("born on a day that is none", "", "20030231", "20040731", "");
    row("born too long ago", "", "00010101", "20040731", "");
    row("nothing is known", "", "", "20040731", "");
    row("the study has no date", "", "19590731", "", "");
  }

  void an_age_is_the_files_or_that_at_the_study() {
    QFETCH(QByteArray, age);
    QFETCH(QByteArray, birth);
    QFETCH(QByteArray, study);
    set(0x0010, 0x1010, age);
    set(0x0010, 0x0030, birth);
    set(0x0008, 0x0020, study);
    QTEST(QString::fromStdString(patient().age), "shown");
  }

  void number_and_sex_are_read() {
    set(0x0010, 0x0020, " PID-4711 ");
    for (const auto& [written, read] :
         {std::pair("F", "F"), {"M ", "M"}, {"O", "O"}, {"female", ""}, {"", ""}}) {
      set(0x0010, 0x0040, written);
      QCOMPARE(patient().sex, std::string(read));
    }
    QCOMPARE(patient().id, std::string("PID-4711"));
  }

  void what_is_not_there_stays_empty() {
    for (const unsigned element : {0x0010U, 0x0020U, 0x0030U, 0x0040U, 0x1010U}) set(0x0010, element, "");
    set(0x0008, 0x0020, "");
    QCOMPARE(patient(), imaging::Patient());
  }
};

TIDEMARK_TEST(DicomPatientTest)

}  // namespace tidemark::test::dicom_patient_test

#include "dicom_patient_test.moc"
