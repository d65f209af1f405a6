// Texts of a language, and sentences in which values were filled in before they were translated.
#include "ui/look/catalogue.h"

#include <QDir>
#include <QFileInfo>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTest>

#include "engine/message_text.h"
#include "engine/start_text.h"
#include "tests/support/test_program.h"
#include "ui/look/language.h"

namespace tidemark::test::catalogue_test {

class CatalogueTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { QCoreApplication::installTranslator(&catalogue_); }
  void cleanupTestCase() { QCoreApplication::removeTranslator(&catalogue_); }

  void a_text_is_known_in_any_context() {
    QCOMPARE(QCoreApplication::translate("A", "Open"), QStringLiteral("Öffnen"));
    QCOMPARE(QCoreApplication::translate("B", "Open"), QStringLiteral("Öffnen"));
    QCOMPARE(QCoreApplication::translate("A", "Close"), QStringLiteral("Close"));
  }

  void a_count_chooses_the_form() {
    const auto said_of = [](QLocale::Language language, int count) {
      const ui::Catalogue catalogue(R"({"%n files": ["one", "several"], "%n steps": "only"})", language);
      return catalogue.translate("A", "%n files", nullptr, count) +
             catalogue.translate("A", "%n steps", nullptr, count);
    };
    for (const int count : {-1, 2, 5, 21, 100}) QCOMPARE(said_of(QLocale::German, count), "severalonly");
    QCOMPARE(said_of(QLocale::German, 1), "oneonly");
    QCOMPARE(said_of(QLocale::German, 0), "severalonly");
    QCOMPARE(said_of(QLocale::French, 0), "oneonly");
    for (const char* json : {R"({"%n": ["", "a"]})", R"({"%n": []})", R"({"%n": [1, "a"]})"})
      QVERIFY2(ui::Catalogue(QByteArray(json)).isEmpty(), json);
  }

  void counts_are_said_in_each_language_and_in_english() {
    const auto said_of = [](const char* language, int count) {
      ui::use_language(language);
      return QCoreApplication::translate("A", "%n warnings", nullptr, count);
    };
    QCOMPARE(said_of("en", 1), "1 warning");
    QCOMPARE(said_of("en", 0), "0 warnings");
    QCOMPARE(said_of("de", 1), "1 Warnung");
    QCOMPARE(said_of("de", 2), "2 Warnungen");
    QCOMPARE(said_of("fr", 0), "0 avertissement");
    QCOMPARE(said_of("ja", 1), QString(said_of("ja", 2)).replace('2', '1'));
    ui::use_language("en");
  }

  // A word of two meanings has but one translation.
  void the_first_and_the_second_are_called_so_in_all_heads_of_a_table() {
    const auto said = [](const char* english) { return QCoreApplication::translate("A", english); };
    for (const ui::Language& language : ui::languages()) {
      ui::use_language(language.code);
      for (const char* number : {"First", "Second"}) {
        const QString with_unit = said(QByteArray(number).append(" (ml)"));
        QVERIFY2(with_unit.startsWith(said(number) + ' '), qPrintable(said(number)));
      }
    }
    ui::use_language("en");
  }

  void each_part_of_a_start_is_said_in_the_language() {
    document::Start start;
    start.from = document::ThresholdStart{1.0, 2.0};
    start.seeds.resize(2);
    start.levels = 3;
    ui::use_language("de");
    QCOMPARE(engine::start_text(start), "Werte 1 bis 2, 2 Kugeln, von grob nach fein in 3 Stufen");
    ui::use_language("en");
    QCOMPARE(engine::start_text(start), QString::fromStdString(start.describe()));
  }

  void values_of_a_sentence_are_found_and_filled_in() {
    QCOMPARE(said("a/b.dcm: no pixel data"), QStringLiteral("a/b.dcm: keine Pixeldaten"));
    QCOMPARE(said("3 of 12 slices"), QStringLiteral("von 12 Schichten 3"));
    QCOMPARE(said("2 spaces"), QStringLiteral("2 spaces"));
  }

  void a_sentence_within_a_sentence_is_translated_too() {
    QCOMPARE(said("x.nii: cannot be read: dim[3] is 7 mm"),
             QStringLiteral("x.nii: nicht lesbar: dim[3] ist 7 mm"));
  }

  void the_most_exact_pattern_is_taken() {
    QCOMPARE(said("x: cannot be read: why"), QStringLiteral("x: nicht lesbar: why"));
  }

  void one_word_is_a_name_and_stays() {
    QCOMPARE(said("Open: no pixel data"), QStringLiteral("Open: keine Pixeldaten"));
  }

  void lines_are_sentences_of_their_own() {
    QCOMPARE(said("a: no pixel data\nunknown\nOpen"), QStringLiteral("a: keine Pixeldaten\nunknown\nÖffnen"));
  }

  // What the user interface says is not searched for sentences.
  void texts_of_the_user_interface_are_taken_as_they_are() {
    QCOMPARE(QCoreApplication::translate("A", "a: no pixel data"), QStringLiteral("a: no pixel data"));
  }

  void doubled_braces_are_braces() {
    QCOMPARE(ui::Catalogue::filled("{{}} {} {0:.2f}", {"1", "2"}), QStringLiteral("{} 1 1"));
    QCOMPARE(said("{x} is needed: 5"), QStringLiteral("5: {x} fehlt"));
  }

  void what_is_no_catalogue_knows_nothing() {
    for (const char* json : {"", "[]", "{", "{\"a\": 1}", "{\"a\": \"\"}"}) {
      QVERIFY2(ui::Catalogue(QByteArray(json)).isEmpty(), json);
    }
  }

  void each_language_has_a_file_and_each_file_a_language() {
    QStringList files = QDir(":/tidemark/languages").entryList({"*.json"}, QDir::Files, QDir::Name);
    for (const ui::Language& language : ui::languages()) {
      const QString code = QString::fromLatin1(language.code);
      QCOMPARE(QLocale(code).name().startsWith(code), true);
      QVERIFY2(files.removeOne(code + ".json"), language.code);
      if (code == "en") continue;  // counts alone
      QFile file(":/tidemark/languages/" + code + ".json");
      QVERIFY(file.open(QIODevice::ReadOnly));
      const QJsonObject texts = QJsonDocument::fromJson(file.readAll()).object();
      QVERIFY2(texts.size() > 2000, language.code);
      QVERIFY2(!texts["&File"].toString().isEmpty(), language.code);
    }
    QCOMPARE(files, QStringList());
  }

  void a_language_is_used_and_given_up_again() {
    ui::use_language("de");
    QCOMPARE(QCoreApplication::translate("A", "Tidemark has no such text"),
             QStringLiteral("Tidemark has no such text"));
    QVERIFY(QCoreApplication::translate("A", "&File") != "&File");
    QCOMPARE(QLocale().language(), QLocale::German);
    ui::use_language("en");
    QCOMPARE(QCoreApplication::translate("A", "&File"), QStringLiteral("&File"));
    QCOMPARE(QLocale().language(), QLocale::English);
  }

 private:
  static QString said(const std::string& message) { return engine::message_text(message); }

  ui::Catalogue catalogue_{R"({"Open": "Öffnen", "{}: no pixel data": "{}: keine Pixeldaten",
    "{} of {} slices": "von {1} Schichten {0}", "{}: cannot be read: {}": "{}: nicht lesbar: {}",
    "{}: {} is needed": "{}: falsch {}", "{} is {:.3g} mm": "{} ist {} mm",
    "{{x}} is needed: {}": "{}: {{x}} fehlt"})"};
};

TIDEMARK_TEST(CatalogueTest)

}  // namespace tidemark::test::catalogue_test

#include "catalogue_test.moc"
