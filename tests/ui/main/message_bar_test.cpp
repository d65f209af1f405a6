// Messages for who reads them, who hears them, and who has no mouse.
#include "ui/main/message_bar.h"

#include <QLabel>
#include <QPushButton>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"

namespace tidemark::test::message_bar_test {
namespace {

QLabel* label_of(const ui::MessageBar& bar, const QString& text) {
  for (QLabel* label : bar.findChildren<QLabel*>()) {
    if (label->text() == text) return label;
  }
  return nullptr;
}

}  // namespace

class MessageBarTest : public QObject {
  Q_OBJECT

 private slots:
  void a_name_is_no_html() {
    ui::MessageBar bar;
    const QString text = "a<h1>b</h1>: cannot be read";
    bar.show_text(text);
    const QLabel* label = label_of(bar, text);
    QVERIFY(label);
    QCOMPARE(label->textFormat(), Qt::PlainText);
  }

  void who_hears_a_button_hears_what_it_is_about() {
    ui::MessageBar bar;
    bar.show_offers("The surface leaks.", {}, {{"Pause", "Pauses the case", [] {}}});
    for (const char* name : {"Pause", "Dismiss"})
      QCOMPARE(button<QPushButton>(bar, name)->accessibleDescription(), QString("The surface leaks."));
  }

  void tab_reaches_the_text() {
    ui::MessageBar bar;
    bar.show_text("The file was not saved.");
    show(bar);
    QLabel* label = label_of(bar, "The file was not saved.");
    QVERIFY(label);
    button<QPushButton>(bar, "Dismiss")->setFocus();
    QTest::keyClick(&bar, Qt::Key_Tab);
    QVERIFY(label->hasFocus());
    QTest::keyClick(label, Qt::Key_Tab);
    QVERIFY(button<QPushButton>(bar, "Dismiss")->hasFocus());
  }
};

TIDEMARK_TEST(MessageBarTest)

}  // namespace tidemark::test::message_bar_test

#include "message_bar_test.moc"
