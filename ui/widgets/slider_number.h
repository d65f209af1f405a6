// A number that can be dragged, typed, and stepped by keys.
#pragma once

#include <QElapsedTimer>
#include <QWidget>
#include <cstdint>

class QSlider;

namespace tidemark::ui {

class NumberBox;

// A slider and a spin box side by side, always of the same value.
class SliderNumber : public QWidget {
  Q_OBJECT
 public:
  enum class Scale { linear, logarithmic };
  explicit SliderNumber(QWidget* parent = nullptr);

  // What the slider spans from its left to its right end; a number outside can be typed as long as it is
  // within [least, most]. A logarithmic scale needs numbers > 0.
  void set_range(double low, double high, double least, double most, Scale scale = Scale::linear);
  void set_range(double low, double high, Scale scale = Scale::linear) {
    set_range(low, high, low, high, scale);
  }
  void set_decimals(int decimals);  // and a step of one in the last place
  void set_step(double step);       // of the arrows
  void set_unit(const QString& unit);
  void set_value(double value);  // without a signal; left alone while the user types
  [[nodiscard]] double value() const;

  void set_name(const QString& name, const QString& tip);  // for screen readers, and for the mouse
  [[nodiscard]] QSlider* slider() const { return slider_; }
  [[nodiscard]] NumberBox* number() const { return number_; }

 signals:
  // By the user. One drag of the slider is one gesture (CaseProxy::new_gesture()), and so are keys that
  // follow each other quickly.
  void edited(double value, std::uint64_t gesture);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void fit_number();
  void slider_moved();
  void number_changed(double value);
  void announce();
  void begin_gesture();
  void show_in_slider(double value);
  [[nodiscard]] double value_at(int position) const;

  QSlider* slider_;
  NumberBox* number_;
  double low_ = 0.0;
  double high_ = 1.0;
  Scale scale_ = Scale::linear;
  std::uint64_t gesture_ = 0;
  QElapsedTimer since_edit_;
};

}  // namespace tidemark::ui
