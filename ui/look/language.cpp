#include "ui/look/language.h"

#include <QCoreApplication>
#include <QFile>
#include <QLibraryInfo>
#include <QLocale>
#include <QStringList>
#include <QTranslator>
#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "ui/look/catalogue.h"

namespace tidemark::ui {
namespace {

constexpr Language kLanguages[] = {{"en", "English"},  {"de", "Deutsch"}, {"es", "Español"},
                                   {"fr", "Français"}, {"ja", "日本語"},  {"zh_CN", "简体中文"}};

// "de_AT" is spoken as "de", "zh_CN" as itself; others are not.
const Language* spoken(const QLocale& locale) {
  const auto found = std::find_if(std::begin(kLanguages), std::end(kLanguages), [&](const Language& one) {
    const QLocale known(QString::fromLatin1(one.code));
    return known.language() == locale.language() && known.script() == locale.script();
  });
  return found == std::end(kLanguages) ? nullptr : found;
}

const Language& language_of_system() {
  for (const QString& wanted : QLocale::system().uiLanguages()) {
    if (const Language* known = spoken(QLocale(wanted))) return *known;
  }
  return kLanguages[0];
}

QString& code_in_use() {
  static QString code = QString::fromLatin1(kLanguages[0].code);
  return code;
}

QByteArray texts_of(const QString& code) {
  QFile file(QStringLiteral(":/tidemark/languages/%1.json").arg(code));
  return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

}  // namespace

std::span<const Language> languages() {
  return kLanguages;
}

void use_language(const QString& code) {
  static std::vector<std::unique_ptr<QTranslator>> translators;
  for (const auto& translator : translators) QCoreApplication::removeTranslator(translator.get());
  translators.clear();
  const QString chosen = code.isEmpty() ? QString::fromLatin1(language_of_system().code) : code;
  const bool is_of_system = QLocale(chosen).language() == QLocale::system().language();
  QLocale::setDefault(code.isEmpty() || is_of_system ? QLocale::system() : QLocale(chosen));
  const auto use = [&](std::unique_ptr<QTranslator> translator) {
    if (translator->isEmpty()) return;
    QCoreApplication::installTranslator(translator.get());
    translators.push_back(std::move(translator));
  };
  auto qt = std::make_unique<QTranslator>();
  if (qt->load(QStringLiteral("qtbase_") + chosen, QLibraryInfo::path(QLibraryInfo::TranslationsPath)))
    use(std::move(qt));
  use(std::make_unique<Catalogue>(texts_of(chosen), QLocale(chosen).language()));  // asked before Qt's
  code_in_use() = chosen;
}

QString used_language() {
  return code_in_use();
}

}  // namespace tidemark::ui
