// The settings that the desktop keeps from one run to the next: each with its name, its type and its first
// value. The list of recent studies keeps itself (RecentStudies). A site's administrator may give first
// values for all users, and lock them: handbook/for-it.md.
#pragma once

#include <QByteArray>
#include <QSettings>
#include <QString>
#include <QStringList>
#include <vector>

namespace tidemark::ui {

enum class Theme;
enum class ViewLayout;

enum class SettingOrigin { program, site, user };

// The site's file has it, and in its list "locked": the user's own value does not count.
[[nodiscard]] bool is_locked(const QString& name);
[[nodiscard]] SettingOrigin origin_of(const QString& name);
// Invalid: neither the user nor the site has one.
[[nodiscard]] QVariant setting_value(const QString& name);
// The user's. Nothing happens to a locked one.
void set_setting(const QString& name, const QVariant& value);

template <class T>
class Setting {
 public:
  explicit Setting(QString name, T at_first = {}) : name_(std::move(name)), at_first_(std::move(at_first)) {}

  [[nodiscard]] const QString& name() const { return name_; }
  [[nodiscard]] T get() const {
    const QVariant value = setting_value(name_);
    return value.isValid() ? value.value<T>() : at_first_;
  }
  [[nodiscard]] QString text() const { return QVariant(get()).toString(); }
  void set(const T& value) const { set_setting(name_, value); }
  [[nodiscard]] bool is_set() const { return setting_value(name_).isValid(); }
  void forget() const { QSettings().remove(name_); }

 private:
  QString name_;
  T at_first_;
};

// One of an enumeration's values, kept as its word. Its number counts too: so it was kept once.
template <class Enum>
class Choice {
 public:
  Choice(const char* name, QStringList words, int at_first)
      : word_(QString::fromLatin1(name)), words_(std::move(words)), at_first_(at_first) {}

  [[nodiscard]] const QString& name() const { return word_.name(); }
  [[nodiscard]] Enum get() const {
    const QString word = word_.get();
    if (words_.contains(word)) return static_cast<Enum>(words_.indexOf(word));
    bool is_number = false;
    const int number = word.toInt(&is_number);
    return static_cast<Enum>(is_number && number >= 0 && number < words_.size() ? number : at_first_);
  }
  [[nodiscard]] QString text() const { return words_[static_cast<int>(get())]; }
  void set(Enum value) const { word_.set(words_[static_cast<int>(value)]); }

 private:
  Setting<QString> word_;
  QStringList words_;
  int at_first_;
};

struct SettingText {
  QString name;
  QString value;
  SettingOrigin origin = SettingOrigin::program;
  bool locked = false;
};

namespace settings {

inline Choice<Theme> theme() {
  return {"theme", {"system", "light", "dark"}, 0};
}
inline Setting<QString> language() {  // its code; empty: the system's
  return Setting<QString>("language");
}
inline Choice<ViewLayout> layout() {  // of the views of the next case
  return {"layout", {"single", "one-three", "two-two", "paper"}, 3};
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
// Where the dialogs for files begin; at first in the user's documents, else at home.
[[nodiscard]] Setting<QString> open_folder();
[[nodiscard]] Setting<QString> save_folder();
// For what comes from servers; at first Tidemark in the user's documents.
[[nodiscard]] Setting<QString> retrieval_folder();
inline Setting<QString> server() {  // by name; the one used last
  return Setting<QString>("pacs/server");
}

// $TIDEMARK_SITE/tidemark.conf, else /etc/tidemark/tidemark.conf, as QSettings writes INI files.
[[nodiscard]] QString site_file();
// Those that a site may give: neither how windows stand nor keys.
[[nodiscard]] std::vector<SettingText> all();
// As such a file, with where each value comes from.
[[nodiscard]] QString print();

}  // namespace settings
}  // namespace tidemark::ui
