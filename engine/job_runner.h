// A runner of work beside the user interface: one piece at a time, on a thread of its own.
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/progress.h"
#include "core/without_exceptions.h"

namespace tidemark::engine {

class BackgroundJob;

// Lives on the thread of the user interface. The next piece of work gives up the one before, which then sends
// no more signals.
class JobRunner : public QObject {
  Q_OBJECT
 public:
  ~JobRunner() override;  // gives up what runs, and waits for nothing

  [[nodiscard]] bool busy() const { return job_ != nullptr; }

 signals:
  // fraction in 0..1 of the step named by `step` ("Reading headers", in the user's language); below 0 when
  // unknown.
  void progressed(double fraction, const QString& step);
  void failed(const QString& message);
  void cancelled();

 protected:
  using QObject::QObject;

  // Calls work(progress) on a thread and deliver(value) here. The work returns a Result or a Status and must
  // hold nothing of ours. It ends with failed() when it fails, and with cancelled() when it was stopped.
  template <class Work, class Deliver>
  void run(Work work, Deliver deliver) {
    start([this, work = std::move(work), deliver = std::move(deliver)](const Progress& progress) -> Ending {
      using Answer = std::invoke_result_t<const Work&, const Progress&>;
      const auto outcome =
          std::make_shared<Answer>(without_exceptions([&]() -> Answer { return work(progress); }));
      return [this, deliver, outcome] {
        if (!*outcome) return end_by(outcome->error());
        if constexpr (std::is_void_v<typename Answer::value_type>) {
          deliver();
        } else {
          deliver(std::move(**outcome));
        }
      };
    });
  }

  // Signals that end of work.
  void end_by(const Error& error);
  void give_up();      // drops the signals of the running work; emits cancelled() if there was any
  void ask_to_stop();  // its end is still signalled

 private:
  using Ending = std::function<void()>;  // to be called here
  void start(std::function<Ending(const Progress&)> work);

  std::shared_ptr<BackgroundJob> job_;
};

}  // namespace tidemark::engine
