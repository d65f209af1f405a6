#include "ui/look/catalogue.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QStringList>
#include <algorithm>
#include <cstring>

#include "engine/message_text.h"

namespace tidemark::ui {
namespace {

const QRegularExpression& value_places() {
  static const QRegularExpression places(QStringLiteral("(?<!\\{)\\{(\\d*)(?::[^}]*)?\\}(?!\\})"));
  return places;
}

// "{{" is a brace in patterns.
QString without_doubled_braces(QString text) {
  return text.replace(QLatin1String("{{"), QLatin1String("{"))
      .replace(QLatin1String("}}"), QLatin1String("}"));
}

// Empty where one of them is.
QStringList forms_of(const QJsonValue& translation) {
  QStringList forms;
  if (translation.isString()) forms << translation.toString();
  for (const auto& form : translation.toArray()) forms << form.toString();
  return forms.contains(QString()) ? QStringList() : forms;
}

}  // namespace

Catalogue::Catalogue(const QByteArray& json, QLocale::Language language, QObject* parent)
    : QTranslator(parent), language_(language) {
  const QJsonObject texts = QJsonDocument::fromJson(json).object();
  texts_.reserve(texts.size());
  for (auto text = texts.begin(); text != texts.end(); ++text) {
    const QStringList forms = forms_of(text.value());
    if (forms.isEmpty()) continue;
    if (text.key().contains(value_places())) {
      add_pattern(text.key(), forms.back());
    } else {
      texts_.insert(text.key(), forms);
    }
  }
  std::stable_sort(patterns_.begin(), patterns_.end(),
                   [](const Pattern& a, const Pattern& b) { return a.letters > b.letters; });
}

void Catalogue::add_pattern(const QString& english, const QString& translation) {
  QString expression = QStringLiteral("\\A");
  Pattern pattern;
  qsizetype end = 0;
  const auto add_letters = [&](qsizetype to) {
    const QString letters = without_doubled_braces(english.mid(end, to - end));
    expression += QRegularExpression::escape(letters);
    pattern.letters += letters.size();
  };
  for (auto place = value_places().globalMatch(english); place.hasNext();) {
    const auto match = place.next();
    add_letters(match.capturedStart());
    expression += QStringLiteral("(.*?)");
    end = match.capturedEnd();
  }
  add_letters(english.size());
  // Compiled when it is tried first.
  pattern.english.setPattern(expression + QStringLiteral("\\z"));
  pattern.translation = translation;
  patterns_.push_back(std::move(pattern));
}

// French says "0 fichier".
bool Catalogue::is_one(int count) const {
  return count == 1 || (count == 0 && language_ == QLocale::French);
}

QString Catalogue::translate(const char* context, const char* text, const char*, int count) const {
  if (!text) return {};
  const QString english = QString::fromUtf8(text);
  const auto found = texts_.constFind(english);
  if (found != texts_.constEnd()) return is_one(count) ? found->front() : found->back();
  if (!context || std::strcmp(context, engine::kMessageContext) != 0) return {};
  QStringList lines = english.split(u'\n');
  bool is_known = false;
  for (QString& line : lines) {
    const QString known = sentence(line, 0);
    if (known.isEmpty()) continue;
    line = known;
    is_known = true;
  }
  return is_known ? lines.join(u'\n') : QString();
}

QString Catalogue::sentence(const QString& message, int depth) const {
  constexpr int kDeepest = 4;  // a sentence within a sentence
  if (const auto found = texts_.constFind(message); found != texts_.constEnd()) return found->back();
  if (depth == kDeepest) return {};
  for (const Pattern& pattern : patterns_) {
    const auto match = pattern.english.match(message);
    if (!match.hasMatch()) continue;
    QStringList values = match.capturedTexts().mid(1);
    for (QString& value : values) {
      // One word alone is a name: of a file, a label, a field.
      const QString known = value.contains(u' ') ? sentence(value, depth + 1) : QString();
      if (!known.isEmpty()) value = known;
    }
    return filled(pattern.translation, values);
  }
  return {};
}

QString Catalogue::filled(const QString& pattern, const QStringList& values) {
  QString text;
  qsizetype end = 0;
  qsizetype next = 0;
  for (auto place = value_places().globalMatch(pattern); place.hasNext();) {
    const auto match = place.next();
    text += without_doubled_braces(pattern.mid(end, match.capturedStart() - end));
    const QString number = match.captured(1);
    text += values.value(number.isEmpty() ? next++ : number.toLongLong());
    end = match.capturedEnd();
  }
  return text + without_doubled_braces(pattern.mid(end));
}

}  // namespace tidemark::ui
