// SPDX-License-Identifier: Apache-2.0
/// Temporary files left by a killed process.
#pragma once

#include <string>

#include <sys/wait.h>
#include <unistd.h>

#include "base/temporary_file.hpp"

namespace gltfx {

/// The number of a process that runs no more.
inline pid_t ended_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

/// The name of a temporary file of that process.
inline std::string left_by(pid_t process, const std::string& target, int number) {
  const std::string own = std::to_string(::getpid());
  std::string name = temporary_name(target, number);
  return name.replace(name.rfind('-' + own + '-') + 1, own.size(), std::to_string(process));
}

}  // namespace gltfx
