// SPDX-License-Identifier: Apache-2.0
// A worker that misbehaves according to its payload or, before any payload, to the name of its
// folder.
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <unistd.h>

#include "codec/packet.hpp"
#include "codec/process.hpp"
#include "codec/server.hpp"

namespace gltfx::codec {
namespace {

DecodeError says(const std::string& message) { return {ErrorKind::malformed, message}; }

// The result of a system call: 0, or its errno.
std::string error_of(long result) { return std::to_string(result < 0 ? errno : 0); }

// The result of raising a limit above its hard limit, which a privileged process may do.
std::string error_of_raising(__rlimit_resource_t resource) {
  rlimit limit{};
  if (::getrlimit(resource, &limit) != 0) return "unknown";
  if (limit.rlim_max == RLIM_INFINITY) return "endless";
  limit.rlim_max += 1;
  limit.rlim_cur = limit.rlim_max;
  return error_of(::setrlimit(resource, &limit));
}

Answer touch_the_system(const std::string& what) {
  if (what == "open") return says(error_of(::open("/dev/null", O_RDONLY)));
  if (what == "stat") {
    struct stat status {};
    return says(error_of(::stat("/", &status)));
  }
  if (what == "socket") return says(error_of(::socket(AF_INET, SOCK_STREAM, 0)));
  if (what == "kill") return says(error_of(::kill(::getppid(), 0)));
  if (what == "signal") return says(error_of(::syscall(SYS_tgkill, 1, 1, 0)));
  if (what == "signal itself") {
    return says(error_of(::syscall(SYS_tgkill, ::getpid(), ::getpid(), 0)));
  }
  if (what == "limit") {
    rlimit limit{};
    return says(error_of(::prlimit(1, RLIMIT_NOFILE, nullptr, &limit)));
  }
  if (what == "limit by its id") {
    rlimit limit{};
    return says(error_of(::prlimit(::getpid(), RLIMIT_NOFILE, nullptr, &limit)));
  }
  if (what == "more memory") return says(error_of_raising(RLIMIT_AS));
  if (what == "more files") return says(error_of_raising(RLIMIT_NOFILE));
  if (what == "exec") {
    char* const none[] = {nullptr};
    return says(error_of(::execve("/bin/true", none, none)));
  }
  if (what == "fork") return says(error_of(::fork()));
  void* at = ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return says(error_of(at == MAP_FAILED ? -1 : 0));
}

std::string open_descriptors() {
  std::string list;
  for (int fd = 0; fd < 64; ++fd) {
    if (::lseek(fd, 0, SEEK_CUR) >= 0 || errno != EBADF) list += std::to_string(fd) + " ";
  }
  return list;
}

DracoMesh one_triangle(std::uint32_t index, const Output& output) {
  DracoMesh mesh;
  mesh.points = 3;
  mesh.faces = 1;
  const std::uint32_t indices[] = {0, 1, index};
  const std::span<std::byte> to = output(16);
  if (to.size() == 16) std::memcpy(to.data(), indices, sizeof indices);
  return mesh;
}

volatile std::uint64_t counter = 0;

Answer misbehave(const std::string& what, const Output& output) {
  if (what == "crash") {
    std::signal(SIGSEGV, SIG_DFL);  // a sanitizer would turn it into an exit
    std::raise(SIGSEGV);
  }
  if (what == "abort") std::abort();
  if (what == "disarm") {
    const itimerval none{};
    ::setitimer(ITIMER_PROF, &none, nullptr);
  }
  if (what == "exit") ::_exit(7);
  if (what == "spin" || what == "disarm") {
    while (true) counter = counter + 1;
  }
  if (what == "sleep") {
    while (true) ::sleep(1000);
  }
  if (what == "memory") {
    std::vector<std::string> all;
    while (true) all.emplace_back(std::size_t{1} << 20U, 'x');
  }
  if (what == "file") {
    const bool given = output(std::uint64_t{1} << 40U).empty();
    return says(given ? "refused" : "given");
  }
  if (what == "garbage") send_packet(kSocketDescriptor, std::vector<std::byte>(9), {});
  if (what == "no result") {
    DracoMesh mesh;
    mesh.points = mesh.faces = 1000;
    return mesh;
  }
  if (what == "wrong index") return one_triangle(3, output);
  if (what == "image") {
    Image image;
    image.width = image.height = image.channels = 1;
    return image;
  }
  if (what == "descriptors") return says(open_descriptors());
  if (what == "environment") return says(environ[0] == nullptr ? "empty" : environ[0]);
  if (what == "process") return says(std::to_string(::getpid()));
  if (what == "triangle") return one_triangle(2, output);
  return touch_the_system(what);
}

// An image must be valid, so its word is at the end, after a '|'.
Answer decode(const Job& job, std::span<const std::byte> bytes, const Output& output) {
  std::string_view what(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (job.task == Task::image) what.remove_prefix(what.rfind('|') + 1);
  return misbehave(std::string(what), output);
}

}  // namespace
}  // namespace gltfx::codec

namespace {

// As in a container that does not allow filters of system calls.
void refuse_filters() {
  sock_filter code[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offsetof(seccomp_data, nr))),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_seccomp, 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
  };
  sock_fprog filter{4, code};
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
}

}  // namespace

int main(int, char** arguments) {
  const std::filesystem::path folder = std::filesystem::path(arguments[0]).parent_path();
  const std::string kind = folder.filename();
  std::ofstream(folder / "starts", std::ios::app) << 'x';
  if (kind == "mute") {
    while (true) ::pause();
  }
  if (kind == "rude") {
    gltfx::codec::send_packet(gltfx::codec::kSocketDescriptor, std::vector<std::byte>(6), {});
    while (true) ::pause();
  }
  if (kind == "gone") return 3;
  if (kind == "unfiltered") refuse_filters();
  return gltfx::codec::serve([] {}, gltfx::codec::decode);
}
