// SPDX-License-Identifier: Apache-2.0
#include "rules/payload/influence_check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <type_traits>
#include <utility>

namespace gltfx::validate {
namespace {

// The error of one rounding to single precision (specification section 3.7.3.3).
constexpr double kSumTolerance = 2e-7;

constexpr std::size_t kMostElements = 48;  // held by one reader
constexpr std::size_t kMostComponents = 16;
constexpr std::size_t kElementsOfAll = 16384;  // held by the readers of all sets

// The influences on one vertex: its joints so far, and the sum of the weights.
class Vertex {
 public:
  explicit Vertex(std::uint64_t joint_count) : seen_(joint_count, 0) {}

  void begin() {
    ++stamp_;
    sum_ = 0;
    summed_ = 0;
  }
  // False if the vertex already has that joint.
  bool add_joint(std::uint64_t joint) {
    if (seen_[joint] == stamp_) return false;
    seen_[joint] = stamp_;
    return true;
  }
  void add_weight(double weight) {
    sum_ = static_cast<double>(static_cast<float>(sum_ + weight));
    ++summed_;
  }
  double sum() const { return sum_; }
  bool is_normalized() const {
    return std::abs(sum_ - 1.0) <= kSumTolerance * static_cast<double>(summed_);
  }

 private:
  std::vector<std::uint64_t> seen_;  // by joint, the last vertex with it
  std::uint64_t stamp_ = 0;
  std::uint64_t summed_ = 0;
  double sum_ = 0;
};

class InfluenceCheck {
 public:
  InfluenceCheck(const std::vector<InfluenceSet>& sets, std::uint64_t joint_count, bool all_weights,
                 const std::function<void(const Influence&)>& emit)
      : joint_count_(joint_count), all_weights_(all_weights), emit_(emit), vertex_(joint_count) {
    const std::size_t block = std::clamp<std::size_t>(
        kElementsOfAll / std::max<std::size_t>(sets.size(), 1), 1, kMostElements);
    for (const InfluenceSet& set : sets) {
      joints_.push_back(reader(set.joints, false, block));
      weights_.push_back(reader(set.weights, true, block));
    }
  }

  void run() {
    vertex_.begin();
    for (std::uint64_t index = 0;; ++index) {
      for (std::uint32_t set = 0; set < joints_.size(); ++set) {
        if (!check(index, set)) return;
      }
      if (index % 4 == 3) finish_vertex(index);
    }
  }

 private:
  using Reader = std::optional<NumberReader>;

  static Reader reader(const model::AccessorData* data, bool normalized, std::size_t block) {
    return data != nullptr ? Reader(std::in_place, *data, normalized, block) : std::nullopt;
  }
  static bool has_more(const Reader& reader) { return reader && !reader->done(); }

  // False if there is nothing left to read.
  bool check(std::uint64_t index, std::uint32_t set) {
    if (!has_more(joints_[set])) return false;
    const double joint = joints_[set]->next();
    const bool weighted = has_more(weights_[set]);
    const double weight = weighted ? weights_[set]->next() : 0;
    if (all_weights_ && weight > 0) vertex_.add_weight(weight);
    if (joint >= static_cast<double>(joint_count_) || joint < 0) {
      emit_({InfluenceError::joint_out_of_range, set, index, joint});
      return true;
    }
    if (weighted && weight != 0) {
      add(index, set, joint, weight);
    } else if (weighted && joint != 0) {
      emit_({InfluenceError::joint_without_weight, set, index, joint});
    }
    return weighted;
  }

  void add(std::uint64_t index, std::uint32_t set, double joint, double weight) {
    const bool fresh = vertex_.add_joint(static_cast<std::uint64_t>(joint));
    if (!fresh) emit_({InfluenceError::joint_repeated, set, index, joint});
    if (weight < 0) {
      checked_ = checked_ && !all_weights_;  // its own error makes the sum wrong
      emit_({InfluenceError::negative_weight, set, index, weight});
    } else if (fresh && !all_weights_) {
      vertex_.add_weight(weight);
    }
  }

  void finish_vertex(std::uint64_t index) {
    if (checked_ && !vertex_.is_normalized()) {
      for (std::uint32_t set = 0; set < weights_.size(); ++set) {
        emit_({InfluenceError::wrong_sum, set, index, vertex_.sum()});
      }
    }
    vertex_.begin();
    checked_ = true;
  }

  std::uint64_t joint_count_;
  bool all_weights_;
  bool checked_ = true;  ///< whether the sum of this vertex's weights is checked
  const std::function<void(const Influence&)>& emit_;
  std::vector<Reader> joints_, weights_;
  Vertex vertex_;
};

}  // namespace

NumberReader::NumberReader(const model::AccessorData& data, bool normalized, std::size_t block)
    : data_(&data),
      normalized_(normalized && data.format().normalized),
      block_(std::min(block, kMostElements)) {}

double NumberReader::next() {
  if (at_ == filled_) fill();
  return values_[at_++];
}

void NumberReader::fill() {
  const auto elements =
      static_cast<std::size_t>(std::min<std::uint64_t>(block_, data_->count() - next_element_));
  filled_ = elements * data_->components();
  at_ = 0;
  values_.resize(filled_);
  model::with_component_type(data_->format().component, [&](auto zero) {
    using T = decltype(zero);
    std::array<T, kMostElements * kMostComponents> raw;  // filled as far as data is read
    data_->read(reinterpret_cast<std::byte*>(raw.data()), next_element_, elements, next_sparse_);
    for (std::size_t i = 0; i < filled_; ++i) {
      values_[i] = static_cast<double>(raw[i]);
      if constexpr (std::is_integral_v<T>) {
        if (normalized_) values_[i] = model::normalize(raw[i]);
      }
    }
  });
  next_element_ += elements;
}

void check_influences_of(const std::vector<InfluenceSet>& sets, std::uint64_t joint_count,
                         bool all_weights, const std::function<void(const Influence&)>& emit) {
  InfluenceCheck(sets, joint_count, all_weights, emit).run();
}

}  // namespace gltfx::validate
