#include "ui/widgets/number_text.h"

#include <algorithm>
#include <cmath>

namespace tidemark::ui {
namespace {

constexpr int kMostDecimals = 15;

}  // namespace

int decimals_for(double span) {
  if (!(span > 0.0) || !std::isfinite(span)) return 0;
  return std::clamp(static_cast<int>(std::ceil(2.5 - std::log10(span))), 0, kMostDecimals);
}

int value_decimals(double span) {
  return std::max(1, decimals_for(span));
}

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale + 0.0;  // -0 + 0 is 0
}

double span_between(double low, double high) {
  return high > low ? high - low : 1e-6;
}

QLocale number_locale() {
  QLocale locale;
  locale.setNumberOptions(locale.numberOptions() | QLocale::OmitGroupSeparator);
  return locale;
}

QString number_text(double value, int decimals, const QString& unit) {
  const QString number = number_locale().toString(rounded(value, decimals), 'f', decimals);
  return unit.isEmpty() ? number : number + QChar(QChar::Nbsp) + unit;
}

QString size_text(double size, int decimals, const QString& unit) {
  const double magnitude = std::abs(size);
  const int needed = magnitude > 0.0 ? 1 - static_cast<int>(std::floor(std::log10(magnitude))) : 0;
  return number_text(size, std::clamp(needed, decimals, kMostDecimals), unit);
}

QString share_text(double share) {
  return number_text(std::floor(1000.0 * share) / 10.0, 1, QStringLiteral("%"));
}

QString count_text(qint64 count) {
  return number_locale().toString(count);
}

QString general_text(double value, int significant) {
  return number_locale().toString(value + 0.0, 'g', significant);
}

QString short_text(double value, int significant) {
  const double size = std::abs(value);
  if (size == 0.0) return QStringLiteral("0");
  const int before = size >= 1.0 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
  if (size < 1e-3) return general_text(value, significant);
  const int leading = size < 1.0 ? static_cast<int>(-std::floor(std::log10(size))) - 1 : 0;
  return number_text(value, std::max(0, significant - before + leading + (size < 1.0 ? 1 : 0)));
}

}  // namespace tidemark::ui
