// SPDX-License-Identifier: MIT
// How a batch knows what is done.
#include <Atlas/core/errors.h>
#include <Atlas/image/internal/Output_file.h>
#include <Atlas/image/internal/Text_scanner.h>
#include <Atlas/version.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>

#include "batch.h"
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace {

namespace fs = std::filesystem;

/// The path of a mesh below the folder of the outputs, without its extension: that of the list, but for its
/// root and for steps upwards.
fs::path place_of(const fs::path& mesh)
{
  fs::path result;
  for (const fs::path& part : mesh.lexically_normal().relative_path())
    if (part != "..")
      result /= part;
  return result.replace_extension();
}

/// The bytes of a file, if it can be read; without telling whoever listens.
std::optional<std::string> bytes_of(const fs::path& path)
{
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored))
    return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (!file || (file.peek() != std::ifstream::traits_type::eof() && !(bytes << file.rdbuf())))
    return std::nullopt;
  return std::move(bytes).str();
}

/// Whether a process of this number is at work here: what it writes is no fragment.
bool is_running(const std::string& process)
{
  const long number = std::strtol(process.c_str(), nullptr, 10);
  return number > 0 && (kill(static_cast<pid_t>(number), 0) == 0 || errno == EPERM);
}

} // namespace

std::vector<Batch_entry> read_list(const std::string& list, const std::string& folder,
                                   const std::string& format)
{
  std::istringstream text(Atlas::internal::read_text_file(list == "-" ? "/dev/stdin" : list));
  std::vector<Batch_entry> entries;
  std::set<std::string> meshes, taken; // names of reports and records
  const auto take = [&taken](const std::string& place) {
    if (taken.count(place + ".json") > 0 || taken.count(place + "_batch.json") > 0)
      return false;
    taken.insert({place + ".json", place + "_batch.json"});
    return true;
  };
  for (std::string line; std::getline(text, line);) {
    if (meshes.empty() && line.starts_with("\xEF\xBB\xBF")) // as Windows has it
      line.erase(0, 3);
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    if (line.empty() || !meshes.insert(line).second)
      continue;
    const std::string place = (fs::path(folder) / place_of(line)).string();
    std::string name = place;
    for (int number = 2; !take(name); ++number)
      name = place + '_' + std::to_string(number);
    entries.push_back({line, name + '.' + format});
  }
  std::error_code ignored;
  std::set<fs::path> sources;
  for (const Batch_entry& entry : entries)
    sources.insert(fs::weakly_canonical(entry.mesh, ignored));
  for (const Batch_entry& entry : entries)
    if (const fs::path place = fs::weakly_canonical(entry.output, ignored);
        !place.empty() && sources.count(place) > 0)
      throw Atlas::IO_error(entry.output + ": would be overwritten by the atlas of " + entry.mesh +
                            ": name another folder by -o");
  return entries;
}

std::string digest_of(std::string_view bytes)
{
  boost::uuids::name_generator_sha1 generator(boost::uuids::ns::oid());
  return to_string(generator(bytes.data(), bytes.size()));
}

std::string digest_of_file(const fs::path& path)
{
  const std::optional<std::string> bytes = bytes_of(path);
  return bytes ? digest_of(*bytes) : "";
}

Batch_record::Batch_record(const Batch_entry& entry, const std::string& wishes) : path_(entry.output)
{
  path_ = path_.parent_path() / (path_.stem().string() + "_batch.json");
  key_ = digest_of(std::string(ATLAS_VERSION) + '\n' + entry.mesh + '\n' + wishes);
}

std::optional<Atlas::Json> Batch_record::result() const
{
  const std::optional<std::string> bytes = bytes_of(path_);
  const Atlas::Json json = Atlas::Json::parse(bytes.value_or(""), nullptr, false);
  try {
    if (json.is_discarded() || json.at("key") != key_)
      return std::nullopt;
    for (const auto& [file, digest] : json.at("read").items())
      if (digest_of_file(file) != digest)
        return std::nullopt;
    for (const auto& [file, digest] : json.at("written").items())
      if (digest_of_file(path_.parent_path() / file) != digest)
        return std::nullopt;
    return json.at("result");
  } catch (const Atlas::Json::exception&) { // of another version, or not of this program
    return std::nullopt;
  }
}

void Batch_record::write(const Atlas::Json& read, const Atlas::Json& written, const Atlas::Json& result) const
{
  Atlas::Json digests = Atlas::Json::object();
  for (const std::string file : written)
    digests[fs::path(file).filename().string()] = digest_of_file(file);
  const Atlas::Json json = {{"key", key_}, {"read", read}, {"written", digests}, {"result", result}};
  Atlas::internal::write_whole_file(path_, Atlas::json_text(json));
}

void clear_fragments(const std::vector<Batch_entry>& entries)
{
  std::map<fs::path, std::set<std::string>> stems; // by folder
  for (const Batch_entry& entry : entries)
    stems[fs::path(entry.output).parent_path()].insert(fs::path(entry.output).stem().string());
  const std::regex form(
      "\\.(.+?)(_(checkerboard|color|texture|normal|tangent_normal|occlusion|displacement|page|stretch|view|"
      "batch))?(\\.[0-9]{4})?\\.[a-z]+\\.([0-9]+)\\.part");
  std::error_code ignored;
  for (const auto& [folder, own] : stems)
    for (const auto& file : fs::directory_iterator(folder.empty() ? "." : folder, ignored)) {
      const std::string name = file.path().filename().string();
      std::smatch match;
      if (std::regex_match(name, match, form) && own.count(match[1].str()) > 0 && !is_running(match[5].str()))
        fs::remove(file.path(), ignored);
    }
}
