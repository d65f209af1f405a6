// The commands under tidemark-cli pacs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/cli/program.h"
#include "imaging/pacs/services.h"

namespace tidemark::cli {

// The choice of a server, common to all of them.
struct ServerChoice {
  std::string server;
  std::string file;  // empty: pacs_configuration_file()

  struct Chosen {
    imaging::PacsServer server;
    imaging::PacsLimits limits;
  };
  [[nodiscard]] Result<Chosen> choose() const;
};
void add_server_choice(CLI::App& command, ServerChoice& choice);

// The keys of a query for studies. `of_studies` alone make no sense for the series of a study.
struct StudyKeys {
  std::vector<CLI::Option*> all, of_studies;
};
StudyKeys add_study_keys(CLI::App& command, imaging::StudyQuery& query, const char* of_description);

void add_pacs_find(CLI::App& pacs, Program& program);
void add_pacs_get(CLI::App& pacs, Program& program);
void add_pacs_send(CLI::App& pacs, Program& program);

}  // namespace tidemark::cli
