// A model on a server of the site, asked about one of two cases that are open.
#include <QComboBox>
#include <QFileDialog>
#include <QLabel>
#include <QPushButton>
#include <QTimer>

#include "core/atomic_file.h"
#include "tests/imaging/ai/model_server.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/results_desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/initialise_panel.h"
#include "ui/panels/model_controls.h"
#include "ui/widgets/work_line.h"

namespace tidemark::test::model_server_story_test {

class ModelServerStoryTest : public QObject {
  Q_OBJECT

  ui::ModelControls& controls() { return *desktop_->window().findChild<ui::ModelControls*>(); }
  QPushButton& button(const char* text) { return *test::button(controls(), text); }
  [[nodiscard]] QString said() { return controls().findChild<ui::WorkLine*>()->text(); }
  QComboBox& choice(const char* name) {
    for (auto* one : controls().findChildren<QComboBox*>()) {
      if (one->accessibleName() == name) return *one;
    }
    qFatal("there is no choice %s", name);
  }
  void click(const char* text) {
    QVERIFY2(button(text).isVisible() && button(text).isEnabled(), text);
    Desktop::in_an_event([&] { button(text).click(); });
  }
  void choose_model(const char* name) {
    if (choice("Model").count() == 0) {
      click("List models");
      QVERIFY(Desktop::wait_for([&] { return choice("Model").count() > 0; }, kPatience));
    }
    choice("Model").setCurrentText(name);
    QCOMPARE(choice("Model").currentText(), QString(name));
  }
  void activate(ui::CaseWindow* window) {
    // What a window manager does with a click, after a dialog had the keyboard.
    desktop_->window().activateWindow();
    QVERIFY(QTest::qWaitForWindowActive(&desktop_->window()));
    ui::PictureView* view = window->views().first();
    QTest::mouseClick(view, Qt::MiddleButton, {}, view->rect().center());
    desktop_->wait_until_idle();
    QCOMPARE(desktop_->window().active_case(), window);
  }
  void mark(ui::CaseWindow* window, glm::dvec3 at, Qt::MouseButton side) {
    activate(window);
    window->proxy().display().choose_tool(engine::Tool::examples);
    Desktop::drag(*desktop_->view<ui::SliceViewWidget>(), {at, at + glm::dvec3(0.5, 0.0, 0.0)}, side);
    desktop_->wait_until_idle();
  }
  void ask(QMessageBox::StandardButton reply) {
    // A name must not hide what is asked.
    bool is_plain = true;
    QTimer look;
    connect(&look, &QTimer::timeout, this, [&is_plain] {
      const auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box && box->textFormat() != Qt::PlainText) is_plain = false;
    });
    look.start(5);
    Desktop::answer(reply);
    click("Ask the model");
    QVERIFY(is_plain);
  }
  [[nodiscard]] int questions_heard() const {
    const std::string heard = server_->heard();
    int count = 0;
    for (std::size_t at = heard.find("POST /infer/"); at != std::string::npos;
         at = heard.find("POST /infer/", at + 1))
      ++count;
    return count;
  }
  // Two cases side by side, each in one axial view.
  void open() {
    qputenv("XDG_CONFIG_HOME", QByteArray::fromStdString((folder_ / "config").string()));
    write_balls(folder_ / "study");
    desktop_ = std::make_unique<Desktop>(solver::ExecutorKind::host, QSize(1300, 900));
    balls_ = desktop_->open(QString::fromStdString((folder_ / "study").string()));
    sphere_ = desktop_->open_phantom("sphere");
    QVERIFY(balls_ && sphere_);
    for (ui::CaseWindow* window : {balls_, sphere_}) window->set_layout(ui::ViewLayout::single);
    desktop_->window().actions().tile->trigger();
    desktop_->window().panels().show("initialise");
    desktop_->wait_until_idle();
    activate(balls_);
  }

  TemporaryFolder folder_;
  std::unique_ptr<ModelServer> server_;
  std::unique_ptr<Desktop> desktop_;
  ui::CaseWindow* balls_ = nullptr;
  ui::CaseWindow* sphere_ = nullptr;

 private slots:
  void init() { server_ = std::make_unique<ModelServer>("monai-label"); }
  void cleanup() {
    desktop_.reset();
    qunsetenv("XDG_CONFIG_HOME");
    std::filesystem::remove_all(folder_ / "config");
    std::filesystem::remove_all(folder_ / "study");
  }

  void without_a_file_of_servers_nothing_is_there() {
    open();
    QVERIFY(desktop_->window().findChild<ui::InitialisePanel*>()->isVisible());
    QVERIFY(!button("Ask the model").isVisible() && !button("List models").isVisible());
  }

  void a_file_that_is_wrong_says_so() {
    std::filesystem::create_directories(folder_ / "config/tidemark");
    QVERIFY(write_file(folder_ / "config/tidemark/ai.json", "{\"servers\": 1}").has_value());
    open();
    QVERIFY2(said().contains("ai.json: servers: not a list"), qPrintable(said()));
    QVERIFY(!button("Ask the model").isEnabled() && !button("List models").isEnabled());
  }

  void what_is_found_goes_into_the_case_that_is_seen() {
    server_->write_configuration(folder_ / "config/tidemark/ai.json");
    open();
    QVERIFY(is_explained(controls()));
    QVERIFY(!button("Ask the model").isEnabled());  // no model yet
    choose_model("deepgrow_3d");
    QVERIFY2(said().contains("needs a click inside"), qPrintable(said()));
    mark(balls_, kLeft, Qt::LeftButton);
    QVERIFY(says(controls(), "1 inside, 0 outside"));
    // Nothing goes anywhere without a yes.
    ask(QMessageBox::No);
    QVERIFY(!button("As surface").isVisible());
    QCOMPARE(questions_heard(), 0);
    ask(QMessageBox::Yes);
    QVERIFY(Desktop::wait_for([&] { return button("As surface").isVisible(); }, kPatience));
    QVERIFY2(says(controls(), "deepgrow_3d: "), qPrintable(said()));
    QCOMPARE(questions_heard(), 1);
    desktop_->screenshot("model-server-1-found");

    // The other case has neither the answer nor the yes.
    activate(sphere_);
    QVERIFY(!button("As surface").isVisible());
    QVERIFY(!button("Ask the model").isEnabled());
    mark(sphere_, desktop_->seed_mm(), Qt::LeftButton);
    ask(QMessageBox::No);
    QCOMPARE(questions_heard(), 1);

    activate(balls_);
    QVERIFY(button("As surface").isVisible());
    click("As surface");
    QVERIFY(Desktop::wait_for([&] { return balls_->proxy().state().begun; }, kPatience));
    desktop_->wait_until_idle();
    QVERIFY(!sphere_->proxy().state().begun);
    QVERIFY(std::abs(balls_->proxy().state().surface.volume_ml - 5.2) < 0.4);  // both are as bright
    desktop_->window().actions().undo->trigger();
    desktop_->wait_until_idle();
    QVERIFY(!balls_->proxy().state().begun);

    desktop_->screenshot("model-server-2-undone");
    desktop_->window().panels().show("initialise");  // a surface that begins brings another panel
    desktop_->wait_until_idle();
    click("As labels");
    QVERIFY(Desktop::wait_for([&] { return balls_->proxy().state().labels.size() == 1; }, kPatience));
    QCOMPARE(QString::fromStdString(balls_->proxy().state().labels.front().name), QString("deepgrow_3d"));
    QVERIFY(sphere_->proxy().state().labels.empty());
    desktop_->wait_until_idle();
    desktop_->window().actions().undo->trigger();
    desktop_->wait_until_idle();
    QVERIFY(balls_->proxy().state().labels.empty());
  }

  void an_answer_waits_for_its_case() {
    server_->write_configuration(folder_ / "config/tidemark/ai.json");
    open();
    choose_model("deepgrow_3d");
    mark(balls_, kLeft, Qt::LeftButton);
    mark(sphere_, desktop_->seed_mm(), Qt::LeftButton);
    activate(balls_);
    ask(QMessageBox::Yes);
    activate(sphere_);
    QVERIFY(Desktop::wait_for([&] { return button("Ask the model").isEnabled(); }, kPatience));
    QCOMPARE(questions_heard(), 1);
    QVERIFY(!button("As surface").isVisible());
    activate(balls_);
    QVERIFY(button("As surface").isVisible());
  }

  void a_probability_drives_the_surface() {
    server_->write_configuration(folder_ / "config/tidemark/ai.json");
    open();
    choose_model("soft");
    mark(balls_, kLeft, Qt::LeftButton);
    ask(QMessageBox::Yes);
    QVERIFY(Desktop::wait_for([&] { return button("As speed…").isVisible(); }, kPatience));
    QVERIFY(says(controls(), "Found a probability"));
    click("As speed…");
    auto* dialog = controls().findChild<QFileDialog*>();
    QVERIFY(dialog);
    name_file(*dialog, QString::fromStdString((folder_ / "map.nii.gz").string()));
    QVERIFY(Desktop::wait_for([&] { return balls_->proxy().drive().map != nullptr; }, kPatience));
    QVERIFY(balls_->proxy().drive().setting.terms.front().function == "image");
    QVERIFY(std::filesystem::exists(balls_->proxy().drive().map->path));  // sessions find it there
    QVERIFY(!sphere_->proxy().drive().map);
    document::Start start;
    start.seeds.push_back({kLeft, 4.0});
    balls_->proxy().begin(start);
    bool rests = false;
    balls_->proxy().play_for(400, true, [&](bool) { rests = true; });
    QVERIFY(Desktop::wait_for([&] { return rests; }, kPatience));
    // A ball of 9 mm, smoothed a little.
    const double ml = balls_->proxy().state().surface.volume_ml;
    QVERIFY2(ml > 2.4 && ml < 3.4, qPrintable(QString::number(ml)));
  }

  void what_goes_wrong_is_said_and_the_case_stays() {
    server_->write_configuration(folder_ / "config/tidemark/ai.json");
    open();
    choose_model("deepgrow_3d");
    mark(balls_, kLeft, Qt::LeftButton);
    server_.reset();  // it is gone
    ask(QMessageBox::Yes);
    QVERIFY(Desktop::wait_for([&] { return said().contains("Connection refused"); }, kPatience));
    QVERIFY(!button("As surface").isVisible() && button("Ask the model").isEnabled());
    QVERIFY(!balls_->proxy().state().begun);
  }
};

TIDEMARK_TEST(ModelServerStoryTest)

}  // namespace tidemark::test::model_server_story_test

#include "model_server_story_test.moc"
