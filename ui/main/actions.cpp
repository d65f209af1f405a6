#include "ui/main/actions.h"

#include <QRegularExpression>
#include <algorithm>

#include "engine/case_proxy.h"
#include "ui/look/icons.h"
#include "ui/look/language.h"
#include "ui/settings.h"
#include "ui/views/mouse_scheme.h"
#include "ui/views/play.h"
#include "ui/widgets/menu_text.h"

namespace tidemark::ui {
namespace {

constexpr const char* kOwnKey = "own_key";  // property: the key that the program gives

Setting<QString> setting_of(const QAction* action) {
  return settings::key(action->objectName());
}

// A menu's entry without its letter, which Chinese and Japanese have behind it: "開く(&O)…".
QString without_letter(QString text) {
  static const QRegularExpression kLetterBehind(QStringLiteral("\\(&\\w\\)"));
  return text.remove(kLetterBehind).remove('&').remove(QStringLiteral("…"));
}

// "Play (P)"
void show_key(QAction* action) {
  const QString key = action->shortcut().toString(QKeySequence::NativeText);
  const QString tip = action->property("tip").toString();
  action->setToolTip(key.isEmpty() ? tip : QStringLiteral("%1 (%2)").arg(tip, key));
}

}  // namespace

Actions::Actions(QObject* parent) : QObject(parent) {
  make_files();
  make_evolution();
  make_tools();
  make_mouse();
  make_views();
  make_windows();
}

QAction* Actions::make(const char* name, const char* picture, const QString& text, const QKeySequence& key,
                       bool of_case, const QString& tip) {
  auto* action = new QAction(text, this);
  if (picture) action->setIcon(icon(QString::fromLatin1(picture)));
  action->setObjectName(QString::fromLatin1(name));
  action->setProperty(kOwnKey, key.toString());
  action->setProperty("tip", tip.isEmpty() ? without_letter(text) : tip);
  const auto chosen = setting_of(action);
  action->setShortcut(chosen.is_set() ? QKeySequence(chosen.get()) : key);
  show_key(action);
  all_.push_back(action);
  if (of_case) of_cases_.push_back(action);
  return action;
}

void Actions::set_key(QAction* action, const QKeySequence& key) {
  setting_of(action).set(key.toString());
  action->setShortcut(key);
  show_key(action);
}

void Actions::reset_key(QAction* action) {
  setting_of(action).forget();
  action->setShortcut(QKeySequence(action->property(kOwnKey).toString()));
  show_key(action);
}

void Actions::make_files() {
  open_folder = make("open-folder", "open-folder", tr("Open &folder…"), QKeySequence("Ctrl+O"), false,
                     tr("Open a folder with a DICOM study"));
  open_file = make("open-file", "open-file", tr("Open fi&le…"), QKeySequence("Ctrl+Shift+O"), false,
                   tr("Open a DICOM file, NIfTI, NRRD, MetaImage or GIPL"));
  open_session = make("open-session", "open-file", tr("Open sess&ion…"), {}, false,
                      tr("Go on with a session that was saved"));
  query_server = make("query-server", "server", tr("Query a ser&ver…"), QKeySequence("Ctrl+Alt+O"), false,
                      tr("Find a series in a PACS and open it"));
  open_cohort = make("open-cohort", "open-folder", tr("&Open cohort…"), {}, false,
                     tr("Go through the cases that tidemark-cli cohort has computed"));
  show_cohort = make("show-cohort", nullptr, tr("&Show the cohort"), {}, false,
                     tr("Show the panel of the cohort again"));
  next_case =
      make("next-case", nullptr, tr("&Next case"), QKeySequence("N"), false, tr("Open the next case"));
  previous_case = make("previous-case", nullptr, tr("&Previous case"), QKeySequence("Shift+N"), false,
                       tr("Open the previous case"));
  accept_case = make("accept-case", nullptr, tr("&Accept the case"), QKeySequence("Shift+A"), false,
                     tr("The result of this case is right; a changed surface takes its place"));
  reject_case = make("reject-case", nullptr, tr("&Reject the case"), QKeySequence("Shift+R"), false,
                     tr("The result of this case is wrong"));
  import_labels = make("import-labels", "label", tr("I&mport labels…"), QKeySequence("Ctrl+I"), true,
                       tr("Add labels from a DICOM segmentation, an RT structure set or a label map"));
  compare_with_mask = make("compare-with-mask", "target", tr("Compare wit&h a mask…"), {}, true,
                           tr("Dice and distances to a known answer from a file, while the surface moves"));
  compare_with_label = make("compare-with-label", nullptr, tr("Compare with the chosen la&bel"), {}, true,
                            tr("Dice and distances to a label as it is now, while the surface moves"));
  stop_comparing = make("stop-comparing", nullptr, tr("St&op comparing"), {}, true,
                        tr("Go back to the phantom's own truth, or to none"));
  compare_readers = make("compare-readers", nullptr, tr("Compare &readers…"), {}, true,
                         tr("Segmentations of several readers each with each, and an estimate of the truth"));
  add_image = make("add-image", "add", tr("Add ima&ge file…"), {}, true,
                   tr("Show another image, such as PET over CT, on the slices of this case"));
  add_series = make("add-series", nullptr, tr("Add series of the st&udy…"), {}, true,
                    tr("Show another series of the same folder on the slices of this case"));
  save = make("save", "save", tr("&Save session"), QKeySequence("Ctrl+S"), true);
  save_as = make("save-as", "save-as", tr("Save session &as…"), QKeySequence("Ctrl+Shift+S"), true);
  export_mask = make("export-mask", "export", tr("&Mask or labels…"), QKeySequence("Ctrl+E"), true,
                     tr("Write the inside of the surface, or the labels"));
  export_segmentation = make("export-segmentation", nullptr, tr("&DICOM segmentation…"), {}, true,
                             tr("Write labels or surface as DICOM segmentation (SEG) of the study"));
  export_structure_set = make("export-structure-set", nullptr, tr("RT s&tructure set…"), {}, true,
                              tr("Write the contours of labels or surface as RT structure set of the study"));
  export_level_set = make("export-level-set", nullptr, tr("&Level set for OpenVDB…"), {}, true,
                          tr("Write the level set itself, in mm of the patient"));
  export_mesh = make("export-mesh", nullptr, tr("&Surface as polygons…"), {}, true,
                     tr("Write the surface as STL, PLY or OBJ, in mm of the patient"));
  export_label_meshes = make("export-label-meshes", nullptr, tr("La&bels as polygons…"), {}, true,
                             tr("Write each label as STL, PLY or OBJ, a file each, in mm of the patient"));
  export_picture = make("export-picture", "camera", tr("&Picture of the view…"), QKeySequence("Ctrl+P"), true,
                        tr("Write the active view as PNG, without the patient's text"));
  export_film =
      make("export-film", nullptr, tr("&Film of the evolution…"), {}, true,
           tr("Write how the surface came to be, in the active view, as a GIF that plays for ever"));
  export_statistics = make("export-statistics", "statistics", tr("Statist&ics…"), {}, true);
  export_report =
      make("export-report", nullptr, tr("Rep&ort…"), {}, true,
           tr("Write a page for people: the regions with their measures, and the pictures that are seen"));
  export_recipe = make("export-recipe", nullptr, tr("&Recipe…"), {}, true,
                       tr("Write all steps and edits, to be repeated by tidemark-cli replay"));
  send_result = make("send-result", "server", tr("Sen&d segmentation to a server…"), {}, true,
                     tr("Send labels or surface to a PACS, as new series of the study"));
  deidentify = make("deidentify", nullptr, tr("Anon&ymous copies…"), {}, false,
                    tr("Copy DICOM files without what tells who the patient is"));
  close = make("close", "close", tr("&Close study"), QKeySequence("Ctrl+W"), true);
  quit = make("quit", nullptr, tr("&Quit"), QKeySequence("Ctrl+Q"), false);
  undo = make("undo", "undo", tr("&Undo"), QKeySequence("Ctrl+Z"), true);
  redo = make("redo", "redo", tr("&Redo"), QKeySequence("Ctrl+Shift+Z"), true);
  keys = make("keys", "keyboard", tr("&Keys…"), {}, false, tr("See and change the keys"));
}

void Actions::make_mouse() {
  mouse_schemes = new QActionGroup(this);
  const auto scheme = [this](MouseScheme which, const char* name, const QString& text, const QString& tip) {
    QAction* action = make(name, nullptr, text, {}, false, tip);
    action->setCheckable(true);
    action->setChecked(which == mouse_scheme());
    action->setData(static_cast<int>(which));
    mouse_schemes->addAction(action);
  };
  scheme(MouseScheme::tidemark, "mouse-tidemark", tr("&Tidemark"),
         tr("Without another tool, the left button drags window and level"));
  scheme(MouseScheme::itk_snap, "mouse-itk-snap", tr("&ITK-SNAP"),
         tr("Without another tool, the left button moves the crosshair; with Alt window and level"));
  mouse_schemes->setEnabled(!is_locked(settings::mouse_scheme().name()));
  connect(mouse_schemes, &QActionGroup::triggered, this,
          [](QAction* chosen) { set_mouse_scheme(static_cast<MouseScheme>(chosen->data().toInt())); });
}

void Actions::make_evolution() {
  play = make("play", "play", tr("&Play"), QKeySequence("P"), true,
              tr("Play or pause the evolution of the surface"));
  play->setCheckable(true);
  step = make("step", "step", tr("One &step"), QKeySequence("."), true, tr("Compute one step"));
  step_back =
      make("step-back", "step-back", tr("One step &back"), QKeySequence(","), true, tr("Take one step back"));
  fastest_place = make("fastest-place", "target", tr("Where it moves &most"), QKeySequence("F"), true,
                       tr("Go to the place where the surface still moves most, and see why"));
  passes = make("passes", nullptr, tr("Passes of a pa&ge"), {}, true,
                tr("Follow a page through the passes of the stream executor, as the paper draws them"));
  restart = make("restart", "restart", tr("&Restart"), QKeySequence("Home"), true,
                 tr("Back to the start, with the parameters as they are now"));
}

void Actions::make_tools() {
  tools = new QActionGroup(this);
  const auto tool = [this](engine::Tool which, const char* name, const char* picture, const QString& text,
                           const char* key, const QString& tip) {
    QAction* action = make(name, picture, text, QKeySequence(QString::fromLatin1(key)), true, tip);
    action->setCheckable(true);
    action->setData(static_cast<int>(which));
    tools->addAction(action);
  };
  tool(engine::Tool::window, "tool-window", "tool-window", tr("&Window and level"), "W",
       tr("Drag on a slice for window and level, in 3D to turn"));
  tool(engine::Tool::crosshair, "tool-crosshair", "tool-crosshair", tr("&Crosshair"), "C",
       tr("Move all slices to the point under the mouse"));
  tool(engine::Tool::probe_speed, "tool-probe-speed", "tool-probe", tr("&Probe T and ε"), "T",
       tr("Drag over the tissue: T becomes its mean, ε its standard deviation"));
  tool(engine::Tool::probe_transfer, "tool-probe-transfer", "tool-probe-transfer",
       tr("Probe t&ransfer function"), "G",
       tr("Drag over the tissue to set the chosen Gaussian of the transfer function"));
  tool(
      engine::Tool::seed, "tool-seed", "tool-seed", tr("&Sphere"), "S",
      tr("Place a surface: click in the tissue, or press in its middle and drag (right button: takes away)"));
  tool(engine::Tool::paint, "tool-paint", "tool-paint", tr("P&aint"), "B",
       tr("Add to the surface with a 3D brush (right button: erase)"));
  tool(engine::Tool::erase, "tool-erase", "tool-erase", tr("&Erase"), "E",
       tr("Take away from the surface with a 3D brush (right button: paint)"));
  tool(engine::Tool::measure_distance, "tool-distance", "tool-distance", tr("&Distance"), "D",
       tr("Measure a distance"));
  tool(engine::Tool::measure_angle, "tool-angle", "tool-angle", tr("A&ngle"), "A",
       tr("Measure an angle: one drag to the vertex, one to the other end"));
  tool(engine::Tool::profile, "tool-profile", "tool-profile", tr("Line pr&ofile"), "J",
       tr("Draw a line in a slice: φ and brightness along it are plotted in the panel Level set"));
  tool(engine::Tool::examples, "tool-examples", "tool-examples", tr("E&xamples"), "M",
       tr("Mark examples in slices: left button inside, right button outside, with Ctrl takes away"));
  tool(engine::Tool::wall, "tool-wall", "tool-wall", tr("Wa&ll"), "K",
       tr("Keep the surface out with a 3D brush; with Shift keep it in (right button: takes away)"));
  tool(engine::Tool::label, "tool-label", "tool-label", tr("La&bel brush"), "Q",
       tr("Paint the chosen label in slices; Shift: a ball, Ctrl: only like brightness (right button: takes "
          "away)"));
  tool(engine::Tool::why, "tool-why", "tool-why", tr("Wh&y here?"), "Y",
       tr("Click on the surface to see why it moves or rests there; with Ctrl, just point at it"));
  last_tool = make("last-tool", nullptr, tr("Last &tool"), QKeySequence("Space"), true,
                   tr("Change between the last two tools"));
}

void Actions::make_views() {
  layouts = new QActionGroup(this);
  const auto layout = [this](int number, const char* picture, const QString& text) {
    QAction* action =
        make(picture, picture, text, QKeySequence(QStringLiteral("Ctrl+%1").arg(number + 1)), true);
    action->setData(number);
    layouts->addAction(action);
  };
  layout(0, "layout-single", tr("&One view"));
  layout(1, "layout-one-three", tr("One &large, three small"));
  layout(2, "layout-two-two", tr("&Two by two"));
  layout(3, "layout-paper", tr("Slice, &speed map and 3D"));
  reset_view = make("reset-view", "reset-view", tr("&Reset views"), QKeySequence("R"), true,
                    tr("Zoom, position and camera as they were at first"));
  clip = make("clip", "clip-plane", tr("&Clip plane"), QKeySequence("X"), true, tr("Cut the 3D view open"));
  clip->setCheckable(true);
  patient_text = make("patient-text", nullptr, tr("Patient's te&xt"), QKeySequence("I"), true,
                      tr("Name, number, age and dates in the corners; off for teaching and screenshots"));
  patient_text->setCheckable(true);
  forces = make("forces", nullptr, tr("Arrows of the t&erms"), QKeySequence("O"), true,
                tr("Show on the surface how the data and the other terms push it"));
  forces->setCheckable(true);
  swipe = make("swipe", nullptr, tr("S&wipe line"), QKeySequence("V"), true,
               tr("Left of a line slices show the study alone, right of it with further images"));
  swipe->setCheckable(true);
  hide_interface = make("hide-interface", nullptr, tr("&Hide panels"), QKeySequence("F3"), true);
  hide_interface->setCheckable(true);
  full_screen = make("full-screen", "full-screen", tr("&Full screen"), QKeySequence("F11"), false);
  full_screen->setCheckable(true);
  themes = new QActionGroup(this);
  const auto theme = [this](int number, const char* name, const char* picture, const QString& text) {
    QAction* action = make(name, picture, text, {}, false);
    action->setCheckable(true);
    action->setData(number);
    themes->addAction(action);
  };
  theme(0, "theme-system", nullptr, tr("As the &system"));
  theme(1, "theme-light", "theme-light", tr("&Light"));
  theme(2, "theme-dark", "theme-dark", tr("&Dark"));
  themes->setEnabled(!is_locked(settings::theme().name()));
  make_languages();
}

// Each in its own words, so that everyone finds theirs.
void Actions::make_languages() {
  languages = new QActionGroup(this);
  const auto add = [this](const QString& code, const QString& name) {
    const QString own = QStringLiteral("language-%1").arg(code.isEmpty() ? QStringLiteral("system") : code);
    QAction* action = make(own.toLatin1().constData(), nullptr, name, {}, false);
    action->setCheckable(true);
    action->setData(code);
    action->setChecked(code == settings::language().get());
    languages->addAction(action);
  };
  add({}, tr("As the &system"));
  for (const Language& language : ui::languages())
    add(QString::fromLatin1(language.code), QString::fromUtf8(language.name));
  languages->setEnabled(!is_locked(settings::language().name()));
}

void Actions::make_windows() {
  tile = make("tile", "tile", tr("&Tile"), {}, false);
  cascade = make("cascade", "cascade", tr("&Cascade"), {}, false);
  tabs = make("tabs", "tabs", tr("Ta&bs"), {}, false);
  tabs->setCheckable(true);
  duplicate_case = make("duplicate-case", "duplicate", tr("&Duplicate case"), {}, true,
                        tr("Open another case that is like this one now, and goes on by itself"));
  compare_schemes =
      make("compare-schemes", nullptr, tr("Compare &schemes"), {}, true,
           tr("The case and a copy of it, one with the scheme of the paper, one with the split one, "
              "side by side in lock-step"));
  link =
      make("link", "link", tr("&Link cases"), QKeySequence("L"), false,
           tr("Cursor, slices and cameras of all cases move together, window and level within a modality"));
  link->setCheckable(true);
  lock_step = make("lock-step", "lockstep", tr("&Play in lock-step"), QKeySequence("Ctrl+L"), false,
                   tr("All cases play and step together, always at the same step"));
  lock_step->setCheckable(true);
  handbook = make("handbook", "handbook", tr("&Handbook"), QKeySequence("F1"), false,
                  tr("Open the handbook at the page of the panel or dialog that has the keyboard"));
  first_steps = make("first-steps", "info", tr("&First steps and mouse"), QKeySequence("Shift+F1"), false);
  about = make("about", "about", tr("&About Tidemark"), {}, false);
}

QAction* Actions::tool(engine::Tool tool) const {
  const QList<QAction*> all = tools->actions();
  return *std::find_if(all.begin(), all.end(), [&](const QAction* action) {
    return action->data().toInt() == static_cast<int>(tool);
  });
}

void Actions::follow(engine::CaseProxy* proxy) {
  static const engine::CaseState kNothing{};
  for (QAction* action : of_cases_) action->setEnabled(proxy != nullptr);
  follow_evolution(proxy ? proxy->state() : kNothing);
  play->setEnabled(proxy && can_play(*proxy));
  stop_comparing->setEnabled(proxy && proxy->has_another_truth());
  clip->setChecked(proxy && proxy->display().settings().clip_on);
  patient_text->setChecked(proxy && proxy->display().settings().patient_text);
  forces->setChecked(proxy && proxy->display().settings().forces);
  swipe->setChecked(proxy && proxy->display().settings().swipe);
  if (proxy) return tool(proxy->display().settings().tool)->setChecked(true);
  if (!tools->checkedAction()) return;
  // An exclusive group keeps one action checked.
  tools->setExclusionPolicy(QActionGroup::ExclusionPolicy::ExclusiveOptional);
  tools->checkedAction()->setChecked(false);
  tools->setExclusionPolicy(QActionGroup::ExclusionPolicy::Exclusive);
}

void Actions::follow_evolution(const engine::CaseState& state) {
  play->setChecked(state.playing);
  play->setIcon(icon(state.playing ? u"pause" : u"play"));
  play->setText(state.playing ? tr("&Pause") : tr("&Play"));
  for (QAction* action : {step, restart, fastest_place, compare_schemes, export_mesh, export_film,
                          export_recipe, export_level_set})
    action->setEnabled(state.begun);
  for (QAction* action : {export_segmentation, export_structure_set, export_label_meshes, send_result})
    action->setEnabled(state.begun || !state.labels.empty());
  compare_with_label->setEnabled(state.begun && !state.labels.empty());
  step_back->setEnabled(state.begun && state.step > 0);
  undo->setEnabled(!state.undo_text.isEmpty());
  undo->setText(state.undo_text.isEmpty() ? tr("&Undo") : tr("&Undo: %1").arg(menu_text(state.undo_text)));
  redo->setEnabled(!state.redo_text.isEmpty());
  redo->setText(state.redo_text.isEmpty() ? tr("&Redo") : tr("&Redo: %1").arg(menu_text(state.redo_text)));
}

}  // namespace tidemark::ui
