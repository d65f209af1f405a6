// The tools that finish labels: which one, its numbers, the preview, and Apply.
#pragma once

#include <QTimer>

#include "document/label_tool.h"
#include "engine/label_finisher.h"
#include "ui/panels/case_widget.h"

class QComboBox;
class QFormLayout;
class QLabel;
class QPushButton;

namespace tidemark::ui {

class SliderNumber;
class WorkLine;

class LabelToolControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit LabelToolControls(QWidget* parent = nullptr);

  // The labels that the tool works on; the first is the one that was chosen first.
  void set_labels(const std::vector<std::uint8_t>& labels);
  void set_take(document::Take take);  // what of others they may take

 protected:
  void attach() override;
  void refresh() override;

 private:
  [[nodiscard]] std::optional<document::LabelTool> tool() const;  // none: none is chosen
  [[nodiscard]] document::LabelToolUse use() const;
  [[nodiscard]] engine::LabelFinisher* finisher() const;  // null: there is no case
  void choose_tool();
  void fill_others();
  // Whether the preview is of all that is chosen here.
  [[nodiscard]] bool is_looked_at() const;
  void look_again();  // soon
  void look();        // computes the preview
  void show_preview();
  void say(const QString& text);  // in place of the progress
  void show_buttons();

  QFormLayout* rows_;
  QComboBox* tool_;
  SliderNumber* amount_;
  QComboBox* axis_;
  QComboBox* other_;
  QLabel* hint_;
  WorkLine* work_;
  QPushButton* apply_;
  QTimer soon_;
  document::Take take_ = document::Take::free_voxels;
  std::vector<std::uint8_t> labels_;
  QPointer<engine::LabelFinisher> shown_;  // to which this is connected
};

}  // namespace tidemark::ui
