/// @file
/// The pipeline on several ranks, and the mesh that it must make on any number of them.
#pragma once

#include "dovetail/files/finishing_pass.hpp"
#include "dovetail/files/vtu_writer.hpp"
#include "dovetail/mesh/mesh_hash.hpp"
#include "dovetail/parallel/any_executor.hpp"
#include "dovetail/pipeline/generate.hpp"
#include "dovetail/sizing/uniform.hpp"
#include "files/scratch_folder.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace dovetail::testing {

/// The names and contents of the files of a mesh. Ranks see them at other times than the folder for
/// unfinished ones.
inline std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file())
      files[entry.path().filename().string()] = file_content(entry.path());
  return files;
}

/// A mesh as all ranks of an executor have it together.
struct ranked_mesh {
  std::uint64_t hash = 0;     ///< of what this rank holds
  std::uint64_t finished = 0; ///< as the finishing pass says
  std::map<std::string, std::string> files;

  bool operator==(const ranked_mesh&) const = default;
};

template <int D, class Model, class Mesher>
ranked_mesh mesh_on(const any_executor& run, const Model& model, double size, const Mesher& mesher,
                    generate_options options, const std::filesystem::path& folder) {
  if (options.subdomains == 0)
    options.subdomains = 4;
  const auto result = generate<D>(
      model, uniform_size(size), parameters<>{}.with_mesher(mesher).with_executor(run).with_options(options));
  REQUIRE(result.failures.empty());
  CHECK(result.mesh.counts.size() == static_cast<std::size_t>(options.subdomains));
  const auto finished = io::finish_mesh<D>(result.mesh, {io::vtu_writer{}}, folder, run, {});
  return {io::mesh_hash(result.mesh), finished.hash, contents(folder)};
}

} // namespace dovetail::testing
