// Answers to the newest of many questions, found away from the thread of the user interface.
#pragma once

#include <QTimer>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <utility>

#include "engine/background_job.h"

namespace tidemark::engine {

// One job at a time. A question that is being answered is answered to its end, and the newest one follows, so
// that answers keep coming while questions change faster than they are found.
template <class Question, class Answer>
class NewestQuestion {
 public:
  // The work runs on a thread of its own; `answered` is called on the receiver's, also where the work was cut
  // off: there is no answer then, and the same question can be asked again.
  using Work = std::function<Answer(const Question&, const std::stop_token&)>;
  // `rest`: after an answer nothing is asked for that many times as long as it took.
  NewestQuestion(QObject* receiver, Work work, std::function<void()> answered, int rest = 0)
      : receiver_(receiver), work_(std::move(work)), answered_(std::move(answered)), rest_(rest) {
    pause_.setSingleShot(true);
    QObject::connect(&pause_, &QTimer::timeout, receiver_, [this] { follow(); });
  }
  ~NewestQuestion() {
    if (job_) job_->abandon();
  }
  NewestQuestion(const NewestQuestion&) = delete;
  NewestQuestion& operator=(const NewestQuestion&) = delete;

  void ask(Question question) {
    if (asked_ == question) return;
    asked_ = std::move(question);
    if (!job_ && !pause_.isActive()) start();
  }
  // Neither question nor answer any more.
  void forget() {
    if (job_) job_->abandon();
    job_.reset();
    pause_.stop();
    asked_.reset();
    answer_.reset();
  }

  // The last question that was answered, and its answer; none before the first.
  struct Answered {
    Question question;
    Answer answer;
  };
  [[nodiscard]] const std::optional<Answered>& answer() const { return answer_; }
  // The answer to the question that was last asked; null while it is not there.
  [[nodiscard]] const Answer* newest() const {
    return answer_ && asked_ == answer_->question ? &answer_->answer : nullptr;
  }
  [[nodiscard]] bool waits() const { return job_ != nullptr; }

 private:
  using Clock = std::chrono::steady_clock;

  void start() {
    began_ = Clock::now();
    job_ = BackgroundJob::start(
        receiver_,
        [this, work = work_, question = *asked_](BackgroundJob& job) {
          auto answered = std::make_shared<Answered>(Answered{question, work(question, job.stop())});
          job.deliver([this, answered] { take(std::move(*answered)); });
        },
        [this, question = *asked_](const Error&) { drop(question); });
  }
  // A former answer would pass for that of the question that was cut off.
  void drop(const Question& question) {
    job_.reset();
    answer_.reset();
    if (asked_ != question) return start();
    answered_();
    if (asked_ == question && !job_) asked_.reset();
  }
  // The receiver may ask something else, or forget, on the answer.
  void take(Answered answered) {
    job_.reset();
    answer_ = std::move(answered);
    if (rest_ > 0) pause_.start(rest_ * std::chrono::ceil<std::chrono::milliseconds>(Clock::now() - began_));
    answered_();
    if (!pause_.isActive()) follow();
  }
  void follow() {
    if (!job_ && asked_ && answer_ && asked_ != answer_->question) start();
  }

  QObject* receiver_;
  Work work_;
  std::function<void()> answered_;
  int rest_;
  Clock::time_point began_;
  QTimer pause_;
  std::optional<Question> asked_;
  std::optional<Answered> answer_;
  std::shared_ptr<BackgroundJob> job_;  // while one runs
};

}  // namespace tidemark::engine
