// SPDX-License-Identifier: MIT
#ifndef ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_FACTOR_PANELS_H
#define ATLAS_PARAMETERIZATION_INTERNAL_SPARSE_FACTOR_PANELS_H

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace Atlas::internal {

/// \brief Where a factorization keeps its panels, each an array of doubles: as they are, in memory.
///
/// `start(s, size)` gives zeros to write the s-th panel into, `finish(s)` keeps it, `read(s)` gives it back.
/// Panels are written in increasing order. What `start` and `read` gave is valid up to the next call.
class Panels_in_memory
{
public:
  void resize(std::size_t panels) { panels_.resize(panels); }

  double* start(std::size_t s, std::size_t size)
  {
    Panel& panel = panels_[s];
    if (panel.size == size) // factorized once more
      std::fill_n(panel.data.get(), size, 0.);
    else
      panel = {std::make_unique<double[]>(size), size};
    return panel.data.get();
  }
  bool finish(std::size_t) { return true; }
  const double* read(std::size_t s) { return panels_[s].data.get(); }

  /// Numbers in all panels.
  std::size_t size() const
  {
    std::size_t sum = 0;
    for (const Panel& panel : panels_)
      sum += panel.size;
    return sum;
  }

private:
  struct Panel
  {
    std::unique_ptr<double[]> data;
    std::size_t size = 0;
  };

  std::vector<Panel> panels_;
};

/// \brief Panels rounded to single precision: half the memory, and a factor of a matrix near the one that was
/// factorized. The elimination itself is in double precision, so that rounding adds up nowhere.
class Panels_in_single_precision
{
public:
  void resize(std::size_t panels) { panels_.resize(panels); }

  double* start(std::size_t, std::size_t size)
  {
    work_.assign(size, 0);
    return work_.data();
  }
  bool finish(std::size_t s)
  {
    panels_[s] = {std::make_unique_for_overwrite<float[]>(work_.size()), work_.size()};
    std::transform(work_.begin(), work_.end(), panels_[s].data.get(),
                   [](double x) { return static_cast<float>(x); });
    return true;
  }
  const double* read(std::size_t s)
  {
    const Panel& panel = panels_[s];
    work_.assign(panel.data.get(), panel.data.get() + panel.size);
    return work_.data();
  }

  std::size_t size() const
  {
    std::size_t sum = 0;
    for (const Panel& panel : panels_)
      sum += panel.size;
    return sum;
  }

private:
  struct Panel
  {
    std::unique_ptr<float[]> data;
    std::size_t size = 0;
  };

  std::vector<Panel> panels_;
  std::vector<double> work_;
};

/// \brief A file of numbers that nobody else sees, and that is gone with the object.
class Temporary_file
{
public:
  /// \param directory  where; empty for the system's choice
  explicit Temporary_file(std::filesystem::path directory)
  {
    std::error_code error;
    if (directory.empty())
      directory = std::filesystem::temp_directory_path(error);
    std::random_device random;
    for (int attempt = 0; attempt < 16 && !file_.is_open(); ++attempt) {
      path_ = directory / ("atlas_factor_" + std::to_string(random()) + std::to_string(random()));
      std::FILE* created = std::fopen(path_.string().c_str(), "wbx"); // only if there is none of this name
      if (!created)
        continue;
      std::fclose(created);
      file_.open(path_, std::ios::in | std::ios::out | std::ios::binary);
      std::filesystem::remove(path_, error); // where open files can be removed, nothing remains after a crash
    }
  }
  Temporary_file(const Temporary_file&) = delete;
  Temporary_file& operator=(const Temporary_file&) = delete;
  ~Temporary_file()
  {
    if (!file_.is_open())
      return;
    file_.close();
    std::error_code error;
    std::filesystem::remove(path_, error);
  }

  bool is_open() const { return file_.is_open(); }
  bool write(std::size_t place, const std::vector<double>& data)
  {
    file_.seekp(static_cast<std::streamoff>(place * sizeof(double)));
    file_.write(reinterpret_cast<const char*>(data.data()),
                static_cast<std::streamsize>(data.size() * sizeof(double)));
    return file_.good();
  }
  bool read(std::size_t place, std::vector<double>& data)
  {
    file_.seekg(static_cast<std::streamoff>(place * sizeof(double)));
    file_.read(reinterpret_cast<char*>(data.data()),
               static_cast<std::streamsize>(data.size() * sizeof(double)));
    return file_.good();
  }

private:
  std::fstream file_;
  std::filesystem::path path_;
};

/// \brief Panels in a file, but for the first ones, which are kept in memory as far as they may.
///
/// A panel that cannot be read is all NaN, so that the solution is not finite.
class Panels_in_file
{
public:
  Panels_in_file() = default;
  /// \param memory     bytes for the factorization
  /// \param directory  where the file is; empty for the system's choice
  Panels_in_file(std::size_t memory, const std::filesystem::path& directory)
      : memory_(memory), file_(std::make_unique<Temporary_file>(directory))
  {}

  /// Sets memory aside for what the factorization needs besides panels; `false` if there is not so much, or
  /// no file.
  bool plan(std::size_t others)
  {
    if (!file_ || !file_->is_open() || memory_ < others)
      return false;
    memory_ = (memory_ - others) / sizeof(double);
    return true;
  }

  void resize(std::size_t panels) { panels_.resize(panels); }

  double* start(std::size_t, std::size_t size)
  {
    work_.assign(size, 0);
    return work_.data();
  }
  bool finish(std::size_t s)
  {
    Panel& panel = panels_[s];
    panel.size = work_.size();
    size_ += panel.size;
    if (panel.size <= memory_) {
      memory_ -= panel.size;
      panel.data = std::make_unique_for_overwrite<double[]>(panel.size);
      std::copy(work_.begin(), work_.end(), panel.data.get());
      return true;
    }
    memory_ = 0;
    panel.place = written_;
    written_ += panel.size;
    return file_->write(panel.place, work_);
  }
  const double* read(std::size_t s)
  {
    const Panel& panel = panels_[s];
    if (panel.data)
      return panel.data.get();
    work_.resize(panel.size);
    if (!file_->read(panel.place, work_))
      work_.assign(panel.size, std::numeric_limits<double>::quiet_NaN());
    return work_.data();
  }

  std::size_t size() const { return size_; }
  /// Numbers in the file.
  std::size_t written() const { return written_; }

private:
  struct Panel
  {
    std::unique_ptr<double[]> data;
    std::size_t size = 0, place = 0;
  };

  std::size_t memory_ = 0; ///< bytes; once planned, numbers that may still be kept in memory
  std::unique_ptr<Temporary_file> file_;
  std::vector<Panel> panels_;
  std::vector<double> work_;
  std::size_t size_ = 0, written_ = 0;
};

} // namespace Atlas::internal

#endif
