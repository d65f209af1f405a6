#include "engine/phantom_text.h"

#include <QCoreApplication>
#include <algorithm>

namespace tidemark::engine {
namespace {

struct Source {
  std::string_view kind;
  const char* title;
  const char* sentence;
};

constexpr Source kTexts[] = {
    {"sphere", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Sphere"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText",
                       "A plain ball: the measured radius can be checked against the formula.")},
    {"dumbbell", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Dumbbell"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText", "Two balls and a neck, which curvature alone pinches off.")},
    {"bridge", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Leaking bridge"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText",
                       "A thin bridge to a second ball: see data leak and curvature hold.")},
    {"tumour", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Brain tumour"),
     QT_TRANSLATE_NOOP(
         "tidemark::PhantomText",
         "A lobed tumour in a head: place a surface in it, let it grow, and compare with the truth.")},
    {"cortex", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Folded sheet"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText",
                       "A sheet as folded as the cortex: the largest surface for its volume.")},
    {"organ", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Liver"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText", "A liver in CT whose bright vessels have to stay outside.")},
    {"junction", QT_TRANSLATE_NOOP("tidemark::PhantomText", "Cell junction"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText", "Two membranes in the noise of an electron microscope.")},
    {"head", QT_TRANSLATE_NOOP("tidemark::PhantomText", "T1 head"),
     QT_TRANSLATE_NOOP("tidemark::PhantomText", "A whole head as MR shows it, for its white matter.")},
};

}  // namespace

PhantomText phantom_text(std::string_view name) {
  const std::size_t colon = name.find(':');
  const std::string_view kind = name.substr(0, colon);
  const auto* found = std::find_if(std::begin(kTexts), std::end(kTexts),
                                   [&](const Source& text) { return text.kind == kind; });
  if (found == std::end(kTexts)) return {QString::fromUtf8(kind.data(), qsizetype(kind.size())), {}};
  QString title = QCoreApplication::translate("tidemark::PhantomText", found->title);
  if (colon != std::string_view::npos) {
    const std::string_view noise = name.substr(colon + 1);
    title = QCoreApplication::translate("tidemark::PhantomText", "%1 with noise of %2 %")
                .arg(title, QString::fromUtf8(noise.data(), qsizetype(noise.size())));
  }
  return {title, QCoreApplication::translate("tidemark::PhantomText", found->sentence)};
}

}  // namespace tidemark::engine
