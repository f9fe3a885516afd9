// SPDX-License-Identifier: Apache-2.0
/// Behaviour graphs of earlier drafts, whose form differs at every turn: one finding says so.
#pragma once

#include <string_view>
#include <utility>

#include "base/codes.hpp"
#include "base/sink.hpp"
#include "json/document.hpp"

namespace gltfx::validate {

inline constexpr Code kEarlierInteractivity = Code::INTERACTIVITY_EARLIER_DRAFT;

/// What tells that the graphs of an asset follow an earlier draft, as the end of a sentence. Empty:
/// nothing does, or there are none.
std::string_view earlier_interactivity(const json::Document& document);

/// Passes on what is found outside of the graphs of an asset, that they are earlier ones, and that
/// their extension is not declared.
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
