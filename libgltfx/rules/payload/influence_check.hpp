// SPDX-License-Identifier: Apache-2.0
/// Joints and weights of one primitive, all sets of a vertex together (specification section
/// 3.7.3.3).
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "model/accessor_data.hpp"

namespace gltfx::validate {

/// Reads the components of an accessor one after the other as doubles, normalized if declared.
class NumberReader {
 public:
  /// Keeps a reference to the data, and at most `block` elements of it.
  NumberReader(const model::AccessorData& data, bool normalized, std::size_t block);
  bool done() const { return at_ == filled_ && next_element_ == data_->count(); }
  /// Precondition: not done.
  double next();

 private:
  void fill();

  const model::AccessorData* data_;
  bool normalized_;
  std::size_t block_;
  std::uint64_t next_element_ = 0;
  std::uint64_t next_sparse_ = 0;
  std::vector<double> values_;
  std::size_t at_ = 0;
  std::size_t filled_ = 0;
};

enum class InfluenceError : std::uint8_t {
  joint_out_of_range,
  joint_repeated,
  negative_weight,
  joint_without_weight,
  wrong_sum,
};
inline constexpr std::size_t kInfluenceErrors = 5;

struct Influence {
  InfluenceError error = InfluenceError::joint_out_of_range;
  std::uint32_t set = 0;    ///< n of JOINTS_n or WEIGHTS_n
  std::uint64_t index = 0;  ///< of the component, counted over all vertices
  double value = 0;         ///< the joint, the weight or the sum
};

/// The accessors of one set; null if the data cannot be read.
struct InfluenceSet {
  const model::AccessorData* joints = nullptr;
  const model::AccessorData* weights = nullptr;
};

/// Calls `emit` for each error, up to the first joint or weight that cannot be read, in the order
/// of the components and, for one of them, of the sets. `joint_count` is that of the smallest skin,
/// at least 1. `all_weights`: weights of reported joints are included in the sum of the vertex.
void check_influences_of(const std::vector<InfluenceSet>& sets, std::uint64_t joint_count,
                         bool all_weights, const std::function<void(const Influence&)>& emit);

}  // namespace gltfx::validate
