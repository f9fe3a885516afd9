// SPDX-License-Identifier: Apache-2.0
/// Behavior graphs of earlier drafts, which differ in most details: they get one finding.
#pragma once

#include <string_view>
#include <utility>

#include "base/codes.hpp"
#include "base/sink.hpp"
#include "json/document.hpp"

namespace gltfx::validate {

inline constexpr Code kEarlierInteractivity = Code::INTERACTIVITY_EARLIER_DRAFT;

/// The evidence that the graphs of an asset follow an earlier draft, as the end of a sentence.
/// Empty: there is none, or there are no graphs.
std::string_view earlier_interactivity(const json::Document& document);

/// Passes on findings outside the graphs of an asset, the finding on the earlier draft, and a
/// missing declaration of the extension.
class OutsideInteractivity final : public Sink {
 public:
  explicit OutsideInteractivity(Sink& next) : next_(next) {}
  void report(const Path& path, Finding finding) override {
    const bool reported = finding.code == kEarlierInteractivity || finding.code == kUndeclared;
    if (reported || !is_inside(path)) {
      next_.report(path, std::move(finding));
    }
  }

 private:
  static constexpr Code kUndeclared = Code::UNDECLARED_EXTENSION;
  static bool is_inside(const Path& path);
  Sink& next_;
};

}  // namespace gltfx::validate
