// The temporary files and folders of this process, for when it has to end at once.
#pragma once

#include <filesystem>

namespace tidemark {

// While it lives, the path is one of those that remove_unfinished() removes.
class Unfinished {
 public:
  Unfinished() = default;
  explicit Unfinished(const std::filesystem::path& path);
  ~Unfinished();
  Unfinished(Unfinished&& other) noexcept;
  Unfinished& operator=(Unfinished&& other) noexcept;

 private:
  std::filesystem::path path_;
};

// Removes them all with what is in them, whoever else works on them: the process must end right after. Any
// thread may call it, but no handler of a signal.
void remove_unfinished();

}  // namespace tidemark
