#include "ui/panels/balance_text.h"

#include <QStringList>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "ui/widgets/number_text.h"
#include "ui/widgets/tr.h"

namespace tidemark::ui {
namespace {

// The terms that push to one side, the strongest first; those that hardly count beside it are left out.
QStringList pushing(const solver::Pushes& pushes, double side) {
  constexpr double kCounts = 0.25;
  std::vector<std::pair<double, QString>> terms{{side * pushes.data, tr("the data term")},
                                                {side * pushes.curvature, tr("curvature")},
                                                {side * pushes.rescaling, tr("rescaling")},
                                                {side * pushes.advection, tr("advection")}};
  std::sort(terms.begin(), terms.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  QStringList names;
  for (const auto& [push, name] : terms) {
    if (push > solver::kConvergedSpeed && push > kCounts * terms.front().first) names << name;
  }
  return names;
}

QString joined(const QStringList& names) {
  return names.join(tr(" and "));
}

QString as_a_beginning(QString sentence) {
  sentence[0] = sentence[0].toUpper();
  return sentence;
}

// The state, and the terms behind it.
QString balance_sentence(const engine::ExplainedPlace& place) {
  const solver::Pushes& pushes = place.balance.pushes;
  if (std::abs(pushes.limits) > solver::kConvergedSpeed && place.rests()) {
    return pushes.limits < 0.0 ? tr("A wall, or the limit of a refinement, keeps it from moving outward.")
                               : tr("An anchor, or the limit of a refinement, keeps it from moving inward.");
  }
  const bool grows = pushes.sum() > 0.0;
  const QStringList winners = pushing(pushes, grows ? 1.0 : -1.0);
  const QStringList losers = pushing(pushes, grows ? -1.0 : 1.0);
  if (place.rests()) {
    if (winners.isEmpty() || losers.isEmpty()) return tr("It rests here: no term pushes much.");
    return (winners.size() > 1 ? tr("It rests here: %1 balance %2.") : tr("It rests here: %1 balances %2."))
        .arg(joined(winners), joined(losers));
  }
  const QString moves = grows ? tr("it moves outward") : tr("it moves inward");
  QString sentence;
  if (losers.isEmpty()) {
    sentence = winners.size() > 1 ? tr("%1 push alone: %2.") : tr("%1 pushes alone: %2.");
    return as_a_beginning(sentence.arg(joined(winners), moves));
  }
  sentence = winners.size() > 1 ? tr("%1 outweigh %2: %3.") : tr("%1 outweighs %2: %3.");
  return as_a_beginning(sentence.arg(joined(winners), joined(losers), moves));
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
  if (ways.size() == 2) {
    return (outward ? tr("%1, or %2, would move it outward.") : tr("%1, or %2, would move it inward."))
        .arg(ways[0], ways[1]);
  }
  if (ways.size() == 1)
    return (outward ? tr("%1 would move it outward.") : tr("%1 would move it inward.")).arg(ways[0]);
  if (place.has_tent) {
    return outward ? tr("No α and no ε by itself would move it outward.")
                   : tr("No α and no ε by itself would move it inward.");
  }
  return outward ? tr("No α would move it outward.") : tr("No α would move it inward.");
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
