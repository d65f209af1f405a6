// One builder for each kind of phantom.
#pragma once

#include <array>

#include "core/thread_pool.h"
#include "imaging/phantom/phantom.h"

namespace tidemark::imaging::phantom {

inline constexpr std::array<std::string_view, 8> kNames{"sphere", "dumbbell", "bridge",   "tumour",
                                                        "cortex", "organ",    "junction", "head"};

using Builder = Result<Phantom> (*)(const PhantomOptions&, ThreadPool&, const Progress&);

Result<Phantom> make_sphere(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_dumbbell(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_bridge(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_tumour(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_cortex(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_organ(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_junction(const PhantomOptions&, ThreadPool&, const Progress&);
Result<Phantom> make_head(const PhantomOptions&, ThreadPool&, const Progress&);

// make_phantom() on a pool of the caller's.
Result<Phantom> make_on(ThreadPool& pool, std::string_view kind, const PhantomOptions& options,
                        const Progress& progress);

// The ground truth of a kind, in one sentence.
std::string_view truth_of(std::string_view kind);

}  // namespace tidemark::imaging::phantom
