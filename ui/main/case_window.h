// One case: its views as docks.
#pragma once

#include <QMainWindow>
#include <QPointer>
#include <QStringList>
#include <memory>

#include "engine/case_autosave.h"
#include "engine/case_proxy.h"
#include "ui/main/actions.h"

class QDockWidget;

namespace tidemark::ui {

class DockShares;
class PictureView;
class ViewBar;

enum class ViewKind { axial, coronal, sagittal, oblique, speed, pages, volume };
enum class ViewLayout { single, one_three, two_two, paper };

QString text_of(ViewKind kind);

// A case without its window, which another one may take over: see CaseWindow::keep().
struct KeptCase {
  std::unique_ptr<engine::CaseProxy> proxy;
  std::unique_ptr<engine::CaseAutosave> autosave;  // goes before the case
  QByteArray views;                                // their arrangement: show_views()
  QString session_file;
  int number = 1;
};

// Child of the MDI area. Views float, tab, close and come back; their arrangement is remembered from one case
// to the next.
class CaseWindow : public QMainWindow {
  Q_OBJECT
 public:
  CaseWindow(std::unique_ptr<engine::CaseProxy> proxy, Actions& actions, QWidget* parent = nullptr);
  // Its views and its links are the receiver's to bring back.
  CaseWindow(KeptCase kept, Actions& actions, QWidget* parent = nullptr);
  ~CaseWindow() override;

  // Gives the case away. Nothing but deleting this window may follow, and the case must outlive it.
  [[nodiscard]] KeptCase keep();

  [[nodiscard]] engine::CaseProxy& proxy() { return *proxy_; }

  // The mark of an open case: a number from 1 on, with a colour (CaseHead), and whether the case is linked to
  // others.
  [[nodiscard]] int number() const { return number_; }
  void set_number(int number);
  [[nodiscard]] bool linked() const { return linked_; }
  void set_linked(bool linked);
  // Another case's window lies over this one, but for views in windows of their own: nothing is drawn for it.
  void set_covered(bool covered);
  // In which parameters it differs from the cases that it is linked to; empty: in none.
  [[nodiscard]] const QString& difference() const { return difference_; }
  void set_difference(const QString& difference);

  // Another view, as a tab behind the active one.
  PictureView* add_view(ViewKind kind);
  // One that is there comes to the front, else another view is added.
  PictureView* show_view(ViewKind kind);
  // Becomes that of the next cases too.
  void set_layout(ViewLayout layout);
  [[nodiscard]] ViewLayout view_layout() const { return layout_; }
  // The view that was last clicked or has the keyboard, else the first. Null without
  // views.
  [[nodiscard]] PictureView* active_view() const;
  [[nodiscard]] QList<PictureView*> views() const;
  [[nodiscard]] QDockWidget* dock_of(const PictureView* view) const;
  void reset_views();
  void show_views(const QByteArray& arrangement);  // as KeptCase has it

  // The display and the arrangement of views, for session files. Fails (ErrorKind::input) on settings that
  // make no sense, and then changes nothing.
  [[nodiscard]] std::string view_state() const;
  // With the images of the session.
  Status restore_view(const document::SessionContents& contents);
  // Closes without a question, as the case was just saved.
  void close_saved();

  [[nodiscard]] engine::CaseAutosave& autosave() { return *autosave_; }
  // The case's own file, once it has one.
  QString session_file;
  QStringList files_being_saved;  // to which the case is on its way

 signals:
  // The number changed, or whether the case is linked, or how it differs from the others.
  void mark_changed();
  // A view in a window of its own was clicked, or given the keyboard.
  void activation_wanted(CaseWindow& window);
  // The panel with all ways to begin.
  void place_panel_wanted();
  // The case may go: nothing would be lost, or the user does not mind.
  void close_wanted(CaseWindow& window, QCloseEvent* event);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void make_contents();
  void arrange(ViewLayout layout);
  PictureView* make_view(ViewKind kind);
  QDockWidget* make_dock(ViewKind kind) { return make_dock(kind, ++docks_made_); }
  QDockWidget* make_dock(ViewKind kind, int number);
  QDockWidget* dock(ViewKind kind);  // one that is there, else a new one
  void toggle_maximised(QDockWidget* dock);
  void follow_state();
  void follow_cover();
  [[nodiscard]] QByteArray arrangement() const;

  std::unique_ptr<engine::CaseProxy> proxy_;
  Actions& actions_;
  std::unique_ptr<engine::CaseAutosave> autosave_;
  QList<QDockWidget*> docks_;
  DockShares* shares_ = nullptr;
  int number_ = 1;
  bool linked_ = false;
  bool covered_ = false;
  QString difference_;
  int docks_made_ = 0;  // for names
  ViewLayout layout_ = ViewLayout::paper;
  QByteArray before_maximised_;
  QPointer<PictureView> active_;
  bool saved_ = false;
};

}  // namespace tidemark::ui
