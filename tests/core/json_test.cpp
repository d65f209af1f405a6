// JSON from outside: read as another library reads it, within bounds of memory and time.
#include <nlohmann/json.hpp>

#include "core/json/json_field.h"
#include "tests/support/child_process.h"
#include "tests/support/test_program.h"

namespace tidemark::test::json_test {

namespace {

constexpr std::int64_t kMiB = std::int64_t{1} << 20;

std::string repeated(const std::string& piece, std::size_t bytes) {
  std::string text;
  text.reserve(bytes + piece.size());
  while (text.size() < bytes) text += piece;
  return text;
}

}  // namespace

class JsonTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_json_is_what_another_library_says_data() {
    QTest::addColumn<QByteArray>("text");
    const char* const texts[] = {"",
                                 " ",
                                 "null",
                                 "true",
                                 "tru",
                                 "truex",
                                 "nul",
                                 "0",
                                 "-0",
                                 "00",
                                 "01",
                                 "-",
                                 "+1",
                                 "1.",
                                 ".5",
                                 "1.5",
                                 "1e",
                                 "1e+",
                                 "1e5",
                                 "1E-5",
                                 "1.5e+3",
                                 "0x1",
                                 "NaN",
                                 "Infinity",
                                 "1 2",
                                 "[]",
                                 "[",
                                 "]",
                                 "[1]",
                                 "[1,]",
                                 "[,1]",
                                 "[1 2]",
                                 "[1,2]",
                                 "{}",
                                 "{",
                                 "{1:2}",
                                 "{\"a\"}",
                                 "{\"a\":}",
                                 "{\"a\":1}",
                                 "{\"a\":1,}",
                                 "{\"a\":1 \"b\":2}",
                                 "{\"a\":1,\"b\":[{}]}",
                                 "{\"a\" : [ 1 , { } ] }",
                                 "[1}",
                                 "{\"a\":1]",
                                 "\"\"",
                                 "\"a",
                                 "\"\\n\\t\\\"\\\\\\/\\b\\f\\r\"",
                                 "\"\\x\"",
                                 "\"\\u12\"",
                                 "\"\\u00e9\"",
                                 "\"\\ud83d\\ude00\"",
                                 "\"\\ud83d\"",
                                 "\"\\ude00\"",
                                 "\"\\ud83dx\"",
                                 "\"\\ud83d\\u0041\"",
                                 "\"\xc3\xa9\"",
                                 "\"\xc3\"",
                                 "\"\x80\"",
                                 "\"\xc0\xaf\"",
                                 "\"\xe0\x80\x80\"",
                                 "\"\xed\xa0\x80\"",
                                 "\"\xf0\x9f\x98\x80\"",
                                 "\"\xf5\x80\x80\x80\"",
                                 "\"\xf4\x90\x80\x80\"",
                                 "\"a\nb\"",
                                 "\"\x7f\"",
                                 "[\"\\",
                                 "[\"\\u",
                                 "\xef\xbb\xbf[]",
                                 "\xff\xfe[",
                                 "// a\n1",
                                 "[1]x",
                                 "[[[]]]",
                                 "[[]",
                                 "'a'",
                                 "\t\r\n [ ] \n"};
    for (const char* text : texts) QTest::newRow(text) << QByteArray(text);
    QTest::newRow("a zero") << QByteArray("\"a\0b\"", 5);
  }
  void what_is_json_is_what_another_library_says() {
    QFETCH(QByteArray, text);
    const std::string bytes = text.toStdString();
    const auto document = JsonDocument::parse(bytes, "a.json");
    QCOMPARE(document.has_value(), nlohmann::json::accept(bytes));
    if (document) return;
    QCOMPARE(document.error().kind, ErrorKind::input);
    QVERIFY(document.error().message.starts_with("a.json: not JSON: "));
  }

  void what_was_written_comes_back() {
    const nlohmann::json written{{"text", "a\"\\/\b\f\n\r\t\x01 \xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80"},
                                 {"numbers", {0.1 + 0.2, -1e-300, 5e300, 0, -7, 1.0}},
                                 {"whole", std::numeric_limits<std::int64_t>::min()},
                                 {"yes", true},
                                 {"none", nullptr},
                                 {"inner", {{"list", {{1, 2}, nlohmann::json::array(), {3}}}}}};
    for (const bool is_ascii : {false, true}) {
      const std::string text = written.dump(is_ascii ? 2 : -1, ' ', is_ascii);
      const auto document = JsonDocument::parse(text, "a.json");
      QCOMPARE(failure(document), QString());
      const JsonField root = root_of(*document, "a.json");
      QCOMPARE(root.at("text").text(), written["text"].get<std::string>());
      const JsonField numbers = root.at("numbers");
      QCOMPARE(numbers.size(6), std::size_t{6});
      for (const std::size_t i : {0, 1, 2, 3, 4, 5, 2, 0}) {
        QCOMPARE(numbers.at(i).number(), written["numbers"][i].get<double>());
      }
      QCOMPARE(root.at("whole").integer(std::numeric_limits<std::int64_t>::min(), 0),
               written["whole"].get<std::int64_t>());
      QVERIFY(root.at("yes").boolean());
      QVERIFY(!root.has("none") && !root.has("other"));
      const JsonField list = root.at("inner").at("list");
      QCOMPARE(list.at(std::size_t{0}).at(std::size_t{1}).integer(0, 9), 2);
      QCOMPARE(list.at(1).size(1), std::size_t{0});
      QCOMPARE(list.at(std::size_t{2}).at(std::size_t{0}).integer(0, 9), 3);
      QVERIFY(root.good());
      static_cast<void>(list.at(3));
      QCOMPARE(root.status().error().message, std::string("a.json: inner.list[3]: is missing"));
    }
  }

  void names_with_escapes_are_found() {
    const auto document = JsonDocument::parse(R"({"st\u0065p": 1, "step2": 2, "ste": 3})", "a.json");
    const JsonField root = root_of(*document, "a.json");
    QCOMPARE(root.at("step").integer(0, 9), 1);
    QCOMPARE(root.at("ste").integer(0, 9), 3);
    root.only({"step", "step2", "ste"});
    QVERIFY(root.good());
  }

  void a_number_beyond_double_is_refused_with_its_field() {
    const auto document = JsonDocument::parse(R"({"a": 1e999, "b": 1e-999})", "a.json");
    const JsonField root = root_of(*document, "a.json");
    QCOMPARE(root.at("b").number(), 0.0);
    QCOMPARE(root.at("a").number(), 0.0);
    QVERIFY(root.status().error().message.starts_with("a.json: a: "));
  }

  // In addition to the text itself, no more than 64 MiB may be taken, and no more than a second.
  void a_large_text_is_refused_within_its_size_and_64_mib_data() {
    QTest::addColumn<QByteArray>("piece");
    QTest::newRow("numbers") << QByteArray("1,");
    QTest::newRow("lists") << QByteArray("[],");
    QTest::newRow("objects") << QByteArray("{\"a\":{}},");
    QTest::newRow("texts") << QByteArray("\"\",");
  }
  void a_large_text_is_refused_within_its_size_and_64_mib() {
    QFETCH(QByteArray, piece);
    const std::string text = "[" + repeated(piece.toStdString(), 60'000'000) + "1]";
    const Ended ended = run_in_child(
        [&]() -> Status {
          const auto document = JsonDocument::parse(text, "large.json");
          if (!document) return pass_on(document);
          return {};
        },
        {.more_memory = 64 * kMiB});
    QVERIFY(!ended.was_killed);
    QVERIFY2(ended.failure.find("large.json: more than 4194304 values") == 0, ended.failure.c_str());
  }

  void depth_takes_no_stack() {
    const auto document = JsonDocument::parse(std::string(60'000'000, '['), "deep.json");
    QCOMPARE(document.error().message, std::string("deep.json: nested more than 32 deep"));
  }
};

TIDEMARK_TEST(JsonTest)

}  // namespace tidemark::test::json_test

#include "json_test.moc"
