// Shadow rays through glass.
#include "reference/through_glass.h"

#include <algorithm>

namespace reflet {

namespace {

constexpr int mostSurfaces = 64;  // that a shadow ray passes; any more block it

vec3 straightShare(const SurfacePoint& point, const Boundary& boundary) {
    if (boundary.kind == Boundary::Kind::none) {
        return vec3(point.transmission * (1.0F - point.metallic));
    }
    const Reflectance r = point.dielectricBetween(boundary.near, boundary.far);
    const float cosine = glm::dot(point.normal, point.toOrigin);
    const vec3 reflected = r.f0 + (r.f90 - r.f0) * schlick(cosine);
    const float most = std::min(std::max({reflected.x, reflected.y, reflected.z}), 1.0F);
    return point.baseColor * (point.transmission * (1.0F - point.metallic) * (1.0F - most));
}

}  // namespace

Boundary boundaryAt(const SurfacePoint& point, const Media& media) {
    if (!point.bounded) {
        return {Boundary::Kind::thin, 1.0F, point.medium.ior};
    }
    return media.boundary(point.medium, point.front);
}

void cross(Media& media, const SurfacePoint& point) {
    if (!point.bounded) {
        return;
    }
    if (point.front) {
        media.enter(point.medium);
    } else {
        media.leave(point.medium.instance);
    }
}

vec3 straightTransmittance(const RayScene& rays, Ray ray, RayKind kind, Media media) {
    const float length = glm::length(ray.direction);
    vec3 share(1.0F);
    for (int i = 0; i < mostSurfaces; ++i) {
        const auto hit = rays.intersect(ray, kind);
        if (!hit) {
            return share;
        }
        const SurfacePoint point = surfaceAt(rays, *hit, ray.direction);
        if (!(point.transmission > 0.0F)) {
            return vec3(0.0F);
        }
        share *= media.transmittance(hit->distance * length) * straightShare(point, boundaryAt(point, media));
        cross(media, point);
        ray.origin = point.rayOrigin(ray.direction);
        ray.far -= hit->distance;
        if (share == vec3(0.0F) || ray.far <= 0.0F) {
            return share;
        }
    }
    return vec3(0.0F);
}

}  // namespace reflet
