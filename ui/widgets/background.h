// Work that may take long, or hang on a network drive, away from the user interface.
#pragma once

#include <QObject>
#include <QThreadPool>
#include <memory>
#include <utility>

#include "session/outlet.h"

namespace tidemark {

// Runs `work` on another thread, then hands what it returned to `done` on this one, unless `owner` is gone by
// then. `work` must hold everything that it uses.
template <class Work, class Done>
void run_in_background(QObject* owner, Work work, Done done) {
  auto outlet = std::make_shared<Outlet>(owner);
  QObject::connect(owner, &QObject::destroyed, [outlet] { outlet->close(); });
  QThreadPool::globalInstance()->start([work = std::move(work), done = std::move(done), outlet]() mutable {
    auto outcome = std::make_shared<decltype(work())>(work());
    outlet->send([outcome, done = std::move(done)]() mutable { done(std::move(*outcome)); });
  });
}

}  // namespace tidemark
