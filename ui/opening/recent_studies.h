// The studies opened last, kept between runs.
#pragma once

#include <QImage>
#include <QList>
#include <QMenu>
#include <QObject>
#include <QString>
#include <memory>
#include <vector>

#include "core/volume.h"
#include "imaging/grid_policy.h"

namespace tidemark::engine {
class BackgroundJob;
}

namespace tidemark::ui {

struct RecentStudy {
  QString path;
  QString uid;
  QString name;                // as titles have it; never the patient's
  imaging::GridPolicy policy;  // by which its slices were made a grid
  bool missing = false;        // as of the last check()
};

// At most ten, the latest first, in QSettings; their pictures are files (recent_pictures.h).
class RecentStudies : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMost = 10;

  explicit RecentStudies(QObject* parent = nullptr);
  ~RecentStudies() override;

  [[nodiscard]] const QList<RecentStudy>& list() const { return list_; }
  void add(const RecentStudy& study);
  // Keeps a small picture of it, made in the background from its slice k; changed() follows.
  void add_picture(const RecentStudy& study, std::shared_ptr<const Volume> volume, const WindowLevel& window,
                   std::int64_t k);
  // Null: there is none.
  [[nodiscard]] static QImage picture_of(const RecentStudy& study);
  void clear();
  // Looks in the background which of them still exist: a folder on a slow network takes its time.
  void check();

  // A submenu that follows the list: missing studies greyed, "Clear" at its end.
  QMenu* make_menu(QWidget* parent);

 signals:
  void changed();
  void chosen(const tidemark::ui::RecentStudy& study);

 private:
  void save() const;
  void fill(QMenu& menu);

  QList<RecentStudy> list_;
  std::shared_ptr<engine::BackgroundJob> job_;
  std::vector<std::shared_ptr<engine::BackgroundJob>> picture_jobs_;
};

}  // namespace tidemark::ui
