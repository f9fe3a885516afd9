// SPDX-License-Identifier: Apache-2.0
/// The bytes of an asset with another JSON text, among them a GLB with another JSON chunk and more
/// in its BIN chunk (glTF 2.0 section 4.4).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "base/shared_text.hpp"
#include "container/container.hpp"

namespace gltfx::edit {

/// Bytes [begin, end).
struct ByteRange {
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

/// Bytes in the place of as many others.
struct BytePatch {
  std::uint64_t offset = 0;
  std::string bytes;
};

/// What becomes of the BIN chunk.
struct BinChange {
  std::string more;            ///< behind its data; a chunk is made when there is none
  std::vector<ByteRange> cut;  ///< of its data, in order, none overlaps; taken out
  bool drop = false;           ///< the whole chunk goes; nothing else is to be done with it
  /// Of its data, in order; none overlaps another or a cut.
  std::vector<BytePatch> patches = {};
  bool empty() const { return more.empty() && cut.empty() && patches.empty() && !drop; }
};

/// What error of a GLB leaves open where its chunks lie, or nothing: the file can be rewritten,
/// also when its lengths are wrong. A sentence.
std::optional<std::string> find_glb_obstacle(const container::Container& container);

/// The file with `json` in place of its JSON and a changed BIN chunk: header and lengths follow,
/// all else stays byte for byte, as does what may follow the last chunk uncounted. An Error when
/// the new file would be too long for its header. Precondition: a GLB without obstacle. The pieces,
/// in order, are the file; what stays is shown where it is, not copied.
Result<std::vector<container::Bytes>> rewrite_glb(const container::Container& container,
                                                  std::string_view json, const BinChange& bin = {});

/// As rewrite_glb(), but nothing of the container stays that it must not have: each chunk has a
/// length that is a multiple of 4, and zeros behind the last chunk go.
Result<std::vector<container::Bytes>> rewrite_sound(const container::Container& container,
                                                    std::string_view json,
                                                    const BinChange& bin = {});

/// The bytes of the container with another JSON text and a changed BIN chunk, as pieces one
/// behind the other; what stays is shown where it is, not copied. An Error when a GLB would be too
/// long. Precondition: `json` is not null, a GLB has no obstacle (find_glb_obstacle()), and `bin`
/// is empty for a text file.
Result<std::vector<container::Bytes>> rewrite(const container::Container& container,
                                              const SharedText& json, const BinChange& bin = {});

/// The container that these bytes make, under the name `path`. Where the BIN chunk stays nothing
/// but the text is made anew: `bytes` and the errors are the old ones.
Result<container::Container> rewritten(const container::Container& container,
                                       const SharedText& json, const BinChange& bin,
                                       const std::string& path);

/// Whether two JSON texts are the same but for blanks behind them, as a GLB has them.
bool same_but_for_padding(std::string_view one, std::string_view other);

}  // namespace gltfx::edit
