// The studies opened last, kept between runs.
#pragma once

#include <QList>
#include <QMenu>
#include <QObject>
#include <QString>
#include <memory>

#include "imaging/grid_policy.h"

namespace tidemark {

class BackgroundJob;

struct RecentStudy {
  QString path;
  QString uid;
  QString name;          // as titles have it; never the patient's
  GridPolicy policy;     // by which its slices were made a grid
  bool missing = false;  // as of the last check()
};

// At most ten, the latest first, in QSettings.
class RecentStudies : public QObject {
  Q_OBJECT
 public:
  static constexpr int kMost = 10;

  explicit RecentStudies(QObject* parent = nullptr);
  ~RecentStudies() override;

  [[nodiscard]] const QList<RecentStudy>& list() const { return list_; }
  void add(const RecentStudy& study);
  void clear();
  // Looks in the background which of them still exist: a folder on a slow network takes its time.
  void check();

  // A submenu that follows the list: missing studies greyed, "Clear" at its end.
  QMenu* make_menu(QWidget* parent);

 signals:
  void changed();
  void chosen(const tidemark::RecentStudy& study);

 private:
  void save() const;
  void fill(QMenu& menu);

  QList<RecentStudy> list_;
  std::shared_ptr<BackgroundJob> job_;
};

}  // namespace tidemark
