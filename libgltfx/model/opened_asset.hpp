// SPDX-License-Identifier: Apache-2.0
/// One asset, opened once: the input of all verbs.
#pragma once

#include <memory>
#include <string>

#include "container/container.hpp"
#include "container/resolver.hpp"
#include "json/parse.hpp"
#include "model/views.hpp"

namespace gltfx::model {

/// A container, its resources, and what is derived from its text: each made once, at first use.
/// References that it returns stay valid when it is moved. Calls that make something are not
/// thread-safe.
class OpenedAsset {
 public:
  /// `name` is the path as the user gave it.
  OpenedAsset(std::string name, container::Container container, container::Resolver resolver);
  /// `parsed` is the container's text.
  OpenedAsset(std::string name, container::Container container, container::Resolver resolver,
              json::Parsed parsed);

  const std::string& name() const { return name_; }
  const container::Container& container() const { return container_; }
  const container::Resolver& resolver() const { return resolver_; }
  /// From now on look-ups of the resolver are recorded.
  void record(std::shared_ptr<container::LookupLog> log) { resolver_.record(std::move(log)); }
  /// The log so far; from now on look-ups are recorded there.
  std::shared_ptr<const container::LookupLog> recorded() {
    if (!resolver_.log()) record(std::make_shared<container::LookupLog>());
    return resolver_.log();
  }

  /// Without a text: no document.
  const json::Parsed& parsed() const;
  const json::Document& document() const { return parsed().document; }
  /// Tables of the document, which a validation may have made already.
  const Views& views() const;
  void keep_views(Views views) { views_ = std::make_unique<const Views>(std::move(views)); }
  /// Frees the memory of views().
  void forget_views() { views_.reset(); }
  /// Whether the document takes so much memory that it should be parsed again rather than kept
  /// beside another one.
  bool is_large() const { return container_.json && container_.json->size() >= 4 << 20; }
  /// Also frees the memory of a large document, which is parsed again on demand.
  void forget_large_document() {
    if (!is_large()) return;
    forget_views();
    parsed_.reset();
  }

 private:
  std::string name_;
  container::Container container_;
  container::Resolver resolver_;
  mutable std::unique_ptr<const json::Parsed> parsed_;  ///< null until first used
  mutable std::unique_ptr<const Views> views_;          ///< likewise
};

}  // namespace gltfx::model
