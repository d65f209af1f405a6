#include "ui/main/keys_dialog.h"

#include <QDialogButtonBox>
#include <QHeaderView>
#include <QKeySequenceEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QVBoxLayout>

#include "ui/look/icons.h"

namespace tidemark::ui {

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
  int row = 0;
  for (QAction* action : actions_.all()) {
    auto* name = new QTableWidgetItem(action->property("tip").toString());
    name->setIcon(action->icon());
    table_->setItem(row, 0, name);
    auto* key = new QKeySequenceEdit(action->shortcut());
    key->setAccessibleName(tr("Key of %1").arg(name->text()));
    table_->setCellWidget(row, 1, key);
    connect(key, &QKeySequenceEdit::keySequenceChanged, this, [this, action](const QKeySequence& sequence) {
      actions_.set_key(action, sequence);
      mark_conflicts();
    });
    ++row;
  }
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close | QDialogButtonBox::RestoreDefaults);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(buttons->button(QDialogButtonBox::RestoreDefaults), &QPushButton::clicked, this, [this] {
    for (std::size_t index = 0; index < actions_.all().size(); ++index) {
      actions_.set_key(actions_.all()[index], {});
      auto* key = qobject_cast<QKeySequenceEdit*>(table_->cellWidget(static_cast<int>(index), 1));
      const QSignalBlocker quiet(key);
      key->setKeySequence(actions_.all()[index]->shortcut());
    }
    mark_conflicts();
  });
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(table_);
  layout->addWidget(buttons);
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
