#include "ui/panels/meaning_picker.h"

#include <QAbstractItemView>
#include <QCompleter>
#include <QCoreApplication>
#include <QLineEdit>
#include <QSignalBlocker>
#include <algorithm>

#include "ui/widgets/wheel_guard.h"

namespace tidemark::ui {
namespace {

constexpr int kByName = 0;  // the first row
constexpr int kRowsShown = 14;

// "brain-ventricle" as people write it.
QString text_of(std::string_view word) {
  QString text = QCoreApplication::translate("tidemark::SegmentMeaning", std::string(word).c_str());
  text.replace('-', ' ');
  text[0] = text[0].toUpper();
  return text;
}

}  // namespace

QString meaning_text(const imaging::SegmentMeaning& meaning) {
  for (const imaging::NamedMeaning& named : imaging::segment_meanings()) {
    if (named.meaning == meaning) return text_of(named.word);
  }
  return QString::fromStdString(meaning.type.meaning);
}

MeaningPicker::MeaningPicker(QWidget* parent) : QComboBox(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setMinimumContentsLength(6);
  setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  setMaxVisibleItems(kRowsShown);
  setEditable(true);
  setInsertPolicy(QComboBox::NoInsert);
  completer()->setCompletionMode(QCompleter::PopupCompletion);
  completer()->setFilterMode(Qt::MatchContains);
  guard_wheel(this);
  addItem(QString());
  for (const imaging::NamedMeaning& named : imaging::segment_meanings()) addItem(text_of(named.word));
  connect(this, &QComboBox::activated, this, &MeaningPicker::pick);
  connect(lineEdit(), &QLineEdit::returnPressed, this, &MeaningPicker::take_first_match);
  show_label(nullptr);
}

int MeaningPicker::row_of(const std::optional<imaging::SegmentMeaning>& meaning) {
  if (!meaning) return kByName;
  const auto meanings = imaging::segment_meanings();
  const auto named = std::find_if(meanings.begin(), meanings.end(),
                                  [&](const imaging::NamedMeaning& one) { return one.meaning == *meaning; });
  if (named != meanings.end()) return 1 + static_cast<int>(named - meanings.begin());
  foreign_ = meaning;
  addItem(meaning_text(*meaning));
  return count() - 1;
}

void MeaningPicker::show_label(const document::Label* label) {
  setEnabled(label != nullptr);
  // Nothing has changed: text that is being typed stays.
  if (label && shown_ && label->id == shown_->id && label->name == shown_->name &&
      label->meaning == shown_->meaning)
    return;
  const QSignalBlocker quiet(this);
  shown_.reset();
  if (label) shown_ = *label;
  if (foreign_) removeItem(count() - 1);
  foreign_.reset();
  setItemText(kByName,
              label ? tr("By its name: %1").arg(meaning_text(imaging::guess_segment_meaning(label->name)))
                    : QString());
  setCurrentIndex(label ? row_of(label->meaning) : kByName);
  setEditText(currentText());
  lineEdit()->setCursorPosition(0);  // a long one shows its beginning
}

void MeaningPicker::pick(int row) {
  if (!shown_) return;
  std::optional<imaging::SegmentMeaning> meaning;
  if (foreign_ && row == count() - 1) {
    meaning = foreign_;
  } else if (row != kByName) {
    meaning = imaging::segment_meanings()[static_cast<std::size_t>(row - 1)].meaning;
  }
  lineEdit()->setCursorPosition(0);
  if (meaning == shown_->meaning) return;
  shown_->meaning = meaning;
  emit picked(meaning);
}

// "kidn" and Return are enough.
void MeaningPicker::take_first_match() {
  if (findText(currentText()) >= 0 || currentText().isEmpty() || completer()->completionCount() == 0) return;
  const int row = findText(completer()->currentCompletion());
  if (row < 0) return;
  setCurrentIndex(row);
  pick(row);
}

// Text that names no choice is removed.
void MeaningPicker::focusOutEvent(QFocusEvent* event) {
  QComboBox::focusOutEvent(event);
  if (!completer()->popup()->isVisible()) setEditText(itemText(currentIndex()));
}

}  // namespace tidemark::ui
