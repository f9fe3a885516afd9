// SPDX-License-Identifier: Apache-2.0
#include "output_places.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include <fmt/format.h>

#include "base/text.hpp"
#include "output.hpp"
#include "pipeline/picture_names.hpp"

namespace gltfx::tool {
namespace {

namespace fs = std::filesystem;

fs::path real_path(fs::path path) {
  while (!path.has_filename() && path.has_relative_path()) path = path.parent_path();  // "out/"
  std::error_code error;
  fs::path real = fs::weakly_canonical(fs::absolute(path, error), error);
  return error ? path : real;
}

std::set<fs::path> real_paths(const std::vector<std::string>& paths) {
  std::set<fs::path> all;
  for (const std::string& path : paths) all.insert(real_path(path));
  return all;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() && rest != path.end();
}

/// The meaning of `--output` for a run.
class Destination {
 public:
  Destination(const std::string& output, const Inputs& inputs, Ending ending)
      : output_(output), several_(inputs.several), ending_stays_(ending == Ending::stays) {
    std::error_code error;
    is_folder_ = several_ || output.ends_with('/') || fs::is_directory(output, error);
    real_ = real_path(output);
    for (const std::string& folder : inputs.folders) {
      inside_search_ = inside_search_ || is_below(real_, real_path(folder));
    }
  }

  /// Why it cannot be the place of a folder, or empty.
  std::string problem() const {
    std::error_code error;
    if (!is_folder_ || fs::is_directory(output_, error)) return {};
    if (fs::exists(real_, error)) {
      return fmt::format("--output: {} is a file, but a folder is needed for {}.",
                         quoted(output_, 200),
                         several_ ? "several assets" : "a name that ends in '/'");
    }
    if (!is_asset_name(output_)) return {};
    return fmt::format(
        "--output: {} looks like one file, but there may be several assets; end it "
        "in '/' for a folder.",
        quoted(output_, 200));
  }

  /// Whether an input is an output of an earlier run.
  bool holds(const fs::path& real) const { return inside_search_ && is_below(real, real_); }

  Result<std::string> of(const std::string& path, const std::string& place) const {
    if (is_folder_) return (fs::path(output_) / place).native();
    const std::string own = ending_of(path);
    if (!is_asset_name(output_)) {
      return Error{
          fmt::format("--output: {} is neither a folder nor the name of a .gltf, .glb or .vrm "
                      "file; write {} for a folder.",
                      quoted(output_, 200), quoted(output_ + "/", 200))};
    }
    if (!ending_stays_ || !is_asset_name(path) || own == ending_of(output_)) return output_;
    return Error{fmt::format("--output: {} has to end in {} as {} does: the container stays.",
                             quoted(output_, 200), own, quoted(path, 200))};
  }

 private:
  const std::string& output_;
  fs::path real_;
  bool several_;
  bool ending_stays_;
  bool is_folder_ = false;
  bool inside_search_ = false;
};

/// Places of outputs below a folder: those of their inputs below the named folder. Equal places get
/// as much more of the path of their input as needed.
class DistinctPlaces {
 public:
  explicit DistinctPlaces(const Inputs& inputs) : own_(inputs.paths.size()) {
    add(inputs.paths, inputs.places);
    add(inputs.paths_of_others, inputs.places_of_others);
    while (lengthen()) {
    }
  }

  /// Places of the inputs of this run, by position.
  std::vector<std::string> take() && {
    all_.resize(own_);
    return std::move(*this).take_all();
  }
  /// And then those of other shards.
  std::vector<std::string> take_all() && {
    std::vector<std::string> places;
    for (Place& each : all_) places.push_back(std::move(each.place));
    return places;
  }
  /// Places of other shards.
  std::set<std::string> of_others() const {
    std::set<std::string> places;
    for (std::size_t i = own_; i < all_.size(); ++i) places.insert(all_[i].place);
    return places;
  }

 private:
  struct Place {
    std::string place;
    std::vector<std::string> above;  ///< folders, the innermost last
  };

  void add(const std::vector<std::string>& paths, const std::vector<std::string>& places) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      Place place{places[i], {}};
      const fs::path plain = fs::path(paths[i]).lexically_normal().relative_path();
      for (const fs::path& step : plain) place.above.push_back(step.native());
      const fs::path kept = fs::path(places[i]).lexically_normal();
      for (auto step = kept.begin(); step != kept.end() && !place.above.empty(); ++step) {
        place.above.pop_back();
      }
      all_.push_back(std::move(place));
    }
  }

  // Whether a place became longer.
  bool lengthen() {
    std::map<std::string, std::size_t> uses;
    for (const Place& place : all_) ++uses[place.place];
    bool any = false;
    for (Place& place : all_) {
      if (uses[place.place] < 2 || place.above.empty() || place.above.back() == "..") continue;
      place.place = place.above.back() + "/" + place.place;
      place.above.pop_back();
      any = true;
    }
    return any;
  }

  const std::size_t own_;
  std::vector<Place> all_;
};

Error same_output(const std::string& target) {
  return {
      fmt::format("--output: two inputs would be written to {}; name the folder that "
                  "holds both, or write them one by one.",
                  quoted(target, 200))};
}

// "a/b.glb" to "a/b.png"; with both an a/b.glb and an a/b.gltf, the whole names are kept. Those of
// other shards come last.
std::vector<std::string> picture_names(const Inputs& inputs, const std::string& format) {
  DistinctPlaces distinct(inputs);
  const std::vector<std::string> places = std::move(distinct).take_all();
  const auto stem = [](const std::string& place) {
    return fs::path(place).replace_extension().native();
  };
  std::map<std::string, int> uses;
  for (const std::string& place : places) ++uses[stem(place)];
  std::vector<std::string> names;
  for (const std::string& place : places) {
    names.push_back(fmt::format("{}.{}", uses[stem(place)] > 1 ? place : stem(place), format));
  }
  return names;
}

/// The files of all pictures of a run.
class PictureFiles {
 public:
  /// `sheet`: of all pictures, or empty.
  PictureFiles(const Inputs& inputs, const BakeOptions& options, const std::string& sheet,
               bool webp)
      : inputs_(inputs),
        suffixes_(possible_suffixes(options, webp)),
        assets_(real_paths(inputs.paths)) {
    assets_.merge(real_paths(inputs.paths_of_others));
    if (!sheet.empty()) sheet_ = real_path(sheet);
  }

  /// Adds those of an input, by its position among all of this run and then those of other shards;
  /// `place` is that of a picture without a suffix. The Error names a conflict.
  std::optional<Error> add(std::size_t input, const std::string& place) {
    for (const std::string& suffix : suffixes_.single) {
      const std::string picture = with_suffix(place, suffix);
      if (auto conflict = add(input, picture, real_path(picture))) return conflict;
      if (suffixes_.numbered.empty()) continue;
      const fs::path number = any_number(real_path(picture));
      const auto frame = owners_.find(number);
      if (frame != owners_.end() && frame->second != input) return same_output(picture);
      like_frames_.emplace(number, input);
    }
    for (const std::string& suffix : suffixes_.numbered) {
      const std::string picture = with_suffix(place, suffix);
      const fs::path frame = real_path(picture);
      if (auto conflict = add(input, picture, frame)) return conflict;
      const auto other = like_frames_.find(frame);
      if (other != like_frames_.end() && other->second != input) return same_output(picture);
    }
    return std::nullopt;
  }

 private:
  static fs::path any_number(const fs::path& path) {
    return path.parent_path() / (with_any_number(path.stem().native()) + path.extension().native());
  }

  std::optional<Error> add(std::size_t input, const std::string& picture, const fs::path& real) {
    const std::string name = quoted(picture, 200);
    const std::size_t own = inputs_.paths.size();
    const std::string asset =
        quoted(input < own ? inputs_.paths[input] : inputs_.paths_of_others[input - own], 200);
    if (!sheet_.empty() && (real == sheet_ || real == any_number(sheet_))) {
      return Error{fmt::format("--sheet: {} is a picture of {}, too; name another file.",
                               quoted(sheet_.native(), 200), asset)};
    }
    if (assets_.contains(real)) {
      return Error{fmt::format("--output: {} is an asset of this run.", name)};
    }
    const auto [owner, fresh] = owners_.emplace(real, input);
    if (fresh) return std::nullopt;
    if (owner->second != input) return same_output(picture);
    return Error{fmt::format("--output: two pictures of {} would be written to {}.", asset, name)};
  }

  const Inputs& inputs_;
  const PossibleSuffixes suffixes_;
  std::set<fs::path> assets_;
  fs::path sheet_;
  std::map<fs::path, std::size_t> owners_;       // inputs by picture
  std::map<fs::path, std::size_t> like_frames_;  // of pictures that may be frames of others
};

bool is_folder(const Inputs& inputs, const std::string& output) {
  std::error_code error;
  return inputs.several || output.ends_with('/') || fs::is_directory(output, error);
}

// Checks for an ending that is not one of a picture.
std::optional<Error> check_name(const char* option, const std::string& name) {
  const std::string wrong = name.empty() ? std::string() : check_picture_name(name);
  if (wrong.empty()) return std::nullopt;
  return Error{fmt::format("{}: {}.", option, wrong)};
}

// With --format, any ending but that of another format.
std::optional<Error> check_output_name(const BakeRequest& request) {
  const std::string& name = request.bake.output;
  if (!request.bake.format || name.empty()) return check_name("--output", name);
  const auto same = [](std::string ending) {
    return ending == ".jpg" ? std::string(".jpeg") : std::move(ending);
  };
  if (!check_picture_name(name).empty() || same(ending_of(name)) == same("." + request.format)) {
    return std::nullopt;
  }
  return Error{
      fmt::format("--format: the ending of {} is that of another format.", quoted(name, 200))};
}

Error no_floats(const char* option, const std::string& name) {
  return {fmt::format("{}: {} would have 8 bits for each channel, which OpenEXR does not hold.",
                      option, quoted(name, 200))};
}

}  // namespace

Result<std::vector<EditInput>> place_outputs(const Inputs& inputs, const std::string& output,
                                             Ending ending) {
  const Destination destination(output, inputs, ending);
  const bool placing = !output.empty();
  if (std::string problem = placing ? destination.problem() : std::string(); !problem.empty()) {
    return Error{std::move(problem)};
  }
  std::vector<EditInput> placed;
  std::set<fs::path> seen, targets;
  std::set<fs::path> assets;  // except those that an earlier run wrote
  if (placing) assets = real_paths(inputs.paths);
  std::erase_if(assets, [&](const fs::path& asset) { return destination.holds(asset); });
  DistinctPlaces distinct(inputs);
  // Several shards write into folders only.
  for (const std::string& place : distinct.of_others()) {
    targets.insert(real_path(fs::path(output) / place));
  }
  const std::vector<std::string> places = std::move(distinct).take();
  for (std::size_t i = 0; i < inputs.paths.size(); ++i) {
    std::error_code error;
    const fs::path real = fs::canonical(inputs.paths[i], error);
    if (!error && !seen.insert(real).second) continue;
    placed.push_back({inputs.paths[i], {}});
    if (!placing) continue;
    if (destination.holds(real)) {
      placed.pop_back();
      continue;
    }
    auto target = destination.of(inputs.paths[i], places[i]);
    if (!target) return target.error();
    const fs::path place = real_path(*target);
    if (!targets.insert(place).second) return same_output(*target);
    if (place != real && assets.contains(place)) {
      return Error{fmt::format("--output: {} is an asset of this run, which {} would replace.",
                               quoted(*target, 200), quoted(inputs.paths[i], 200))};
    }
    placed.back().output = *std::move(target);
  }
  return placed;
}

std::optional<Error> check_difference_name(const BakeRequest& request) {
  const std::string& name = request.bake.output;
  if (name.empty()) return std::nullopt;
  std::error_code error;
  if (name.ends_with('/') || fs::is_directory(name, error)) {
    return Error{fmt::format("--output: {} is a folder; name a file.", quoted(name, 200))};
  }
  if (auto wrong = check_output_name(request)) return wrong;
  const bool exr = request.bake.format ? request.format == "exr" : ending_of(name) == ".exr";
  return exr ? std::optional(no_floats("--output", name)) : std::nullopt;
}

Result<PicturePlaces> place_pictures(const Inputs& inputs, const BakeRequest& request) {
  const std::string& output = request.bake.output;
  PicturePlaces places;
  if (!inputs.paths.empty()) places.sheet = request.sheet;
  const bool folder = !output.empty() && is_folder(inputs, output);
  std::error_code error;
  if (folder && fs::exists(output, error) && !fs::is_directory(output, error)) {
    return Error{fmt::format("--output: {} is a file, but a folder is needed for several assets.",
                             quoted(output, 200))};
  }
  const bool to_be_made = folder && !output.ends_with('/') && !fs::exists(output, error);
  if (to_be_made && check_picture_name(output).empty()) {
    return Error{fmt::format(
        "--output: {} looks like one picture, but there may be several assets; end it in '/' for a "
        "folder.",
        quoted(output, 200))};
  }
  if (!folder) {
    if (const auto wrong = check_output_name(request)) return *wrong;
  }
  if (const auto wrong = check_name("--sheet", request.sheet)) return *wrong;
  if (ending_of(request.sheet) == ".exr") return no_floats("--sheet", request.sheet);
  const bool all = request.paths.shard.count <= 1 && !inputs.paths.empty();
  if (folder && all && inputs.several && places.sheet.empty()) {
    places.sheet = (fs::path(output) / "contact-sheet.png").native();
  }
  const std::vector<std::string> names = picture_names(inputs, request.format);
  const bool webp =
      folder || request.bake.format ? request.format == "webp" : ending_of(output) == ".webp";
  PictureFiles files(inputs, request.bake, places.sheet, webp);
  for (std::size_t i = 0; i < inputs.paths.size(); ++i) {
    const std::string place = folder ? (fs::path(output) / names[i]).native() : output;
    if (!place.empty()) {
      if (fs::equivalent(place, inputs.paths[i], error)) {
        return Error{fmt::format("--output: {} is the asset itself.", quoted(place, 200))};
      }
      if (auto conflict = files.add(i, place)) return *std::move(conflict);
    }
    places.inputs.push_back({inputs.paths[i], place});
  }
  for (std::size_t i = inputs.paths.size(); folder && i < names.size(); ++i) {
    const std::string place = (fs::path(output) / names[i]).native();
    if (auto conflict = files.add(i, place)) return *std::move(conflict);
  }
  return places;
}

}  // namespace gltfx::tool
