// SPDX-License-Identifier: Apache-2.0
/// A value or the reason why there is none: how the library reports failure without exceptions.
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace gltfx {

/// Why something could not be done, as a sentence that names the place and the remedy.
struct Error {
  std::string message;
};

/// Holds a T or an Error. Accessing the other one is a programming error.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Result(Error error)
      : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  explicit operator bool() const { return state_.index() == 0; }
  T& operator*() & { return *std::get_if<0>(&state_); }
  const T& operator*() const& { return *std::get_if<0>(&state_); }
  T&& operator*() && { return std::move(*std::get_if<0>(&state_)); }
  T* operator->() { return std::get_if<0>(&state_); }
  const T* operator->() const { return std::get_if<0>(&state_); }
  const Error& error() const { return *std::get_if<1>(&state_); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace gltfx
