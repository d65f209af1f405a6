#include "ui/opening/phantom_menu.h"

#include <QCoreApplication>
#include <algorithm>

#include "imaging/phantom/phantom.h"

namespace tidemark {
namespace {

struct Source {
  std::string_view kind;
  const char* title;
  const char* sentence;
};

constexpr Source kTexts[] = {
    {"sphere", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Sphere"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu",
                       "A plain ball: the measured radius can be checked against the formula.")},
    {"dumbbell", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Dumbbell"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Two balls and a neck, which curvature alone pinches off.")},
    {"bridge", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Leaking bridge"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu",
                       "A thin bridge to a second ball: see data leak and curvature hold.")},
    {"tumour", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Brain tumour"),
     QT_TRANSLATE_NOOP(
         "tidemark::PhantomMenu",
         "A lobed tumour in a head: seed it, let the surface grow, and compare with the truth.")},
    {"cortex", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Folded sheet"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu",
                       "A sheet as folded as the cortex: the largest surface for its volume.")},
    {"organ", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Liver"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "A liver in CT whose bright vessels have to stay outside.")},
    {"junction", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Cell junction"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "Two membranes in the noise of an electron microscope.")},
    {"head", QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "T1 head"),
     QT_TRANSLATE_NOOP("tidemark::PhantomMenu", "A whole head as MR shows it, for its white matter.")},
};

}  // namespace

PhantomText phantom_text(std::string_view kind) {
  const auto* found = std::find_if(std::begin(kTexts), std::end(kTexts),
                                   [&](const Source& text) { return text.kind == kind; });
  if (found == std::end(kTexts)) return {QString::fromUtf8(kind.data(), qsizetype(kind.size())), {}};
  return {QCoreApplication::translate("tidemark::PhantomMenu", found->title),
          QCoreApplication::translate("tidemark::PhantomMenu", found->sentence)};
}

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
