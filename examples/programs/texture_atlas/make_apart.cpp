// SPDX-License-Identifier: MIT
// A mesh of a batch, in a process of its own.
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Reading_listener.h>
#include <Atlas/image/internal/text_bytes.h>

#include "batch.h"
#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <mutex>
#include <sstream>
#include <string_view>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

namespace {

namespace fs = std::filesystem;
using Json = Atlas::Json;

Atlas::IO_error failure(const char* what)
{
  return Atlas::IO_error(std::string(what) + ": " + std::generic_category().message(errno));
}

/// What a process writes and another one reads once it has ended.
class Note
{
public:
  Note() : file_(std::tmpfile(), &std::fclose)
  {
    if (!file_)
      throw failure("no temporary file");
  }

  int descriptor() const { return fileno(file_.get()); }

  void write(const std::string& text) const
  {
    std::fputs(text.c_str(), file_.get());
    std::fflush(file_.get());
  }

  std::string read() const
  {
    std::rewind(file_.get());
    std::string text;
    char block[4096];
    while (const std::size_t n = std::fread(block, 1, sizeof block, file_.get()))
      text.append(block, n);
    return text;
  }

private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

Json figures_of(const Atlas::Atlas_report& report)
{
  return {{"faces", report.faces},
          {"rejected_faces", report.rejected.size()},
          {"charts", report.charts.size()},
          {"pages", report.pages},
          {"page_width", report.page_width},
          {"page_height", report.page_height},
          {"texels_per_unit", report.density},
          {"packing_efficiency", report.packing_efficiency},
          {"seam_length", report.seam_length},
          {"symmetric_dirichlet_mean", report.distortion.symmetric_dirichlet_mean}};
}

/// Files and digests of what is read from now on. Those that options name count, too.
class Reading_log
{
public:
  explicit Reading_log(const Options& options)
  {
    for (const std::string& file : {options.seams, options.pinned, options.hiding})
      if (const std::string digest = digest_of_file(file); !digest.empty())
        files_[file] = digest;
    Atlas::internal::reading_listener() = [this](const fs::path& path,
                                                 std::optional<std::string_view> bytes) {
      const std::lock_guard lock(mutex_);
      files_[path.string()] = bytes ? digest_of(*bytes) : "";
    };
  }
  ~Reading_log() { Atlas::internal::reading_listener() = {}; }

  const Json& files() const { return files_; }

  /// Throws if one of these has been read: what a batch changes is not what it comes from.
  void check_unread(const std::vector<std::string>& names) const
  {
    std::error_code ignored;
    for (const std::string& name : names)
      for (const auto& [file, digest] : files_.items())
        if (fs::equivalent(file, name, ignored))
          throw Atlas::IO_error(
              name + ": is read for this atlas, and would be overwritten: name another folder by -o");
  }

private:
  std::mutex mutex_;
  Json files_ = Json::object();
};

/// The life of the new process.
int work(const CLI::App& app, Options options, const Batch_entry& entry, const Note& messages,
         const Note& findings)
{
  const int nowhere = open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO})
    dup2(nowhere, stream);
  dup2(messages.descriptor(), STDERR_FILENO);
  options.meshes = {entry.mesh};
  options.output = entry.output;
  options.shows_progress = options.tells_times = false;
  return exit_code_of(options, [&] {
    complete_all(app, options);
    if (const fs::path folder = fs::path(entry.output).parent_path(); !folder.empty())
      fs::create_directories(folder);
    const Reading_log log(options);
    options.before_writing = [&log](const std::vector<std::string>& names) { log.check_unread(names); };
    options.when_written = [&](const Atlas::Atlas_report& report, const std::vector<std::string>& names) {
      const Json found = {{"figures", figures_of(report)}, {"read", log.files()}, {"written", names}};
      findings.write(found.dump(-1, ' ', false, Json::error_handler_t::replace));
    };
    return run(options);
  });
}

/// How the process has ended. It is asked to, if a signal says so.
int status_of(pid_t child)
{
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR)
      throw failure("no process to wait for");
    if (is_interrupted)
      kill(child, SIGTERM);
  }
  return status;
}

/// The first lines, without the name of the program.
Json lines_of(const std::string& text)
{
  constexpr std::size_t most = 20;
  constexpr std::string_view program = "texture_atlas: ";
  Json lines = Json::array();
  std::istringstream stream(text);
  for (std::string line; lines.size() < most && std::getline(stream, line);)
    lines.push_back(
        Atlas::internal::printable(line.starts_with(program) ? line.substr(program.size()) : line));
  return lines;
}

/// The exit code, and what was said.
Json outcome_of(const Batch_entry& entry, int status, const std::string& messages, bool has_files)
{
  Json lines = lines_of(messages);
  int code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) {
    code = 128 + WTERMSIG(status); // as shells have it
    lines.push_back(entry.mesh + ": ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                    strsignal(WTERMSIG(status)) + ")");
  }
  const char* const result = code == success    ? "valid"
                             : !has_files       ? "failed"
                             : code == not_full ? "not full"
                                                : "not valid";
  return {{"result", result}, {"exit_code", code}, {"messages", std::move(lines)}};
}

} // namespace

Json make_apart(const CLI::App& app, const Options& options, const Batch_entry& entry,
                const Batch_record& record)
{
  const Note messages, findings;
  const pid_t parent = getpid(), child = fork();
  if (child < 0)
    throw failure("no further process");
  if (child == 0) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); // does not outlive the batch
    if (getppid() != parent)
      std::_Exit(interrupted);
#endif
    std::_Exit(work(app, options, entry, messages, findings));
  }
  const int status = status_of(child);
  const Json found = Json::parse(findings.read(), nullptr, false);
  const bool is_whole = WIFEXITED(status) && found.is_object();
  Json result = outcome_of(entry, status, messages.read(), is_whole);
  if (is_whole) {
    result.update(found.at("figures"));
    try {
      record.write(found.at("read"), found.at("written"), result);
    } catch (const Atlas::IO_error& error) { // then it is done again
      result["messages"].push_back(Atlas::internal::printable(error.what()));
    }
  }
  return result;
}
