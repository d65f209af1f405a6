// A box in which a number is typed.
#pragma once

#include <QDoubleSpinBox>

namespace tidemark::ui {

// A point and a comma both stand before the digits behind the point, whatever the user's language; digits are
// not grouped, and 1.000 is no number where fewer than three are kept behind the point. An exponent and the
// box's own unit may follow. What is no number, or none that the box can hold as it was typed, changes
// nothing: it stays, marked, until something else is typed or Escape brings the value back. The mark says why
// in the tool tip and to screen readers. While nothing is typed a letter is the window's, as in its views.
class NumberBox : public QDoubleSpinBox {
  Q_OBJECT
 public:
  explicit NumberBox(QWidget* parent = nullptr);

  // Shows the value, without a signal, unless another one is just being typed: nothing is taken out of the
  // user's hands.
  void show_unless_typed(double value);
  void show_value(double value);  // whatever is typed
  // Why what stands in the box is not taken; empty: it is, or is not finished.
  [[nodiscard]] QString problem() const;

  [[nodiscard]] QString textFromValue(double value) const override;
  [[nodiscard]] double valueFromText(const QString& text) const override;
  QValidator::State validate(QString& text, int& position) const override;
  void fixup(QString& text) const override;

 protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

 private:
  enum class Reading { number, unfinished, no_number, too_fine, out_of_range };
  struct Typed {
    Reading reading = Reading::unfinished;
    double value = 0.0;
  };
  [[nodiscard]] Typed read(const QString& typed) const;
  [[nodiscard]] bool is_being_typed() const;
  [[nodiscard]] QString typed_in(const QString& text) const;  // without prefix and suffix
  [[nodiscard]] QString without_unit(const QString& typed) const;
  [[nodiscard]] bool can_become_larger_only(double value) const;

  // What was typed to the end and not taken, and the value that holds on instead.
  mutable QString refused_;
  mutable double kept_ = 0.0;
};

}  // namespace tidemark::ui
