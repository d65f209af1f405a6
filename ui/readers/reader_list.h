// The list of segmentations that can be compared: the case's surface and labels, and files.
#pragma once

#include <QListWidget>
#include <QPointer>
#include <vector>

#include "engine/case_proxy.h"
#include "engine/reader_comparison.h"

namespace tidemark::ui {

struct ListedReader {
  engine::Reader reader;
  QString name;   // no two files have the same
  QColor colour;  // not valid: a file's
};

// A tick says which take part. The surface and labels come and go with the case's.
class ReaderList : public QListWidget {
  Q_OBJECT
 public:
  explicit ReaderList(engine::CaseProxy& proxy, QWidget* parent = nullptr);

  // It takes part. A file that is there already is replaced.
  void add(std::shared_ptr<const document::FileRegions> file);
  void remove_current();
  [[nodiscard]] bool can_remove_current() const;

  [[nodiscard]] std::vector<ListedReader> chosen() const;
  // The regions' names in files that have several, in the order in which files bring them.
  [[nodiscard]] QStringList region_names() const;

 signals:
  void chosen_changed();  // which ones take part, or what files hold

 private:
  struct Entry {
    ListedReader listed;
    bool takes_part = false;
  };
  void follow();
  [[nodiscard]] std::vector<ListedReader> of_case() const;
  [[nodiscard]] QString name_of(const document::FileRegions& file) const;
  void show_entries();
  void take_tick(const QListWidgetItem& item);

  QPointer<engine::CaseProxy> proxy_;
  std::vector<Entry> entries_;  // the case's first
  bool showing_ = false;        // ticks are set by show_entries()
};

}  // namespace tidemark::ui
