#include "build_identity.hpp"

#include "file_checksums.hpp"

#include "dovetail/core/hash.hpp"

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <link.h>
#include <string>

namespace dovetail::app {
namespace {

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

run_identity identity_of_build() {
  return {{"build", checksum_of_file("/proc/self/exe")}, {"libraries", checksum_of_libraries()}};
}

} // namespace dovetail::app
