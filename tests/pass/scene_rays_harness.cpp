// Traces rays through a scene on the device and by Embree, and compares what they hit.
#include "pass/scene_rays_harness.h"

#include "device/upload.h"
#include "pass/test_shaders.h"
#include "reference/ray_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ostream>
#include <random>

namespace reflet::test {

void SceneRaysTest::SetUpTestSuite() {
    addPassTestShaders(device());
}

bool SceneRaysTest::hasRayQuery() {
    return device().hasRayQuery();
}

std::vector<TestHit> SceneRaysTest::trace(const SceneRays& scene, const std::vector<TestRay>& rays) {
    constexpr VkBufferUsageFlags storage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const gpu::Buffer in = gpu::uploadBuffer(device(), std::as_bytes(std::span(rays)), storage, "rays");
    const gpu::Buffer out(device(), rays.size() * sizeof(TestHit), storage, gpu::MemoryUse::readback, "hits");
    gpu::Frame& f = frame();
    f.begin();
    gpu::ComputePass pass = f.compute("scene_rays_test", scene.shader("scene_rays_test"));
    scene.bind(pass.read("rays", in.view()).write("hits", out.view())).dispatch(static_cast<uint32_t>(rays.size()));
    f.submit();
    f.wait();
    showToHost();
    std::vector<TestHit> hits(rays.size());
    std::memcpy(hits.data(), out.bytes().data(), out.bytes().size());
    return hits;
}

std::vector<TestRay> randomRays(const Scene& scene, size_t count) {
    std::mt19937 random(1);
    const auto number = [&] { return static_cast<float>(random() >> 8U) * 0x1p-24F; };
    const Aabb box = scene.bounds();
    std::vector<TestRay> rays(count);
    for (TestRay& ray : rays) {
        const float x = number();
        const float y = number();
        const vec3 place(x, y, number());
        const float z = 2.0F * number() - 1.0F;
        const float angle = 2.0F * glm::pi<float>() * number();
        const float r = std::sqrt(1.0F - z * z);
        ray = {box.min + box.size() * (1.2F * place - 0.1F), 0.0F, vec3(r * std::cos(angle), r * std::sin(angle), z),
               std::numeric_limits<float>::infinity()};
    }
    return rays;
}

Scene withoutCutOuts(Scene scene) {
    for (Material& material : scene.materials) {
        material.alphaCutoff = 0.0F;
        material.transmission = {};  // rays pass glass by chance
    }
    return scene;
}

namespace {

// Of meshes, in the list of all of them.
std::vector<uint32_t> firstIndices(const Scene& scene) {
    std::vector<uint32_t> first;
    uint32_t sum = 0;
    for (const Mesh& mesh : scene.meshes) {
        first.push_back(sum);
        sum += static_cast<uint32_t>(mesh.indices.size());
    }
    return first;
}

constexpr double roundings = 3.0;  // that distances of the same place may be apart

// A ray and a hit triangle's plane, in double precision.
struct Meeting {
    double distance = 0.0;
    double inside = 0.0;  // the smallest barycentric
    double cosine = 0.0;
    double extent = 0.0;  // metres: of the coordinates that were added up

    Meeting(const Triangle& t, const TestRay& ray) {
        const glm::dvec3 a(t.a);
        const glm::dvec3 ab = glm::dvec3(t.b) - a;
        const glm::dvec3 ac = glm::dvec3(t.c) - a;
        const glm::dvec3 normal = glm::cross(ab, ac);
        const glm::dvec3 direction(ray.direction);
        const glm::dvec3 origin(ray.origin);
        distance = glm::dot(a - origin, normal) / glm::dot(direction, normal);
        const glm::dvec3 place = origin + distance * direction - a;
        const double area = glm::dot(normal, normal);
        const double u = glm::dot(glm::cross(place, ac), normal) / area;
        const double v = glm::dot(glm::cross(ab, place), normal) / area;
        inside = std::min({u, v, 1.0 - u - v});
        cosine = std::abs(glm::dot(direction, normal)) / std::sqrt(area);
        for (const vec3& corner : {t.a, t.b, t.c}) {
            extent = std::max(extent, glm::length(glm::dvec3(corner) - origin));
        }
    }
    // Metres along the ray that single precision may be off.
    [[nodiscard]] double rounding() const { return 1e-6 * extent / cosine; }
};

class HitComparison {
public:
    explicit HitComparison(const Scene& scene) : scene_(scene), firstIndices_(firstIndices(scene)) {}

    void add(HitDifference& d, const TestRay& ray, const TestHit& a, const TestHit& b) const {
        d.any += (a.any != a.found ? 1 : 0) + (b.any != b.found ? 1 : 0);
        d.hits += a.found;
        if (a.found != b.found) {
            ++d.other;
            ++d.oneOnly;
        } else if (a.found != 0) {
            const Meeting first(triangle(a), ray);
            const Meeting second(triangle(b), ray);
            const double rounding = std::max(first.rounding(), second.rounding());
            const double apart = std::abs(a.distance - b.distance) / rounding;
            if (a.instance == b.instance && a.firstIndex == b.firstIndex) {
                d.distance = std::max(d.distance, apart);
                d.barycentric = std::max<double>(d.barycentric, glm::length(a.barycentrics - b.barycentrics));
            } else if (std::min(first.inside, second.inside) >= 0.0 &&
                       std::abs(first.distance - second.distance) < rounding) {
                d.distance = std::max(d.distance, apart);
                ++d.coincident;
            } else {
                ++d.other;
                d.elsewhere += apart > roundings ? 1 : 0;
            }
        }
    }

private:
    [[nodiscard]] Triangle triangle(const TestHit& hit) const {
        const Instance& instance = scene_.instances.at(hit.instance);
        const Mesh& mesh = scene_.meshes[instance.mesh];
        const uint32_t first = hit.firstIndex - firstIndices_[instance.mesh];
        const auto corner = [&](uint32_t i) {
            return vec3(instance.objectToWorld * vec4(mesh.positions[mesh.indices.at(first + i)], 1.0F));
        };
        return {corner(0), corner(1), corner(2)};
    }

    const Scene& scene_;
    std::vector<uint32_t> firstIndices_;
};

}  // namespace

std::vector<TestHit> traceWithEmbree(const Scene& scene, const std::vector<TestRay>& rays) {
    const RayScene embree(scene);
    const std::vector<uint32_t> first = firstIndices(scene);
    std::vector<TestHit> hits(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) {
        const Ray ray{rays[i].origin, rays[i].direction, rays[i].nearest, rays[i].farthest};
        if (const auto hit = embree.intersect(ray, RayKind::light)) {
            const uint32_t firstIndex = first[scene.instances[hit->instance].mesh] + 3 * hit->triangle;
            hits[i] = {hit->distance, hit->barycentric, hit->instance, firstIndex, 1, 1};
        }
    }
    return hits;
}

HitDifference difference(const Scene& scene, const std::vector<TestRay>& rays, const std::vector<TestHit>& one,
                         const std::vector<TestHit>& another) {
    const HitComparison comparison(scene);
    HitDifference d;
    d.rays = rays.size();
    for (size_t i = 0; i < rays.size(); ++i) {
        comparison.add(d, rays[i], one[i], another[i]);
    }
    return d;
}

std::ostream& operator<<(std::ostream& out, const HitDifference& d) {
    return out << d.rays << " rays, " << d.hits << " hit; " << d.other << " otherwise (" << d.oneOnly
               << " one way only, " << d.elsewhere << " at another distance), " << d.coincident
               << " one of two coincident triangles; distances within " << d.distance
               << " roundings, barycentrics within " << d.barycentric;
}

}  // namespace reflet::test
