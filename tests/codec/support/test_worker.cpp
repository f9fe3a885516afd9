// SPDX-License-Identifier: Apache-2.0
// A worker that misbehaves as its payload tells it to.
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "codec/packet.hpp"
#include "codec/process.hpp"
#include "codec/server.hpp"

namespace gltfx::codec {
namespace {

Fault says(const std::string& message) { return {FaultKind::malformed, message}; }

// What the system says to a call: 0, or the number of its error.
std::string error_of(long result) { return std::to_string(result < 0 ? errno : 0); }

Answer touch_the_system(const std::string& what) {
  if (what == "open") return says(error_of(::open("/dev/null", O_RDONLY)));
  if (what == "stat") {
    struct stat status {};
    return says(error_of(::stat("/", &status)));
  }
  if (what == "socket") return says(error_of(::socket(AF_INET, SOCK_STREAM, 0)));
  if (what == "kill") return says(error_of(::kill(::getppid(), 0)));
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

DracoMesh one_triangle(std::uint32_t index, Output& output) {
  DracoMesh mesh;
  mesh.points = 3;
  mesh.faces = 1;
  const std::uint32_t indices[] = {0, 1, index};
  const std::span<std::byte> to = output.create(16);
  if (to.size() == 16) std::memcpy(to.data(), indices, sizeof indices);
  return mesh;
}

volatile std::uint64_t counter = 0;

Answer misbehave(const std::string& what, Output& output) {
  if (what == "crash") std::raise(SIGSEGV);
  if (what == "exit") ::_exit(7);
  if (what == "spin") {
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
    const bool given = output.create(std::uint64_t{1} << 40U).empty();
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
  if (what == "process") return says(std::to_string(::getpid()));
  if (what == "triangle") return one_triangle(2, output);
  return touch_the_system(what);
}

Answer decode(const Job&, std::span<const std::byte> bytes, Output& output) {
  return misbehave({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, output);
}

}  // namespace
}  // namespace gltfx::codec

int main() {
  return gltfx::codec::serve([] {}, gltfx::codec::decode);
}
