// Questions with names from files in them.
#include "ui/widgets/question.h"

#include <QApplication>
#include <QPushButton>
#include <QTest>
#include <QTimer>

#include "tests/support/test_program.h"

namespace tidemark::test::question_test {

class QuestionTest : public QObject {
  Q_OBJECT

 private slots:
  void a_name_is_no_html() {
    const QString text = "The voxels of CT<p style=\"font-size:1px\"> go to the server.";
    Qt::TextFormat format = Qt::AutoText;
    QString asked;
    QPushButton* proposed = nullptr;
    QTimer::singleShot(0, this, [&] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (!box) return;
      format = box->textFormat();
      asked = box->text();
      proposed = box->defaultButton();
      box->button(QMessageBox::Yes)->click();
    });
    const auto answer = ui::ask(nullptr, "Send?", text, QMessageBox::Yes | QMessageBox::No, QMessageBox::No);
    QCOMPARE(answer, QMessageBox::Yes);
    QCOMPARE(format, Qt::PlainText);
    QCOMPARE(asked, text);
    QVERIFY(proposed);
  }

  void escape_is_no() {
    QTimer::singleShot(0, this, [] { QTest::keyClick(QApplication::activeModalWidget(), Qt::Key_Escape); });
    QCOMPARE(ui::ask(nullptr, "Send?", "Send it?", QMessageBox::Yes | QMessageBox::No, QMessageBox::Yes),
             QMessageBox::No);
  }
};

TIDEMARK_TEST(QuestionTest)

}  // namespace tidemark::test::question_test

#include "question_test.moc"
