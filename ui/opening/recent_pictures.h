// Small pictures of the studies opened last, in the user's cache folder.
//
// A picture of a patient's slice tells of the patient, if not by name. Files and folder are the user's alone,
// their names say nothing, and a picture goes when its study leaves the list.
#pragma once

#include <QImage>
#include <QString>
#include <QStringList>

namespace tidemark::ui {

// The file's name for a study, in recent_picture_folder().
QString recent_picture_name(const QString& path, const QString& uid);
QString recent_picture_folder();

// Null: there is none.
QImage read_recent_picture(const QString& name);
// Any thread. False when it cannot be written: the list then has no picture.
bool write_recent_picture(const QString& name, const QImage& picture);
// Removes all others.
void keep_recent_pictures(const QStringList& names);

}  // namespace tidemark::ui
