// SPDX-License-Identifier: Apache-2.0
/// Arrays whose copies share their elements until one of them is written to.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace gltfx {

/// Reading costs what it costs with a vector. Access to an array that is not const is writing: it
/// copies shared elements first.
template <class T>
class SharedArray {
 public:
  using value_type = T;
  using const_iterator = const T*;
  using iterator = T*;

  SharedArray() = default;
  SharedArray(std::vector<T> values)  // as a vector is given to what keeps it
      : values_(values.empty() ? nullptr : std::make_shared<std::vector<T>>(std::move(values))) {
    find();
  }
  SharedArray(std::initializer_list<T> values) : SharedArray(std::vector<T>(values)) {}
  SharedArray(const SharedArray&) = default;
  SharedArray& operator=(const SharedArray&) = default;
  SharedArray(SharedArray&& other) noexcept
      : values_(std::move(other.values_)),
        data_(std::exchange(other.data_, nullptr)),
        size_(std::exchange(other.size_, 0)) {}
  SharedArray& operator=(SharedArray&& other) noexcept {
    values_ = std::move(other.values_);
    data_ = std::exchange(other.data_, nullptr);
    size_ = std::exchange(other.size_, 0);
    return *this;
  }
  ~SharedArray() = default;

  const T* data() const { return data_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  const T& front() const { return data_[0]; }
  const T& back() const { return data_[size_ - 1]; }
  /// Whether a copy has the same elements in memory.
  bool shared() const { return values_.use_count() > 1; }
  friend bool operator==(const SharedArray& a, const SharedArray& b) {
    return a.data_ == b.data_ ? a.size_ == b.size_
                              : std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

  T* data() { return own().data(); }
  T* begin() { return own().data(); }
  T* end() { return own().data() + size_; }
  T& operator[](std::size_t i) { return own()[i]; }
  T& back() { return own().back(); }
  void clear() { *this = SharedArray(); }
  void resize(std::size_t count, const T& value = {}) {
    own().resize(count, value);
    find();
  }
  void push_back(T value) {
    own().push_back(std::move(value));
    find();
  }
  void pop_back() {
    own().pop_back();
    find();
  }
  T& emplace_back() {
    push_back({});
    return own().back();
  }

 private:
  std::vector<T>& own() {
    if (!values_) {
      values_ = std::make_shared<std::vector<T>>();
    } else if (values_.use_count() > 1) {
      values_ = std::make_shared<std::vector<T>>(*values_);
    }
    find();
    return *values_;
  }
  void find() {
    data_ = values_ ? values_->data() : nullptr;
    size_ = values_ ? values_->size() : 0;
  }

  std::shared_ptr<std::vector<T>> values_;
  const T* data_ = nullptr;  // of the elements
  std::size_t size_ = 0;
};

}  // namespace gltfx
