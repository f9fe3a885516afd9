// SPDX-License-Identifier: Apache-2.0
// Accessors of every form over any bytes, through the whole of validation: it answers, in one
// profile as in the other, and says the same whatever the threads.
#include <gltfx/pipeline.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace {

void require(bool promise) {
  if (!promise) std::abort();
}

// Takes numbers from the front of the input; zeros when there is no more.
class Source {
 public:
  explicit Source(std::string_view bytes) : bytes_(bytes) {}

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const auto first = static_cast<std::uint8_t>(bytes_.front());
    bytes_.remove_prefix(1);
    return first;
  }
  // Small ones, and those at which arithmetic turns over.
  std::string number() {
    static constexpr std::string_view kOdd[] = {"-1",         "2147483647", "2147483648",
                                                "4294967295", "4294967296", "9007199254740991",
                                                "0.5",        "1e300",      "18446744073709551615"};
    const std::uint8_t pick = byte();
    const std::size_t odd = pick - 240U;
    return pick < 240 ? std::to_string(pick) : std::string(kOdd[odd % std::size(kOdd)]);
  }
  template <std::size_t N>
  std::string_view one_of(const std::string_view (&words)[N]) {
    return words[byte() % N];
  }
  std::string_view rest() const { return bytes_; }

 private:
  std::string_view bytes_;
};

constexpr std::string_view kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
constexpr std::string_view kComponents[] = {"5120", "5121", "5122", "5123", "5125", "5126"};
constexpr std::string_view kSemantics[] = {"POSITION", "NORMAL",   "TANGENT",  "TEXCOORD_0",
                                           "COLOR_0",  "JOINTS_0", "WEIGHTS_0"};

std::string accessor(Source& source) {
  std::string text =
      fmt::format(R"({{"bufferView": {}, "componentType": {}, "type": "{}", )", source.byte() % 3,
                  source.one_of(kComponents), source.one_of(kTypes));
  text += fmt::format(R"("byteOffset": {}, "count": {}, "normalized": {})", source.number(),
                      source.number(), source.byte() % 2 == 0);
  if (source.byte() % 2 == 0) {
    text += fmt::format(R"(, "min": [{0}, {0}, {0}], "max": [{1}, {1}, {1}])", source.number(),
                        source.number());
  }
  if (source.byte() % 4 == 0) {
    text += fmt::format(
        R"(, "sparse": {{"count": {}, "indices": {{"bufferView": {}, "componentType": {}, )",
        source.number(), source.byte() % 3, source.one_of(kComponents));
    text += fmt::format(R"("byteOffset": {}}}, "values": {{"bufferView": {}, "byteOffset": {}}}}})",
                        source.number(), source.byte() % 3, source.number());
  }
  return text + "}";
}

std::string document(Source& source) {
  std::string text = R"({"asset": {"version": "2.0"}, "accessors": [)";
  text += accessor(source) + "," + accessor(source) + "," + accessor(source);
  text += R"(], "bufferViews": [)";
  for (int i = 0; i < 3; ++i) {
    text += fmt::format(R"({}{{"buffer": 0, "byteOffset": {}, "byteLength": {})", i > 0 ? ", " : "",
                        source.number(), source.number());
    if (source.byte() % 2 == 0) text += fmt::format(R"(, "byteStride": {})", source.number());
    text += "}";
  }
  text += fmt::format(R"(], "meshes": [{{"primitives": [{{"mode": {}, "indices": 2, "attributes": )"
                      R"({{"{}": 0, "{}": 1}}}}]}}], )",
                      source.byte() % 8, source.one_of(kSemantics), source.one_of(kSemantics));
  text += R"("nodes": [{"mesh": 0, "skin": 0}, {}], "scenes": [{"nodes": [0, 1]}],
    "skins": [{"joints": [1], "inverseBindMatrices": 0}], "animations": [{"samplers":
    [{"input": 0, "output": 1}], "channels": [{"sampler": 0, "target": {"node": 1,
    "path": "rotation"}}]}], )";
  return text + fmt::format(R"("buffers": [{{"byteLength": {}}}]}})", source.rest().size());
}

void append_number(std::string& bytes, std::size_t number) {
  for (unsigned shift = 0; shift < 32; shift += 8) {
    bytes += static_cast<char>(number >> shift & 0xFFU);
  }
}

std::string as_glb(std::string text, std::string data) {
  text.resize((text.size() + 3) / 4 * 4, ' ');
  data.resize((data.size() + 3) / 4 * 4, '\0');
  std::string bytes = "glTF";
  append_number(bytes, 2);
  append_number(bytes, 28 + text.size() + data.size());
  append_number(bytes, text.size());
  bytes += "JSON" + text;
  append_number(bytes, data.size());
  return bytes.append("BIN\0", 4) + data;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Source source({reinterpret_cast<const char*>(data), size});
  std::string text = document(source);
  const std::string glb = as_glb(std::move(text), std::string(source.rest()));
  gltfx::ValidateOptions options;
  const gltfx::FileReport first = gltfx::validate_bytes(glb, "fuzz.glb", options);
  require(first.readable);
  options.jobs = 1;
  require(gltfx::validate_bytes(glb, "fuzz.glb", options).counts.errors == first.counts.errors);
  options.profile = gltfx::Profile::khronos;
  options.max_issues = 1000;
  require(gltfx::validate_bytes(glb, "fuzz.glb", options).diagnostics.size() <= 1000);
  return 0;
}
