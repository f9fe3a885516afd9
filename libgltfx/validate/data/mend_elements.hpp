// SPDX-License-Identifier: Apache-2.0
/// The elements of an accessor where they lie in a buffer, to be changed in place.
#pragma once

#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

#include "model/accessor.hpp"
#include "validate/fix.hpp"

namespace gltfx::validate {

/// Elements that nobody else reads: plain ones, neither sparse nor compressed, whose bytes lie
/// apart from those of all other accessors.
class Elements {
 public:
  /// `role` as in Users::roles_of(): nothing where the accessor is used for something else, too.
  /// With an empty role any use will do. Nothing where it was changed before.
  static std::optional<Elements> open(Fixing& fixing, std::uint32_t accessor,
                                      std::string_view role);

  std::uint64_t count() const { return count_; }
  const model::Format& format() const { return format_; }
  bool is_float() const { return format_.component == model::ComponentType::float32; }
  unsigned components() const { return components_; }
  double get(std::uint64_t element, unsigned component) const;
  /// Integers are rounded; precondition: they can hold the value.
  void set(std::uint64_t element, unsigned component, double value);
  /// Bytes of one element, packed.
  std::string bytes(std::uint64_t element) const;
  void set_bytes(std::uint64_t element, std::string_view bytes);

 private:
  std::size_t at(std::uint64_t element, unsigned component) const {
    return static_cast<std::size_t>(begin_ + element * stride_ + component * component_size_);
  }

  std::string* content_ = nullptr;
  std::uint64_t begin_ = 0, stride_ = 0, count_ = 0;
  unsigned components_ = 1, component_size_ = 1;
  model::Format format_;
};

/// Claims an accessor whose elements changed, and corrects its declared bounds.
void follow_with_bounds(Fixing& fixing, std::uint32_t accessor, const Elements& elements);

/// How many numbers are looked at in one run: accessors may share their bytes.
class ReadBudget {
 public:
  explicit ReadBudget(Fixing& fixing);
  bool take(std::uint64_t count, unsigned components);

 private:
  std::uint64_t left_ = std::uint64_t{1} << 24U;
};

/// A bound as it stands in the text.
std::string bound_text(model::ComponentType type, double value);
/// Writes those numbers of an array that are not the wanted ones.
void correct_numbers(Fixing& fixing, model::ComponentType type, json::NodeId array,
                     const std::vector<double>& wanted);

}  // namespace gltfx::validate
