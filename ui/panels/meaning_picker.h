// A picker of a label's meaning, from a list or by typing.
#pragma once

#include <QComboBox>
#include <optional>

#include "document/labels.h"

namespace tidemark {

class MeaningPicker : public QComboBox {
  Q_OBJECT
 public:
  explicit MeaningPicker(QWidget* parent = nullptr);

  void show_label(const Label* label);  // null: there is none

 signals:
  // Unset: the meaning of the label's name.
  void picked(const std::optional<tidemark::SegmentMeaning>& meaning);

 protected:
  void focusOutEvent(QFocusEvent* event) override;

 private:
  [[nodiscard]] int row_of(const std::optional<SegmentMeaning>& meaning);
  void pick(int row);
  void take_first_match();

  std::optional<Label> shown_;
  std::optional<SegmentMeaning> foreign_;  // one that is not in the list, in the last row
};

// In the user's language: "Brain ventricle"; of another system's codes the meaning that they came with.
[[nodiscard]] QString meaning_text(const SegmentMeaning& meaning);

}  // namespace tidemark
