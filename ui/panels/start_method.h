// One way to begin a level set.
#pragma once

#include "solver/coarse_grid.h"
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
  virtual void start() = 0;
  // Whether the surface can come to rest on coarser grids first.
  [[nodiscard]] virtual bool has_levels() const { return true; }
  void set_coarse_to_fine(bool wanted) { coarse_to_fine_ = wanted; }

 signals:
  void changed();  // the sentence
  void failed(const QString& message);

 protected:
  // Of a start in the case.
  [[nodiscard]] int levels() const {
    return coarse_to_fine_ && has_levels() ? solver::levels_for(proxy()->volume().geometry) : 1;
  }

 private:
  bool coarse_to_fine_ = false;
};

}  // namespace tidemark::ui
