// The events of a folder, counted by name. None is missed.
#pragma once

#include <sys/inotify.h>
#include <unistd.h>

#include <QMap>
#include <QString>
#include <array>
#include <filesystem>

namespace tidemark::test {

class FolderEvents {
 public:
  // From now on; `kind` as inotify(7) has them: IN_CREATE, IN_MOVED_TO.
  FolderEvents(const std::filesystem::path& folder, std::uint32_t kind)
      : notifier_(::inotify_init1(IN_NONBLOCK | IN_CLOEXEC)) {
    if (::inotify_add_watch(notifier_, folder.c_str(), kind) < 0) qFatal("cannot watch %s", folder.c_str());
  }
  ~FolderEvents() { ::close(notifier_); }
  FolderEvents(const FolderEvents&) = delete;
  FolderEvents& operator=(const FolderEvents&) = delete;

  // The names of entries that an event was about, with how often. To be called before the system's queue of
  // some 16,000 events is full.
  const QMap<QString, int>& by_name() {
    alignas(inotify_event) std::array<char, 1 << 16> buffer;
    for (ssize_t got = 0; (got = ::read(notifier_, buffer.data(), buffer.size())) > 0;) {
      for (ssize_t at = 0; at < got;) {
        const auto* event = reinterpret_cast<const inotify_event*>(buffer.data() + at);
        if ((event->mask & IN_Q_OVERFLOW) != 0) qFatal("too many events of a folder");
        ++count_[QString::fromUtf8(event->name)];
        at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
      }
    }
    return count_;
  }

 private:
  int notifier_;
  QMap<QString, int> count_;
};

}  // namespace tidemark::test
