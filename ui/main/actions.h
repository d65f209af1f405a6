// The actions of menus, tool bars and keys, each made once.
#pragma once

#include <QAction>
#include <QActionGroup>
#include <QObject>
#include <vector>

#include "engine/display.h"

namespace tidemark::engine {
class CaseProxy;
struct CaseState;
}  // namespace tidemark::engine

namespace tidemark::ui {

// Names, pictures and keys. The objects that carry an action out connect to it. Keys are kept in the settings
// and can be changed (KeysDialog).
class Actions : public QObject {
  Q_OBJECT
 public:
  explicit Actions(QObject* parent);

  // File.
  QAction* open_folder;
  QAction* open_file;
  QAction* open_session;
  QAction* query_server;
  QAction* open_cohort;
  QAction* show_cohort;
  QAction* next_case;
  QAction* previous_case;
  QAction* accept_case;
  QAction* reject_case;
  QAction* add_image;
  QAction* add_series;
  QAction* import_labels;
  QAction* compare_with_mask;
  QAction* compare_with_label;
  QAction* stop_comparing;
  QAction* compare_readers;
  QAction* save;
  QAction* save_as;
  QAction* export_mask;
  QAction* export_segmentation;
  QAction* export_structure_set;
  QAction* export_level_set;
  QAction* export_mesh;
  QAction* export_label_meshes;
  QAction* export_picture;
  QAction* export_film;
  QAction* export_statistics;
  QAction* export_report;
  QAction* export_recipe;
  QAction* send_result;
  QAction* deidentify;
  QAction* close;
  QAction* quit;
  // Edit.
  QAction* undo;
  QAction* redo;
  QAction* keys;
  QActionGroup* mouse_schemes;  // in the order of MouseScheme
  // Evolution.
  QAction* play;
  QAction* step;
  QAction* step_back;
  QAction* restart;
  QAction* fastest_place;
  QAction* passes;
  // Tools, in the order of Tool.
  QActionGroup* tools;
  QAction* last_tool;
  // View.
  QActionGroup* layouts;
  QAction* reset_view;
  QAction* clip;
  QAction* patient_text;
  QAction* forces;
  QAction* swipe;
  QAction* hide_interface;
  QAction* full_screen;
  QActionGroup* themes;
  QActionGroup* languages;  // their data: the code, as in the settings
  // Window.
  QAction* tile;
  QAction* cascade;
  QAction* tabs;
  QAction* duplicate_case;
  QAction* compare_schemes;
  QAction* link;
  QAction* lock_step;
  // Help.
  QAction* handbook;
  QAction* first_steps;
  QAction* about;

  [[nodiscard]] QAction* tool(engine::Tool tool) const;
  // The actions whose keys can be changed.
  [[nodiscard]] const std::vector<QAction*>& all() const { return all_; }
  // Enables and checks the actions by the state of the active case; null: there is none.
  void follow(engine::CaseProxy* proxy);
  void set_key(QAction* action, const QKeySequence& key);  // an empty one: none
  void reset_key(QAction* action);                         // its own again

 private:
  QAction* make(const char* name, const char* icon, const QString& text, const QKeySequence& key,
                bool of_case, const QString& tip = {});
  void make_files();
  void make_evolution();
  void make_tools();
  void make_mouse();
  void make_views();
  void make_languages();
  void make_windows();
  void follow_evolution(const engine::CaseState& state);

  std::vector<QAction*> of_cases_;  // need a case
  std::vector<QAction*> all_;
};

}  // namespace tidemark::ui
