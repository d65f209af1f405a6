// The controls that paint labels by hand: by which tool, and on which voxels.
#pragma once

#include "engine/display.h"
#include "ui/panels/case_widget.h"

class QFormLayout;
class QToolButton;

namespace tidemark::ui {

class SliderNumber;

class LabelPaintControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit LabelPaintControls(QWidget* parent = nullptr);

  void set_label(std::uint8_t label);  // 0: the newest, or a new one
  void set_take(document::Take take);

 protected:
  void attach() override;
  void refresh() override;

 private:
  QWidget* make_buttons();
  void choose(engine::LabelWay way);
  void limit_values(bool on);
  void read_values();
  // Changes the brush of the case; without one nothing happens.
  template <class Change>
  void change_brush(Change&& apply);
  void show_brush();

  QFormLayout* rows_;
  QToolButton* brush_;
  QToolButton* outline_;
  QToolButton* livewire_;
  QToolButton* limited_;
  SliderNumber* low_;
  SliderNumber* high_;
};

}  // namespace tidemark::ui
