// The pushes of the speed terms at a place as bars: to the left inward, to the right outward.
#pragma once

#include <QColor>
#include <QString>
#include <QWidget>
#include <optional>
#include <vector>

#include "engine/case_balance.h"

namespace tidemark::ui {

class BalanceBars : public QWidget {
  Q_OBJECT
 public:
  explicit BalanceBars(QWidget* parent = nullptr);

  void set_place(const std::optional<engine::ExplainedPlace>& place);

  // In mm per unit of time, > 0 outward.
  struct Bar {
    QString name;
    QColor colour;  // invalid: the colour of text
    double push_mm = 0.0;
  };
  [[nodiscard]] const std::vector<Bar>& bars() const { return bars_; }  // the last one is the sum

  [[nodiscard]] QSize sizeHint() const override;
  [[nodiscard]] QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  [[nodiscard]] int row_height() const;
  void paint_bar(QPainter& painter, const Bar& bar, const QRectF& row, double largest) const;

  std::vector<Bar> bars_;
};

}  // namespace tidemark::ui
