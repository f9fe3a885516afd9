// SPDX-License-Identifier: Apache-2.0
#include "base/build_id.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include <elf.h>
#include <link.h>

#include "base/fork.hpp"

namespace gltfx {
namespace {

constexpr std::size_t padded(std::size_t size) { return (size + 3) / 4 * 4; }

std::string id_among(std::string_view notes) {
  ElfW(Nhdr) note{};
  while (notes.size() >= sizeof note) {
    std::memcpy(&note, notes.data(), sizeof note);
    const std::size_t name = sizeof note;
    const std::size_t content = name + padded(note.n_namesz);
    if (content + note.n_descsz > notes.size()) return {};
    const bool gnu = notes.substr(name, note.n_namesz) == std::string_view("GNU\0", 4);
    if (gnu && note.n_type == NT_GNU_BUILD_ID) {
      return std::string(notes.substr(content, note.n_descsz));
    }
    notes.remove_prefix(std::min(notes.size(), content + padded(note.n_descsz)));
  }
  return {};
}

// The first object is the program.
int look_at_program(dl_phdr_info* info, std::size_t, void* found) {
  for (std::size_t i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)& header = info->dlpi_phdr[i];
    std::string& id = *static_cast<std::string*>(found);
    if (header.p_type != PT_NOTE || !id.empty()) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the dynamic linker gives addresses as numbers
    id = id_among({reinterpret_cast<const char*>(info->dlpi_addr + header.p_vaddr),
                   static_cast<std::size_t>(header.p_memsz)});
  }
  return 1;
}

}  // namespace

const std::string& build_id() {
  static constinit MadeOnce<std::string> id;
  return id.get([] {
    std::string found;
    ::dl_iterate_phdr(look_at_program, &found);
    return found;
  });
}

}  // namespace gltfx
