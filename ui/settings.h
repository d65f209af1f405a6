// The settings that the desktop keeps from one run to the next: each with its name, its type and its first
// value. The list of recent studies keeps itself (RecentStudies).
#pragma once

#include <QByteArray>
#include <QSettings>
#include <QString>

namespace tidemark::ui {

enum class Theme;
enum class ViewLayout;

template <class T>
class Setting {
 public:
  explicit Setting(QString name, T at_first = {}) : name_(std::move(name)), at_first_(std::move(at_first)) {}

  [[nodiscard]] T get() const {
    const QVariant value = QSettings().value(name_);
    return value.isValid() ? value.value<T>() : at_first_;
  }
  void set(const T& value) const { QSettings().setValue(name_, value); }
  [[nodiscard]] bool is_set() const { return QSettings().contains(name_); }
  void forget() const { QSettings().remove(name_); }

 private:
  QString name_;
  T at_first_;
};

// One of an enumeration's first `count` values, kept as its number.
template <class Enum>
class Choice {
 public:
  Choice(const char* name, int count, int at_first)
      : number_(QString::fromLatin1(name), at_first), count_(count), at_first_(at_first) {}

  [[nodiscard]] Enum get() const {
    const int number = number_.get();
    return static_cast<Enum>(number >= 0 && number < count_ ? number : at_first_);
  }
  void set(Enum value) const { number_.set(static_cast<int>(value)); }

 private:
  Setting<int> number_;
  int count_;
  int at_first_;
};

namespace settings {

inline Choice<Theme> theme() {
  return {"theme", 3, 0};
}
inline Choice<ViewLayout> layout() {  // of the views of the next case
  return {"layout", 4, 3};
}
inline Setting<QByteArray> window_geometry() {
  return Setting<QByteArray>("main/geometry");
}
inline Setting<QByteArray> window_state() {  // how panels and tool bars stand
  return Setting<QByteArray>("main/state");
}
inline Setting<QString> mouse_scheme() {  // "tidemark" or "itk-snap"
  return Setting<QString>("mouse/scheme", "tidemark");
}
inline Setting<QString> key(const QString& action) {  // is set where the user has changed it
  return Setting<QString>("keys/" + action);
}
// Whether a part called "Details" is open, by its key.
inline Setting<bool> details(const QString& key) {
  return Setting<bool>("details/" + key);
}
// Folders that were used last.
inline Setting<QString> open_folder() {
  return Setting<QString>("open/folder");
}
inline Setting<QString> save_folder() {
  return Setting<QString>("save/folder");
}
inline Setting<QString> retrieval_folder(const QString& at_first) {
  return Setting<QString>("pacs/folder", at_first);
}
inline Setting<QString> server() {  // by name; the one used last
  return Setting<QString>("pacs/server");
}

}  // namespace settings
}  // namespace tidemark::ui
