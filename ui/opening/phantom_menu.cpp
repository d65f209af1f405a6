#include "ui/opening/phantom_menu.h"

#include "imaging/phantom/phantom.h"

namespace tidemark::ui {

PhantomMenu::PhantomMenu(QWidget* parent) : QMenu(tr("Open &Phantom"), parent) {
  setToolTipsVisible(true);
  for (const std::string_view kind : imaging::phantom_kinds()) {
    const engine::PhantomText text = engine::phantom_text(kind);
    QAction* action = addAction(text.title);
    action->setToolTip(text.sentence);
    action->setStatusTip(text.sentence);
    const QString name = QString::fromUtf8(kind.data(), qsizetype(kind.size()));
    action->setObjectName(name);
    connect(action, &QAction::triggered, this, [this, name] { emit chosen(name); });
  }
}

}  // namespace tidemark::ui
