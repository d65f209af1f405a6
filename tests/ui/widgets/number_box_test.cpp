// Numbers as they are typed, whatever the language.
#include "ui/widgets/number_box.h"

#include <QApplication>
#include <QLineEdit>
#include <QShortcut>
#include <QSignalSpy>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::test::number_box_test {

namespace fs = std::filesystem;

class NumberBoxTest : public QObject {
  Q_OBJECT

  std::unique_ptr<QWidget> window_;
  ui::NumberBox* box_ = nullptr;

  void make(const QString& language) {
    QLocale::setDefault(QLocale(language));
    window_ = std::make_unique<QWidget>();
    box_ = new ui::NumberBox(window_.get());
    box_->resize(120, 28);
    box_->setDecimals(3);
    box_->setRange(-5000.0, 5000.0);
    box_->setSuffix(" HU");
    box_->setValue(7.0);
    auto* other = new QLineEdit(window_.get());
    other->move(0, 40);
    test::show(*window_);
  }
  void type(const QString& text) {
    box_->setFocus();
    box_->selectAll();
    QTest::keyClicks(box_, text);
  }
  void leave() { QTest::keyClick(box_, Qt::Key_Tab); }
  bool is_marked() {
    const QImage picture = box_->grab().toImage();
    return picture.pixelColor(1, picture.height() / 2) == ui::problem_colour(box_->palette());
  }

 private slots:
  void cleanup() {
    window_.reset();
    QLocale::setDefault(QLocale::c());
  }

  void both_separators_stand_before_the_digits_behind_the_point_data() {
    QTest::addColumn<QString>("language");
    QTest::addColumn<QString>("typed");
    QTest::addColumn<double>("value");
    for (const char* language : {"de_DE", "en_US", "fr_FR", "sv_SE", "C"}) {
      const auto row = [&](const char* typed, double value) {
        QTest::addRow("%s: %s", language, typed) << language << typed << value;
      };
      row("97.5", 97.5);
      row("97,5", 97.5);
      row("0.25", 0.25);
      row(",25", 0.25);
      row("-0,125", -0.125);
      row("1.234", 1.234);
      row("1,234", 1.234);
      row("1234", 1234.0);
    }
  }
  void both_separators_stand_before_the_digits_behind_the_point() {
    QFETCH(QString, language);
    QFETCH(QString, typed);
    QFETCH(double, value);
    make(language);
    type(typed);
    QTest::keyClick(box_, Qt::Key_Return);
    QCOMPARE(box_->value(), value);
    type("7");
    type(typed);
    leave();
    QCOMPARE(box_->value(), value);
    QVERIFY(!is_marked());
  }

  void what_is_no_number_stays_marked_and_changes_nothing_data() {
    QTest::addColumn<QString>("typed");
    QTest::newRow("groups and digits behind the point") << "1.234,5";
    QTest::newRow("groups") << "1,234,567";
    QTest::newRow("groups by spaces") << "1 234";
    QTest::newRow("groups by apostrophes") << "1'234";
    QTest::newRow("finer than it can be kept") << "1.23456";
    QTest::newRow("too large") << "50000";
    QTest::newRow("too small") << "-50000";
    QTest::newRow("a sign in the middle") << "12-3";
  }
  void what_is_no_number_stays_marked_and_changes_nothing() {
    QFETCH(QString, typed);
    for (const char* language : {"de_DE", "en_US"}) {
      make(language);
      const QSignalSpy changes(box_, &QDoubleSpinBox::valueChanged);
      QVERIFY(!is_marked());
      type(typed);
      QCOMPARE(box_->cleanText(), typed);
      QTest::keyClick(box_, Qt::Key_Return);
      QCOMPARE(box_->cleanText(), typed);
      leave();
      QCOMPARE(box_->cleanText(), typed);
      QVERIFY(is_marked());
      QVERIFY(box_->problem().contains(typed));
      QCOMPARE(box_->value(), 7.0);
      box_->show_unless_typed(7.0);  // as after any other change of the case
      QCOMPARE(box_->cleanText(), typed);
      QCOMPARE(changes.count(), 0);
      type("8");
      QVERIFY(!is_marked());
      leave();
      QCOMPARE(box_->value(), 8.0);
      QCOMPARE(changes.count(), 1);
    }
  }

  void another_value_takes_the_place_of_what_was_refused() {
    make("de_DE");
    type("1.2.3");
    leave();
    box_->show_unless_typed(9.0);
    QCOMPARE(box_->cleanText(), QStringLiteral("9,000"));
    QVERIFY(!is_marked());
    box_->show_unless_typed(7.0);
    QCOMPARE(box_->cleanText(), QStringLiteral("7,000"));
  }

  void a_number_that_is_not_finished_is_not_marked() {
    make("en_US");
    box_->setRange(10.0, 100.0);
    box_->setValue(20.0);
    for (const char* typed : {"-", "", "1", "0."}) {
      type(typed);
      QVERIFY2(!is_marked(), typed);
    }
    leave();
    QVERIFY(is_marked());  // 0 is too small
    QCOMPARE(box_->value(), 20.0);
  }

  void nothing_typed_is_the_value_that_was() {
    make("de_DE");
    type("4");
    QTest::keyClick(box_, Qt::Key_Backspace);
    leave();
    QCOMPARE(box_->cleanText(), QStringLiteral("7,000"));
    QVERIFY(!is_marked());
  }

  // As after a number was typed and Return pressed: P plays.
  void a_letter_is_the_windows_while_nothing_is_typed() {
    make("de_DE");
    int played = 0;
    auto* shortcut = new QShortcut(QKeySequence("P"), window_.get());
    connect(shortcut, &QShortcut::activated, this, [&played] { ++played; });
    QApplication::setActiveWindow(window_.get());
    type("12,5");
    QTest::keyClicks(box_, "p");  // no letter is lost: what stands there is no number then
    QCOMPARE(played, 0);
    QVERIFY(is_marked());
    QTest::keyClick(box_, Qt::Key_Backspace);
    QTest::keyClick(box_, Qt::Key_Return);
    QTest::keyClick(box_, Qt::Key_P);
    QCOMPARE(played, 1);
    QCOMPARE(box_->value(), 12.5);
    QVERIFY(!is_marked());
  }

  void a_unit_and_an_exponent_may_follow() {
    make("de_DE");
    for (const char* typed : {"12,5HU", "12,5 hu", "12,5h", "1,25e1", "125E-1"}) {
      type(typed);
      QVERIFY2(!is_marked(), typed);
      QTest::keyClick(box_, Qt::Key_Return);
      QCOMPARE(box_->value(), 12.5);
      box_->setValue(7.0);
    }
    type("1e");
    QVERIFY(!is_marked());  // not finished
    leave();
    QCOMPARE(box_->cleanText(), QStringLiteral("7,000"));
    for (const char* typed : {"1e9", "12mm", "1e3,5", "abc1"}) {
      type(typed);
      QTest::keyClick(box_, Qt::Key_Return);
      QVERIFY2(is_marked(), typed);
      QCOMPARE(box_->value(), 7.0);
    }
  }

  void escape_brings_the_value_back() {
    make("de_DE");
    for (const char* typed : {"12", "50000", "1 000"}) {
      const QSignalSpy changes(box_, &QDoubleSpinBox::valueChanged);
      type(typed);
      QTest::keyClick(box_, Qt::Key_Escape);
      QCOMPARE(box_->cleanText(), QStringLiteral("7,000"));
      QVERIFY(!is_marked());
      type(typed);
      QTest::keyClick(box_, Qt::Key_Escape);
      leave();
      QCOMPARE(box_->value(), 7.0);
      QCOMPARE(changes.count(), 0);
    }
    // What was refused, too.
    type("50000");
    QTest::keyClick(box_, Qt::Key_Return);
    QVERIFY(is_marked());
    QTest::keyClick(box_, Qt::Key_Escape);
    QVERIFY(!is_marked());
    QCOMPARE(box_->cleanText(), QStringLiteral("7,000"));
  }

  void a_whole_number_has_nothing_behind_the_point() {
    make("de_DE");
    box_->setDecimals(0);
    type("11.112");  // a port with its digits grouped is not 11
    leave();
    QCOMPARE(box_->value(), 7.0);
    QVERIFY(is_marked());
    type("11,0");
    leave();
    QCOMPARE(box_->value(), 11.0);
  }

  void a_group_of_digits_is_not_what_stands_behind_the_point() {
    make("de_DE");
    for (const int decimals : {0, 1, 2}) {
      box_->setDecimals(decimals);
      for (const char* typed : {"1.000", "-11,000", "110.000"}) {
        box_->show_value(7.0);
        type(typed);
        leave();
        QCOMPARE(box_->value(), 7.0);
        QVERIFY2(is_marked(), typed);
      }
      for (const char* typed : {"8.0000", "0008,000", "8,00"}) {
        box_->show_value(7.0);
        type(typed);
        leave();
        QVERIFY2(box_->value() == 8.0 && !is_marked(), typed);
      }
      type("0.000");
      leave();
      QVERIFY(box_->value() == 0.0 && !is_marked());
    }
  }

  // Their minus is two characters.
  void a_negative_number_is_one_in_languages_from_right_to_left() {
    for (const char* language : {"he_IL", "ar_EG", "fa_IR", "ur_PK"}) {
      make(language);
      box_->setValue(-7.0);
      QVERIFY2(box_->problem().isEmpty(), language);
      box_->stepUp();
      QCOMPARE(box_->value(), -6.0);
      type("-7,5");
      leave();
      QCOMPARE(box_->value(), -7.5);
      QVERIFY2(!is_marked(), language);
    }
  }

  void a_screen_reader_says_why_a_number_is_refused() {
    make("en_US");
    type("50000");
    leave();
    QVERIFY(is_marked());
    QVERIFY(!box_->problem().isEmpty());
    QCOMPARE(box_->accessibleDescription(), box_->problem());
    box_->show_value(8.0);
    QVERIFY(!is_marked());
    QCOMPARE(box_->accessibleDescription(), QString());
  }

  void digits_are_not_grouped_and_zero_has_no_sign() {
    make("de_DE");
    box_->setValue(1234.5);
    QCOMPARE(box_->cleanText(), QStringLiteral("1234,500"));
    box_->setRange(-1e7, 1e7);
    box_->setValue(-1234567.0);
    QCOMPARE(box_->cleanText(), QStringLiteral("-1234567,000"));
    box_->setValue(-0.0);
    QCOMPARE(box_->cleanText(), QStringLiteral("0,000"));
    QCOMPARE(ui::count_text(1234567), QStringLiteral("1234567"));
    QCOMPARE(ui::number_text(-1234.56, 1), QStringLiteral("-1234,6"));
    QCOMPARE(ui::number_text(-0.04, 1), QStringLiteral("0,0"));
    QCOMPARE(ui::general_text(-0.0, 4), QStringLiteral("0"));
    QCOMPARE(ui::short_text(-0.0), QStringLiteral("0"));
    QVERIFY(!std::signbit(ui::rounded(-0.2, 0)));
  }

  // Others than these boxes read numbers by the rules of one language.
  void no_other_box_takes_numbers() {
    QStringList others;
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(TIDEMARK_SOURCE) / "ui")) {
      if (!entry.is_regular_file() || entry.path().stem() == "number_box") continue;
      std::ifstream stream(entry.path());
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      for (const char* box : {"QSpinBox", "QDoubleSpinBox", "QDoubleValidator", "QInputDialog"}) {
        if (text.find(box) != std::string::npos)
          others << QString::fromStdString(entry.path().filename().string()) + ": " + box;
      }
    }
    QCOMPARE(others.join(", "), QString());
  }
};

TIDEMARK_TEST(NumberBoxTest)

}  // namespace tidemark::test::number_box_test

#include "number_box_test.moc"
