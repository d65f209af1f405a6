// Base64 as RFC 4648 has it, there and back.
#include "core/base64.h"

#include <QByteArray>

#include "tests/support/test_program.h"

namespace tidemark::test::base64_test {

class Base64Test : public QObject {
  Q_OBJECT

 private slots:
  void it_is_that_of_rfc_4648() {
    QCOMPARE(to_base64(""), std::string());
    QCOMPARE(to_base64("f"), std::string("Zg=="));
    QCOMPARE(to_base64("fo"), std::string("Zm8="));
    QCOMPARE(to_base64("foo"), std::string("Zm9v"));
    QCOMPARE(to_base64("foobar\xff"), std::string("Zm9vYmFy/w=="));
  }

  void it_is_read_as_it_is_written() {
    for (int size = 0; size < 70; ++size) {
      QByteArray bytes;
      for (int i = 0; i < size; ++i) bytes += static_cast<char>(i * 37 + size);
      const std::string text = bytes.toBase64().toStdString();
      QCOMPARE(to_base64(bytes.toStdString()), text);
      const auto back = from_base64(text);
      QVERIFY(back.has_value());
      QCOMPARE(QByteArray::fromStdString(*back), bytes);
    }
  }

  void what_is_no_base64_is_refused() {
    for (const char* bad : {"A", "AB", "ABC", "AB!=", "A===", "AB=C", "ABCD\n", "====", "A\xc3\xa9=="}) {
      QVERIFY2(!from_base64(bad), bad);
    }
  }
};

TIDEMARK_TEST(Base64Test)

}  // namespace tidemark::test::base64_test

#include "base64_test.moc"
