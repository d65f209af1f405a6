// The texts of a language: what the user interface and the folders below it say.
#pragma once

#include <QByteArray>
#include <QHash>
#include <QLocale>
#include <QRegularExpression>
#include <QString>
#include <QTranslator>
#include <vector>

namespace tidemark::ui {

// Read from an object of JSON: English text, translation. One English text has one translation wherever it
// stands. Of a text with a count ("%n studies.") it may be a list of two: for one thing, and for others;
// English has lists of its own in such a file. A sentence in which the folders below have filled values in is
// known by its pattern ("{}: no pixel data", core/result.h): its values are found, and filled into the
// translated pattern.
class Catalogue : public QTranslator {
  Q_OBJECT
 public:
  // Texts that are not translated, or no object, make an empty catalogue.
  explicit Catalogue(const QByteArray& json, QLocale::Language language = QLocale::AnyLanguage,
                     QObject* parent = nullptr);

  [[nodiscard]] bool isEmpty() const override { return texts_.isEmpty(); }
  // Empty: not known. The context matters only where it says that the text is a sentence with its values.
  // `count` chooses the form; Qt fills it in for %n.
  [[nodiscard]] QString translate(const char* context, const char* text, const char* = nullptr,
                                  int count = -1) const override;
  // A pattern's translation with its values: "{}" in their order, "{1}" by their number.
  [[nodiscard]] static QString filled(const QString& pattern, const QStringList& values);

 private:
  struct Pattern {
    QRegularExpression english;
    QString translation;
    qsizetype letters = 0;  // that are no values: the more, the better it fits
  };
  void add_pattern(const QString& english, const QString& translation);
  [[nodiscard]] QString sentence(const QString& message, int depth) const;
  [[nodiscard]] bool is_one(int count) const;

  QLocale::Language language_;
  QHash<QString, QStringList> texts_;  // with their forms, one or two
  std::vector<Pattern> patterns_;      // those with most letters first
};

}  // namespace tidemark::ui
