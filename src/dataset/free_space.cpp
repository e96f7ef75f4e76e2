// Searches for cameras by casting rays.
#include "dataset/free_space.h"

#include "reference/camera_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace reflet {

namespace {

constexpr float endless = std::numeric_limits<float>::infinity();
constexpr uvec2 probes{16, 9};  // rays of a view

float freeWay(const RayScene& rays, const vec3& from, const vec3& direction) {
    const auto hit = rays.intersect({from, direction}, RayKind::light);
    return hit ? hit->distance : endless;
}

// The unit normal of the triangle's front face.
vec3 outward(const RayScene& rays, const Hit& hit) {
    const Triangle t = rays.triangle(hit.instance, hit.triangle);
    const vec3 normal = glm::cross(t.b - t.a, t.c - t.a) * (rays.mirrored(hit.instance) ? -1.0F : 1.0F);
    const float length = glm::length(normal);
    return length > 0.0F ? normal / length : vec3(0.0F);
}

// Evenly over the sphere (Fibonacci lattice).
std::vector<vec3> around(int count) {
    std::vector<vec3> all;
    for (int i = 0; i < count; ++i) {
        const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
        const float angle = 2.39996323F * static_cast<float>(i);
        const float radius = std::sqrt(1.0F - y * y);
        all.emplace_back(radius * std::cos(angle), y, radius * std::sin(angle));
    }
    return all;
}

float median(std::vector<float>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

float scaleAround(const RayScene& rays, const Camera& start) {
    std::vector<float> distances;
    for (const vec3& direction : around(64)) {
        if (const float way = freeWay(rays, start.position, direction); std::isfinite(way) && way > 0.0F) {
            distances.push_back(way);
        }
    }
    return distances.empty() ? std::max(glm::length(start.target - start.position), 1e-3F) : median(distances);
}

class Search {
public:
    Search(const RayScene& rays, const Camera& start, float aspect, const CameraLimits& limits, Draws& draws)
        : rays_(rays),
          start_(start),
          limits_(limits),
          draws_(draws),
          scale_(scaleAround(rays, start)),
          size_(static_cast<uint32_t>(std::lround(1000.0F * aspect)), 1000U) {}

    // nullopt: there is no floor, or something is between it and the place.
    std::optional<vec3> place(const Distribution& height) {
        vec3 at = start_.position;
        for (int step = 0; step < 3; ++step) {
            const vec3 way = glm::normalize(draws_.direction() * vec3(1.0F, 0.35F, 1.0F));  // rather aside than up
            const float most = std::min(freeWay(rays_, at, way), 2.0F * scale_);
            at += way * most * static_cast<float>(draws_.between(0.05, 0.8));
        }
        const double wanted = height.draw(draws_);
        if (height.kind == Distribution::Kind::none) {
            return at;
        }
        const float floor = freeWay(rays_, at, vec3(0, -1, 0));
        const float up = static_cast<float>(wanted) - floor;
        if (!std::isfinite(floor) || wanted <= 0.0 || (up > 0.0F && freeWay(rays_, at, vec3(0, 1, 0)) < up)) {
            return std::nullopt;
        }
        return at + vec3(0, up, 0);
    }

    [[nodiscard]] bool isFree(const vec3& at) const {
        const float nearest = std::max(limits_.nearest * scale_, 4.0F * start_.near);
        return std::ranges::all_of(around(26), [&](const vec3& way) { return freeWay(rays_, at, way) > nearest; });
    }

    // At what the scene's camera sees, which is what the scene is about, or in a quarter of the cases anywhere.
    // nullopt: something is in between.
    std::optional<vec3> target(const vec3& at) {
        if (draws_.unit() < 0.25) {
            vec3 ahead = draws_.direction();
            ahead = glm::normalize(vec3(ahead.x, std::clamp(0.6F * ahead.y - 0.1F, -0.6F, 0.5F), ahead.z));
            return at + ahead * std::min(freeWay(rays_, at, ahead), 4.0F * scale_);
        }
        const vec2 pixel = vec2(draws_.unit(), draws_.unit()) * vec2(size_);
        const Ray ray = CameraRays(start_, size_).through(pixel);
        const auto hit = rays_.intersect(ray, RayKind::camera);
        if (!hit) {
            return std::nullopt;
        }
        const vec3 seen = ray.origin + ray.direction * hit->distance;
        const float away = glm::length(seen - at);
        const bool visible = away > 0.0F && freeWay(rays_, at, (seen - at) / away) > 0.98F * away;
        return visible ? std::optional(seen) : std::nullopt;
    }

    Camera aimedAt(const vec3& target, const vec3& at, const Distribution& fov) {
        Camera camera;
        camera.position = at;
        camera.near = start_.near;
        camera.fovY = glm::radians(static_cast<float>(fov.draw(draws_)));
        const vec3 aside = draws_.direction() * 0.2F * glm::length(target - at);  // not always in the middle
        camera.target = target + aside;
        return camera;
    }

    // The median distance of what it sees; nullopt if that breaks a limit.
    [[nodiscard]] std::optional<float> sees(const Camera& camera) const {
        const CameraRays through(camera, size_);
        std::vector<float> distances;
        vec3 normals(0.0F);
        float close = 0.0F;
        float backs = 0.0F;
        for (uint32_t i = 0; i < probes.x * probes.y; ++i) {
            const vec2 at = (vec2(i % probes.x, i / probes.x) + 0.5F) / vec2(probes) * vec2(size_);
            const Ray ray = through.through(at);
            const auto hit = rays_.intersect(ray, RayKind::light);
            if (!hit) {
                continue;
            }
            const vec3 normal = outward(rays_, *hit);
            const bool back = glm::dot(normal, ray.direction) > 0.0F;
            backs += back && !rays_.material(hit->instance).doubleSided ? 1.0F : 0.0F;
            close += hit->distance < limits_.near * scale_ ? 1.0F : 0.0F;
            normals += back ? -normal : normal;
            distances.push_back(hit->distance);
        }
        const auto all = static_cast<float>(probes.x * probes.y);
        const auto hits = static_cast<float>(distances.size());
        if (hits < 1.0F || hits < (1.0F - limits_.mostSky) * all || close > limits_.mostNear * all ||
            backs > limits_.mostBacks * all) {
            return std::nullopt;
        }
        const bool even = hits > 0.95F * all && glm::length(normals) > limits_.mostEven * hits;
        const float middle = median(distances);
        return even || middle > limits_.farthest * scale_ ? std::nullopt : std::optional(middle);
    }

private:
    const RayScene& rays_;
    const Camera& start_;
    const CameraLimits& limits_;
    Draws& draws_;
    float scale_;
    uvec2 size_;
};

}  // namespace

std::optional<FoundCamera> findCamera(const RayScene& rays, const Camera& start, float aspect,
                                      const Distribution& height, const Distribution& fov, Draws& draws,
                                      const CameraLimits& limits) {
    Search search(rays, start, aspect, limits, draws);
    for (uint32_t i = 1; i <= limits.tries; ++i) {
        const auto at = search.place(height);
        if (!at || !search.isFree(*at)) {
            continue;
        }
        const auto target = search.target(*at);
        if (!target) {
            continue;
        }
        const Camera camera = search.aimedAt(*target, *at, fov);
        const bool steep = std::abs(glm::normalize(camera.target - camera.position).y) > 0.95F;  // along its `up`
        if (const auto distance = steep ? std::nullopt : search.sees(camera)) {
            return FoundCamera{camera, *distance, i};
        }
    }
    return std::nullopt;
}

}  // namespace reflet
