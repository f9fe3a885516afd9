// SPDX-License-Identifier: Apache-2.0
/// Elements that a change appends to the root arrays of a document. Indices are known at once,
/// bytes and their places only after placement (`change/place.hpp`).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "json/document.hpp"

namespace gltfx::change {

/// Does not keep a reference to the document.
class Additions {
 public:
  struct Image {
    std::shared_ptr<const std::string> png;  ///< the file; may be set until placement
    /// URI of a file that gives the folder and the name of a new file; empty: there is none.
    std::string beside = {};
    /// Index of the image that it replaces; none: a new image.
    std::optional<std::uint64_t> place = std::nullopt;
  };
  struct Accessor {
    std::string members;  ///< JSON object with all members but `bufferView` and `byteOffset`
    std::string bytes;    ///< of its elements, packed
  };

  Additions() = default;
  explicit Additions(const json::Document& document);

  /// Give the index in the root array of that name. The bytes of an accessor get a separate buffer
  /// view; `array` is not one to which add_image() or add_accessor() adds.
  std::uint64_t add_image(Image image);
  std::uint64_t add_accessor(Accessor accessor);
  std::uint64_t add_element(const std::string& array, std::string json);

  bool empty() const { return images_.empty() && accessors_.empty() && elements_.empty(); }
  std::vector<Image>& images() { return images_; }
  const std::vector<Image>& images() const { return images_; }
  const std::vector<Accessor>& accessors() const { return accessors_; }
  const std::map<std::string, std::vector<std::string>>& elements() const { return elements_; }
  /// Number of elements that a root array had before.
  std::uint64_t old_count(const std::string& array) const;

 private:
  std::map<std::string, std::uint64_t> counts_;
  std::vector<Image> images_;
  std::vector<Accessor> accessors_;
  std::map<std::string, std::vector<std::string>> elements_;  ///< by array
};

}  // namespace gltfx::change
