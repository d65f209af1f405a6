// Numbers as text for people, and the digits that they need.
#pragma once

#include <QLocale>
#include <QString>

namespace tidemark::ui {

// Where there is no number.
inline const QString kNothing = QStringLiteral("–");

// Digits behind the point, so that a span has about a thousand steps: 0 for HU, 3 for shares of 1.
int decimals_for(double span);
// The same for figures of a study's values, such as a mean or T: one at least.
int value_decimals(double span);
double rounded(double value, int decimals);  // never -0
// From the lowest value to the highest, and more than 0 where they are one.
double span_between(double low, double high);

// The user's, except that digits are not grouped: what is read can be typed (NumberBox).
QLocale number_locale();
// A share in percent; one below 1 is not rounded up to 100.
QString share_text(double share);
// In the user's language, with a space that does not break before the unit (none if it is empty).
QString number_text(double value, int decimals, const QString& unit = {});
// A size that may be small: with more digits where it would have less than two that are not 0.
QString size_text(double size, int decimals, const QString& unit = {});
QString count_text(qint64 count);
// With at most that many significant digits, as short as it can be.
QString general_text(double value, int significant);
// With about that many significant digits, for places where the magnitude is not known.
QString short_text(double value, int significant = 3);

}  // namespace tidemark::ui
