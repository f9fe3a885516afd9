// SPDX-License-Identifier: Apache-2.0
/// Numbers with units, from and to text.
#pragma once

#include <string>
#include <string_view>

#include "base/result.hpp"

namespace gltfx::measure {

/// A number such as "5 MiB", "1cm" or "3 %" in the unit of a measure; without a unit it is in that
/// one. The Error is a clause: what is wrong with the text, and which units there are.
Result<double> read_quantity(std::string_view text, std::string_view unit);

/// "20,000", "0.015". At most six digits behind the first one that is not 0.
std::string number_words(double value);
/// The same with its unit: "5,242,880 bytes", "0.015 m".
std::string quantity_words(double value, std::string_view unit);

}  // namespace gltfx::measure
