// A lesson on its way: the part that is shown, what was answered, tried and measured, and the cases of its
// tries.
#pragma once

#include <QObject>
#include <QPointer>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "document/lesson.h"
#include "document/lesson_answers.h"
#include "document/lesson_copy.h"
#include "engine/lesson_meter.h"
#include "engine/study_loader.h"

namespace tidemark::engine {

class CaseProxy;

// Lives on the thread of the user interface. It commands only cases that were opened for it.
class LessonCourse : public QObject {
  Q_OBJECT
 public:
  // `folder` holds the lesson's file, beside which its studies lie.
  LessonCourse(document::Lesson lesson, std::filesystem::path folder, QObject* parent = nullptr);

  ~LessonCourse() override;

  [[nodiscard]] const document::Lesson& lesson() const { return lesson_; }
  [[nodiscard]] const document::LessonAnswers& answers() const { return answers_; }
  [[nodiscard]] std::size_t index() const { return index_; }
  [[nodiscard]] const document::LessonPart& part() const { return lesson_.parts[index_]; }
  [[nodiscard]] const document::PartAnswers& given() const { return answers_.parts[index_]; }
  void go_to(std::size_t index);  // of a part, whose study opens
  // Opens the study of the part that is shown, to be looked at, unless it is open: see case_wanted().
  void open_study();

  // What is kept for a crash. Cases are not part of it: a try that goes on from another is carried out with
  // those before it.
  [[nodiscard]] document::LessonProgress progress() const { return {index_, answers_.parts, tried_}; }
  void go_on_from(const document::LessonProgress& progress);  // of the same lesson
  [[nodiscard]] bool begun() const;                           // something was answered, tried or measured
  // Whether there are answers that no file has which the student saved.
  [[nodiscard]] bool has_news() const { return begun() && answers_.parts != handed_in_; }
  void set_handed_in() { handed_in_ = answers_.parts; }

  // A question is answered before its part is tried, and not again. Where there is nothing to try, a choice
  // is not taken back.
  void choose(std::size_t choice);
  void answer(const QString& words);
  [[nodiscard]] bool answered(std::size_t part) const;
  [[nodiscard]] bool can_answer() const;

  // Sets the part's level set up and plays it, after those that it goes on from where the case is not there.
  // Where the study is not open it opens first.
  void attempt();
  [[nodiscard]] bool can_attempt() const;
  [[nodiscard]] bool attempting() const { return attempt_ != nullptr; }
  [[nodiscard]] bool tried(std::size_t part) const { return tried_[part]; }
  // How many steps of the try are left, of how many; of the part that is tried.
  [[nodiscard]] double fraction() const;
  void stop();  // gives the try up where it is

  // Takes the part's figures from its case as it is.
  void measure();
  [[nodiscard]] bool can_measure() const;
  [[nodiscard]] bool measuring() const { return measuring_; }
  // Whether nothing is left to do before the explanation.
  [[nodiscard]] bool done(std::size_t part) const;

  // The case of the part's tries; null: not open.
  [[nodiscard]] CaseProxy* proxy() const;

 signals:
  void changed();
  // The study of a part, to be opened: the receiver gives its case to take_case().
  void case_wanted(const std::shared_ptr<const tidemark::engine::LoadedStudy>& study);
  // A try begins on this case, which should be seen.
  void case_used(tidemark::engine::CaseProxy& proxy, const tidemark::document::LessonTry& attempt);
  void failed(const QString& message);

 public slots:
  void take_case(tidemark::engine::CaseProxy& proxy);

 private:
  struct LessonCase {
    document::LessonStudy study;
    QPointer<CaseProxy> proxy;
    std::optional<std::size_t> after;  // the part whose try it stands at the end of
    std::uint64_t edits = 0;           // CaseState::edits then
    std::int64_t step = 0;             // CaseState::step then
  };
  struct Attempt;

  [[nodiscard]] LessonCase* case_of(std::size_t part);
  [[nodiscard]] const LessonCase* case_of(std::size_t part) const;
  [[nodiscard]] std::size_t before(std::size_t part) const;  // that it goes on from
  void close_study();                                        // that is being opened
  void begin();
  void try_next();
  void wait_for_source();
  void play();
  void follow_end(bool reached);
  void follow_failure(const CaseProxy& of);
  void follow_closing();
  void break_off();
  void end_attempt();
  void take_figures(const std::vector<std::optional<double>>& figures);

  document::Lesson lesson_;
  std::filesystem::path folder_;
  document::LessonAnswers answers_;
  std::vector<document::PartAnswers> handed_in_;
  std::size_t index_ = 0;
  std::vector<char> tried_;
  std::vector<LessonCase> cases_;
  std::unique_ptr<Attempt> attempt_;
  std::optional<document::LessonStudy> opening_;
  StudyLoader loader_;
  LessonMeter meter_;
  bool measuring_ = false;
  std::size_t measured_part_ = 0;
};

}  // namespace tidemark::engine
