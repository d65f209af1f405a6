// The legend of curves: what the solid line and the dashed one are.
#pragma once

#include <QWidget>

namespace tidemark::ui {

class CurveLegend : public QWidget {
  Q_OBJECT
 public:
  explicit CurveLegend(QWidget* parent = nullptr);

  void set_predicted(const QString& name);  // of the law
  [[nodiscard]] const QString& predicted() const { return predicted_; }

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override { return {100, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  QString predicted_;
};

}  // namespace tidemark::ui
