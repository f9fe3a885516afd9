// SPDX-License-Identifier: Apache-2.0
// Draws an asset, then casts as many rays at its triangles with Embree and nothing else:
//   bake_rays ASSET SIZE SAMPLES BOUNCES JOBS
// prints processor seconds of drawing, rays, and seconds of the same number of rays: of the
// processor and on the clock.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "base/packed.hpp"
#include "base/parallel.hpp"
#include "pipeline/bake_picture.hpp"
#include "pipeline/bake_scene.hpp"
#include "pipeline/bake_views.hpp"
#include "render/embree.hpp"
#include "render/sampler.hpp"
#include "render/surface.hpp"
#include "render/transform.hpp"

namespace {

using namespace gltfx;

// Of all threads: what else runs on the machine counts for little.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RTCScene plain_scene(RTCDevice device, const render::Scene& scene) {
  RTCScene top = rtcNewScene(device);
  for (const render::Instance& instance : scene.instances) {
    const render::Mesh& mesh = scene.meshes[instance.mesh];
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* points = static_cast<Float3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.positions.size()));
    for (const Float3& p : mesh.positions) {
      *points++ = to_float3(render::transform_point(instance.to_world, to_vec(p)));
    }
    auto* triangles = static_cast<std::array<std::uint32_t, 3>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(top, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcCommitScene(top);
  return top;
}

RTCRayHit query(const Vec3d& origin, const Vec3d& direction) {
  RTCRayHit q{};
  q.ray.org_x = static_cast<float>(origin.x);
  q.ray.org_y = static_cast<float>(origin.y);
  q.ray.org_z = static_cast<float>(origin.z);
  q.ray.dir_x = static_cast<float>(direction.x);
  q.ray.dir_y = static_cast<float>(direction.y);
  q.ray.dir_z = static_cast<float>(direction.z);
  q.ray.tfar = INFINITY;
  q.ray.mask = 0xFFFFFFFFU;
  q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  return q;
}

// A cosine-weighted direction around where the ray came from.
Vec3d bounce(const RTCRayHit& q, const Float2& random) {
  Vec3d n = normalize(Vec3d(static_cast<double>(q.hit.Ng_x), static_cast<double>(q.hit.Ng_y),
                            static_cast<double>(q.hit.Ng_z)));
  if (n.x * static_cast<double>(q.ray.dir_x) + n.y * static_cast<double>(q.ray.dir_y) +
          n.z * static_cast<double>(q.ray.dir_z) >
      0) {
    n = -n;
  }
  const double r = std::sqrt(static_cast<double>(random[0]));
  const double phi = 6.2831853 * static_cast<double>(random[1]);
  return render::frame_around(n).to_world(
      {r * std::cos(phi), r * std::sin(phi), std::sqrt(1 - static_cast<double>(random[0]))});
}

// One path of intersections and occlusions; the number of rays.
std::uint64_t cast(RTCScene scene, const render::Ray& ray, const render::SampleStream& random,
                   unsigned bounces) {
  RTCRayQueryContext context;
  rtcInitRayQueryContext(&context);
  std::uint64_t rays = 0;
  RTCRayHit q = query(ray.origin, ray.direction);
  for (unsigned step = 0;; ++step) {
    render::find_hit(scene, context, q);
    ++rays;
    if (q.hit.geomID == RTC_INVALID_GEOMETRY_ID || step == bounces) return rays;
    const double t = static_cast<double>(q.ray.tfar) * 0.9999;
    const Vec3d at(static_cast<double>(q.ray.org_x) + t * static_cast<double>(q.ray.dir_x),
                   static_cast<double>(q.ray.org_y) + t * static_cast<double>(q.ray.dir_y),
                   static_cast<double>(q.ray.org_z) + t * static_cast<double>(q.ray.dir_z));
    RTCRay shadow = query(at, bounce(q, random.pair(2 * step + 1))).ray;
    render::find_occluder(scene, context, shadow);
    ++rays;
    q = query(at, bounce(q, random.pair(2 * step + 2)));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 6) return 2;
  BakeOptions options;
  const auto size = static_cast<std::uint32_t>(std::atoi(argv[2]));
  options.samples = static_cast<std::uint32_t>(std::atoi(argv[3]));
  options.bounces = static_cast<std::uint32_t>(std::atoi(argv[4]));
  options.jobs = static_cast<unsigned>(std::atoi(argv[5]));
  options.denoise = false;
  const BakeScene loaded = load_bake_scene(argv[1], options);
  if (!loaded.ready()) return 1;
  const render::View view = choose_views(loaded, options, 1)->front();
  const double begin = seconds();
  const render::Framebuffer drawn =
      draw_picture(loaded, view, {size, size}, options, layers_of(options), {});
  const double drawing = seconds() - begin;
  const std::uint64_t wanted = drawn.rays;

  RTCDevice device = rtcNewDevice(nullptr);
  RTCScene plain = plain_scene(device, *loaded.scene);
  std::vector<std::uint64_t> rows(size);
  std::uint64_t cast_rays = 0;
  const double start = seconds();
  const double clock_start = clock_seconds();
  for (std::uint32_t sample = 0; cast_rays < wanted; ++sample) {
    parallel_ordered(
        size, options.jobs,
        [&](std::size_t y) {
          rows[y] = 0;
          for (std::uint32_t x = 0; x < size; ++x) {
            const render::SampleStream random(0, static_cast<std::uint32_t>(y) * size + x, sample);
            rows[y] +=
                cast(plain, view.ray((x + 0.5) / size, (static_cast<double>(y) + 0.5) / size),
                     random, *options.bounces);
          }
        },
        [&](std::size_t y) { cast_rays += rows[y]; });
  }
  const double share = static_cast<double>(wanted) / static_cast<double>(cast_rays);
  std::printf("%.6f %llu %.6f %.6f\n", drawing, static_cast<unsigned long long>(wanted),
              (seconds() - start) * share, (clock_seconds() - clock_start) * share);
  rtcReleaseScene(plain);
  rtcReleaseDevice(device);
  return 0;
}
