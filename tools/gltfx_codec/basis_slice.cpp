// SPDX-License-Identifier: Apache-2.0
#include "basis_slice.hpp"

#include <utility>

namespace gltfx::codec {
namespace {

// The source of an endpoint.
enum Prediction : std::uint32_t { from_left = 0, from_above = 1, from_above_left = 2 };
constexpr std::uint32_t kPredictionMask = 3;

constexpr std::uint32_t kRepeatPredictions = 256;
constexpr std::uint64_t kLeastPredictionRepeats = 3;
constexpr std::uint32_t kLongSelectorRun = 63;
constexpr std::uint64_t kLeastSelectorRun = 3;

// A number in chunks of `chunk` bits, each followed by one bit that states whether another chunk
// follows ("ETC1S VLC Decoding Procedure").
std::uint64_t take_chunks(BitReader& bits, unsigned chunk) {
  std::uint64_t value = 0;
  for (unsigned at = 0; at < 32; at += chunk) {
    value |= std::uint64_t{bits.take(chunk)} << at;
    if (bits.take(1) == 0) return value;
  }
  bits.fail();
  return 0;
}

}  // namespace

void SelectorHistory::add(std::uint16_t selector) {
  values_[next_++] = selector;
  if (next_ == values_.size()) next_ = values_.size() / 2;
}

std::uint16_t SelectorHistory::use(std::size_t index) {
  const std::uint16_t selector = values_[index];
  std::swap(values_[index / 2], values_[index]);
  return selector;
}

Etc1sSlice::Etc1sSlice(const Etc1sSliceCodes& codes, const Etc1sCodebooks& codebooks,
                       std::span<const std::byte> bytes, std::size_t blocks_across)
    : codes_(codes),
      codebooks_(codebooks),
      bits_(bytes),
      for_odd_rows_((blocks_across + 1) / 2),
      history_(codes.history_size) {}

bool Etc1sSlice::next_row(std::span<Etc1sBlock> row) {
  std::uint32_t predictions = 0;
  for (std::size_t x = 0; x < row.size() && bits_.ok(); ++x) {
    if (x % 2 == 0 && odd_row_) {
      predictions = for_odd_rows_[x / 2];
    } else if (x % 2 == 0) {
      predictions = next_predictions();
      for_odd_rows_[x / 2] = static_cast<std::uint8_t>(predictions >> 4U);
    }
    read_block(x, predictions & kPredictionMask, row);
    predictions >>= 2U;
  }
  above_.assign(row.begin(), row.end());
  odd_row_ = !odd_row_;
  return bits_.ok();
}

// Predictions of blocks in a 2 by 2 square, two bits each.
std::uint32_t Etc1sSlice::next_predictions() {
  if (prediction_repeats_ > 0) {
    --prediction_repeats_;
    return predictions_;
  }
  const std::uint32_t symbol = codes_.endpoint_prediction.decode(bits_);
  if (symbol == kRepeatPredictions) {
    prediction_repeats_ = take_chunks(bits_, 4) + kLeastPredictionRepeats - 1;
  } else if (symbol < kRepeatPredictions) {
    predictions_ = symbol;
  } else {
    bits_.fail();
  }
  return predictions_;
}

void Etc1sSlice::read_block(std::size_t x, std::uint32_t prediction, std::span<Etc1sBlock> row) {
  const std::uint16_t endpoint = read_endpoint(x, prediction, endpoint_before_);
  endpoint_before_ = endpoint;
  row[x] = {endpoint, read_selector()};
  if (endpoint >= codebooks_.endpoints.size() || row[x].selector >= codebooks_.selectors.size()) {
    bits_.fail();
  }
}

std::uint16_t Etc1sSlice::read_endpoint(std::size_t x, std::uint32_t prediction,
                                        std::uint16_t left) {
  const bool outside = (prediction == from_left && x == 0) ||
                       (prediction == from_above && above_.empty()) ||
                       (prediction == from_above_left && (above_.empty() || x == 0));
  if (outside) {
    bits_.fail();
    return 0;
  }
  switch (prediction) {
    case from_left:
      return left;
    case from_above:
      return above_[x].endpoint;
    case from_above_left:
      return above_[x - 1].endpoint;
    default:
      break;
  }
  const std::size_t count = codebooks_.endpoints.size();
  const std::size_t index = left + codes_.endpoint_delta.decode(bits_);
  return static_cast<std::uint16_t>(index < count ? index : index - count);
}

// Symbols are entries of the codebook, then entries of the history, then a run of the first entry
// of the history.
std::uint16_t Etc1sSlice::read_selector() {
  if (selector_repeats_ > 0) {
    --selector_repeats_;
    return from_history(0);
  }
  const std::size_t count = codebooks_.selectors.size();
  const std::size_t symbol = codes_.selector.decode(bits_);
  if (symbol < count) {
    const auto selector = static_cast<std::uint16_t>(symbol);
    if (history_.size() > 0) history_.add(selector);
    return selector;
  }
  if (symbol != count + history_.size()) return from_history(symbol - count);
  const std::uint32_t run = codes_.selector_run.decode(bits_);
  const std::uint64_t more = run == kLongSelectorRun ? take_chunks(bits_, 7) : run;
  selector_repeats_ = more + kLeastSelectorRun - 1;
  return from_history(0);
}

std::uint16_t Etc1sSlice::from_history(std::size_t index) {
  if (index < history_.size()) return history_.use(index);
  bits_.fail();
  return 0;
}

}  // namespace gltfx::codec
