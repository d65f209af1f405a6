#include "ui/opening/phantom_menu.h"

#include "imaging/phantom/phantom.h"

namespace tidemark {

PhantomMenu::PhantomMenu(QWidget* parent) : QMenu(tr("Open &Phantom"), parent) {
  setToolTipsVisible(true);
  for (const std::string_view kind : phantom_kinds()) {
    const PhantomText text = phantom_text(kind);
    QAction* action = addAction(text.title);
    action->setToolTip(text.sentence);
    action->setStatusTip(text.sentence);
    const QString name = QString::fromUtf8(kind.data(), qsizetype(kind.size()));
    action->setObjectName(name);
    connect(action, &QAction::triggered, this, [this, name] { emit chosen(name); });
  }
}

}  // namespace tidemark
