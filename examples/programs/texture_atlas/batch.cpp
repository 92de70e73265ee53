// SPDX-License-Identifier: MIT
// An atlas for each mesh of a list, one after another.
#include "batch.h"

#include <Atlas/core/errors.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <set>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using Json = Atlas::Json;

/// The options that have an influence on what is made, in the order of their declaration.
std::string wishes_of(const CLI::App& app)
{
  static const std::set<std::string> others = {"batch",    "shard",      "threads",      "quiet",
                                               "progress", "time-limit", "memory-limit", "output"};
  std::string wishes;
  for (const CLI::Option* option : app.get_options()) {
    const std::string name = option->get_single_name();
    if (option->count() == 0 || others.count(name) > 0)
      continue;
    wishes += name;
    for (const std::string& value : option->results())
      (wishes += '\0') += value;
    wishes += '\n';
  }
  return wishes;
}

/// How far the work is, on stderr: a line that is written over, or, where it is no terminal, one every ten
/// seconds; and each mesh that fails.
class Batch_progress
{
public:
  Batch_progress(std::size_t size, bool is_shown) : size_(size), is_shown_(is_shown) {}

  void add(const std::string& mesh, const Json& result, bool is_new)
  {
    ++done_;
    new_ += is_new;
    if (result.at("exit_code") != success) {
      ++failed_;
      clear();
      const Json& messages = result.at("messages");
      print_error(messages.empty() ? mesh + ": " + result.at("result").get<std::string>()
                                   : messages.back().get<std::string>());
    }
    const double now = seconds();
    if (!is_shown_ || now - last_ < (is_terminal_ ? 0.1 : 10))
      return;
    last_ = now;
    std::fprintf(stderr, "%s%s%s", is_terminal_ ? "\r" : "", counts().c_str(), is_terminal_ ? "" : "\n");
  }

  void finish()
  {
    clear();
    if (is_shown_)
      std::fprintf(stderr, "%s, %.1f s\n", counts().c_str(), seconds());
  }

  bool has_failures() const { return failed_ > 0; }

private:
  std::string counts() const
  {
    return "texture_atlas: " + std::to_string(done_) + " of " + std::to_string(size_) +
           " meshes: " + std::to_string(new_) + " now, " + std::to_string(done_ - new_) + " before, " +
           std::to_string(failed_) + " failed";
  }

  void clear() const
  {
    if (is_shown_ && is_terminal_)
      std::fprintf(stderr, "\r%78s\r", "");
  }

  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  std::size_t size_, done_ = 0, new_ = 0, failed_ = 0;
  bool is_shown_, is_terminal_ = isatty(STDERR_FILENO) != 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double last_ = 0;
};

/// One JSON line. The place of the model is that of this run.
void print_line(const Batch_entry& entry, const Json& result)
{
  Json line = {{"mesh", entry.mesh}, {"model", entry.output}};
  line.update(result);
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
  if (std::fputs(text.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
    throw Atlas::IO_error("cannot write to stdout");
}

/// The shard of a list: every n-th of its entries.
std::vector<Batch_entry> part_of(const std::vector<Batch_entry>& entries, const Batch_options& batch)
{
  std::vector<Batch_entry> part;
  for (std::size_t i = batch.shard - 1; i < entries.size(); i += batch.shards)
    part.push_back(entries[i]);
  return part;
}

/// Refuses options that speak of one mesh, or do not go together, before anything is done.
void check_options(const CLI::App& app, Options options, const Batch_options& batch)
{
  for (const char* name : {"MESH", "--report", "--picture"})
    if (app.count(name) > 0)
      throw CLI::ValidationError(name, "is for one atlas, and --batch makes many");
  options.meshes = {"any.glb"};
  options.output = "any." + batch.format;
  complete_all(app, options);
}

/// Reads `i/n`.
std::string read_shard(const std::string& text, Batch_options& batch)
{
  std::size_t end = 0;
  int shard = 0, shards = 0, length = 0;
  if (std::sscanf(text.c_str(), "%9d/%9d%n", &shard, &shards, &length) == 2)
    end = static_cast<std::size_t>(length);
  if (end != text.size() || shard < 1 || shard > shards)
    return "'" + text + "' is no part of several, as 3/8";
  batch.shard = static_cast<std::size_t>(shard);
  batch.shards = static_cast<std::size_t>(shards);
  return {};
}

} // namespace

void declare_batch_options(CLI::App& app, Batch_options& batch)
{
  CLI::Option* list = app.add_option(
      "--batch", batch.list,
      "Make an atlas for each mesh of a list, a file with a name per line, or `-` for stdin, instead of "
      "MESH. "
      "-o names a folder; models have the paths of the list there. stdout gets a JSON line for each mesh. "
      "What is done is not done again: beside each model _batch.json tells what it was made of. A mesh "
      "that fails stops nothing; then the exit code is 1");
  app.add_option("--format", batch.format, "Of the models of a batch")
      ->check(CLI::IsMember({"obj", "glb", "ply"}))
      ->needs(list)
      ->capture_default_str();
  app.add_option_function<std::string>(
         "--shard", [](const std::string&) {},
         "Of a batch, only this part of so many: 1/8, 2/8, ... 8/8 are all. Parts may run at the same time")
      ->check([&batch](const std::string& text) { return read_shard(text, batch); })
      ->needs(list)
      ->type_name("I/N");
}

int run_batch(const CLI::App& app, const Options& options, const Batch_options& batch)
{
  check_options(app, options, batch);
  const std::string folder = options.output.empty() ? "atlases" : options.output;
  const std::vector<Batch_entry> entries = part_of(read_list(batch.list, folder, batch.format), batch);
  clear_fragments(entries);
  const std::string wishes = wishes_of(app);
  Batch_progress progress(entries.size(), !options.is_quiet);
  for (const Batch_entry& entry : entries) {
    const Batch_record record(entry, wishes);
    const std::optional<Json> before = record.result();
    const Json result = before ? *before : make_apart(app, options, entry, record);
    if (is_interrupted)
      break;
    print_line(entry, result);
    progress.add(entry.mesh, result, !before);
  }
  clear_fragments(entries); // of a run that was killed just before this one began, and had not ended yet
  progress.finish();
  return is_interrupted ? interrupted : progress.has_failures() ? not_valid : success;
}
