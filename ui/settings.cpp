#include "ui/settings.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <QStandardPaths>

#include "core/site_folder.h"

namespace tidemark::ui {
namespace {

const QString kLocked = QStringLiteral("locked");  // a list of names

struct Found {
  SettingOrigin origin = SettingOrigin::program;
  bool locked = false;
  QVariant value;  // invalid: nobody has set it
};

// The user's own value stands above the site's, unless the site has locked it.
Found found_setting(const QString& name) {
  const QSettings site(settings::site_file(), QSettings::IniFormat);
  const bool is_sites = site.contains(name);
  const bool locked = is_sites && site.value(kLocked).toStringList().contains(name);
  const QSettings own;
  if (!locked && own.contains(name)) return {SettingOrigin::user, false, own.value(name)};
  if (is_sites) return {SettingOrigin::site, locked, site.value(name)};
  return {};
}

template <class Described>
SettingText described(const Described& setting) {
  const Found found = found_setting(setting.name());
  return {setting.name(), setting.text(), found.origin, found.locked};
}

// As QSettings reads it back.
QString quoted(QString value) {
  static const QRegularExpression kSpecial(QStringLiteral("[,;\\\\\"=]"));
  if (!value.contains(kSpecial)) return value;
  return QStringLiteral("\"%1\"").arg(
      value.replace('\\', QLatin1String("\\\\")).replace('"', QLatin1String("\\\"")));
}

QString origin_text(const SettingText& setting) {
  if (setting.locked) return QStringLiteral("the site's, locked");
  switch (setting.origin) {
    case SettingOrigin::program:
      break;
    case SettingOrigin::site:
      return QStringLiteral("the site's");
    case SettingOrigin::user:
      return QStringLiteral("the user's");
  }
  return QStringLiteral("the program's");
}

QString documents() {
  return QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
}

// Not everybody has a folder for documents.
QString begin_folder() {
  return QFileInfo::exists(documents()) ? documents() : QDir::homePath();
}

}  // namespace

bool is_locked(const QString& name) {
  return found_setting(name).locked;
}

SettingOrigin origin_of(const QString& name) {
  return found_setting(name).origin;
}

QVariant setting_value(const QString& name) {
  return found_setting(name).value;
}

void set_setting(const QString& name, const QVariant& value) {
  if (!is_locked(name)) QSettings().setValue(name, value);
}

Setting<QString> settings::open_folder() {
  return Setting<QString>("open/folder", begin_folder());
}

Setting<QString> settings::save_folder() {
  return Setting<QString>("save/folder", begin_folder());
}

Setting<QString> settings::retrieval_folder() {
  return Setting<QString>("pacs/folder", documents() + "/Tidemark");
}

QString settings::site_file() {
  return QString::fromStdString((site_folder() / "tidemark.conf").string());
}

std::vector<SettingText> settings::all() {
  return {described(language()),         described(theme()),       described(layout()),
          described(mouse_scheme()),     described(open_folder()), described(save_folder()),
          described(retrieval_folder()), described(server())};
}

QString settings::print() {
  QString text =
      QStringLiteral("; the user's: %1\n; the site's: %2%3\n")
          .arg(QSettings().fileName(), site_file(),
               QFileInfo::exists(site_file()) ? QString() : QStringLiteral(", which is not there"));
  QString group = QStringLiteral("General");
  text += QStringLiteral("[General]\n");
  const QStringList locked = QSettings(site_file(), QSettings::IniFormat).value(kLocked).toStringList();
  if (!locked.isEmpty()) text += QStringLiteral("%1=%2\n").arg(kLocked, locked.join(QStringLiteral(", ")));
  for (const SettingText& setting : all()) {
    const QStringList path = setting.name.split(u'/');
    if (path.size() > 1 && path.front() != group) {
      group = path.front();
      text += QStringLiteral("[%1]\n").arg(group);
    }
    text += QStringLiteral("; %1\n%2=%3\n").arg(origin_text(setting), path.back(), quoted(setting.value));
  }
  return text;
}

}  // namespace tidemark::ui
