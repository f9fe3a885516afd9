// SPDX-License-Identifier: Apache-2.0
// Animations that jump or vanish.
#include "rules/shows_assets.hpp"

namespace gltfx::test {
namespace {

constexpr Four kNone{};

std::vector<float> times_of(std::size_t count, double step) {
  std::vector<float> times;
  for (std::size_t i = 0; i < count; ++i) {
    times.push_back(static_cast<float>(step * static_cast<double>(i)));
  }
  return times;
}

// Adds an animation of a node with a mesh; `channels` have values as stored.
struct Channel {
  std::string path;
  std::vector<Four> values;
  std::string interpolation = "LINEAR";
};

void animate(Drawn& d, const std::vector<float>& times, const std::vector<Channel>& channels) {
  Json animation{{"samplers", Json::array()}, {"channels", Json::array()}};
  const std::size_t input = d.made.accessor("SCALAR", 5126, times.size(), packed(times),
                                            {{"min", {times.front()}}, {"max", {times.back()}}});
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::size_t node = d.root({{"mesh", d.mesh(d.shape(1))}});
    const bool rotation = channels[i].path == "rotation";
    std::size_t output = 0;
    if (rotation) {
      output = d.values("VEC4", channels[i].values);
    } else {
      std::vector<Point> points;
      for (const Four& each : channels[i].values) points.push_back({each[0], each[1], each[2]});
      output = d.values("VEC3", points);
    }
    animation["samplers"].push_back(
        {{"input", input}, {"output", output}, {"interpolation", channels[i].interpolation}});
    animation["channels"].push_back(
        {{"sampler", i}, {"target", {{"node", node}, {"path", channels[i].path}}}});
  }
  d.made.add("animations", std::move(animation));
}

Four negative(Four value) {
  for (float& each : value) each = -each;
  return value;
}

// Rotations around one axis, `step` degrees apart.
std::vector<Four> spin(Drawn& d, std::size_t count, double step) {
  const Four axis = d.turn(180);
  std::vector<Four> turns;
  for (std::size_t i = 0; i < count; ++i) {
    const double half = step * static_cast<double>(i) * 3.14159265358979 / 360;
    Four turn{};
    for (std::size_t k = 0; k < 3; ++k) {
      turn[k] = static_cast<float>(static_cast<double>(axis[k]) * std::sin(half));
    }
    turn[3] = static_cast<float>(std::cos(half));
    turns.push_back(turn);
  }
  return turns;
}

// A spline through values, with tangents of the central differences times `slope`.
Channel spline(const std::vector<Four>& values, const std::string& path, double step,
               double slope) {
  Channel channel{path, {}, "CUBICSPLINE"};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Four& before = values[i == 0 ? 0 : i - 1];
    const Four& after = values[std::min(i + 1, values.size() - 1)];
    Four tangent{};
    for (std::size_t k = 0; k < 4; ++k) {
      tangent[k] =
          static_cast<float>(slope * static_cast<double>(after[k] - before[k]) / (2 * step));
    }
    channel.values.insert(channel.values.end(), {tangent, values[i], tangent});
  }
  return channel;
}

TEST(RotationFlips, AreFoundInSplines) {
  expect_found(
      "ANIMATION_ROTATION_FLIPS", "/animations/0/samplers/0/output",
      {
          // One key has the other sign.
          [](Drawn& d) {
            const auto count = static_cast<std::size_t>(d.pick(2, 12));
            std::vector<Four> turns = spin(d, count, d.number(-110, 110));
            Four& one = turns[static_cast<std::size_t>(d.pick(0, static_cast<int>(count) - 1))];
            one = negative(one);
            animate(d, times_of(count, 0.5), {spline(turns, "rotation", 0.5, 0)});
          },
          // All keys from one on have the other sign.
          [](Drawn& d) {
            std::vector<Four> turns = spin(d, 8, d.number(-80, 80));
            const double step = d.number(0.1, 2);
            Channel channel = spline(turns, "rotation", step, 1);
            const auto from = static_cast<std::size_t>(d.pick(1, 7)) * 3;
            for (std::size_t i = from; i < channel.values.size(); ++i) {
              channel.values[i] = negative(channel.values[i]);
            }
            animate(d, times_of(8, step), {channel});
          },
          // A whole turn between two keys.
          [](Drawn& d) {
            const Four turn = d.turn(d.number(0, 180));
            animate(
                d, times_of(2, d.number(0.2, 5)),
                {{"rotation", {kNone, turn, kNone, kNone, negative(turn), kNone}, "CUBICSPLINE"}});
          },
      });
}

TEST(RotationFlips, AreNoTurnsOfOneSignNorOtherInterpolations) {
  expect_silent({
      [](Drawn& d) {
        const auto turns = spin(d, static_cast<std::size_t>(d.pick(2, 12)), d.number(-100, 100));
        animate(d, times_of(turns.size(), 0.5), {spline(turns, "rotation", 0.5, 0)});
      },
      [](Drawn& d) {
        const double step = d.number(0.1, 2);
        animate(d, times_of(8, step), {spline(spin(d, 8, d.number(-80, 80)), "rotation", step, 1)});
      },
      [](Drawn& d) {
        std::vector<Four> turns = spin(d, 8, d.number(5, 100));
        for (Four& each : turns) {
          if (d.pick(0, 1) == 0) each = negative(each);
        }
        animate(d, times_of(8, 0.5), {{"rotation", turns, d.pick(0, 1) == 0 ? "LINEAR" : "STEP"}});
      },
  });
}

TEST(HalfTurn, IsFound) {
  expect_found(
      "ANIMATION_HALF_TURN", "/animations/0/samplers/0/output",
      {
          [](Drawn& d) {
            animate(d, times_of(2, d.number(0.2, 3)), {{"rotation", spin(d, 2, 180)}});
          },
          [](Drawn& d) {
            const auto turns = spin(d, static_cast<std::size_t>(d.pick(3, 9)), -180);
            animate(d, times_of(turns.size(), 1), {{"rotation", turns}});
          },
          [](Drawn& d) {
            std::vector<Four> turns = spin(d, 5, d.number(10, 100));
            turns.push_back({turns.back()[3], -turns.back()[2], turns.back()[1], -turns.back()[0]});
            animate(d, times_of(6, d.number(0.2, 3)), {{"rotation", turns}});
          },
      });
  expect_silent({
      [](Drawn& d) {
        animate(d, times_of(2, 1), {{"rotation", spin(d, 2, d.number(1, 178))}});
      },
      [](Drawn& d) {
        animate(d, times_of(2, 0.04), {{"rotation", spin(d, 2, 180)}});
      },
      [](Drawn& d) {
        animate(d, times_of(2, 1), {{"rotation", spin(d, 2, 180), "STEP"}});
      },
  });
}

std::vector<Four> sizes(Drawn& d, std::size_t count) {
  std::vector<Four> sizes;
  for (std::size_t i = 0; i < count; ++i) {
    sizes.push_back({static_cast<float>(d.number(0.1, 3)), static_cast<float>(d.number(0.1, 3)),
                     static_cast<float>(d.number(0.1, 3)), 0});
  }
  return sizes;
}

TEST(ScaleSign, IsFound) {
  const auto flip = [](Drawn& d, std::size_t count, bool rest) {
    std::vector<Four> keys = sizes(d, count);
    const auto axis = static_cast<std::size_t>(d.pick(0, 2));
    const auto from = static_cast<std::size_t>(d.pick(1, static_cast<int>(count) - 1));
    for (std::size_t i = from; i < (rest ? count : from + 1); ++i) keys[i][axis] *= -1;
    return keys;
  };
  expect_found("ANIMATION_SCALE_SIGN", "/animations/0/samplers/0/output",
               {
                   [&](Drawn& d) {
                     animate(d, times_of(6, 0.5), {{"scale", flip(d, 6, true)}});
                   },
                   [&](Drawn& d) {
                     animate(d, times_of(6, 0.5), {{"scale", flip(d, 6, false)}});
                   },
                   [&](Drawn& d) {
                     animate(d, times_of(4, 0.5), {spline(flip(d, 4, true), "scale", 0.5, 0)});
                   },
               });
  expect_silent({
      [](Drawn& d) {
        animate(d, times_of(6, 0.5), {{"scale", sizes(d, 6)}});
      },
      [&](Drawn& d) {
        animate(d, times_of(6, 0.5), {{"scale", flip(d, 6, true), "STEP"}});
      },
      [](Drawn& d) {
        std::vector<Four> keys = sizes(d, 5);
        keys[static_cast<std::size_t>(d.pick(0, 4))] = kNone;
        animate(d, times_of(5, 0.5), {{"scale", keys}});
      },
      [](Drawn& d) {
        std::vector<Four> keys = sizes(d, 5);
        for (Four& key : keys) key[1] *= -1;
        animate(d, times_of(5, 0.5), {{"scale", keys}});
      },
  });
}

// Places that go somewhere and come back.
std::vector<Four> path(Drawn& d, std::size_t count) {
  std::vector<Four> places;
  for (std::size_t i = 0; i < count; ++i) {
    const Point place = d.point(3);
    places.push_back({place[0], place[1], place[2], 0});
  }
  places.back() = places.front();
  return places;
}

TEST(DenseKeys, AreFound) {
  const auto dense = [](Drawn& d, std::size_t count, double rate) {
    animate(d, times_of(count, 1 / rate), {{"translation", path(d, count)}});
  };
  expect_found(
      "ANIMATION_KEYS_DENSE", "/animations/0/samplers/0/input",
      {
          [&](Drawn& d) { dense(d, 200, d.number(250, 480)); },
          [&](Drawn& d) { dense(d, static_cast<std::size_t>(d.pick(200, 900)), 960); },
          [&](Drawn& d) { dense(d, static_cast<std::size_t>(d.pick(200, 400)), 900 * 30); },
      });
  expect_silent({
      [&](Drawn& d) { dense(d, static_cast<std::size_t>(d.pick(200, 900)), d.number(10, 230)); },
      [&](Drawn& d) { dense(d, static_cast<std::size_t>(d.pick(3, 199)), d.number(10, 2000)); },
      [&](Drawn& d) { dense(d, 2, 1000); },
  });
}

TEST(TangentsMove, AreFoundOnConstantKeys) {
  const auto still = [](Drawn& d, std::size_t count, std::size_t part, double tangent) {
    const Point place = d.point(3);
    Channel channel{"translation", {}, "CUBICSPLINE"};
    for (std::size_t i = 0; i < count; ++i) {
      channel.values.insert(channel.values.end(),
                            {kNone, {place[0], place[1], place[2], 0}, kNone});
    }
    // Not the first tangent in, nor the last one out.
    const std::size_t key = part == 0 ? count - 1 : 0;
    channel.values[key * 3 + part][static_cast<std::size_t>(d.pick(0, 2))] =
        static_cast<float>(d.sign() * tangent);
    animate(d, times_of(count, 0.5), {channel});
  };
  expect_found("ANIMATION_TANGENTS_MOVE", "/animations/0/samplers/0/output",
               {
                   [&](Drawn& d) { still(d, 2, 0, d.magnitude(0.01, 10)); },
                   [&](Drawn& d) { still(d, 2, 2, d.magnitude(0.01, 10)); },
                   [&](Drawn& d) { still(d, static_cast<std::size_t>(d.pick(3, 9)), 2, 1); },
               });
  expect_silent({
      [&](Drawn& d) { still(d, static_cast<std::size_t>(d.pick(2, 9)), 2, 0); },
      [](Drawn& d) { animate(d, times_of(5, 0.5), {spline(path(d, 5), "translation", 0.5, 1)}); },
      [](Drawn& d) { animate(d, times_of(5, 0.5), {spline(path(d, 5), "translation", 0.5, 0)}); },
  });
}

TEST(WithoutDuration, IsAPose) {
  expect_found(
      "ANIMATION_WITHOUT_DURATION", "/animations/0",
      {
          [](Drawn& d) {
            animate(d, {static_cast<float>(d.number(0, 9))}, {{"translation", path(d, 1)}});
          },
          [](Drawn& d) {
            animate(d, {0}, {{"rotation", {d.turn(d.number(0, 90))}}});
          },
          [](Drawn& d) {
            animate(d, {0}, {{"translation", path(d, 1)}, {"scale", sizes(d, 1)}});
          },
      });
  expect_silent({
      [](Drawn& d) {
        animate(d, {0, static_cast<float>(d.magnitude(0.01, 9))}, {{"translation", path(d, 2)}});
      },
      [](Drawn& d) {
        animate(d, times_of(3, 0.1), {{"scale", sizes(d, 3)}});
      },
      [](Drawn& d) { d.root_with(d.shape(1)); },
  });
}

TEST(LoopOpen, IsFoundWhereMostChannelsAreClosed) {
  const auto loop = [](Drawn& d, std::size_t channels, std::size_t open) {
    std::vector<Channel> all;
    for (std::size_t i = 0; i < channels; ++i) {
      const bool turns = i % 2 == 1;
      std::vector<Four> values = turns ? spin(d, 5, d.number(5, 55)) : path(d, 5);
      if (turns) values.back() = d.pick(0, 1) == 0 ? values.front() : negative(values.front());
      if (i < open) values.back() = turns ? d.turn(77) : Four{9, 9, 9, 0};
      all.push_back({turns ? "rotation" : "translation", values});
    }
    animate(d, times_of(5, 0.5), all);
  };
  expect_found("ANIMATION_LOOP_OPEN", "/animations/0/channels/0",
               {
                   [&](Drawn& d) { loop(d, 4, 1); },
                   [&](Drawn& d) { loop(d, static_cast<std::size_t>(d.pick(5, 12)), 1); },
                   [&](Drawn& d) { loop(d, 12, static_cast<std::size_t>(d.pick(1, 3))); },
               });
  expect_silent(
      {
          [&](Drawn& d) { loop(d, static_cast<std::size_t>(d.pick(1, 12)), 0); },
          [&](Drawn& d) { loop(d, 3, 1); },
          [&](Drawn& d) { loop(d, 8, static_cast<std::size_t>(d.pick(3, 8))); },
      },
      {"DUPLICATE_ACCESSORS", "ANIMATION_HALF_TURN"});  // an open end may be half a turn away
}

}  // namespace
}  // namespace gltfx::test
