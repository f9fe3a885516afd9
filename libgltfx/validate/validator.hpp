// SPDX-License-Identifier: Apache-2.0
/// The phases of validation in their order, over one opened container.
#pragma once

#include <gltfx/report.hpp>
#include <gltfx/validate.hpp>

#include <string>

#include "container/container.hpp"
#include "container/resolver.hpp"

namespace gltfx::validate {

/// Runs every phase that can run; each collects and none stops the next, unless what it would look
/// at does not exist. `name` is the path as the user gave it: it stands in the report, and its
/// ending says which container was promised.
FileReport validate(const container::Container& container, const std::string& name,
                    const container::Resolver& resolver, const ValidateOptions& options);

/// The report on a file that could not be opened.
FileReport unreadable(const std::string& name, const std::string& reason,
                      const ValidateOptions& options);

}  // namespace gltfx::validate
