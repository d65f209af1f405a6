// The page of one list of primitives: plots of them, the list, and the numbers of the chosen one.
#pragma once

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLabel>
#include <QStackedWidget>

#include "ui/transfer/primitive_form.h"
#include "ui/transfer/primitive_list.h"
#include "ui/transfer/transfer_plot.h"

namespace tidemark::ui {

class PrimitivePage : public QWidget {
  Q_OBJECT
 public:
  PrimitivePage(PrimitiveKind kind, int axes, const QString& when_empty, QWidget* parent = nullptr);

  // The plots are of the first two axes, or of the first and opacity; with more than one there are buttons to
  // change between them. Takes the plot over.
  void add_plot(const QString& name, TransferPlot* plot);
  void set_axes(const std::vector<PrimitiveAxis>& axes);
  void set_primitives(const std::vector<AxisPrimitive>& primitives, int chosen);  // emits nothing
  void reset_zoom();

  [[nodiscard]] TransferPlot* shown_plot() const;
  [[nodiscard]] PrimitiveList* list() const { return list_; }
  [[nodiscard]] PrimitiveForm* form() const { return form_; }

 signals:
  void edited(const std::vector<tidemark::ui::AxisPrimitive>& primitives, int chosen);

 private:
  void replace(int index, const AxisPrimitive& primitive);
  void add(const AxisPrimitive& primitive);
  void remove_chosen();
  [[nodiscard]] AxisPrimitive new_primitive(renderer::TransferFactor::Kind kind) const;

  PrimitiveKind kind_;
  std::vector<PrimitiveAxis> axes_;
  std::vector<AxisPrimitive> primitives_;
  int chosen_ = -1;
  QWidget* switches_;
  QButtonGroup* switch_group_;
  QStackedWidget* plots_;
  std::vector<TransferPlot*> all_plots_;
  QLabel* greyed_;
  PrimitiveList* list_;
  PrimitiveForm* form_;
};

}  // namespace tidemark::ui
