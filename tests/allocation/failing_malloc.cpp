// SPDX-License-Identifier: Apache-2.0
/// To be preloaded: lets one allocation of a program fail. GLTFX_FAIL_AT is its number, counted
/// from 1 from main() on (0: none); before that nothing could report it. GLTFX_FAIL_LOG names a
/// file that gets the number of allocations when the program ends, or "failed" and a number when
/// one did.
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
}

namespace {

std::atomic<bool> counting{false};
std::atomic<bool> failed{false};
std::atomic<long> allocations{0};
long fail_at = 0;

void write_log() {
  counting = false;
  const char* path = std::getenv("GLTFX_FAIL_LOG");
  const int fd = path == nullptr ? -1 : ::open(path, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (fd < 0) return;
  char text[64];
  const int size =
      std::snprintf(text, sizeof(text), "%s%ld\n", failed ? "failed " : "", allocations.load());
  static_cast<void>(!::write(fd, text, static_cast<std::size_t>(size)));
  ::close(fd);
}

bool fails() {
  if (!counting.load(std::memory_order_relaxed)) return false;
  if (allocations.fetch_add(1) + 1 != fail_at) return false;
  failed = true;
  write_log();
  errno = ENOMEM;
  return true;
}

using Main = int (*)(int, char**, char**);
Main real_main = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  const char* number = std::getenv("GLTFX_FAIL_AT");
  fail_at = number == nullptr ? 0 : std::atol(number);
  // Processes that are started from here do not fail.
  ::unsetenv("LD_PRELOAD");
  std::atexit(write_log);
  counting = true;
  const int code = real_main(argc, argv, environment);
  counting = false;
  return code;
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) { return fails() ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t count, std::size_t size) {
  return fails() ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) { return fails() ? nullptr : __libc_realloc(old, size); }

void* memalign(std::size_t alignment, std::size_t size) {
  return fails() ? nullptr : __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) { return memalign(alignment, size); }

int posix_memalign(void** to, std::size_t alignment, std::size_t size) {
  void* memory = memalign(alignment, size);
  if (memory == nullptr) return ENOMEM;
  *to = memory;
  return 0;
}

void* mmap(void* address, std::size_t size, int protection, int flags, int fd, off_t offset) {
  if ((flags & MAP_ANONYMOUS) != 0 && fails()) return MAP_FAILED;
  return reinterpret_cast<void*>(::syscall(SYS_mmap, address, size, protection, flags, fd, offset));
}

int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                      void (*loader_fini)(), void* stack_end) {
  real_main = main;
  using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
  const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(counted_main, argc, argv, init, fini, loader_fini, stack_end);
}

}  // extern "C"
