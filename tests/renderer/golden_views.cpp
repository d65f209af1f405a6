#include "tests/renderer/golden_views.h"

#include <QtGlobal>

#include "imaging/phantom/phantom.h"
#include "renderer/sheet.h"
#include "solver/distance_transform.h"

namespace tidemark::test {
namespace {

constexpr renderer::PictureSize kSize{128, 128};

renderer::VolumeView from_the_left(const Patient& patient) {
  renderer::VolumeView view;
  view.camera.azimuth = 35.0;
  view.camera.elevation = 20.0;
  view.window = patient.window;
  return view;
}

Golden::Draw volume(const std::function<void(renderer::VolumeView&, const Patient&)>& change) {
  return [change](Patient& patient) {
    renderer::VolumeView view = from_the_left(patient);
    change(view, patient);
    if (patient.step_voxels) view.quality.step_voxels = *patient.step_voxels;
    return patient.painter->renderer().draw(view, kSize);
  };
}

Golden slice(const char* of, const std::function<void(renderer::SliceView&, Patient&)>& change) {
  const auto draw = [change](Patient& patient) {
    renderer::SliceView view;
    view.position_mm = patient.scene.middle;
    view.window = patient.window;
    view.label_opacity = 0.0;
    change(view, patient);
    return patient.painter->renderer().draw(view, kSize);
  };
  return {of, draw, true};
}

void add_presets(GoldenViews& all, const std::string& suffix, renderer::Mode mode) {
  for (const std::string& name : renderer::preset_names()) {
    const char* patient = name.starts_with("mr-") ? "head" : "organ";
    all["preset-" + name + suffix] = {patient,
                                      volume([name, mode](renderer::VolumeView& view, const Patient& p) {
                                        view.mode = mode;
                                        view.source = *renderer::preset(name);
                                        view.surface = !view.source->surface.empty();
                                        if (view.surface) {
                                          view.clip = renderer::ClipPlane{{0.0, 0.0, 1.0}, p.scene.middle.z};
                                        }
                                      })};
  }
}

void add_surfaces(GoldenViews& all, const std::string& suffix, renderer::Mode mode) {
  const auto add = [&](const char* name,
                       const std::function<void(renderer::VolumeView&, const Patient&)>& change) {
    all[name + suffix] = {"organ", volume([change, mode](renderer::VolumeView& view, const Patient& patient) {
                            view.mode = mode;
                            view.camera = view.camera.on(renderer::box_around(patient.scene.phi),
                                                         patient.scene.source->geometry, 1.0);
                            change(view, patient);
                          })};
  };
  add("surface", [](renderer::VolumeView&, const Patient&) {});
  add("surface-translucent",
      [](renderer::VolumeView& view, const Patient&) { view.surface_colour.a = 0.3F; });
  add("surface-lit-from-above", [](renderer::VolumeView& view, const Patient&) {
    view.lighting.from = {0.0, 0.0, 1.0};
  });
  add("surface-and-bone", [](renderer::VolumeView& view, const Patient&) {
    view.camera.focus_mm.reset();
    view.camera.zoom = 1.0;
    view.source = *renderer::preset("ct-bone");
  });
  for (const auto& [name, region] : {std::pair{"region-inside", renderer::Region::inside},
                                     {"region-outside", renderer::Region::outside},
                                     {"region-tinted", renderer::Region::tinted}}) {
    add(name, [region = region](renderer::VolumeView& view, const Patient&) {
      view.source = *renderer::preset("ct-soft-tissue");
      view.surface = false;
      view.region = region;
      view.camera.zoom *= 0.6;
    });
  }
  for (const auto& [name, source, surface] :
       {std::tuple{"clip-both", true, true}, {"clip-source", true, false}, {"clip-surface", false, true}}) {
    add(name, [source = source, surface = surface](renderer::VolumeView& view, const Patient& patient) {
      view.camera.zoom *= 0.6;
      view.source = *renderer::preset("ct-bone");
      view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -patient.scene.middle.y};
      view.clip->clips_source = source;
      view.clip->clips_surface = surface;
    });
  }
}

void add_teaching(GoldenViews& all) {
  for (const auto& [name, colouring] : {std::pair{"total", renderer::SurfaceColouring::total_speed},
                                        {"data", renderer::SurfaceColouring::data},
                                        {"curvature-term", renderer::SurfaceColouring::curvature_term},
                                        {"rescaling", renderer::SurfaceColouring::rescaling},
                                        {"curvature", renderer::SurfaceColouring::curvature},
                                        {"pages", renderer::SurfaceColouring::pages}}) {
    all[std::string("teaching-") + name] = {
        "organ", volume([colouring = colouring](renderer::VolumeView& view, const Patient& p) {
          view.camera = view.camera.on(renderer::box_around(p.scene.phi), p.scene.source->geometry, 1.0);
          view.colouring = colouring;
        })};
  }
  all["surface-occlusion"] = {"organ", volume([](renderer::VolumeView& view, const Patient& p) {
                                view.camera = view.camera.on(renderer::box_around(p.scene.phi),
                                                             p.scene.source->geometry, 1.0);
                                view.lighting.occlusion = 1.0;
                              })};
  all["moving"] = {"head", volume([](renderer::VolumeView& view, const Patient&) {
                     view.quality = renderer::kMovingQuality;
                     view.source = *renderer::preset("mr-head");
                   })};
}

void add_slices(GoldenViews& all) {
  for (const auto& [name, orientation] : {std::pair{"axial", renderer::kAxial},
                                          {"coronal", renderer::kCoronal},
                                          {"sagittal", renderer::kSagittal},
                                          {"oblique", renderer::oblique({1.0, 0.6, 0.8})}}) {
    all[std::string("slice-") + name] = slice(
        "organ",
        [orientation = orientation](renderer::SliceView& view, Patient&) { view.orientation = orientation; });
  }
  all["slice-nearest"] = slice("head", [](renderer::SliceView& view, Patient&) {
    view.nearest = true;
    view.zoom = 6.0;
  });
  all["slice-labels"] = slice("organ", [](renderer::SliceView& view, Patient& patient) {
    if (const Status set = patient.painter->renderer().set_labels(patient.labels); !set) {
      qFatal("%s", set.error().message.c_str());
    }
    view.label_opacity = 0.5;
  });
  for (const auto& [name, term] : {std::pair{"total", renderer::SpeedTerm::total},
                                   {"data", renderer::SpeedTerm::data},
                                   {"curvature", renderer::SpeedTerm::curvature},
                                   {"rescaling", renderer::SpeedTerm::rescaling}}) {
    all[std::string("speed-") + name] = slice("organ", [term = term](renderer::SliceView& view, Patient&) {
      view.content = renderer::SliceContent::speed;
      view.surface = false;
      view.zoom = 2.0;
      view.term = term;
    });
  }
  all["pages"] = slice(
      "organ", [](renderer::SliceView& view, Patient&) { view.content = renderer::SliceContent::pages; });
  all["sheet"] = {"head", [](Patient& patient) {
                    renderer::SheetView view;
                    view.position_mm = patient.scene.middle;
                    view.window = patient.window;
                    view.speed = true;
                    view.volume = from_the_left(patient);
                    return renderer::draw_sheet(patient.painter->renderer(), view, {384, 256});
                  }};
}

}  // namespace

Patient::Patient(const char* kind, renderer::RendererKind renderer, int threads) {
  auto phantom = imaging::make_phantom(kind);
  if (!phantom) qFatal("%s", phantom.error().message.c_str());
  scene.phi = solver::distance_transform(phantom->truth, solver::default_band(phantom->truth.geometry));
  scene.middle = renderer::middle_of(scene.phi);
  scene.source = std::make_shared<const Volume>(std::move(phantom->volume));
  parameters.target = phantom->target;
  parameters.range = phantom->range;
  parameters.alpha = phantom->alpha;
  window = renderer::window_of(*scene.source);
  labels = PagedBytes(phantom->truth.geometry.size, phantom->truth.voxels);
  painter = std::make_unique<Painter>(scene, renderer, threads);
  painter->renderer().set_parameters(parameters);
}

const GoldenViews& golden_views() {
  static const GoldenViews kAll = [] {
    GoldenViews all;
    add_presets(all, "", renderer::Mode::raycast);
    add_presets(all, "-by-slices", renderer::Mode::slices);
    add_surfaces(all, "", renderer::Mode::raycast);
    add_surfaces(all, "-by-slices", renderer::Mode::slices);
    add_teaching(all);
    add_slices(all);
    return all;
  }();
  return kAll;
}

}  // namespace tidemark::test
