#include "ui/main/keys_dialog.h"

#include <QApplication>
#include <QDialogButtonBox>
#include <QHeaderView>
#include <QKeyEvent>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/look/icons.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

bool is_plain(const QKeyEvent& key) {
  return (key.modifiers() & ~(Qt::ShiftModifier | Qt::KeypadModifier)) == 0;
}

bool is_of_dialog(const QKeyEvent& key) {
  const auto is_any_of = [&](auto... keys) { return ((key.key() == keys) || ...); };
  return is_plain(key) &&
         is_any_of(Qt::Key_Escape, Qt::Key_Return, Qt::Key_Enter, Qt::Key_Tab, Qt::Key_Backtab);
}

class KeyBox : public QKeySequenceEdit {
 public:
  using QKeySequenceEdit::QKeySequenceEdit;

 protected:
  bool event(QEvent* event) override {
    if (event->type() != QEvent::ShortcutOverride || !is_of_dialog(*static_cast<QKeyEvent*>(event)))
      return QKeySequenceEdit::event(event);
    event->ignore();
    return false;
  }
  void keyPressEvent(QKeyEvent* event) override {
    if (is_of_dialog(*event)) return event->ignore();
    if (event->key() != Qt::Key_Backspace || !is_plain(*event)) return QKeySequenceEdit::keyPressEvent(event);
    clear();
    emit editingFinished();
  }
};

}  // namespace

KeysDialog::KeysDialog(Actions& actions, QWidget* parent) : QDialog(parent), actions_(actions) {
  setWindowTitle(tr("Keys"));
  resize(520, 560);
  table_ = new QTableWidget(static_cast<int>(actions_.all().size()), 2);
  table_->setHorizontalHeaderLabels({tr("Action"), tr("Key")});
  table_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  table_->horizontalHeader()->resizeSection(1, 180);
  table_->verticalHeader()->hide();
  table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table_->setSelectionMode(QAbstractItemView::NoSelection);
  table_->setTabKeyNavigation(false);
  int row = 0;
  for (QAction* action : actions_.all()) {
    auto* name = new QTableWidgetItem(action->property("tip").toString());
    name->setIcon(action->icon());
    table_->setItem(row, 0, name);
    auto* key = new KeyBox(action->shortcut());
    key->setAccessibleName(tr("Key of %1").arg(name->text()));
    table_->setCellWidget(row, 1, key);
    connect(key, &QKeySequenceEdit::editingFinished, this, &KeysDialog::keep_keys);
    ++row;
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close | QDialogButtonBox::RestoreDefaults);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this,
          &KeysDialog::reset_keys);
  // Tab goes on to boxes that are out of sight, too.
  connect(qApp, &QApplication::focusChanged, table_, [this](const QWidget* /*before*/, const QWidget* now) {
    if (now && now->parentWidget() == table_->viewport()) table_->scrollTo(table_->indexAt(now->pos()));
  });
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(table_);
  layout->addWidget(make_note(tr("Type a key into its box. Backspace leaves an action without one.")));
  layout->addWidget(buttons);
  QPushButton* close = buttons->button(QDialogButtonBox::Close);
  setTabOrder(buttons->button(QDialogButtonBox::RestoreDefaults), close);
  close->setDefault(true);  // of this dialog, in which it is by now
  mark_conflicts();
}

QKeySequenceEdit& KeysDialog::box(std::size_t row) const {
  return *qobject_cast<QKeySequenceEdit*>(table_->cellWidget(static_cast<int>(row), 1));
}

// A key is what its box shows, also where the box still waits for another one of a sequence.
void KeysDialog::done(int result) {
  keep_keys();
  QDialog::done(result);
}

void KeysDialog::keep_keys() {
  const auto& all = actions_.all();
  for (std::size_t row = 0; row < all.size(); ++row) {
    const QKeySequence key = box(row).keySequence();
    if (key != all[row]->shortcut()) actions_.set_key(all[row], key);
  }
  mark_conflicts();
}

void KeysDialog::reset_keys() {
  const auto& all = actions_.all();
  for (std::size_t row = 0; row < all.size(); ++row) {
    actions_.reset_key(all[row]);
    box(row).setKeySequence(all[row]->shortcut());
  }
  mark_conflicts();
}

// Two actions with one key: neither would work.
void KeysDialog::mark_conflicts() {
  const auto& all = actions_.all();
  for (std::size_t index = 0; index < all.size(); ++index) {
    QString others;
    for (const QAction* other : all) {
      if (other == all[index] || other->shortcut().isEmpty()) continue;
      if (other->shortcut() == all[index]->shortcut()) others = other->property("tip").toString();
    }
    auto* name = table_->item(static_cast<int>(index), 0);
    QFont font = name->font();
    font.setBold(!others.isEmpty());
    name->setFont(font);
    const QString tip = all[index]->property("tip").toString();
    name->setText(others.isEmpty() ? tip : tr("%1 (same key as: %2)").arg(tip, others));
  }
}

}  // namespace tidemark::ui
