// Follows surface points from one frame to the one before.
#include "reference/motion.h"

#include "reference/camera_rays.h"
#include "reference/parallel.h"
#include "scene/volumes_around.h"

#include <algorithm>

namespace reflet {

namespace {

vec3 pointOn(const RayScene& rays, const Hit& hit) {
    const Triangle t = rays.triangle(hit.instance, hit.triangle);
    return t.a + hit.barycentric.x * (t.b - t.a) + hit.barycentric.y * (t.c - t.a);
}

// As the path tracer's first surface: from inside of a volume of glass its back faces count.
RayKind kindFor(const RayScene& rays, const Camera& camera) {
    const bool glass =
        std::ranges::any_of(rays.scene().materials, [](const Material& m) { return m.transmission.factor > 0.0F; });
    return glass && !VolumeFinder{}.around(rays.scene(), nullptr, camera).empty() ? RayKind::inside : RayKind::camera;
}

}  // namespace

MotionImages traceMotion(const RayScene& now, const View& seen, const RayScene& before, const View& seenBefore,
                         uvec2 size) {
    const size_t pixels = size_t(size.x) * size.y;
    MotionImages images{{size.x, size.y, {"X", "Y"}, std::vector<float>(2 * pixels)},
                        {size.x, size.y, {"Y"}, std::vector<float>(pixels)}};
    const CameraRays camera(seen.camera, size);
    const CameraRays cameraBefore(seenBefore.camera, size);
    const RayKind kind = kindFor(now, seen.camera);
    const bool perspective = !(seen.camera.orthographicHeight > 0.0F);
    const float aspect = static_cast<float>(size.x) / static_cast<float>(size.y);
    const glm::dmat4 toClip =
        glm::dmat4(viewToClip(seenBefore.camera, aspect)) * glm::dmat4(worldToView(seenBefore.camera));
    parallelFor(size.y, [&](uint32_t y) {
        for (uint32_t x = 0; x < size.x; ++x) {
            const vec2 place = vec2(x, y) + 0.5F;
            const Ray ray = camera.through(place);
            const auto hit = now.intersect(ray, kind);
            if (!hit && !perspective) {
                continue;
            }
            const size_t i = size_t(y) * size.x + x;
            const vec3 was = hit ? pointOn(before, *hit) : ray.direction;
            const glm::dvec4 clip = toClip * glm::dvec4(was, hit ? 1.0 : 0.0);
            images.previousDepth.data[i] = hit ? cameraBefore.depth(was) : 0.0F;
            if (clip.w > 0.0) {
                const glm::dvec2 motion =
                    glm::dvec2(place) / glm::dvec2(size) - (0.5 + 0.5 * glm::dvec2(clip) / clip.w);
                images.motion.data[2 * i] = static_cast<float>(motion.x);
                images.motion.data[2 * i + 1] = static_cast<float>(motion.y);
            }
        }
    });
    return images;
}

}  // namespace reflet
