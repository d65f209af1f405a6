// What panels keep of cases goes with them.
#include "ui/panels/per_case.h"

#include <memory>

#include "tests/support/test_program.h"

namespace tidemark::test::per_case_test {

class PerCaseTest : public QObject {
  Q_OBJECT

 private slots:
  void each_case_has_its_own() {
    ui::PerCase<int> kept;
    QObject one;
    QObject other;
    QVERIFY(!kept.find(&one));
    kept[one] = 7;
    kept[other] = 8;
    kept[one] += 1;
    QCOMPARE(*kept.find(&one), 8);
    QCOMPARE(*kept.find(&other), 8);
    QVERIFY(!kept.find(nullptr));
  }

  // The next one may lie at the same address.
  void what_is_kept_goes_with_its_case_though_nobody_follows_that() {
    QObject panel;
    ui::PerCase<int> kept;
    auto one = std::make_unique<QObject>();
    kept[*one] = 7;
    one->disconnect(&panel);
    const QObject* address = one.get();
    one.reset();
    QVERIFY(!kept.find(address));
  }
};

TIDEMARK_TEST(PerCaseTest)

}  // namespace tidemark::test::per_case_test

#include "per_case_test.moc"
