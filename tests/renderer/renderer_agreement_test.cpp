// The processor's own pictures beside OpenGL's of the same views: the same within a few grey levels, and the
// same bytes for any number of threads.
#include <QTest>
#include <filesystem>
#include <iterator>
#include <map>

#include "solver/executor.h"
#include "solver/speed/motion_limit.h"
#include "tests/renderer/golden_views.h"
#include "tests/solver/formula_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::renderer_agreement_test {

namespace {

// In grey levels, of the channel that differs most.
struct Limits {
  double mean;
  int of_99_percent;
};
constexpr Limits kSame{1.0, 3};
// The 3D view of a sheet is a mean of fewer rounds by the processor than by OpenGL.
constexpr Limits kOtherRounds{1.0, 8};
// While something moves the processor lights the source by differences within a voxel.
constexpr Limits kOtherGradient{3.0, 30};
constexpr double kFineStep = 0.2;

// What lies over slices, all of it at once.
struct Laden {
  Geometry geometry = test::grid({70, 61, 52}, {1.0, 1.1, 1.4});
  Scene scene =
      ball_scene(geometry, 18.0, [](glm::dvec3 p) { return 2.0 * p.x + 40.0 * std::sin(0.3 * p.y); });
  PagedBytes labels;
  solver::Constraints constraints{geometry.size};
  std::shared_ptr<const solver::SpeedFunction> change;
  std::shared_ptr<const renderer::ImagesOver> images;

  Laden() {
    const auto numbers = sample(geometry, [](glm::dvec3 p) {
      return p.x + p.y < 40.0 ? 0.0 : p.x > 40.0 ? 2.0 : 1.0;
    });
    labels = PagedBytes(geometry.size, std::vector<std::uint8_t>(numbers.begin(), numbers.end()));
    constraints.set(geometry, {scene.middle + glm::dvec3(14, 3, 0), 9.0}, solver::Constraint::wall);
    constraints.set(geometry, {scene.middle - glm::dvec3(14, 3, 0), 9.0}, solver::Constraint::anchor);
    Mask began{geometry, {}};
    const auto inside = sample(geometry, [&](glm::dvec3 p) {
      return glm::length(p - scene.middle - glm::dvec3(3, 0, 0)) < 16.0 ? 1.0 : 0.0;
    });
    began.voxels.assign(inside.begin(), inside.end());
    change = solver::MotionLimit(std::make_shared<const BitMask>(began), 6.0).change();
    renderer::ImagesOver over{37, 23, {}};
    for (int i = 0; i < 37 * 23; ++i) {
      const auto opacity = static_cast<std::uint8_t>(i % 37 * 5);
      over.rgba.insert(over.rgba.end(), {opacity, static_cast<std::uint8_t>(opacity / 2), 0, opacity});
    }
    images = std::make_shared<const renderer::ImagesOver>(std::move(over));
  }

  void give(renderer::Renderer& renderer) const {
    renderer.set_change(change);
    for (const Status& status : {renderer.set_labels(labels), renderer.set_constraints(&constraints)}) {
      if (!status) qFatal("%s", status.error().message.c_str());
    }
  }
};

const Laden& laden() {
  static const Laden kLaden;
  return kLaden;
}

std::vector<std::pair<QString, renderer::SliceView>> laden_views() {
  std::vector<std::pair<QString, renderer::SliceView>> views;
  const auto add = [&](const QString& name, const std::function<void(renderer::SliceView&)>& change) {
    for (const auto& [orientation, slice] :
         {std::pair{"axial", renderer::kAxial}, {"oblique", renderer::oblique({1.0, 2.0, -1.5})}}) {
      renderer::SliceView view;
      view.orientation = slice;
      view.position_mm = laden().scene.middle + glm::dvec3(0.3, 0.2, 0.4);
      view.window = {60.0, 200.0};
      view.label_opacity = 0.0;
      view.background = {0.2F, 0.4F, 0.6F};
      change(view);
      views.emplace_back(name + ", " + orientation, view);
    }
  };
  add("nothing", [](renderer::SliceView&) {});
  add("everything", [](renderer::SliceView& view) {
    view.change = true;
    view.images = laden().images;
    view.images_from = 0.3;
    view.label_opacity = 0.5;
  });
  add("nearest, enlarged", [](renderer::SliceView& view) {
    view.nearest = true;
    view.zoom = 3.0;
    view.pan_mm = {7.0, -5.0};
  });
  add("far away", [](renderer::SliceView& view) { view.zoom = 0.3; });
  add("images", [](renderer::SliceView& view) { view.images = laden().images; });
  add("change", [](renderer::SliceView& view) { view.change = true; });
  add("contours", [](renderer::SliceView& view) { view.contours = true; });
  add("labels", [](renderer::SliceView& view) { view.label_opacity = 0.7; });
  add("pages", [](renderer::SliceView& view) { view.content = renderer::SliceContent::pages; });
  for (const auto& [name, term] : {std::pair{"total", renderer::SpeedTerm::total},
                                   {"data", renderer::SpeedTerm::data},
                                   {"curvature", renderer::SpeedTerm::curvature},
                                   {"rescaling", renderer::SpeedTerm::rescaling},
                                   {"doubt", renderer::SpeedTerm::doubt}}) {
    add(QString("speed: ") + name, [term = term](renderer::SliceView& view) {
      view.content = renderer::SliceContent::speed;
      view.term = term;
    });
  }
  return views;
}

}  // namespace

class RendererAgreementTest : public QObject {
  Q_OBJECT

 private slots:
  void golden_views_agree_data() { name_golden_views(); }
  void golden_views_agree() {
    QFETCH(QString, name);
    const Golden& golden = golden_views().at(name.toStdString());
    const auto draw = [&](renderer::RendererKind kind) {
      Patient& one = patient(golden.patient, kind);
      // Samples of rays are at other places; with many of them that does not count.
      one.step_voxels = kFineStep;
      return golden.draw(one);
    };
    const auto by_gl = draw(renderer::RendererKind::gl);
    const auto by_host = draw(renderer::RendererKind::host);
    QCOMPARE(failure(by_gl), QString());
    QCOMPARE(failure(by_host), QString());
    compare(*by_gl, *by_host, name == "moving" ? kOtherGradient : name == "sheet" ? kOtherRounds : kSame);
  }

  void laden_slices_agree_data() {
    QTest::addColumn<int>("index");
    int index = 0;
    for (const auto& [name, view] : laden_views()) QTest::newRow(qPrintable(name)) << index++;
  }
  void laden_slices_agree() {
    QFETCH(int, index);
    static Painter by_gl(laden().scene, renderer::RendererKind::gl);
    static Painter by_host(laden().scene, renderer::RendererKind::host);
    for (Painter* painter : {&by_gl, &by_host}) laden().give(painter->renderer());
    const renderer::SliceView view = laden_views()[static_cast<std::size_t>(index)].second;
    // Odd sides: the quads at the edges reach beyond the picture.
    const renderer::Picture picture = by_host(view, 173, 131);
    compare(by_gl(view, 173, 131), picture);
    renderer::SliceView plain = view;
    plain.content = renderer::SliceContent::source;
    plain.change = plain.nearest = plain.surface = false;
    plain.label_opacity = 0.0;
    plain.images.reset();
    QVERIFY2(grey_difference(picture, by_host(plain, 173, 131)).mean > 0.15, "nothing lies over the source");
    // D as a function evaluates it.
    for (Painter* painter : {&by_gl, &by_host}) {
      painter->renderer().set_speed(std::make_shared<FormulaSpeed>(
          [](glm::dvec3 p) { return std::sin(0.15 * p.x + 0.1 * p.y) * std::cos(0.2 * p.z); }));
    }
    if (view.content == renderer::SliceContent::speed)
      compare(by_gl(view, 160, 132), by_host(view, 160, 132));
    for (Painter* painter : {&by_gl, &by_host}) painter->renderer().set_speed(nullptr);
  }

  void any_number_of_threads_draws_the_same_data() { name_golden_views(); }
  void any_number_of_threads_draws_the_same() {
    QFETCH(QString, name);
    const Golden& golden = golden_views().at(name.toStdString());
    const auto alone = golden.draw(patient(golden.patient, renderer::RendererKind::host, 1));
    QCOMPARE(failure(alone), QString());
    for (const int threads : {2, 5}) {
      const auto together = golden.draw(patient(golden.patient, renderer::RendererKind::host, threads));
      QCOMPARE(failure(together), QString());
      QVERIFY(together->pixels == alone->pixels);
    }
  }
  void any_number_of_threads_draws_laden_slices() {
    Painter one(laden().scene, renderer::RendererKind::host, 1);
    Painter five(laden().scene, renderer::RendererKind::host, 5);
    for (Painter* painter : {&one, &five}) laden().give(painter->renderer());
    for (const auto& [name, view] : laden_views()) {
      QVERIFY2(one(view, 173, 131).pixels == five(view, 173, 131).pixels, qPrintable(name));
    }
  }

  // The host executor's memory is drawn like a copy of it, also after it has grown.
  void as_many_threads_draw_as_were_asked_for() {
    const auto threads = [] {
      return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
    };
    const Laden laden;
    const auto before = threads();
    const auto renderer = renderer::make_renderer(renderer::RendererKind::host, nullptr, laden.scene.source,
                                                  laden.scene.phi.layout, 4);
    QCOMPARE(failure(renderer), QString());
    QCOMPARE(threads(), before + 3);  // and the caller
  }
  void the_executors_own_memory_gives_the_same_picture() {
    const Scene scene = ball_scene(grid({64, 64, 48}), 22.0);
    solver::Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 50.0;
    auto executor = solver::make_executor(solver::ExecutorKind::host, scene.source, parameters, {});
    QCOMPARE(failure(executor), QString());
    QCOMPARE(failure((*executor)->paint({scene.middle, 5.0}, solver::Brush::add)), QString());
    Painter of_copy(scene, renderer::RendererKind::host);
    Painter of_memory(scene, renderer::RendererKind::host);
    renderer::SliceView outline;
    renderer::SliceView pages;
    pages.content = renderer::SliceContent::pages;
    for (int run = 0; run < 4; ++run) {
      QCOMPARE(failure((*executor)->advance({20})), QString());
      const auto quiet = (*executor)->quiet_pages();
      const auto looks = of_memory.renderer().look_at(**executor, *quiet);
      QCOMPARE(failure(looks), QString());
      QVERIFY(*looks);
      QCOMPARE(failure(of_copy.renderer().set_phi(*(*executor)->snapshot(), *quiet)), QString());
      QVERIFY(count(of_memory(outline, 96, 96), is_yellow) > 50);
      for (const renderer::SliceView& view : {outline, pages}) {
        QVERIFY(of_memory(view, 96, 96).pixels == of_copy(view, 96, 96).pixels);
      }
    }
  }

 private:
  static void name_golden_views() {
    QTest::addColumn<QString>("name");
    for (const auto& [name, golden] : golden_views()) {
      // The processor's renderer draws by rays what OpenGL draws by slices, which slice_stack_test compares.
      if (!name.ends_with("-by-slices")) QTest::newRow(name.c_str()) << QString::fromStdString(name);
    }
  }
  static void compare(const renderer::Picture& by_gl, const renderer::Picture& by_host,
                      const Limits& limits = kSame) {
    const GreyDifference found = grey_difference(by_gl, by_host);
    qInfo("%s", words(found).data());
    QVERIFY2(found.mean <= limits.mean && found.of_99_percent <= limits.of_99_percent, words(found));
  }
  Patient& patient(const char* kind, renderer::RendererKind renderer, int threads = 0) {
    auto& one = patients_[{kind, renderer, threads}];
    if (!one) one = std::make_unique<Patient>(kind, renderer, threads);
    return *one;
  }

  std::map<std::tuple<std::string, renderer::RendererKind, int>, std::unique_ptr<Patient>> patients_;
};

TIDEMARK_TEST(RendererAgreementTest)

}  // namespace tidemark::test::renderer_agreement_test

#include "renderer_agreement_test.moc"
