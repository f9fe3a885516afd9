// SPDX-License-Identifier: Apache-2.0
// System calls that emscripten does not have: files in memory have no attributes, nothing is loaded
// beside the module, and no other program can be started. Of iconv(), it has tables for all
// encodings of East Asia, which take 128 kB of the module when compressed: JavaScript reads
// Shift-JIS, the only one that is used, and by the same table as glibc.
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include <emscripten.h>
#include <iconv.h>
#include <link.h>
#include <spawn.h>
#include <sys/xattr.h>

// Whether JavaScript knows the encoding.
EM_JS(int, gltfx_has_shift_jis, (), {
  try {
    new TextDecoder("shift_jis");
    return 1;
  } catch (error) {
    return 0;
  }
});

// Writes a text in UTF-8 and returns its size; negative when it is not in Shift-JIS, or is larger
// than `room`. The byte 0x80 alone is no character on Windows.
EM_JS(int, gltfx_read_shift_jis, (const char* from, std::size_t size, char* to, std::size_t room), {
  try {
    const bytes = HEAPU8.slice(from >>> 0, (from >>> 0) + size);
    const text = new TextDecoder("shift_jis", {fatal : true}).decode(bytes);
    const utf8 = new TextEncoder().encode(text);
    if (text.includes(String.fromCharCode(128)) || utf8.length > room) return -1;
    HEAPU8.set(utf8, to >>> 0);
    return utf8.length;
  } catch (error) {
    return -1;
  }
});

namespace {

int unsupported() {
  errno = ENOTSUP;
  return -1;
}

}  // namespace

extern "C" {

ssize_t getxattr(const char*, const char*, void*, size_t) { return unsupported(); }
ssize_t fgetxattr(int, const char*, void*, size_t) { return unsupported(); }
ssize_t listxattr(const char*, char*, size_t) { return unsupported(); }
int fsetxattr(int, const char*, const void*, size_t, int) { return unsupported(); }
int fremovexattr(int, const char*) { return unsupported(); }

int dl_iterate_phdr(int (*)(dl_phdr_info*, size_t, void*), void*) { return 0; }

int posix_spawnp(pid_t*, const char*, const posix_spawn_file_actions_t*, const posix_spawnattr_t*,
                 char* const*, char* const*) {
  return ENOSYS;
}

iconv_t iconv_open(const char* to, const char* from) {
  const bool known = to == std::string_view("UTF-8") && from == std::string_view("CP932");
  if (known && gltfx_has_shift_jis() != 0) return iconv_t(1);
  errno = EINVAL;
  return iconv_t(-1);  // NOLINT: the value that POSIX specifies
}

int iconv_close(iconv_t) { return 0; }

// Converts all or nothing.
std::size_t iconv(iconv_t, char** from, std::size_t* left, char** to, std::size_t* room) {
  const int size = gltfx_read_shift_jis(*from, *left, *to, *room);
  if (size < 0) {
    errno = EILSEQ;
    return SIZE_MAX;
  }
  *from += *left;
  *left = 0;
  *to += size;
  *room -= static_cast<std::size_t>(size);
  return 0;
}

}  // extern "C"
