#include "run_identity.hpp"

#include "file_checksums.hpp"
#include "named_policies.hpp"
#include "policies.hpp"
#include "run_setup.hpp"

#include "dovetail/core/hash.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <link.h>

namespace dovetail::app {
namespace {

std::string all_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

/// The build ids of a loaded library, which its linker has made of its content.
void add_build_ids(const dl_phdr_info& library, content_hash& hash) {
  for (int k = 0; k < library.dlpi_phnum; ++k) {
    const auto& segment = library.dlpi_phdr[k];
    if (segment.p_type != PT_NOTE)
      continue;
    const std::size_t unit = segment.p_align == 8 ? 8 : 4;
    const auto padded = [unit](std::size_t size) { return (size + unit - 1) / unit * unit; };
    const auto* notes = reinterpret_cast<const std::byte*>(library.dlpi_addr + segment.p_vaddr);
    ElfW(Nhdr) note;
    for (std::size_t at = 0; at + sizeof note <= segment.p_memsz;) {
      std::memcpy(&note, notes + at, sizeof note);
      const std::size_t content = at + sizeof note + padded(note.n_namesz);
      if (note.n_type == NT_GNU_BUILD_ID && content + note.n_descsz <= segment.p_memsz)
        hash.bytes({notes + content, note.n_descsz});
      at = content + padded(note.n_descsz);
    }
  }
}

/// The shared libraries that this program runs with: a mesh may be another one with the next version of one.
std::string checksum_of_libraries() {
  content_hash hash;
  const auto add = [](dl_phdr_info* library, std::size_t, void* into) {
    const std::filesystem::path file(library->dlpi_name);
    if (file.has_parent_path()) { // neither the program itself nor what the kernel brings along
      static_cast<content_hash*>(into)->text(file.filename().string());
      add_build_ids(*library, *static_cast<content_hash*>(into));
    }
    return 0;
  };
  ::dl_iterate_phdr(add, &hash);
  return hexadecimal(hash.value());
}

} // namespace

std::string values_of_field(const any_sizing& size, const box3& box) {
  constexpr std::array<double, 3> steps{0.8191725133961645, 0.6710436067037893, 0.5497004779019703};
  constexpr int samples = 4096;
  const vec3 extent = box.upper - box.lower;
  content_hash hash;
  for (int i = 0; i < samples; ++i) {
    vec3 p = box.lower;
    for (int axis = 0; axis < 3; ++axis) {
      const double t = i * steps[static_cast<std::size_t>(axis)];
      p[axis] += (t - std::floor(t)) * extent[axis];
    }
    hash.number(size(p));
  }
  return hexadecimal(hash.value());
}

run_identity identity_of_run(const mesh_options& options, const model_source& source) {
  run_identity identity{{"model", source.name}};
  identity.emplace_back("build", checksum_of_file("/proc/self/exe"));
  identity.emplace_back("libraries", checksum_of_libraries());
  if (!options.model.input.empty()) {
    identity.emplace_back("file", source.file);
    identity.emplace_back("unit", options.model.unit);
  }
  if (!source.sizing.empty())
    identity.emplace_back("sizing", source.sizing);
  if (!source.sizing_meshes.empty())
    identity.emplace_back("meshes of the sizing", source.sizing_meshes);
  identity.emplace_back("sizes", values_of_field(source.size, source.geometry.bounds()));
  identity.emplace_back("enlarged above", all_digits(make_generate_options(options).enlarged_above));
  identity.emplace_back("subdomains", options.subdomains ? std::to_string(*options.subdomains) : "default");
  identity.emplace_back("coarsening", options.coarsening ? all_digits(*options.coarsening) : "default");
  identity.emplace_back("decomposition",
                        chosen_name(decomposition_names(), options.decomposition, "--decomposition"));
  identity.emplace_back("dimension", std::to_string(options.dimension));
  identity.emplace_back("order", std::to_string(options.order));
  identity.emplace_back("mesher", options.dimension == 3 ? make_mesher<3>(options.mesher).name()
                                                         : make_mesher<2>(options.mesher).name());
  identity.emplace_back("background mesher", make_background_mesher(options.background_mesher).name());
  identity.emplace_back("background improver",
                        options.background_improver.empty() ? "default" : options.background_improver);
  identity.emplace_back("surface mesher", make_surface_mesher(options.surface_mesher).name());
  identity.emplace_back("partitioner", make_partitioner(options.partitioner).name());
  identity.emplace_back("simplifier",
                        make_simplifier(options.simplifier, options.wedge_angle, options.dimension).name());
  identity.emplace_back("improver", make_improver<3>(options.improver).name());
  return identity;
}

} // namespace dovetail::app
