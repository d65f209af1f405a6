#include "engine/engine.h"

#include <QCoreApplication>
#include <algorithm>
#include <iterator>
#include <utility>

#include "core/without_exceptions.h"

namespace tidemark::engine {
namespace {

// Newest first: compute needs 4.5, everything else 3.3.
constexpr std::pair<int, int> kVersions[] = {{4, 5}, {3, 3}};

QSurfaceFormat format_of(std::pair<int, int> version) {
  QSurfaceFormat format;
  format.setRenderableType(QSurfaceFormat::OpenGL);
  format.setProfile(QSurfaceFormat::CoreProfile);
  format.setVersion(version.first, version.second);
  format.setOption(QSurfaceFormat::ResetNotification);
  format.setSamples(0);
  return format;
}

bool at_least(const QSurfaceFormat& format, std::pair<int, int> version) {
  return format.version() >= qMakePair(version.first, version.second);
}

Engine::Pictures choose_pictures(Engine::Graphics graphics, renderer::RendererKind renderer) {
  const QByteArray wanted = qgetenv("TIDEMARK_PICTURES");
  if (renderer == renderer::RendererKind::host || wanted == "images") return Engine::Pictures::images;
  if (wanted == "textures") return Engine::Pictures::textures;
  return graphics == Engine::Graphics::hardware ? Engine::Pictures::textures : Engine::Pictures::images;
}

}  // namespace

Engine::Engine(bool use_opengl) {
  if (use_opengl) {
    surface_ = std::make_unique<QOffscreenSurface>();
    surface_->setFormat(format_of(kVersions[1]));
    surface_->create();
    if (!surface_->isValid()) surface_.reset();
    if (!surface_) graphics_problem_ = "this screen has no surfaces for OpenGL";
  } else {
    graphics_problem_ = "OpenGL was not wanted";
  }
  thread_.reset(QThread::create([this] { run(); }));
  thread_->setObjectName("engine");
  // DICOM and shader compilers need more than the half megabyte that some systems give.
  thread_->setStackSize(16U << 20U);
  thread_->start();
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return started_; });
}

Engine::~Engine() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
    if (running_) running_->stop.request_stop();
  }
  changed_.notify_all();
  thread_->wait();
  context_.reset();
  surface_.reset();
}

Status Engine::make_context() {
  if (!surface_) return fail(ErrorKind::capability, "{}", graphics_problem_);
  for (const auto& version : kVersions) {
    auto context = std::make_unique<QOpenGLContext>();
    context->setFormat(format_of(version));
    context->setShareContext(QOpenGLContext::globalShareContext());
    if (!context->create() || !at_least(context->format(), version)) continue;
    if (!context->makeCurrent(surface_.get())) continue;
    auto device = gpu::Device::adopt_current(
        {version == kVersions[0] ? gpu::GlVersion::gl45 : gpu::GlVersion::gl33, false});
    if (!device) {
      graphics_problem_ = device.error().message;
      context->doneCurrent();
      continue;
    }
    context_ = std::move(context);
    device_ = std::move(*device);
    ++contexts_made_;
    return {};
  }
  if (graphics_problem_.empty()) graphics_problem_ = "no OpenGL 3.3 core context could be made";
  return fail(ErrorKind::capability, "{}", graphics_problem_);
}

void Engine::choose_renderer() {
  using renderer::RendererKind;
  const std::string word = qgetenv("TIDEMARK_RENDERER").toStdString();
  const auto named = renderer::renderer_named(word);
  if (!word.empty() && !named) {
    renderer_problem_ = fmt::format("TIDEMARK_RENDERER: '{}' is unknown; use auto, host or gl", word);
  }
  const auto asked = named.value_or(RendererKind::automatic);
  renderer_ = device_ == nullptr ? RendererKind::host : renderer::chosen_kind(asked, device_.get());
  if (asked == renderer_) {
    renderer_reason_ = "TIDEMARK_RENDERER asks for it";
  } else if (asked == RendererKind::gl) {
    renderer_reason_ = "there is no OpenGL for gl, which TIDEMARK_RENDERER asks for";
  } else if (graphics_ == Graphics::none) {
    renderer_reason_ = "there is no OpenGL";
  } else {
    renderer_reason_ = graphics_ == Graphics::software ? "there is no GPU" : "there is a GPU";
  }
}

Status Engine::renew_graphics() {
  let_graphics_go();
  context_.reset();
  return make_context();
}

void Engine::let_graphics_go() {
  device_.reset();
  if (context_) context_->doneCurrent();
}

void Engine::post(Priority priority, const void* owner, Job job, CutOff cut_off, Clock::time_point due) {
  {
    const std::lock_guard lock(mutex_);
    waiting_[static_cast<std::size_t>(priority)].push_back({owner, std::move(job), std::move(cut_off), due});
  }
  changed_.notify_all();
}

void Engine::cancel(const void* owner) {
  std::deque<Waiting> forgotten;  // dies after the lock is given back: what jobs hold may post as it goes
  const std::lock_guard lock(mutex_);
  for (auto& queue : waiting_) {
    const auto others = std::stable_partition(
        queue.begin(), queue.end(), [owner](const Waiting& waiting) { return waiting.owner == owner; });
    std::move(queue.begin(), others, std::back_inserter(forgotten));
    queue.erase(queue.begin(), others);
  }
  if (running_ && running_->owner == owner) running_->stop.request_stop();
}

void Engine::interrupt(Priority priority, const void* owner) {
  const std::lock_guard lock(mutex_);
  if (running_ && running_->priority > priority && (!owner || running_->owner == owner)) {
    running_->stop.request_stop();
  }
}

bool Engine::idle() const {
  const std::lock_guard lock(mutex_);
  const auto nothing = [](const auto& queue) { return queue.empty(); };
  return !running_ && std::all_of(waiting_.begin(), waiting_.end(), nothing);
}

// The next job; none when the engine closes. Edits run even then: by them owners drop their objects.
std::optional<Engine::Waiting> Engine::next(std::unique_lock<std::mutex>& lock) {
  for (;;) {
    const Clock::time_point now = Clock::now();
    Clock::time_point wake = Clock::time_point::max();
    for (std::size_t priority = 0; priority < (closing_ ? 1 : kPriorities); ++priority) {
      auto& queue = waiting_[priority];
      const auto due = std::ranges::find_if(queue, [now](const Waiting& job) { return job.due <= now; });
      for (const Waiting& job : queue) wake = std::min(wake, job.due);
      if (due == queue.end()) continue;
      Waiting job = std::move(*due);
      queue.erase(due);
      running_.emplace(Running{static_cast<Priority>(priority), job.owner, {}});
      if (closing_) running_->stop.request_stop();
      return job;
    }
    if (closing_) return std::nullopt;
    if (wake == Clock::time_point::max()) {
      changed_.wait(lock);
    } else {
      changed_.wait_until(lock, wake);
    }
  }
}

// What jobs hold may post as it goes.
void Engine::forget_jobs(std::unique_lock<std::mutex>& lock) {
  const auto none_waits = [this] {
    return std::ranges::all_of(waiting_, [](const auto& queue) { return queue.empty(); });
  };
  while (!none_waits()) {
    Queues forgotten = std::exchange(waiting_, {});
    lock.unlock();
    forgotten = {};
    lock.lock();
  }
}

// Nothing that is thrown gets further than this.
void Engine::carry_out(const Waiting& waiting, const std::stop_token& stop) {
  const Status done = without_exceptions([&]() -> Status {
    waiting.job(stop);
    return {};
  });
  if (done || !waiting.cut_off) return;
  const Status told = without_exceptions([&]() -> Status {
    waiting.cut_off(done.error());
    return {};
  });
  if (!told) qWarning("A job of the engine: %s", told.error().message.c_str());
}

void Engine::run() {
  const Status made = make_context();
  std::unique_lock lock(mutex_);
  if (made) {
    capabilities_ = device_->capabilities();
    graphics_ = capabilities_.software ? Graphics::software : Graphics::hardware;
  }
  choose_renderer();
  pictures_ = choose_pictures(graphics_, renderer_);
  started_ = true;
  changed_.notify_all();
  while (auto waiting = next(lock)) {
    const std::stop_token stop = running_->stop.get_token();
    lock.unlock();
    carry_out(*waiting, stop);
    waiting.reset();  // its objects are destroyed on this thread
    lock.lock();
    running_.reset();
  }
  forget_jobs(lock);
  lock.unlock();
  let_graphics_go();
  // Contexts are deleted where their surface is.
  if (context_) context_->moveToThread(QCoreApplication::instance()->thread());
}

}  // namespace tidemark::engine
