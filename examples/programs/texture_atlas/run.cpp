// SPDX-License-Identifier: MIT
// The work on the meshes of one atlas, from reading to writing.
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/text_bytes.h>
#include <Atlas/soup/orient_faces.h>

#include "texture_atlas.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <unistd.h>
#include <utility>
#include <vector>

void print_error(std::string message)
{
  std::replace(message.begin(), message.end(), '\n', ' ');
  std::fprintf(stderr, "texture_atlas: %s\n", Atlas::internal::printable(message).c_str());
}

std::atomic<bool> is_interrupted{false};

namespace {

class Stopwatch
{
public:
  double seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// How long to go on: until a signal comes, or the time is over.
class Patience
{
public:
  explicit Patience(double limit) : limit_(limit) {}

  bool is_over() const { return is_interrupted || is_late(); }

  /// Tells why the work ended; returns the exit code.
  Exit_code say() const
  {
    if (is_interrupted)
      print_error("interrupted; nothing has been written");
    else
      print_error("not finished within the time limit; nothing has been written");
    return is_interrupted ? interrupted : out_of_time;
  }

private:
  bool is_late() const { return limit_ > 0 && watch_.seconds() > limit_; }

  double limit_;
  Stopwatch watch_;
};

/// One line on stderr that is written over, or a line per stage where it is no terminal.
class Progress_printer
{
public:
  Progress_printer(const Options& options, const Patience& patience)
      : patience_(patience), is_terminal_(isatty(STDERR_FILENO) != 0),
        is_shown_((is_terminal_ || options.shows_progress) && !options.is_quiet)
  {}

  bool operator()(Atlas::Stage stage, double fraction)
  {
    const int percent = static_cast<int>(100 * fraction);
    if (is_shown_ && is_terminal_ && (stage != stage_ || percent != percent_))
      std::fprintf(stderr, "\r%-16s %3d %%", Atlas::name(stage), percent);
    else if (is_shown_ && !is_terminal_ && (percent_ < 0 || stage != stage_))
      std::fprintf(stderr, "%s\n", Atlas::name(stage));
    stage_ = stage;
    percent_ = percent;
    return !patience_.is_over();
  }

  void finish() const
  {
    if (is_shown_ && is_terminal_)
      std::fprintf(stderr, "\r%24s\r", "");
  }

private:
  const Patience& patience_;
  bool is_terminal_, is_shown_;
  Atlas::Stage stage_{};
  int percent_ = -1;
};

/// Tells what was not kept; returns the exit code.
Exit_code say(const Options& options, const Atlas::Atlas_report& report)
{
  using enum Atlas::Coverage_outcome;
  if (!report.is_valid()) {
    print_error(options.name() + ": " + message(report.certificate));
    return not_valid;
  }
  if (report.coverage_outcome != kept && report.coverage_outcome != not_asked_for) {
    print_error(options.name() + ": " + message(report.coverage_outcome));
    return not_full;
  }
  return success;
}

bool has_coordinates(const Atlas::Atlas_report& report)
{
  return report.status == Atlas::Atlas_status::valid || report.status == Atlas::Atlas_status::not_valid;
}

/// Makes the atlas, and gives the model its coordinates.
Atlas::Atlas_report fill_model(Options& options, Input& input, const Patience& patience)
{
  Progress_printer progress(options, patience);
  Atlas::Polygon_soup& model = input.models.whole();
  std::vector<Atlas::Point_2> uv;
  Atlas::Atlas_report report = make_atlas(options, model, input.surface, uv, std::ref(progress));
  progress.finish();
  if (!options.tells_times)
    report.seconds = {};
  if (!has_coordinates(report))
    return report;
  model.old_uv = std::exchange(model.uv, std::move(uv));
  model.face_page = report.face_page;
  start_polygons_at_fans(input.surface, model);
  return report;
}

/// The same, where no charts share a place but those that look alike.
Atlas::Atlas_report fill_model_as_it_looks(Options& options, Input& input, const Patience& patience)
{
  const bool is_baked = options.has(Bake::texture) || options.has(Bake::colors);
  if (options.page.stacking == Atlas::Chart_stacking::none || !is_baked)
    return fill_model(options, input, patience);
  const Input before = input;
  Atlas::Atlas_report report = fill_model(options, input, patience);
  if (!is_stacked_wrongly(options, input, report))
    return report;
  if (!options.is_quiet)
    print_error("charts that are copies of one another show different colours: none are stacked");
  input = before;
  options.page.stacking = Atlas::Chart_stacking::none;
  return fill_model(options, input, patience);
}

} // namespace

int exit_code_of(const Options& options, const std::function<int()>& work)
{
  try {
    return work();
  } catch (const CLI::Error& error) {
    print_error(std::string(error.what()) + " (see --help)");
    return wrong_usage;
  } catch (const Atlas::IO_error& error) {
    print_error(error.what());
    return io_failure;
  } catch (const std::filesystem::filesystem_error& error) {
    print_error(error.what());
    return io_failure;
  } catch (const std::bad_alloc&) {
    print_error(options.name() + ": not enough memory");
    return io_failure;
  } catch (const std::exception& error) {
    print_error(options.name() + ": internal error: " + error.what());
    return internal_failure;
  }
}

int run(Options& options)
{
  const Patience patience(options.time_limit);
  check_outputs(options);
  limit_memory(options);
  const Stopwatch reading;
  Input input = read_meshes(options);
  const double seconds_reading = reading.seconds();
  check_memory(options, input.surface);
  const Atlas::Atlas_report report = fill_model_as_it_looks(options, input, patience);
  options.page.width = report.page_width; // where the aspect is free, another one
  options.page.height = report.page_height;
  if (report.status == Atlas::Atlas_status::cancelled)
    return patience.say();
  if (!has_coordinates(report)) {
    if (!options.is_quiet)
      print_rejected(options, input.models, report);
    print_error(options.name() + ": " + message(report.status));
    return not_valid;
  }

  const Stopwatch writing;
  const Atlas::Execution execution(options.threads, [&](double) { return !patience.is_over(); });
  const Atlas::Polygon_soup& model = input.models.whole();
  const Written written = write_outputs(options, input, report, execution);
  if (execution.is_cancelled())
    return patience.say();
  if (options.when_written)
    options.when_written(report, written.names);
  if (!options.is_quiet) {
    print_rejected(options, input.models, report);
    print_unfulfilled(options, model, report);
    print_beyond_bound(report);
    print_disagreement(options, model, report);
    print_unwelded(options, model, input.surface, report);
    print_table(options, model, report);
    for (const std::string& line : written.seams)
      std::printf("seams         %s\n", line.c_str());
    print_times(report, seconds_reading, writing.seconds());
    for (std::size_t i = 0; i < written.names.size(); ++i)
      std::printf("%-13s %s\n", i == 0 ? "written" : "", written.names[i].c_str());
    if (std::fflush(stdout) != 0)
      throw Atlas::IO_error("cannot write to stdout");
  }
  return say(options, report);
}
