#include "ui/widgets/number_text.h"

#include <QLocale>
#include <algorithm>
#include <cmath>

namespace tidemark {

int decimals_for(double span) {
  if (!(span > 0.0) || !std::isfinite(span)) return 0;
  return std::clamp(static_cast<int>(std::ceil(2.5 - std::log10(span))), 0, 6);
}

double rounded(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

QString number_text(double value, int decimals, const QString& unit) {
  const QString number = QLocale().toString(value, 'f', decimals);
  return unit.isEmpty() ? number : number + QChar(QChar::Nbsp) + unit;
}

QString count_text(qint64 count) {
  return QLocale().toString(count);
}

QString short_text(double value, int significant) {
  const double size = std::abs(value);
  if (size == 0.0) return QStringLiteral("0");
  const int before = size >= 1.0 ? static_cast<int>(std::floor(std::log10(size))) + 1 : 1;
  if (size > 0.0 && size < 1e-3) return QLocale().toString(value, 'g', significant);
  const int leading = size > 0.0 && size < 1.0 ? static_cast<int>(-std::floor(std::log10(size))) - 1 : 0;
  return QLocale().toString(value, 'f', std::max(0, significant - before + leading + (size < 1.0 ? 1 : 0)));
}

}  // namespace tidemark
