// SPDX-License-Identifier: Apache-2.0
/// Extras and extensions: arbitrary JSON values in the form of tinygltf. For files that include
/// <tiny_gltf.h>.
#pragma once

#include "interop/notes.hpp"
#include "json/document.hpp"
#include "json/writer.hpp"

namespace tinygltf {
class Value;
}

namespace gltfx::interop {

/// Integers of 32 bits become integers, other numbers doubles. Values nested too deeply, whose
/// copies would exhaust the stack, become a null and a note.
tinygltf::Value read_value(const json::Document& document, json::NodeId id, const Path& path,
                           Notes& notes);

/// Writes one value. Binary values, which JSON cannot represent, become nulls and a note.
void write_value(json::Writer& writer, const tinygltf::Value& value, const Path& path,
                 Notes& notes);

}  // namespace gltfx::interop
