#include "ui/readers/reader_list.h"

#include <algorithm>
#include <utility>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/colour_button.h"
#include "ui/widgets/path_text.h"

namespace tidemark::ui {

ReaderList::ReaderList(engine::CaseProxy& proxy, QWidget* parent) : QListWidget(parent), proxy_(&proxy) {
  setAccessibleName(tr("Segmentations"));
  setIconSize(QSize(kIconSmall, kIconSmall));
  connect(this, &QListWidget::itemChanged, this, [this](QListWidgetItem* item) { take_tick(*item); });
  connect(&proxy, &engine::CaseProxy::state_changed, this, &ReaderList::follow);
  follow();
}

std::vector<ListedReader> ReaderList::of_case() const {
  const engine::CaseState& state = proxy_->state();
  std::vector<ListedReader> readers;
  if (state.begun) {
    const glm::vec4 colour = proxy_->display().settings().surface_colour;
    readers.push_back({{}, tr("Surface"), QColor::fromRgbF(colour.r, colour.g, colour.b)});
  }
  for (const document::Label& label : state.labels) {
    readers.push_back({{label.id, nullptr},
                       QString::fromStdString(label.name),
                       QColor(label.colour[0], label.colour[1], label.colour[2])});
  }
  return readers;
}

// What the user has ticked stays; a surface takes part at first.
void ReaderList::follow() {
  const auto listed_as = [](const ListedReader& a, const ListedReader& b) {
    return a.reader == b.reader && a.name == b.name && a.colour == b.colour;
  };
  const std::vector<ListedReader> now = of_case();
  const auto files = std::find_if(entries_.begin(), entries_.end(),
                                  [](const Entry& entry) { return entry.listed.reader.file != nullptr; });
  if (std::equal(entries_.begin(), files, now.begin(), now.end(),
                 [&](const Entry& entry, const ListedReader& one) { return listed_as(entry.listed, one); }))
    return;
  std::vector<Entry> entries;
  for (const ListedReader& one : now) {
    const auto before = std::find_if(entries_.begin(), files,
                                     [&](const Entry& entry) { return entry.listed.reader == one.reader; });
    const bool is_surface = one.reader.label == document::kTheSurface;
    entries.push_back({one, before == files ? is_surface : before->takes_part});
  }
  entries.insert(entries.end(), files, entries_.end());
  const auto before = chosen();
  entries_ = std::move(entries);
  show_entries();
  const auto is_same = [](const ListedReader& a, const ListedReader& b) { return a.reader == b.reader; };
  if (const auto after = chosen();
      !std::equal(before.begin(), before.end(), after.begin(), after.end(), is_same))
    emit chosen_changed();
}

void ReaderList::add(std::shared_ptr<const document::FileRegions> file) {
  std::erase_if(entries_, [&](const Entry& entry) {
    return entry.listed.reader.file && entry.listed.reader.file->file == file->file;
  });
  entries_.push_back({{{document::kTheSurface, std::move(file)}, {}, {}}, true});
  show_entries();
  emit chosen_changed();
}

bool ReaderList::can_remove_current() const {
  return currentRow() >= 0 && entries_[static_cast<std::size_t>(currentRow())].listed.reader.file != nullptr;
}

void ReaderList::remove_current() {
  if (!can_remove_current()) return;
  entries_.erase(entries_.begin() + currentRow());
  show_entries();
  emit chosen_changed();
}

// The file's own, after its folder's where another one is called the same.
QString ReaderList::name_of(const document::FileRegions& file) const {
  const auto others = std::count_if(entries_.begin(), entries_.end(), [&](const Entry& entry) {
    const auto& other = entry.listed.reader.file;
    return other && other->file.filename() == file.file.filename();
  });
  const QString name = text_of(file.file.filename());
  return others == 1 ? name : QStringLiteral("%1/%2").arg(text_of(file.file.parent_path().filename()), name);
}

void ReaderList::show_entries() {
  showing_ = true;
  const int row = currentRow();
  clear();
  for (Entry& entry : entries_) {
    ListedReader& listed = entry.listed;
    const auto& file = listed.reader.file;
    if (file) listed.name = name_of(*file);
    auto* item = new QListWidgetItem(listed.name, this);
    item->setIcon(file ? icon(u"open-file")
                       : QIcon(colour_swatch(listed.colour, QSize(kIconSmall, kIconSmall), *this)));
    item->setToolTip(file ? text_of(file->file) : listed.name);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable | Qt::ItemIsUserCheckable);
    item->setCheckState(entry.takes_part ? Qt::Checked : Qt::Unchecked);
  }
  setCurrentRow(std::min(row, count() - 1));
  showing_ = false;
}

void ReaderList::take_tick(const QListWidgetItem& item) {
  if (showing_) return;
  Entry& entry = entries_[static_cast<std::size_t>(row(&item))];
  if (std::exchange(entry.takes_part, item.checkState() == Qt::Checked) != entry.takes_part)
    emit chosen_changed();
}

std::vector<ListedReader> ReaderList::chosen() const {
  std::vector<ListedReader> readers;
  for (const Entry& entry : entries_) {
    if (entry.takes_part) readers.push_back(entry.listed);
  }
  return readers;
}

QStringList ReaderList::region_names() const {
  QStringList names;
  for (const Entry& entry : entries_) {
    const auto& file = entry.listed.reader.file;
    if (!file || file->list.size() < 2) continue;
    for (const auto& [name, region] : file->list) {
      if (!names.contains(QString::fromStdString(name))) names << QString::fromStdString(name);
    }
  }
  return names;
}

}  // namespace tidemark::ui
