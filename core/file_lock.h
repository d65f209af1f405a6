// Locks on files and folders across programs, and the owner of a folder.
#pragma once

#include <filesystem>
#include <stop_token>

namespace tidemark {

// The lock of a file or a folder. One holder at a time has it, and it ends with the holder's program, however
// that ends: it tells the files of killed programs from those of running ones. It does not keep others
// from reading, writing or renaming. Links are not followed.
class FileLock {
 public:
  enum class Missing { give_up, make };  // a file that is made is for its owner alone

  FileLock() = default;  // holds nothing
  // Holds nothing where another holder has it, `path` cannot be opened, or the file system knows no locks.
  static FileLock take(const std::filesystem::path& path, Missing missing = Missing::give_up);
  // Waits until no other holder has it. Holds nothing on a request to stop, and where take() never would.
  static FileLock wait(const std::filesystem::path& path, Missing missing, const std::stop_token& stop);
  // Whether another holder has it.
  [[nodiscard]] static bool is_taken(const std::filesystem::path& path);

  ~FileLock();
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;

  [[nodiscard]] explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

// Whether `path` is a folder of this user's, not a link.
[[nodiscard]] bool is_own_folder(const std::filesystem::path& path);

}  // namespace tidemark
