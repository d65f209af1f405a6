#include "ui/panels/balance_text.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

QString tr(const char* text) {
  return QCoreApplication::translate("Balance", text);
}

struct Term {
  double push;
  QString first;   // as a sentence begins
  QString within;  // as it goes on
};

std::array<Term, 4> terms_of(const solver::Pushes& pushes) {
  return {Term{pushes.data, tr("The data term"), tr("the data term")},
          Term{pushes.curvature, tr("Curvature"), tr("curvature")},
          Term{pushes.rescaling, tr("Rescaling"), tr("rescaling")},
          Term{pushes.advection, tr("Advection"), tr("advection")}};
}

// The state, and the terms behind it.
QString balance_sentence(const engine::ExplainedPlace& place) {
  const solver::Pushes& pushes = place.balance.pushes;
  if (std::abs(pushes.limits) > solver::kConvergedSpeed && place.rests()) {
    return pushes.limits < 0.0 ? tr("A wall, or the limit of a refinement, keeps it from moving outward.")
                               : tr("An anchor, or the limit of a refinement, keeps it from moving inward.");
  }
  const auto terms = terms_of(pushes);
  const auto by_push = [](const Term& a, const Term& b) { return a.push < b.push; };
  const Term& out = *std::max_element(terms.begin(), terms.end(), by_push);
  const Term& in = *std::min_element(terms.begin(), terms.end(), by_push);
  const bool grows = out.push + in.push > 0.0;
  const Term& winner = grows ? out : in;
  const Term& loser = grows ? in : out;
  if (place.rests()) {
    if (std::max(out.push, -in.push) <= solver::kConvergedSpeed) return tr("It rests here: no term pushes.");
    return tr("It rests here: %1 and %2 balance.").arg(out.within, in.within);
  }
  const QString moves = place.sum_mm() > 0.0 ? tr("it moves outward") : tr("it moves inward");
  if (loser.push * winner.push >= 0.0 || std::abs(loser.push) < 0.02 * std::abs(winner.push))
    return tr("%1 pushes alone: %2.").arg(winner.first, moves);
  return tr("%1 outweighs %2: %3.").arg(winner.first, loser.within, moves);
}

// Rounded away from the present value, so that what is said would do.
double beyond(double value, double now, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return (value > now ? std::ceil(value * scale - 1e-9) : std::floor(value * scale + 1e-9)) / scale;
}

QString above_or_below(const QString& name, double value, double now, int decimals) {
  const QString number = number_text(beyond(value, now, decimals), decimals);
  return value > now ? tr("%1 above %2").arg(name, number) : tr("%1 below %2").arg(name, number);
}

QString turn_sentence(const engine::ExplainedPlace& place, const engine::ExplainedPlace::Turn& turn,
                      bool outward, int decimals) {
  constexpr int kAlphaDecimals = 3;
  const solver::Parameters& now = place.parameters;
  QStringList ways;
  if (turn.alpha) ways << above_or_below(tr("α"), *turn.alpha, now.alpha, kAlphaDecimals);
  if (turn.range) ways << above_or_below(tr("ε"), *turn.range, now.range, decimals);
  const QString effect = outward ? tr("would move it outward") : tr("would move it inward");
  if (!ways.isEmpty()) {
    QString text = ways.join(tr(", or ")) + (ways.size() > 1 ? ", " : " ") + effect + ".";
    return text;
  }
  return place.has_tent ? tr("No α and no ε by itself %1.").arg(effect) : tr("No α %1.").arg(effect);
}

}  // namespace

QString why_text(const engine::ExplainedPlace& place, int decimals) {
  QStringList sentences{balance_sentence(place)};
  const double sum = place.balance.pushes.sum();
  const bool held = std::abs(place.balance.pushes.limits) > solver::kConvergedSpeed;
  if (held) return sentences.front();  // parameters do not move a limit
  if (sum < solver::kConvergedSpeed) sentences << turn_sentence(place, place.to_outward, true, decimals);
  if (sum > -solver::kConvergedSpeed) sentences << turn_sentence(place, place.to_inward, false, decimals);
  return sentences.join(' ');
}

QString brightness_text(const engine::ExplainedPlace& place, int decimals, const QString& unit) {
  const QString value = number_text(place.balance.intensity, decimals, unit);
  if (!place.has_tent) return value;
  const solver::Parameters& now = place.parameters;
  return tr("%1 (T %2, ε %3)")
      .arg(value, number_text(now.target, decimals), number_text(now.range, decimals));
}

}  // namespace tidemark::ui
