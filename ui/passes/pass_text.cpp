#include "ui/passes/pass_text.h"

#include <QStringList>

#include "solver/executor.h"
#include "solver/paging/page_neighbours.h"
#include "ui/passes/message_bits.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

// "+x and −z"
QString list_of_faces(std::uint8_t faces) {
  QStringList names;
  for (int face = 0; face < solver::kFaces; ++face) {
    if ((faces >> face & 1U) != 0) names << face_name(face);
  }
  const QString last = names.takeLast();
  return names.isEmpty() ? last : tr("%1 and %2").arg(names.join(QStringLiteral(", ")), last);
}

QString constant_text(const solver::PassRecord& record) {
  const solver::PageDecision& decision = record.decision;
  const QString side = record.message.is_inside() ? tr("inside") : tr("outside");
  if (decision.frees)
    return tr("It is constant for the second step: it is freed, and the page table points to the static page "
              "%1.")
        .arg(side);
  if (record.message.differs_across_any()) return tr("It is constant, but something touches it: it stays.");
  return tr("It is constant: after another step like this it is freed, and the static page %1 stands for it.")
      .arg(side);
}

}  // namespace

QString address_text(const solver::PassRecord& record) {
  const Index3 page = record.layout.page_coordinates(record.page);
  const QString number = tr("Virtual page %1, %2, %3").arg(page.x).arg(page.y).arg(page.z);
  if (!record.is_resident()) {
    return number + tr(" is not resident: the page table points to the static page %1, which holds %2W.")
                        .arg(record.physical == solver::kInsidePage ? tr("inside") : tr("outside"),
                             record.physical == solver::kInsidePage ? QString() : QStringLiteral("−"));
  }
  return number + tr(" is physical page %1. Its first texel is %2, %3 of G, which has %4 × %5.")
                      .arg(record.physical)
                      .arg(record.address.x)
                      .arg(record.address.y)
                      .arg(record.memory_size.x)
                      .arg(record.memory_size.y);
}

QString decision_text(const solver::PassRecord& record) {
  const solver::PageDecision& decision = record.decision;
  QStringList sentences;
  if (record.quiet)
    sentences << tr("This page rests: the step leaves it out, and φ stays. Shown is what it would compute.");
  if (decision.allocates != 0) {
    sentences << tr("The page across %1 is allocated.").arg(list_of_faces(decision.allocates));
  } else if (record.message.differs_across_any()) {
    sentences << tr("All pages across these faces are resident already: nothing is allocated.");
  }
  if (!record.message.is_mixed()) {
    sentences << constant_text(record);
  } else if (decision.wakes_around) {
    sentences << tr("It moved: resting pages around it wake.");
  } else if (!record.message.moved()) {
    sentences << tr("Beside the surface it has changed by %1 in this window of %2 steps; at %3 or less it "
                    "may rest.")
                     .arg(short_text(record.window_change, 2))
                     .arg(solver::kConvergenceWindow)
                     .arg(short_text(solver::kQuietChange, 1));
  }
  return sentences.join(QLatin1Char(' '));
}

}  // namespace tidemark::ui
