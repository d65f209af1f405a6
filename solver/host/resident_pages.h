// The pages of the host executor that are in memory: where they lie, what is around them, and when they come
// and go (a page stays while it has a non-flat voxel, and the page across a face is needed as soon as the
// face differs from it).
#pragma once

#include <algorithm>
#include <vector>

#include "core/thread_pool.h"
#include "solver/field.h"
#include "solver/host/host_fields.h"
#include "solver/model.h"

namespace tidemark::solver {

class ResidentPages {
 public:
  // What pages are filled from. It changes between steps; refill() is called then.
  struct Contents {
    const Geometry& geometry;
    const Model& model;
    const std::shared_ptr<const SpeedFunction>& speed;
    const std::shared_ptr<const Constraints>& constraints;
  };
  // Everything is outside at first. What it is made from outlives it.
  ResidentPages(const Contents& contents, ThreadPool& threads, std::int64_t memory_budget);
  ResidentPages(const ResidentPages&) = delete;  // its fields know its memory
  ResidentPages& operator=(const ResidentPages&) = delete;
  ~ResidentPages() = default;
  void clear();

  [[nodiscard]] const PagedMemory<3>& memory() const { return memory_; }
  [[nodiscard]] const PageTable& table() const { return memory_.table(); }
  [[nodiscard]] HostFields& fields() { return fields_; }
  [[nodiscard]] const HostFields& fields() const { return fields_; }

  // The buffer that holds phi. A step writes the other one.
  [[nodiscard]] int current() const { return current_; }
  void swap_buffers() { current_ = 1 - current_; }
  [[nodiscard]] float* phi(PhysicalPage page) const { return fields_.phi(current_, page); }
  // Shares what has not changed with the copy before it, and with the field that was restored.
  [[nodiscard]] Field copy() const;
  // phi is what these pages say, to the last bit.
  void know(const SharedPages& pages);
  // phi of the page has changed.
  void note_change(PhysicalPage page) const { memory_.note_change(memory_.virtual_page(page)); }

  // What a page asks for after a step that wrote `buffer`, as bits of page_code.h.
  [[nodiscard]] std::uint8_t requests(PhysicalPage page, int buffer);
  Status grant_requests(PhysicalPage page, std::uint8_t code);
  // Grants the requests of every page, after phi was replaced. Where the budget does not allow a page, those
  // before it are made, and needs_activation() says that it is missing.
  Status activate_all();
  // The same after these virtual pages have changed: nothing else asks for pages but they and those that they
  // touch.
  Status activate_around(const std::vector<std::int64_t>& virtual_pages);
  [[nodiscard]] bool needs_activation() const { return needs_activation_; }

  // Makes a page resident with the constant that stood for it. Its voxels are written by fill_new_pages().
  Result<PhysicalPage> make_resident(std::int64_t virtual_page);
  void fill_new_pages();
  // Gives a constant page back, if what touches it is the same constant.
  void release_if_surrounded(PhysicalPage page);
  // A page that is not resident becomes all inside or all outside.
  void set_static(Index3 coordinates, bool inside);

  // After the current buffer of a page was written to: the masks of both buffers, and the other buffer.
  void refresh(PhysicalPage page);
  // Before the parameters or the speed function change: room for the velocity that the next one has. Fails
  // (ErrorKind::capability) when that is above the budget; nothing has changed then.
  Status keep_advection(bool wanted);
  // After they have changed.
  void refill();
  // After the constraints changed: what pages know of them. phi is as before.
  void link_constraints();

  // Visits the resident pages in the order of virtual pages.
  template <class Visit>
  void for_each_in_order(Visit visit) {
    put_in_order();
    std::erase_if(listed_, [&](std::int64_t virtual_page) {
      const PhysicalPage page = memory_.physical(virtual_page);
      if (is_static_page(page)) return true;
      visit(page);
      return false;
    });
    listed_in_order_ = std::ssize(listed_);
  }

  // Of what drives the surface in all pages, and of all else.
  [[nodiscard]] std::int64_t drive_bytes() const { return table().capacity() * fields_.drive_bytes(); }
  [[nodiscard]] std::int64_t state_bytes() const;
  // The tables, and what each page knows of its neighbours.
  [[nodiscard]] Status validate() const;
  // Fails (ErrorKind::internal) where a copy, made now, does not hold what the resident pages hold.
  [[nodiscard]] Status validate(const Field& copy) const;

 private:
  [[nodiscard]] float constant(bool inside) const;
  void describe(PhysicalPage page);
  void link_neighbours(PhysicalPage page);
  void tell_neighbours(Index3 coordinates, PhysicalPage page);
  void fill_motion(PhysicalPage page);
  void link_constraints(PhysicalPage page);
  [[nodiscard]] bool surroundings_are_constant(PhysicalPage page, bool inside) const;
  void put_in_order();
  Status activate(const std::vector<PhysicalPage>& pages);

  Contents contents_;
  ThreadPool& threads_;
  std::int64_t memory_budget_;
  PagedMemory<3> memory_;
  HostFields fields_;
  int current_ = 0;
  std::vector<PhysicalPage> new_pages_;  // not filled yet
  // The virtual numbers of all resident pages, and of those freed since they were visited in order: first so
  // many in order, then those made resident since.
  std::vector<std::int64_t> listed_;
  std::ptrdiff_t listed_in_order_ = 0;
  bool needs_activation_ = false;  // the budget stopped an allocation
  mutable Field known_;            // the last copy; memory_ knows what has changed since
};

}  // namespace tidemark::solver
