// SPDX-License-Identifier: Apache-2.0
// Compressed buffer views: decoded data is checked like plain data, and every error of a stream is
// reported at its buffer view.
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "model/meshopt_encoder.hpp"
#include "rules/data_asset.hpp"

namespace gltfx::test {
namespace {

const std::string kExt = "EXT_meshopt_compression";
const std::string kKhr = "KHR_meshopt_compression";
const std::string kMeshoptAt = " /bufferViews/0/extensions/" + kKhr;

// One compressed view, an accessor on it, and the use of the accessor. The placeholder for decoded
// bytes is buffer 1.
struct Packed {
  std::string stream;
  std::size_t count = 1;
  std::size_t stride = 12;
  std::string mode = "ATTRIBUTES";
  std::string filter{};
  std::string accessor = R"("type": "VEC3", "componentType": 5126)";
  std::string members{};  ///< further members of the root
  std::string extension = kKhr;
  std::string view_more{};
  std::string placeholder = R"("extensions": {"KHR_meshopt_compression": {"fallback": true}})";
  std::size_t placeholder_size = 0;  ///< 0: as large as the view

  std::string text() const {
    const std::string size = std::to_string(count * stride);
    const std::string names = "\"" + extension + R"(", "KHR_mesh_quantization")";
    const std::string filter_member = filter.empty() ? "" : R"(, "filter": ")" + filter + "\"";
    const std::string view =
        R"({"buffer": 1, "byteLength": )" + size + view_more + R"(, "extensions": {")" + extension +
        R"(": {"buffer": 0, "byteLength": )" + std::to_string(stream.size()) +
        R"(, "byteStride": )" + std::to_string(stride) + R"(, "count": )" + std::to_string(count) +
        R"(, "mode": ")" + mode + "\"" + filter_member + "}}}";
    const std::string buffers = R"({"byteLength": )" + std::to_string(stream.size()) +
                                R"(, "uri": ")" + buffer_uri(stream) + R"("}, {"byteLength": )" +
                                (placeholder_size == 0 ? size : std::to_string(placeholder_size)) +
                                ", " + placeholder + "}";
    return R"({"asset": {"version": "2.0"}, "extensionsUsed": [)" + names +
           R"(], "extensionsRequired": [)" + names + R"(], "accessors": [{"bufferView": 0, )" +
           accessor + R"(, "count": )" + std::to_string(count) + R"(}], "bufferViews": [)" + view +
           R"(], "buffers": [)" + buffers + "]" + (members.empty() ? "" : ", " + members) + "}";
  }
};

// The findings, except those on unused parts of these small assets.
Lines said(const std::string& asset, Profile profile = Profile::standard) {
  Lines lines = verdict(asset, profile);
  std::erase_if(lines, [](const std::string& line) {
    return line.starts_with("UNUSED") || line.starts_with("NODE_EMPTY") ||
           line.starts_with("EXTENSION_") || line.starts_with("NOTHING_VISIBLE") ||
           line.starts_with("UNNEEDED") || line.starts_with("UNSUPPORTED_EXTENSION ");
  });
  return lines;
}
Lines said(const Packed& packed) { return said(packed.text()); }

template <typename T>
Octets octets(const std::vector<T>& numbers) {
  Octets bytes(numbers.size() * sizeof(T));
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

std::string stream_of(unsigned version, std::size_t stride, const Octets& elements) {
  return text_of(MeshoptEncoder(version, stride).encode(elements));
}

const std::string kBounds = R"(, "min": [1, 2, 3], "max": [4, 5, 6])";
const Octets kPositions = octets<float>({1, 2, 3, 4, 5, 6});

Packed positions(unsigned version = 1) {
  Packed packed{stream_of(version, 12, kPositions), 2};
  packed.accessor += kBounds;
  return packed;
}

TEST(Meshopt, SoundStreamsRaiseNothing) {
  EXPECT_EQ(said(positions(0)), Lines());
  EXPECT_EQ(said(positions(1)), Lines());
  Packed older = positions(0);
  older.extension = kExt;
  older.placeholder = R"("extensions": {"EXT_meshopt_compression": {"fallback": true}})";
  EXPECT_EQ(said(older), Lines());
  older.placeholder = R"("name": "without a mark")";
  EXPECT_EQ(said(older), Lines());
}

TEST(Meshopt, DecodedNumbersAreCheckedAsPlainOnes) {
  Packed packed = positions();
  packed.accessor = R"("type": "VEC3", "componentType": 5126, "min": [1, 2, 3], "max": [4, 5, 5])";
  EXPECT_EQ(said(packed), (Lines{"ACCESSOR_MAX_MISMATCH /accessors/0/max/2",
                                 "ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND /accessors/0/max/2"}));
  packed.stream =
      stream_of(0, 12, octets<float>({1, 2, 3, std::numeric_limits<float>::quiet_NaN(), 5, 6}));
  EXPECT_EQ(said(packed), (Lines{"ACCESSOR_INVALID_FLOAT /accessors/0"}));
}

TEST(Meshopt, TheKhronosProfileDecodesNothing) {
  Packed packed = positions();
  packed.stream[0] = '\0';
  EXPECT_EQ(said(packed.text(), Profile::khronos), Lines());
}

// Invalid streams, each with its message.
struct FilterCase {
  std::string name;
  Packed packed;
  Lines wanted;
};

std::string changed(std::string stream, std::size_t at, unsigned byte) {
  stream[at] = static_cast<char>(byte);
  return stream;
}

Packed with_stream(std::string stream, std::size_t count = 2) {
  Packed packed = positions();
  packed.stream = std::move(stream);
  if (count != 2) packed.accessor = R"("type": "VEC3", "componentType": 5126)";
  packed.count = count;
  return packed;
}

std::vector<FilterCase> attribute_cases() {
  const std::string zero = stream_of(0, 12, kPositions), one = stream_of(1, 12, kPositions);
  const Lines failed{"MESHOPT_DECODE_FAILED" + kMeshoptAt},
      header{"MESHOPT_INVALID_HEADER" + kMeshoptAt};
  std::string noise(300, '\xaa');
  noise[0] = '\xa1';
  return {
      {"one byte short, version 0", with_stream(zero.substr(0, zero.size() - 1)), failed},
      {"one byte short, version 1", with_stream(one.substr(0, one.size() - 1)), failed},
      {"a single byte", with_stream("\xa0"), failed},
      {"a header of triangles", with_stream(changed(zero, 0, 0xe1)), header},
      {"a header of indices", with_stream(changed(zero, 0, 0xd1)), header},
      {"a header of zero", with_stream(changed(zero, 0, 0)), header},
      {"version 2", with_stream(changed(zero, 0, 0xa2)), header},
      {"a byte too many in version 0",
       with_stream(zero.substr(0, zero.size() - 32) + '\0' + zero.substr(zero.size() - 32)),
       {"MESHOPT_TRAILING_BYTES" + kMeshoptAt}},
      {"a byte too many in version 1",
       with_stream(one.substr(0, one.size() - 24) + '\0' + one.substr(one.size() - 24)),
       {"MESHOPT_TRAILING_BYTES" + kMeshoptAt}},
      {"data cut off before the tail",
       with_stream(zero.substr(0, zero.size() - 34) + zero.substr(zero.size() - 32)), failed},
      {"an unknown mode of a channel", with_stream(changed(one, one.size() - 1, 3)), failed},
      {"a rotation without bits", with_stream(changed(one, one.size() - 2, 0x10)), failed},
      {"a block more than there is", with_stream(zero, 600), failed},
      {"a count that needs more bytes", with_stream(zero, 40000000), failed},
      {"noise", with_stream(noise, 256), failed},
  };
}

Packed index_case(const std::string& mode, const std::string& stream, std::size_t count = 3) {
  Packed packed{stream, count, 2, mode};
  packed.accessor = R"("type": "SCALAR", "componentType": 5123)";
  return packed;
}

const std::string kTable("\x00\x76\x87\x56\x67\x78\xa9\x86\x65\x89\x68\x98\x01\x69\x00\x00", 16);

std::vector<FilterCase> index_cases() {
  const Lines failed{"MESHOPT_DECODE_FAILED" + kMeshoptAt},
      header{"MESHOPT_INVALID_HEADER" + kMeshoptAt};
  const Lines trailing{"MESHOPT_TRAILING_BYTES" + kMeshoptAt};
  const auto triangles = [](const std::string& bytes, std::size_t count = 3) {
    return index_case("TRIANGLES", bytes + kTable, count);
  };
  const auto indices = [](const std::string& bytes, std::size_t count = 3) {
    return index_case("INDICES", bytes + std::string(4, '\0'), count);
  };
  const std::string steps("\xd1\x00\x04\x04", 4);
  return {
      {"sound triangles", triangles("\xe1\xf0"), {}},
      {"sound indices", indices(steps), {}},
      {"triangles of version 0", triangles("\xe0\xf0"), header},
      {"triangles as indices", index_case("INDICES", "\xe1\xf0" + kTable), header},
      {"indices as triangles", triangles(steps), header},
      {"indices of version 0", indices(changed(steps, 0, 0xd0)), header},
      {"more triangles than codes", triangles("\xe1\xf0", 12), failed},
      {"an edge from nowhere", triangles(std::string("\xe1\x00", 2)), failed},
      {"a vertex from nowhere", triangles("\xe1\xf1"), failed},
      {"a free triangle without data", triangles("\xe1\xff"), failed},
      {"data that no triangle needs", triangles(std::string("\xe1\xf0\x00", 3)), trailing},
      {"a table with an entry too high",
       index_case("TRIANGLES", "\xe1\xf0" + changed(kTable, 3, 0x0f)), failed},
      {"a table that does not end in zeros",
       index_case("TRIANGLES", "\xe1\xf0" + changed(kTable, 15, 1)), failed},
      {"more indices than bytes", indices(steps, 4), failed},
      {"fewer indices than bytes", indices(steps, 2), trailing},
      {"an index that does not end", indices("\xd1\x80\x80\x80"), failed},
      {"an index of six bytes", indices(std::string("\xd1\xff\xff\xff\xff\xff\x01\x00\x00", 9)),
       failed},
  };
}

Packed filter_case(const std::string& filter, const Octets& element) {
  Packed packed{stream_of(1, element.size(), element), 1, element.size(), "ATTRIBUTES", filter};
  packed.accessor = element.size() == 4
                        ? R"("type": "VEC4", "componentType": 5120, "normalized": true)"
                        : R"("type": "VEC4", "componentType": 5122, "normalized": true)";
  return packed;
}

std::vector<FilterCase> filter_cases() {
  const Lines misfit{"MESHOPT_FILTER_INPUT_INVALID" + kMeshoptAt};
  Packed floats = filter_case("EXPONENTIAL", {1, 0, 0, 0x7f});
  floats.accessor = R"("type": "SCALAR", "componentType": 5126)";
  Packed color = filter_case("COLOR", {1, 0, 0, 1});
  color.accessor = R"("type": "VEC4", "componentType": 5121, "normalized": true)";
  Packed older = color;
  older.extension = kExt;
  older.placeholder = R"("extensions": {"EXT_meshopt_compression": {"fallback": true}})";
  Packed sound = color;
  sound.stream = stream_of(1, 4, {100, 0, 0, 0xff});
  return {
      {"sound colours", sound, {}},
      {"vectors without precision", filter_case("OCTAHEDRAL", {0, 0, 0, 0}), misfit},
      {"vectors of odd precision", filter_case("OCTAHEDRAL", {0, 0, 5, 0}), misfit},
      {"wide vectors without precision", filter_case("OCTAHEDRAL", {0, 0, 0, 0, 0, 0x80, 0, 0}),
       misfit},
      {"rotations without precision", filter_case("QUATERNION", {0, 0, 0, 0, 0, 0, 3, 0}), misfit},
      {"exponents out of range", floats, misfit},
      {"colours without precision", color, misfit},
      {"colours in the older extension",
       older,
       {"VALUE_NOT_IN_LIST /bufferViews/0/extensions/" + kExt + "/filter"}},
  };
}

TEST(Meshopt, ErrorsOfStreamsAreToldAtTheirView) {
  for (const auto& cases : {attribute_cases(), index_cases(), filter_cases()}) {
    for (const FilterCase& each : cases) EXPECT_EQ(said(each.packed), each.wanted) << each.name;
  }
}

TEST(Meshopt, TheOlderExtensionHasNoVersionOne) {
  Packed packed = positions(1);
  packed.extension = kExt;
  packed.placeholder = R"("extensions": {"EXT_meshopt_compression": {"fallback": true}})";
  EXPECT_EQ(said(packed),
            Lines{"MESHOPT_INVALID_HEADER /bufferViews/0/extensions/EXT_meshopt_compression"});
}

TEST(Meshopt, CombinationsThatCannotBeAreNotDecoded) {
  const auto codes = [](Packed packed) {
    std::set<std::string> found;
    for (const std::string& line : said(packed)) found.insert(line.substr(0, line.find(' ')));
    return found;
  };
  Packed packed = positions();
  packed.mode = "TRIANGLES";
  EXPECT_EQ(codes(packed).count("MESHOPT_INVALID_HEADER"), 0U);
  EXPECT_FALSE(codes(packed).empty());
  packed = positions();
  packed.filter = "QUATERNION";
  EXPECT_EQ(codes(packed).count("MESHOPT_FILTER_INPUT_INVALID"), 0U);
  EXPECT_FALSE(codes(packed).empty());
}

TEST(Meshopt, ThePlaceholderHoldsAllThatIsDecoded) {
  Packed packed = positions();
  packed.placeholder_size = 20;
  EXPECT_EQ(said(packed), Lines{"BUFFER_VIEW_TOO_LONG /bufferViews/0/byteLength"});
}

std::string mesh_of(const std::string& attributes) {
  return R"("meshes": [{"primitives": [{"attributes": {)" + attributes + R"(}, "mode": 0}]}])";
}

// Positions without data in addition to the accessor.
Packed packed_with_attribute(Packed packed, const std::string& name) {
  std::string& accessor = packed.accessor;
  accessor += R"(, "count": )" + std::to_string(packed.count) +
              R"(}, {"type": "VEC3", "componentType": 5126, "min": [0, 0, 0], "max": [0, 0, 0])";
  packed.members = mesh_of(R"("POSITION": 1, ")" + name + "\": 0");
  packed.view_more = R"(, "byteStride": )" + std::to_string(packed.stride) + R"(, "target": 34962)";
  return packed;
}

TEST(Meshopt, IndicesBehindTheLastVertexAreFound) {
  Packed packed = index_case("TRIANGLES", "\xe1\xf0" + kTable);
  packed.view_more = R"(, "target": 34963)";
  packed.accessor +=
      R"(, "count": 3}, {"type": "VEC3", "componentType": 5126, "min": [0, 0, 0], "max": [0, 0, 0])";
  packed.members = R"("meshes": [{"primitives": [{"attributes": {"POSITION": 1}, "indices": 0}]}])";
  EXPECT_EQ(said(packed), Lines());
  // Four bytes: vertices 0, 100 and 1.
  packed.stream = std::string("\xe1\xfe\xf0\xc8\x01", 5) + kTable;
  EXPECT_EQ(said(packed), Lines{"ACCESSOR_INDEX_OOB /meshes/0/primitives/0/indices"});
}

TEST(Meshopt, UnitVectorsMayBeRoundedByTheDecoder) {
  Packed packed = filter_case("OCTAHEDRAL", {40, 30, 127, 0});
  packed.accessor = R"("type": "VEC3", "componentType": 5120, "normalized": true)";
  const Packed normals = packed_with_attribute(packed, "NORMAL");
  EXPECT_EQ(about_data(normals.text()), Lines());
}

TEST(Meshopt, UnitVectorsInFewerBitsAreOnlyWarnedOf) {
  // Values of 12 bits in 16 bits that were not scaled up, and then a value that is not a unit
  // vector in any number of bits.
  const auto normals = [](std::int16_t z) {
    Packed packed{stream_of(1, 8, octets<std::int16_t>({0, 0, z, 0})), 1, 8};
    packed.accessor = R"("type": "VEC3", "componentType": 5122, "normalized": true)";
    return packed_with_attribute(packed, "NORMAL").text();
  };
  const auto severity = [](const std::string& text) {
    ValidateOptions options;
    options.select = {"ACCESSOR_VECTOR3_NON_UNIT"};
    const FileReport report = validate_bytes(text, "test", options);
    return report.diagnostics.empty() ? std::string()
                                      : std::string(severity_name(report.diagnostics[0].severity));
  };
  EXPECT_EQ(severity(normals(32767)), "");
  EXPECT_EQ(severity(normals(2047)), "warning");
  EXPECT_EQ(severity(normals(20000)), "error");
}

TEST(Meshopt, BoundsOfFilteredDataMayBeTakenBeforeRounding) {
  const auto bounded = [](const std::string& most) {
    // The mantissa 1000 without an exponent.
    Packed packed = filter_case("EXPONENTIAL", {0xe8, 3, 0, 0});
    packed.accessor = R"("type": "SCALAR", "componentType": 5126, "max": [)" + most + "]";
    return about_data(packed.text());
  };
  EXPECT_EQ(bounded("1000.5"), Lines());
  EXPECT_EQ(bounded("999.5"), Lines());
  EXPECT_EQ(bounded("1002"), Lines{"ACCESSOR_MAX_MISMATCH /accessors/0/max/0"});
}

std::string with_plain_copy(float last, const std::string& filter = {}) {
  const Octets element = filter.empty() ? octets<float>({1, 2, 3}) : Octets{0, 0, 127, 0};
  const Octets copy = filter.empty() ? octets<float>({1, 2, last}) : Octets{0, 0, 126, 0};
  Packed packed{stream_of(1, element.size(), element), 1, element.size(), "ATTRIBUTES", filter};
  packed.accessor = filter.empty()
                        ? R"("type": "VEC3", "componentType": 5126)"
                        : R"("type": "VEC4", "componentType": 5120, "min": [0, 0, 126, 0])";
  packed.placeholder = R"("uri": ")" + buffer_uri(text_of(copy)) + "\"";
  return packed.text();
}

TEST(Meshopt, PlainCopiesAreComparedWhereDecodingIsExact) {
  EXPECT_EQ(said(with_plain_copy(3)), Lines());
  EXPECT_EQ(said(with_plain_copy(4)), Lines{"MESHOPT_FALLBACK_DIFFERS" + kMeshoptAt});
  // The values of a filter may differ slightly; bounds are those of the plain copy.
  EXPECT_EQ(said(with_plain_copy(0, "OCTAHEDRAL")), Lines());
}

// A view of zeros in as few bytes as possible.
Packed zeros(std::size_t blocks) {
  Packed packed{"\xa1" + std::string(blocks, '\xaa') + std::string(24, '\0'), blocks * 256, 4};
  packed.accessor = R"("type": "SCALAR", "componentType": 5126)";
  return packed;
}

TEST(Meshopt, ZerosInFewBytesAreDecodedUpToALimit) {
  EXPECT_EQ(said(zeros(10)), Lines());
  EXPECT_EQ(said(zeros(200000)), Lines{"MESHOPT_NOT_DECODED" + kMeshoptAt});
}

TEST(Meshopt, ViewsThatShareAStreamShareTheLimit) {
  const std::string one = zeros(60000).text();
  const std::string begin = R"("bufferViews": [)";
  const std::size_t from = one.find(begin) + begin.size();
  const std::string view = one.substr(from, one.find("]", from) - from);
  const auto copies = [&](int count) {
    std::string text = one;
    for (int i = 1; i < count; ++i) text.insert(from, view + ", ");
    ValidateOptions options;
    options.select = {"MESHOPT_NOT_DECODED"};
    std::uint64_t said = 0;
    for (const Diagnostic& each : validate_bytes(text, "test", options).diagnostics) {
      said += each.count;
    }
    return said;
  };
  EXPECT_EQ(copies(2), 0U);
  EXPECT_EQ(copies(4), 2U);
}

}  // namespace
}  // namespace gltfx::test
