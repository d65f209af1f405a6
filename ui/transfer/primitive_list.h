// The primitives of a transfer function by number, colour and description.
#pragma once

#include <QListWidget>
#include <QPushButton>
#include <QWidget>

#include "ui/transfer/axis_primitive.h"

namespace tidemark::ui {

class PrimitiveList : public QWidget {
  Q_OBJECT
 public:
  // `when_empty`: a sentence on what an empty list means.
  explicit PrimitiveList(const QString& when_empty, QWidget* parent = nullptr);

  void set_primitives(const std::vector<AxisPrimitive>& primitives, const std::vector<PrimitiveAxis>& axes,
                      int chosen);  // emits nothing

  [[nodiscard]] QListWidget* list() const { return list_; }

 signals:
  void chosen(int index);
  void add_asked(tidemark::renderer::TransferFactor::Kind kind);
  void duplicate_asked();
  void delete_asked();

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QListWidget* list_;
  QPushButton* add_gaussian_;
  QPushButton* add_ramp_;
  QPushButton* duplicate_;
  QPushButton* remove_;
  QString when_empty_;
};

// A piece of colour with a border, so that any colour is seen on any background.
QIcon colour_swatch(const QColor& colour, const QWidget& on);

}  // namespace tidemark::ui
