#include "ui/opening/recent_pictures.h"

#include <sys/stat.h>

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QStandardPaths>
#include <QTemporaryFile>
#include <cstdio>

namespace tidemark::ui {

QString recent_picture_name(const QString& path, const QString& uid) {
  const QByteArray key = (path + QLatin1Char('\n') + uid).toUtf8();
  return QString::fromLatin1(QCryptographicHash::hash(key, QCryptographicHash::Sha256).toHex().first(32)) +
         QStringLiteral(".png");
}

QString recent_picture_folder() {
  return QStandardPaths::writableLocation(QStandardPaths::CacheLocation) + QStringLiteral("/recent");
}

QImage read_recent_picture(const QString& name) {
  return QImage(recent_picture_folder() + QLatin1Char('/') + name, "PNG");
}

bool write_recent_picture(const QString& name, const QImage& picture) {
  const QString folder = recent_picture_folder();
  if (!QDir().mkpath(folder) || ::chmod(QFile::encodeName(folder).constData(), 0700) != 0) return false;
  QTemporaryFile file(folder + QStringLiteral("/XXXXXX.part"));  // which only its owner may read: mode 0600
  if (!file.open() || !picture.save(&file, "PNG") || !file.flush()) return false;
  const QByteArray from = QFile::encodeName(file.fileName());
  const QByteArray to = QFile::encodeName(folder + QLatin1Char('/') + name);
  if (std::rename(from.constData(), to.constData()) != 0) return false;
  file.setAutoRemove(false);
  return true;
}

void keep_recent_pictures(const QStringList& names) {
  QDir folder(recent_picture_folder());
  for (const QString& file : folder.entryList({QStringLiteral("*.png")}, QDir::Files)) {
    if (!names.contains(file)) folder.remove(file);
  }
}

}  // namespace tidemark::ui
