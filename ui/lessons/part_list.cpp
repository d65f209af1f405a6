#include "ui/lessons/part_list.h"

#include <QHBoxLayout>
#include <QShortcut>
#include <QSignalBlocker>
#include <utility>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/question.h"

namespace tidemark::ui {

PartList::PartList(QWidget* parent) : QWidget(parent), list_(new QListWidget) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  list_->setAccessibleName(tr("The lesson and its parts"));
  list_->setToolTip(tr("The chosen one is shown beside."));
  list_->setIconSize({kIconSmall, kIconSmall});
  list_->setTextElideMode(Qt::ElideRight);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setMinimumHeight(4 * list_->fontMetrics().lineSpacing());
  connect(list_, &QListWidget::currentRowChanged, this, &PartList::choose);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpaceTight);
  const auto put = [row](QToolButton* button) {
    row->addWidget(button);
    return button;
  };
  put(make_button("add-part", u"add", tr("Add a part"), QKeySequence(Qt::ALT | Qt::Key_Insert),
                  &PartList::add));
  duplicate_ = put(make_button("duplicate-part", u"duplicate", tr("Duplicate the part"),
                               QKeySequence(Qt::CTRL | Qt::Key_D), &PartList::duplicate));
  remove_ = put(make_button("remove-part", u"remove", tr("Remove the part"),
                            QKeySequence(Qt::ALT | Qt::Key_Delete), &PartList::remove));
  row->addStretch(1);
  up_ = put(make_button("part-up", {}, tr("Move the part up"), QKeySequence(Qt::ALT | Qt::Key_Up),
                        &PartList::move_up));
  up_->setArrowType(Qt::UpArrow);
  down_ = put(make_button("part-down", {}, tr("Move the part down"), QKeySequence(Qt::ALT | Qt::Key_Down),
                          &PartList::move_down));
  down_->setArrowType(Qt::DownArrow);
  column->addWidget(list_, 1);
  column->addLayout(row);
}

QToolButton* PartList::make_button(const QString& name, QStringView picture, const QString& text,
                                   const QKeySequence& keys, void (PartList::*method)()) {
  auto* button = new QToolButton;
  button->setObjectName(name);
  if (!picture.isEmpty()) button->setIcon(icon(picture));
  button->setIconSize({kIconSmall, kIconSmall});
  button->setFocusPolicy(Qt::StrongFocus);
  button->setAccessibleName(text);
  button->setToolTip(QStringLiteral("%1 (%2)").arg(text, keys.toString(QKeySequence::NativeText)));
  button->setShortcut(keys);
  connect(button, &QToolButton::clicked, this, method);
  return button;
}

void PartList::show_lesson(document::Lesson& lesson, std::optional<std::size_t> chosen) {
  lesson_ = &lesson;
  fill(chosen ? static_cast<int>(*chosen) + 1 : 0);
}

void PartList::fill(int row) {
  {
    const QSignalBlocker quiet(list_);
    list_->clear();
    for (std::size_t i = 0; i <= lesson_->parts.size(); ++i) list_->addItem(QString());
    const QSize high(0, list_->fontMetrics().height() + kSpace);
    for (int item = 0; item < list_->count(); ++item) list_->item(item)->setSizeHint(high);
    QFont bold = list_->font();
    bold.setBold(true);
    list_->item(0)->setFont(bold);
    list_->setCurrentRow(row);
  }
  show_titles(std::nullopt);
  choose(row);
}

void PartList::show_titles(std::optional<int> problem_row) {
  const auto or_none = [](const std::string& title) {
    const QString text = QString::fromStdString(title).simplified();
    return text.isEmpty() ? tr("(no title)") : text;
  };
  for (int row = 0; row < list_->count(); ++row) {
    QListWidgetItem* item = list_->item(row);
    const QString text = row == 0 ? or_none(lesson_->title)
                                  : QStringLiteral("%1  %2").arg(row).arg(
                                        or_none(lesson_->parts[static_cast<std::size_t>(row) - 1].title));
    item->setText(text);
    item->setToolTip(text);
    item->setIcon(problem_row == row ? icon(u"warning") : QIcon());
  }
}

std::optional<std::size_t> PartList::chosen() const {
  const int row = list_->currentRow();
  if (row <= 0) return std::nullopt;
  return static_cast<std::size_t>(row) - 1;
}

void PartList::choose(int row) {
  const bool is_part = row > 0;
  duplicate_->setEnabled(is_part);
  remove_->setEnabled(is_part);
  up_->setEnabled(row > 1);
  down_->setEnabled(is_part && row < list_->count() - 1);
  emit chose();
}

// After the chosen one, or at the end.
void PartList::insert(document::LessonPart part) {
  const std::size_t at = chosen() ? *chosen() + 1 : lesson_->parts.size();
  lesson_->parts.insert(lesson_->parts.begin() + static_cast<std::ptrdiff_t>(at), std::move(part));
  fill(static_cast<int>(at) + 1);
  emit edited();
  emit added();
}

void PartList::add() {
  document::LessonPart part;
  part.attempt.emplace();
  part.attempt->parameters = lesson_->parameters;
  insert(std::move(part));
}

void PartList::duplicate() {
  if (chosen()) insert(document::LessonPart(lesson_->parts[*chosen()]));
}

void PartList::remove() {
  if (!chosen()) return;
  const std::size_t at = *chosen();
  const document::LessonPart& part = lesson_->parts[at];
  const bool holds_words =
      !part.title.empty() || !part.text.empty() || part.question || !part.explanation.empty();
  if (holds_words &&
      ask(this, tr("Remove the part"), tr("Remove part %1 with all that it holds?").arg(at + 1),
          QMessageBox::Yes | QMessageBox::No, QMessageBox::No) != QMessageBox::Yes) {
    return;
  }
  lesson_->parts.erase(lesson_->parts.begin() + static_cast<std::ptrdiff_t>(at));
  fill(static_cast<int>(std::min(at + 1, lesson_->parts.size())));
  emit edited();
}

void PartList::move(int by) {
  if (!chosen()) return;
  const auto to = static_cast<std::ptrdiff_t>(*chosen()) + by;
  if (to < 0 || to >= static_cast<std::ptrdiff_t>(lesson_->parts.size())) return;
  std::swap(lesson_->parts[*chosen()], lesson_->parts[static_cast<std::size_t>(to)]);
  fill(static_cast<int>(to) + 1);
  emit edited();
}

}  // namespace tidemark::ui
