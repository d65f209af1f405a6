// Small files as text.
#include "core/text_file.h"

#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::text_file_test {

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace

class TextFileTest : public QObject {
  Q_OBJECT

 private slots:
  void all_of_a_file_is_read_up_to_a_limit() {
    const TemporaryFolder folder;
    write(folder / "a.txt", std::string("one\0two", 7));
    QVERIFY(read_text_file(folder / "a.txt", 7).value() == std::string("one\0two", 7));
    QVERIFY(
        failure(read_text_file(folder / "a.txt", 6)).endsWith("a.txt: 7 bytes, more than 6 are not read"));
    write(folder / "b.txt", "");
    QVERIFY(read_text_file(folder / "b.txt", 0).value().empty());
  }

  void what_is_no_file_is_refused_at_once() {
    const TemporaryFolder folder;
    QVERIFY(
        failure(read_text_file(folder / "none", 9)).endsWith("cannot be read: No such file or directory"));
    QVERIFY(failure(read_text_file(folder.path(), 9)).endsWith("cannot be read: Is a directory"));
    QCOMPARE(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    QVERIFY(failure(read_text_file(folder / "pipe", 9)).contains("cannot be read: "));
  }

  // As where one program saves a table that another one looks at.
  void a_file_that_is_replaced_meanwhile_is_one_or_the_other() {
    const TemporaryFolder folder;
    const std::string texts[] = {"short", std::string(5000, 'l')};
    write(folder / "table", texts[0]);
    std::jthread writer([&](const std::stop_token& stop) {
      for (std::size_t n = 1; !stop.stop_requested(); ++n) {
        write(folder / "next", texts[n % 2]);
        std::filesystem::rename(folder / "next", folder / "table");
      }
    });
    int lengths[2] = {0, 0};
    for (int n = 0; n < 5000 || (lengths[0] == 0 || lengths[1] == 0); ++n) {
      const auto text = read_text_file(folder / "table", 10000);
      QCOMPARE(failure(text), QString());
      QVERIFY2(*text == texts[0] || *text == texts[1], text->c_str());
      ++lengths[*text == texts[0] ? 0 : 1];
    }
  }
};

TIDEMARK_TEST(TextFileTest)

}  // namespace tidemark::test::text_file_test

#include "text_file_test.moc"
