// SPDX-License-Identifier: Apache-2.0
/// Whether a change of an asset makes it worse.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rules/validated_asset.hpp"
#include "schema/set.hpp"

namespace gltfx {

/// What an asset has that it had not, or not as often, by codes.
struct NewFindings {
  std::string_view error;             ///< the code of an error; empty: there is none
  std::vector<std::string> warnings;  ///< one a code: "CODE at /pointer: message"
};

/// What `after` has that `before` has not, as default options judge. Where `before` was validated
/// with other options that is done anew, and not at all where nothing is wrong with `after`.
/// `schemas` are those that both were validated with.
NewFindings new_findings(const validate::ValidatedAsset& before,
                         const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas);

/// The same of an asset that was not validated: that is done where something is wrong with `after`.
NewFindings new_findings(const model::OpenedAsset& before, const validate::ValidatedAsset& after,
                         const std::shared_ptr<const schema::Set>& schemas);

/// Default options for one of many files.
ValidateOptions default_validation(const std::shared_ptr<const schema::Set>& schemas);

}  // namespace gltfx
