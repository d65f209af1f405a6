// The one thread that computes and draws, with the one OpenGL context.
#pragma once

#include <QObject>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QThread>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>

#include "core/result.h"
#include "gpu/device.h"
#include "renderer/renderer.h"

namespace tidemark::engine {

// Waiting jobs run in this order; jobs of the same priority in the order in which they came.
enum class Priority {
  edit,        // what a user did: always first, so that it is seen in the next picture
  picture,     // pictures to be seen now
  step,        // a chunk of steps of a level set that plays; figures of one that rests
  refine,      // better pictures of views in which nothing moves
  background,  // states of the history, and checkpoints
};

// A queue of small jobs, drained by one thread that owns the context, the executors and the renderers.
// Created and destroyed on the thread of the user interface, which never waits for it but at the very end.
class Engine : public QObject {
  Q_OBJECT
 public:
  enum class Graphics { hardware, software, none };

  // Without OpenGL the processor draws and computes, and graphics_problem() has the reason. `use_opengl`
  // false asks for that.
  explicit Engine(bool use_opengl = true);
  ~Engine() override;

  [[nodiscard]] Graphics graphics() const { return graphics_; }
  [[nodiscard]] const std::string& graphics_problem() const { return graphics_problem_; }
  [[nodiscard]] const gpu::Capabilities& capabilities() const { return capabilities_; }
  // Who draws, gl or host, and why: OpenGL on a GPU, else the processor. The environment's
  // TIDEMARK_RENDERER=gl|host overrides the choice; without OpenGL the processor draws all the same.
  [[nodiscard]] renderer::RendererKind renderer() const { return renderer_; }
  [[nodiscard]] const std::string& renderer_reason() const { return renderer_reason_; }
  // What is wrong with TIDEMARK_RENDERER, which counts as unset then; empty: nothing.
  [[nodiscard]] const std::string& renderer_problem() const { return renderer_problem_; }
  // How finished pictures of OpenGL's reach the views: as textures that their contexts share, or read back.
  // With a GPU the former; the environment's TIDEMARK_PICTURES=textures|images overrides the choice.
  enum class Pictures { textures, images };
  [[nodiscard]] Pictures pictures() const { return pictures_; }
  // For contexts that are to see the engine's textures; null without OpenGL.
  [[nodiscard]] QOpenGLContext* context() const { return context_.get(); }

  // A job takes a stop token, which asks it to end early when the engine closes or the job is cancelled. Jobs
  // of an `owner` (any address) that still wait are forgotten by cancel(owner), and the running one is asked
  // to stop. What a job throws ends it alone: `cut_off` is then called with the error, on the engine's
  // thread. Any thread may call these.
  using Job = std::function<void(std::stop_token)>;
  using CutOff = std::function<void(const Error&)>;
  using Clock = std::chrono::steady_clock;
  // It does not run before `due`.
  void post(Priority priority, const void* owner, Job job, CutOff cut_off = {}, Clock::time_point due = {});
  void cancel(const void* owner);
  // Asks the running job to stop if it is less urgent than `priority` and belongs to `owner` (null:
  // anyone's).
  void interrupt(Priority priority, const void* owner = nullptr);
  // Whether nothing waits and nothing runs.
  [[nodiscard]] bool idle() const;
  // Shares an object with other threads, but destroys it on the engine's thread, whichever thread drops the
  // last reference: for holders of OpenGL objects.
  template <class T>
  std::shared_ptr<T> share(std::unique_ptr<T> object) {
    return std::shared_ptr<T>(object.release(), [this](T* last) {
      post(Priority::edit, last, [dying = std::shared_ptr<T>(last)](const std::stop_token&) {});
    });
  }

  // On the engine's thread: the device, null without OpenGL.
  [[nodiscard]] const std::shared_ptr<gpu::Device>& device() const { return device_; }
  // On the engine's thread, after the device was lost: makes a new context. Owners must drop their objects
  // of the lost device. Fails (ErrorKind::capability) when no other context can be made.
  Status renew_graphics();
  // Contexts made since the start: 1, and one more for each that was lost.
  [[nodiscard]] int contexts_made() const { return contexts_made_; }

 private:
  struct Waiting {
    const void* owner;
    Job job;
    CutOff cut_off;
    Clock::time_point due;
  };
  struct Running {
    Priority priority;
    const void* owner;
    std::stop_source stop;
  };
  static constexpr std::size_t kPriorities = 5;

  Status make_context();
  void choose_renderer();
  void run();
  std::optional<Waiting> next(std::unique_lock<std::mutex>& lock);
  static void carry_out(const Waiting& waiting, const std::stop_token& stop);
  void forget_jobs(std::unique_lock<std::mutex>& lock);
  void let_graphics_go();

  std::unique_ptr<QOffscreenSurface> surface_;
  std::unique_ptr<QOpenGLContext> context_;
  std::shared_ptr<gpu::Device> device_;
  gpu::Capabilities capabilities_;
  Graphics graphics_ = Graphics::none;
  renderer::RendererKind renderer_ = renderer::RendererKind::host;
  std::string renderer_reason_;
  std::string renderer_problem_;
  Pictures pictures_ = Pictures::images;
  std::string graphics_problem_;
  std::atomic<int> contexts_made_{0};

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  using Queues = std::array<std::deque<Waiting>, kPriorities>;
  Queues waiting_;
  std::optional<Running> running_;
  bool started_ = false;
  bool closing_ = false;
  std::unique_ptr<QThread> thread_;
};

}  // namespace tidemark::engine
