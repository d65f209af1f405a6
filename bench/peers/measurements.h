// The measurements of peers. Each adds its tables and its goals to the report.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "bench/peers/contestants.h"
#include "bench/peers/report.h"

namespace tidemark::bench {

struct Settings {
  int rounds = 3;                 // contestants take turns this often; medians are reported
  bool quick = false;             // one short round, to see that everything works
  std::vector<std::string> only;  // names of contestants; empty: all
  std::string program;            // this program's path, for child processes
};

// Whether a contestant takes part.
bool wanted(const Settings& settings, const std::string& name);

// The middle value; of an even number the mean of the middle two. values must not be empty.
double median(std::vector<double> values);

// Steps/s at the beginning, in the middle and at the end of an evolution, voxel updates/s, paging.
Status measure_stages(const Problem& problem, const Settings& settings, Report& report);

// Seconds from source to mask by each contestant's own criterion, Dice, and what a step costs afterwards.
Status measure_convergence(const Problem& problem, const Settings& settings, Report& report);

// Peak memory of each contestant, measured in a process of its own, and what our executor says of its state.
Status measure_memory(const Problem& problem, const Settings& settings, Report& report);
// The child's part: prints the bytes by which the contestant raises the process's peak.
Status print_memory_of(const Problem& problem, const std::string& contestant);

// Time per step and bytes against resident voxels, over spheres of radius 20 to 120.
Status measure_scaling(const Settings& settings, Report& report);

// Dice between the results of the instruction sets that this processor has.
Status measure_instruction_sets(const Problem& problem, Report& report);

// Processor, instruction sets, compiler.
void describe_machine(Report& report);
bool has_avx512();

}  // namespace tidemark::bench
