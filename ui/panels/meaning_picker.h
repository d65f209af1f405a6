// A picker of a label's meaning, from a list or by typing.
#pragma once

#include <QComboBox>
#include <optional>

#include "document/labels.h"

namespace tidemark::ui {

class MeaningPicker : public QComboBox {
  Q_OBJECT
 public:
  explicit MeaningPicker(QWidget* parent = nullptr);

  void show_label(const document::Label* label);  // null: there is none

 signals:
  // Unset: the meaning of the label's name.
  void picked(const std::optional<tidemark::imaging::SegmentMeaning>& meaning);

 protected:
  void focusOutEvent(QFocusEvent* event) override;

 private:
  [[nodiscard]] int row_of(const std::optional<imaging::SegmentMeaning>& meaning);
  void pick(int row);
  void take_first_match();

  std::optional<document::Label> shown_;
  std::optional<imaging::SegmentMeaning> foreign_;  // one that is not in the list, in the last row
};

// In the user's language: "Brain ventricle"; of another system's codes the meaning that they came with.
[[nodiscard]] QString meaning_text(const imaging::SegmentMeaning& meaning);

}  // namespace tidemark::ui
