#include "ui/main/menus.h"

#include <QActionGroup>
#include <QMenuBar>
#include <QToolBar>
#include <algorithm>
#include <memory>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/main/case_head.h"
#include "ui/main/main_window.h"
#include "ui/main/menu_bar_icon.h"
#include "ui/main/panel_docks.h"
#include "ui/main/server_query.h"
#include "ui/main/teaching.h"
#include "ui/opening/phantom_menu.h"
#include "ui/opening/recent_studies.h"
#include "ui/widgets/menu_text.h"

namespace tidemark::ui {
namespace {

void make_file_menu(MainWindow& window, Actions& actions, RecentStudies& recent) {
  QMenu* file = window.menuBar()->addMenu(MainWindow::tr("&File"));
  file->addActions({actions.open_folder, actions.open_file, actions.open_session, actions.query_server});
  QObject::connect(actions.query_server, &QAction::triggered, &window,
                   [&window] { (void)query_server(window); });
  file->addMenu(recent.make_menu(file));
  auto* phantoms = new PhantomMenu(file);
  phantoms->setTitle(MainWindow::tr("&Phantoms"));
  phantoms->setIcon(icon(u"phantom"));
  QObject::connect(phantoms, &PhantomMenu::chosen, &window, &MainWindow::open_phantom);
  file->addMenu(phantoms);
  QMenu* cohort = file->addMenu(MainWindow::tr("Cohor&t"));
  cohort->addActions({actions.open_cohort, actions.show_cohort, actions.next_case, actions.previous_case});
  cohort->addSeparator();
  cohort->addActions({actions.accept_case, actions.reject_case});
  file->addSeparator();
  file->addActions({actions.add_image, actions.add_series, actions.import_labels, actions.compare_with_mask,
                    actions.compare_with_label, actions.stop_comparing, actions.compare_readers, actions.save,
                    actions.save_as});
  QMenu* exports = file->addMenu(icon(u"export"), MainWindow::tr("&Export"));
  exports->addActions({actions.export_mask, actions.export_segmentation, actions.export_structure_set,
                       actions.export_mesh, actions.export_label_meshes, actions.export_level_set});
  exports->addSeparator();
  exports->addActions({actions.export_picture, actions.export_film, actions.export_statistics,
                       actions.export_report, actions.export_recipe});
  file->addActions({actions.send_result, actions.deidentify});
  file->addSeparator();
  file->addActions({actions.close, actions.quit});
}

void make_view_menu(MainWindow& window, Actions& actions, PanelDocks& panels) {
  QMenu* view = window.menuBar()->addMenu(MainWindow::tr("&View"));
  view->addActions(actions.layouts->actions());
  QMenu* more = view->addMenu(icon(u"add"), MainWindow::tr("&Add a view"));
  for (const ViewKind kind : {ViewKind::axial, ViewKind::coronal, ViewKind::sagittal, ViewKind::oblique,
                              ViewKind::speed, ViewKind::pages, ViewKind::volume}) {
    QObject::connect(more->addAction(text_of(kind)), &QAction::triggered, &window, [&window, kind] {
      if (CaseWindow* active = window.active_case()) active->add_view(kind);
    });
  }
  QObject::connect(view, &QMenu::aboutToShow, more,
                   [&window, more] { more->setEnabled(window.active_case() != nullptr); });
  view->addSeparator();
  view->addActions({actions.reset_view, actions.clip, actions.swipe, actions.patient_text});
  view->addSeparator();
  QMenu* docks = view->addMenu(MainWindow::tr("&Panels"));
  docks->addActions(panels.toggles());
  view->addActions({actions.hide_interface, actions.full_screen});
  QMenu* theme = view->addMenu(MainWindow::tr("The&me"));
  theme->addActions(actions.themes->actions());
  // Its English name beside the present one: whoever cannot read the language still finds it.
  const QString languages = MainWindow::tr("Langua&ge");
  const bool is_english = languages == QLatin1String("Langua&ge");
  view->addMenu(is_english ? languages : QStringLiteral("%1 (Language)").arg(languages))
      ->addActions(actions.languages->actions());
}

// The open cases by their numbers, the active one checked: one that lies behind others is found by its name.
class CaseEntries : public QObject {
 public:
  CaseEntries(QMenu& menu, MainWindow& window) : QObject(&menu), menu_(menu), window_(window) {
    connect(&menu, &QMenu::aboutToShow, this, &CaseEntries::fill);
  }

 private:
  void fill() {
    entries_ = std::make_unique<QActionGroup>(nullptr);
    QList<CaseWindow*> cases = window_.cases();
    std::sort(cases.begin(), cases.end(),
              [](const CaseWindow* a, const CaseWindow* b) { return a->number() < b->number(); });
    if (!cases.empty()) {
      auto* line = new QAction(entries_.get());
      line->setSeparator(true);
      menu_.addAction(line);
    }
    for (CaseWindow* one : cases) {
      const QString title = menu_text(one->windowTitle().remove(QStringLiteral("[*]")));
      const QString form = one->number() < 10 ? QStringLiteral("&%1  %2") : QStringLiteral("%1  %2");
      auto* entry = new QAction(case_mark(one->number()), form.arg(QString::number(one->number()), title),
                                entries_.get());
      entry->setCheckable(true);
      entry->setChecked(one == window_.active_case());
      connect(entry, &QAction::triggered, one, [this, one] { window_.bring_to_front(*one); });
      menu_.addAction(entry);
    }
  }

  QMenu& menu_;
  MainWindow& window_;
  std::unique_ptr<QActionGroup> entries_;  // of the menu's last showing
};

}  // namespace

void make_menus(MainWindow& window, Actions& actions, const MenuParts& parts) {
  draw_menu_bar_icon_whole(*window.menuBar());
  make_file_menu(window, actions, *parts.recent);
  QMenu* edit = window.menuBar()->addMenu(MainWindow::tr("&Edit"));
  edit->addActions({actions.undo, actions.redo});
  edit->addSeparator();
  edit->addAction(actions.keys);
  edit->addMenu(MainWindow::tr("&Mouse"))->addActions(actions.mouse_schemes->actions());
  make_view_menu(window, actions, *parts.panels);
  QMenu* evolution = window.menuBar()->addMenu(MainWindow::tr("Ev&olution"));
  evolution->addActions({actions.play, actions.step, actions.step_back, actions.restart});
  evolution->addSeparator();
  evolution->addActions({actions.fastest_place, actions.forces, actions.passes});
  QMenu* tools = window.menuBar()->addMenu(MainWindow::tr("&Tools"));
  tools->addActions(actions.tools->actions());
  tools->addSeparator();
  tools->addAction(actions.last_tool);
  parts.teaching->fill(*window.menuBar()->addMenu(MainWindow::tr("Te&ach")));
  QMenu* windows = window.menuBar()->addMenu(MainWindow::tr("&Window"));
  windows->addActions({actions.tile, actions.cascade, actions.tabs});
  windows->addSeparator();
  windows->addActions({actions.duplicate_case, actions.compare_schemes});
  windows->addSeparator();
  windows->addActions({actions.link, actions.lock_step});
  new CaseEntries(*windows, window);
  QMenu* help = window.menuBar()->addMenu(MainWindow::tr("&Help"));
  help->addActions({actions.handbook, actions.first_steps, actions.about});
}

void make_tool_bar(MainWindow& window, Actions& actions) {
  QToolBar* bar = window.addToolBar(MainWindow::tr("Main tools"));
  bar->setObjectName("tool-bar");
  bar->setIconSize(QSize(kIcon, kIcon));
  bar->addActions({actions.open_folder, actions.save});
  bar->addSeparator();
  bar->addActions({actions.undo, actions.redo});
  bar->addSeparator();
  bar->addActions({actions.restart, actions.step_back, actions.play, actions.step});
  bar->addSeparator();
  bar->addActions(actions.tools->actions());
  bar->addSeparator();
  bar->addAction(actions.clip);
  bar->addSeparator();
  bar->addActions(actions.layouts->actions());
}

}  // namespace tidemark::ui
