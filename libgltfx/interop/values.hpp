// SPDX-License-Identifier: Apache-2.0
/// Extras and extensions: JSON values that nobody but their author knows, as tinygltf has them.
/// For files that include <tiny_gltf.h>.
#pragma once

#include "interop/notes.hpp"
#include "json/document.hpp"
#include "json/writer.hpp"

namespace tinygltf {
class Value;
}

namespace gltfx::interop {

/// Integers of 32 bits become integers, other numbers doubles. What is nested deeper than any sane
/// asset, which would exhaust the stack of those who copy such values, becomes a null and a note.
tinygltf::Value read_value(const json::Document& document, json::NodeId id, const Path& path,
                           Notes& notes);

/// Writes one value. Binary values, which JSON has no form for, become nulls and a note.
void write_value(json::Writer& writer, const tinygltf::Value& value, const Path& path,
                 Notes& notes);

}  // namespace gltfx::interop
