// SPDX-License-Identifier: Apache-2.0
/// System calls that fail on request. The executable that links this has them in the place of the C
/// library's, for its own code.
#pragma once

#include <array>

namespace gltfx::test {

enum class Call {
  open,
  openat,
  stat,
  fstat,
  fstatat,
  readlinkat,
  read,
  pread,
  write,
  mmap,
  access,
  fchmod,
  fchown,
  fsync,
  rename,
  renameat2,
  link,
  listxattr,
  getxattr,
  fsetxattr,
  fremovexattr,
};
constexpr std::array kCalls{Call::open,        Call::openat,     Call::stat,     Call::fstat,
                            Call::fstatat,     Call::readlinkat, Call::read,     Call::pread,
                            Call::write,       Call::mmap,       Call::access,   Call::fchmod,
                            Call::fchown,      Call::fsync,      Call::rename,   Call::renameat2,
                            Call::link,        Call::listxattr,  Call::getxattr, Call::fsetxattr,
                            Call::fremovexattr};

/// While it lives, the `number`-th `call` (from 1) of this thread fails with `error`; one at a
/// time.
class FailingCall {
 public:
  FailingCall(Call call, int number, int error);
  ~FailingCall();
  FailingCall(const FailingCall&) = delete;
  FailingCall& operator=(const FailingCall&) = delete;

  /// Ends the failure; returns whether there were so many calls.
  bool stop();
};

/// Runs `action` with each system call and number, until each that it makes has failed once.
/// `action` makes a FailingCall of them and returns the result of its stop().
template <typename Action>
void fail_each_call(Action action) {
  for (const Call call : kCalls) {
    int number = 1;
    while (action(call, number)) ++number;
  }
}

}  // namespace gltfx::test
