// Rows of a form that come and go.
#include "ui/widgets/form.h"

#include <QLineEdit>
#include <QTest>

#include "tests/support/test_program.h"

namespace tidemark::test::form_test {

class FormTest : public QObject {
  Q_OBJECT

 private slots:
  void a_row_that_takes_the_place_of_a_hidden_one_has_its_height() {
    QWidget panel;
    ui::Form form(&panel);
    form.note(QStringLiteral("Words that wrap, so that the height of the form follows from its width."));
    auto* first = new QLineEdit;
    form.row(QStringLiteral("First"), first, {});
    auto* second = new QLineEdit;
    form.row(QStringLiteral("Second"), second, {});
    panel.resize(260, 200);
    const auto show = [&](bool first_shown, bool second_shown) {
      ui::show_row(*form.layout(), first, first_shown);
      ui::show_row(*form.layout(), second, second_shown);
      QCoreApplication::processEvents();
    };
    show(false, false);
    panel.show();
    QVERIFY(QTest::qWaitForWindowExposed(&panel));
    for (int round = 0; round < 2; ++round) {
      show(false, true);
      QCOMPARE(second->height(), second->sizeHint().height());
      show(false, false);
      show(true, false);
      QVERIFY(first->isVisible() && !second->isVisible());
      QCOMPARE(first->height(), first->sizeHint().height());
      QVERIFY(form.layout()->labelForField(first)->isVisible());
      show(true, true);
      QVERIFY(second->y() >= first->y() + first->height());
      QCOMPARE(second->height(), second->sizeHint().height());
      QCOMPARE(form.layout()->rowCount(), 3);
      show(false, false);
    }
  }
};

TIDEMARK_TEST(FormTest)

}  // namespace tidemark::test::form_test

#include "form_test.moc"
