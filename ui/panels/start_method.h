// One way to begin a level set.
#pragma once

#include "ui/panels/case_widget.h"

namespace tidemark::ui {

class StartMethod : public CaseWidget {
  Q_OBJECT
 public:
  using CaseWidget::CaseWidget;

  [[nodiscard]] virtual QString title() const = 0;
  // The effect of start(), in words.
  [[nodiscard]] virtual QString sentence() const = 0;
  [[nodiscard]] virtual bool can_start() const = 0;
  // On so many levels; 1 where it has no others.
  virtual void start(int levels) = 0;
  // Whether the surface can come to rest on coarser grids first.
  [[nodiscard]] virtual bool has_levels() const { return true; }

 signals:
  void changed();  // the sentence
  void failed(const QString& message);
  void remarked(const QString& message);  // on what the start was made from
};

}  // namespace tidemark::ui
