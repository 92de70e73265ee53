// SPDX-License-Identifier: MIT
// An atlas for each mesh of a list.
#ifndef BATCH_H
#define BATCH_H

#include <Atlas/report/write_report.h>

#include "texture_atlas.h"
#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct Batch_options
{
  std::string list;                  ///< the file with the names of the meshes; empty: there is no batch
  std::string format = "obj";        ///< of the models
  std::size_t shard = 1, shards = 1; ///< this part of so many, counting from 1
};

void declare_batch_options(CLI::App& app, Batch_options& batch);

/// Makes the atlases. Returns the exit code. \throw CLI::Error, Atlas::IO_error
int run_batch(const CLI::App& app, const Options& options, const Batch_options& batch);

/// A mesh of the list, and where its model goes.
struct Batch_entry
{
  std::string mesh, output;
};

/// The meshes of the list, each once, and outputs of different names below the folder. \throw Atlas::IO_error
std::vector<Batch_entry> read_list(const std::string& list, const std::string& folder,
                                   const std::string& format);

/// \brief What is kept beside a model: of which bytes and by which options it was made, and what came out.
///
/// So a mesh has to be done again exactly if a file that was read, an option or the version has changed, or
/// if a file that was written is not there as it was.
class Batch_record
{
public:
  /// \param wishes  the options that have an influence on the result, as text
  Batch_record(const Batch_entry& entry, const std::string& wishes);

  /// What came out, if it need not be done again.
  std::optional<Atlas::Json> result() const;

  /// \param read     files, and digests of their bytes, empty where there was no such file
  /// \param written  names of files beside the model
  void write(const Atlas::Json& read, const Atlas::Json& written, const Atlas::Json& result) const;

private:
  std::filesystem::path path_;
  std::string key_;
};

/// Tells bytes apart: 122 bits of their SHA-1.
std::string digest_of(std::string_view bytes);

/// That of a file; empty if it cannot be read.
std::string digest_of_file(const std::filesystem::path& path);

/// Makes the atlas of one mesh in a process of its own, so that nothing that happens there ends this one.
/// Fills the record if files have been written. Returns the exit code, messages and figures.
Atlas::Json make_apart(const CLI::App& app, const Options& options, const Batch_entry& entry,
                       const Batch_record& record);

/// Deletes what runs that were killed have left beside the outputs.
void clear_fragments(const std::vector<Batch_entry>& entries);

#endif
