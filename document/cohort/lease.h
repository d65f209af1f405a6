// A lease: the right to compute one case, among programs that share nothing but a disk.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "core/result.h"

namespace tidemark::cohort {

// A file FOLDER/ID.N, made by link(), which one program alone succeeds in, also on network file systems. Its
// age by the disk's own clock says whether the holder still lives. A lease that has aged out is not removed
// but followed by ID.N+1, made in the same way: of all who see it, one gets the next. The files of a case go
// away when it is done.
class Lease {
 public:
  // Nothing, where another program holds the case. A lease is free when it was given back, when it is older
  // than `stale_after_s`, or when its holder was a process of this machine that has ended. Fails
  // (ErrorKind::write) where the folder cannot be written to.
  static Result<std::optional<Lease>> take(const std::filesystem::path& folder, const std::string& id,
                                           double stale_after_s);
  // Gives it back, unless it was finished: the next who looks has it.
  ~Lease();
  Lease(Lease&& other) noexcept;
  Lease& operator=(Lease&& other) noexcept;

  [[nodiscard]] const std::string& id() const { return id_; }
  [[nodiscard]] int number() const { return number_; }  // N, from 1: no two holders of a case have the same
  // A program that was held up may have lost it to another.
  [[nodiscard]] bool held() const;
  // Makes it new. To be called several times within the age at which it ends.
  void refresh() const;
  // The case is done: removes its files.
  void finish();

 private:
  Lease() = default;
  std::filesystem::path folder_;
  std::string id_;
  int number_ = 0;  // 0: moved from, or finished
};

// Removes what killed programs have left in the folder: the leases of cases that are done, by `is_done(id)`,
// and files that were to become leases. None that its holder may still need.
void sweep_leases(const std::filesystem::path& folder, double stale_after_s,
                  const std::function<bool(const std::string& id)>& is_done);

// A name of this machine, and of the processes that can see each other on it.
[[nodiscard]] std::string this_machine();

}  // namespace tidemark::cohort
