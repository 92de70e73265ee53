// SPDX-License-Identifier: MIT
// The main job as a program: any polygon mesh in, a textured model out, with a report and, if asked for,
// pictures.
#include <CGAL/assertions.h>

#include "batch.h"
#include "texture_atlas.h"
#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <string>

int main(int argc, char** argv)
{
  std::signal(SIGXFSZ, SIG_IGN); // a limit of the file size is then an error like a full disk
  std::signal(SIGPIPE, SIG_IGN);
  struct sigaction interrupt = {}; // which also ends waiting
  interrupt.sa_handler = [](int) { is_interrupted = true; };
  sigaction(SIGINT, &interrupt, nullptr);
  sigaction(SIGTERM, &interrupt, nullptr);
  CGAL::set_error_handler([](const char*, const char*, const char*, int, const char*) {});

  Options options;
  Batch_options batch;
  CLI::App app("", "texture_atlas");
  declare_options(app, options);
  declare_batch_options(app, batch);
  return exit_code_of(options, [&]() -> int {
    try {
      app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
      std::fputs((app.help() + '\n').c_str(), stdout);
      return std::fflush(stdout) == 0 ? success : io_failure;
    }
    if (!batch.list.empty())
      return run_batch(app, options, batch);
    complete_all(app, options);
    return run(options);
  });
}
