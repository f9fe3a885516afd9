// SPDX-License-Identifier: Apache-2.0
/// The destination of findings. Modules below `rules` use codes, not severities: the
/// implementations of this interface apply the rules and the user's options.
#pragma once

#include <gltfx/diagnostic.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/code.hpp"
#include "base/json_pointer.hpp"
#include "base/span.hpp"

namespace gltfx {

/// One finding of a phase.
struct Finding {
  explicit Finding(Code rule) : code(rule) {}
  Finding(Code rule, std::string text, std::string what_to_do = {}, Span place = {},
          std::optional<Severity> level = {})
      : code(rule),
        message(std::move(text)),
        help(std::move(what_to_do)),
        span(place),
        severity(level) {}

  Code code;
  std::string message;  ///< one sentence; asset text in it is neutralised by the formatters
  std::string help;     ///< what to do in this case; may be empty
  Span span;            ///< bytes of the JSON text to mark; empty: no place in the text
  std::optional<Severity> severity;  ///< instead of the rule's default
  std::uint64_t count = 1;           ///< errors of this kind that the finding counts for
  /// Distinguishes findings of one code at one place, for example by the member that an object
  /// lacks: findings that differ here are not repeats of each other.
  std::string about = {};
  std::shared_ptr<const CheckedLimit> requirement = {};  ///< that is not met; null: of no limit
};

/// Not thread-safe: each thread of a phase fills its own.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Takes a finding about the value at `path`. The path is only used during the call.
  virtual void report(const Path& path, Finding finding) = 0;
  /// Whether findings are used. If not, callers need not format them.
  virtual bool is_enabled() const { return true; }

 protected:
  Sink() = default;
  Sink(const Sink&) = default;
  Sink& operator=(const Sink&) = default;
};

}  // namespace gltfx
