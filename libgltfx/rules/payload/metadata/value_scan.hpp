// SPDX-License-Identifier: Apache-2.0
/// One pass over stored values of a property of metadata: finite, of the enum, smallest and
/// greatest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "model/metadata.hpp"
#include "rules/payload/metadata/instance.hpp"

namespace gltfx::validate {

/// Limits of values: of the class, and of the object that stores the values. One number per
/// component; empty: none. offset and scale as they apply.
struct ValueLimits {
  std::vector<double> class_min, class_max, min, max, offset, scale;
  std::vector<double> no_data;

  bool any() const {
    return !class_min.empty() || !class_max.empty() || !min.empty() || !max.empty();
  }
};

/// The limits of a property and of `stored`, an object of the asset with members of the same names.
ValueLimits value_limits(const MetadataPhase& phase, const PropertyUse& use);

/// The results for stored values.
struct ValueFindings {
  struct Tally {
    std::uint64_t count = 0;
    std::uint64_t row = 0;  ///< row of the first one
    std::string value;      ///< value of the first one
  };
  Tally infinite, unlisted;
  /// One per component, as stored; empty if not requested or all rows are noData.
  std::vector<double> least, most;
};

/// Reads rows of packed components, in any number of calls. Not thread-safe.
class ValueScan {
 public:
  virtual ~ValueScan() = default;
  ValueScan(const ValueScan&) = delete;
  ValueScan& operator=(const ValueScan&) = delete;

  /// Adds `rows` rows at `bytes`, with any alignment.
  virtual void add(std::span<const std::byte> bytes, std::uint64_t rows) = 0;
  virtual ValueFindings finish() const = 0;

 protected:
  ValueScan() = default;
};

/// Null if no value can be invalid, so that nothing needs to be read. `property` is numeric or an
/// ENUM of a known component; a row has `width` components, at most kMostWidth if there are limits.
/// Both must outlive the scan.
std::unique_ptr<ValueScan> make_value_scan(const model::MetadataProperty& property,
                                           const ValueLimits& limits, std::uint64_t width);
inline constexpr std::uint64_t kMostWidth = 65536;

/// A finding on data, with the member of the object that it is about; empty: the object itself.
struct StoredFinding {
  std::string_view member;
  Finding finding;
};

/// The messages for the results of a scan. `what` is the name of a row: "row", "texel", "vertex".
std::vector<StoredFinding> describe_values(const model::MetadataProperty& property,
                                           const ValueLimits& limits, const ValueFindings& found,
                                           std::string_view what);

/// Reports findings on the object `node` of the asset at `path`.
void report_stored(MetadataPhase& phase, const Path& path, json::NodeId node,
                   std::vector<StoredFinding> findings);

/// Reports a value in JSON that is outside min or max of its class, and not noData.
void check_json_bounds(MetadataPhase& phase, const PropertyUse& use);

}  // namespace gltfx::validate
