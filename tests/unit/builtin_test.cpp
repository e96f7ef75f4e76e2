// The built-in scenes: valid data, deterministic, and lit as each scene intends.
#include "scene/builtin.h"

#include "scene/image_suns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace reflet {

/// Prints a parameter for GoogleTest, which would otherwise print its bytes, including addresses.
static void PrintTo(const BuiltinScene& scene, std::ostream* out) {
    *out << scene.name;
}

namespace builtin_test {
namespace {

struct Triangle {
    vec3 a;
    vec3 ab;
    vec3 ac;
    bool doubleSided = false;
};

std::vector<Triangle> worldTriangles(const Scene& scene) {
    std::vector<Triangle> triangles;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        const auto corner = [&](size_t i) {
            return vec3(instance.objectToWorld * vec4(mesh.positions[mesh.indices[i]], 1.0F));
        };
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const vec3 a = corner(i);
            const bool doubleSided = scene.materials[mesh.material].doubleSided;
            triangles.push_back({a, corner(i + 1) - a, corner(i + 2) - a, doubleSided});
        }
    }
    return triangles;
}

struct Hit {
    float distance = std::numeric_limits<float>::max();
    const Triangle* triangle = nullptr;
};

/// The nearest triangle, either side (T. Möller, B. Trumbore, 1997). Ignores alpha.
Hit castRay(const std::vector<Triangle>& triangles, const vec3& origin, const vec3& direction) {
    Hit hit;
    for (const Triangle& t : triangles) {
        const vec3 p = glm::cross(direction, t.ac);
        const float determinant = glm::dot(t.ab, p);
        if (std::abs(determinant) < 1e-12F) {
            continue;
        }
        const vec3 s = origin - t.a;
        const float u = glm::dot(s, p) / determinant;
        if (u < 0.0F || u > 1.0F) {
            continue;
        }
        const vec3 q = glm::cross(s, t.ab);
        const float v = glm::dot(direction, q) / determinant;
        const float distance = glm::dot(t.ac, q) / determinant;
        if (v >= 0.0F && u + v <= 1.0F && distance > 0.0F && distance < hit.distance) {
            hit = {distance, &t};
        }
    }
    return hit;
}

vec3 faceNormal(const Triangle& t) {
    return glm::normalize(glm::cross(t.ab, t.ac));
}

/// Evenly spaced directions on the sphere (a Fibonacci lattice).
std::vector<vec3> directions(int count) {
    std::vector<vec3> all;
    for (int i = 0; i < count; ++i) {
        const float y = 1.0F - (2.0F * static_cast<float>(i) + 1.0F) / static_cast<float>(count);
        const float phi = 2.3999632F * static_cast<float>(i);
        const float r = std::sqrt(1.0F - y * y);
        all.emplace_back(r * std::cos(phi), y, r * std::sin(phi));
    }
    return all;
}

/// Its directional light, or the strongest sun in the image of its sky.
Sun sunOf(const Scene& scene) {
    std::vector<Lamp> others;
    const ImageSuns found = scene.environment.image ? findImageSuns(*scene.environment.image) : ImageSuns{};
    return withImageSuns(defaultView(scene), found, others).sun;
}

/// A visible point on a coarse grid of the image, and whether the sun reaches it.
struct VisiblePoint {
    vec3 position;
    bool facesSun = false;
    bool sunlit = false;
};

std::vector<VisiblePoint> visiblePoints(const Scene& scene, const std::vector<Triangle>& triangles) {
    const Camera& camera = scene.cameras.front();
    const vec3 toSun = -sunOf(scene).direction;
    const vec3 ahead = glm::normalize(camera.target - camera.position);
    const vec3 right = glm::normalize(glm::cross(ahead, camera.up));
    const vec3 up = glm::cross(right, ahead);
    const float halfHeight = std::tan(0.5F * camera.fovY);
    std::vector<VisiblePoint> points;
    for (int y = 0; y < 14; ++y) {
        for (int x = 0; x < 25; ++x) {
            const vec2 ndc((static_cast<float>(x) + 0.5F) / 12.5F - 1.0F, (static_cast<float>(y) + 0.5F) / 7.0F - 1.0F);
            const vec3 ray = glm::normalize(ahead + halfHeight * (ndc.x * 16.0F / 9.0F * right + ndc.y * up));
            const Hit hit = castRay(triangles, camera.position, ray);
            if (hit.triangle == nullptr) {
                continue;
            }
            vec3 normal = faceNormal(*hit.triangle);
            normal = glm::dot(normal, ray) > 0.0F ? -normal : normal;
            VisiblePoint point{camera.position + hit.distance * ray + 1e-3F * normal};
            point.facesSun = glm::dot(normal, toSun) > 0.0F;
            point.sunlit = point.facesSun && castRay(triangles, point.position, toSun).triangle == nullptr;
            points.push_back(point);
        }
    }
    return points;
}

/// Where a ray from inside exits the box.
vec3 leaves(const Aabb& box, const vec3& origin, const vec3& direction) {
    const vec3 far = glm::mix(box.min, box.max, vec3(glm::greaterThan(direction, vec3(0.0F))));
    const vec3 t = (far - origin) / direction;
    return origin + std::min(t.x, std::min(t.y, t.z)) * direction;
}

class EveryBuiltinScene : public testing::TestWithParam<BuiltinScene> {
protected:
    // The scenes of earlier tests are kept: some take a second to make.
    static const Scene& made(const BuiltinScene& builtin) {
        static std::map<std::string_view, Scene> all;
        const auto found = all.find(builtin.name);
        return found != all.end() ? found->second : all.emplace(builtin.name, builtin.make()).first->second;
    }

    const Scene& scene = made(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Builtin, EveryBuiltinScene, testing::ValuesIn(builtinScenes().begin(), builtinScenes().end()),
                         [](const auto& test) {
                             std::string name(test.param.name);
                             std::erase(name, '-');
                             return name;
                         });

TEST_P(EveryBuiltinScene, CarriesItsOwnName) {
    EXPECT_EQ(scene.name, GetParam().name);
}

TEST_P(EveryBuiltinScene, IsTheSameSceneEveryTime) {
    const auto sameBytes = [](const auto& a, const auto& b) {
        return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
    };
    const Scene again = GetParam().make();
    ASSERT_EQ(again.meshes.size(), scene.meshes.size());
    for (size_t i = 0; i < scene.meshes.size(); ++i) {
        const Mesh& a = scene.meshes[i];
        const Mesh& b = again.meshes[i];
        EXPECT_TRUE(sameBytes(a.positions, b.positions)) << a.name;
        EXPECT_TRUE(sameBytes(a.attributes, b.attributes)) << a.name;
        EXPECT_TRUE(sameBytes(a.indices, b.indices)) << a.name;
        EXPECT_EQ(a.material, b.material) << a.name;
    }
    ASSERT_EQ(again.images.size(), scene.images.size());
    for (size_t i = 0; i < scene.images.size(); ++i) {
        EXPECT_EQ(again.images[i].rgba, scene.images[i].rgba) << scene.images[i].name;
    }
    ASSERT_EQ(again.instances.size(), scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        EXPECT_EQ(again.instances[i].objectToWorld, scene.instances[i].objectToWorld) << scene.instances[i].name;
    }
}

TEST_P(EveryBuiltinScene, IndicesPointAtThingsThatExist) {
    for (const Mesh& mesh : scene.meshes) {
        EXPECT_LT(mesh.material, scene.materials.size()) << mesh.name;
        EXPECT_EQ(mesh.attributes.size(), mesh.positions.size()) << mesh.name;
        EXPECT_EQ(mesh.indices.size() % 3, 0U) << mesh.name;
        EXPECT_FALSE(mesh.indices.empty()) << mesh.name;
        for (const uint32_t index : mesh.indices) {
            ASSERT_LT(index, mesh.positions.size()) << mesh.name;
        }
    }
    for (const Instance& instance : scene.instances) {
        EXPECT_LT(instance.mesh, scene.meshes.size()) << instance.name;
    }
    for (const Material& m : scene.materials) {
        for (const TextureSlot* slot : {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.normalTexture,
                                        &m.occlusionTexture, &m.emissiveTexture}) {
            EXPECT_LT(slot->image, static_cast<int32_t>(scene.images.size())) << m.name;
            EXPECT_LT(slot->sampler, static_cast<int32_t>(scene.samplers.size())) << m.name;
            EXPECT_LT(slot->uvSet, 2U) << m.name;
        }
    }
    for (const TextureImage& image : scene.images) {
        EXPECT_EQ(image.rgba.size(), size_t{4} * image.width * image.height) << image.name;
    }
}

TEST_P(EveryBuiltinScene, NormalsAndTangentsAreUnitLengthAndOrthogonal) {
    for (const Mesh& mesh : scene.meshes) {
        for (const VertexAttributes& a : mesh.attributes) {
            ASSERT_NEAR(glm::length(a.normal), 1.0F, 1e-4F) << mesh.name;
            ASSERT_NEAR(glm::length(vec3(a.tangent)), 1.0F, 1e-4F) << mesh.name;
            ASSERT_NEAR(glm::dot(a.normal, vec3(a.tangent)), 0.0F, 1e-3F) << mesh.name;
            ASSERT_EQ(std::abs(a.tangent.w), 1.0F) << mesh.name;
            ASSERT_TRUE(std::isfinite(a.uv0.x) && std::isfinite(a.uv0.y)) << mesh.name;
        }
    }
}

TEST_P(EveryBuiltinScene, FrontFacesLookTheWayTheirNormalsPoint) {
    for (const Mesh& mesh : scene.meshes) {
        size_t against = 0;
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::array<uint32_t, 3> t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
            const vec3 face =
                glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]);
            const vec3 sum = mesh.attributes[t[0]].normal + mesh.attributes[t[1]].normal + mesh.attributes[t[2]].normal;
            against += glm::dot(face, sum) > 0.0F ? 0 : 1;
        }
        EXPECT_LE(against, mesh.indices.size() / 3 / 500) << mesh.name;
    }
}

TEST_P(EveryBuiltinScene, TangentsPointToGrowingUAndBitangentsToFallingV) {
    for (const Mesh& mesh : scene.meshes) {
        size_t wrong = 0;
        for (size_t i = 0; i < mesh.indices.size(); i += 3) {
            const std::array<uint32_t, 3> t{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]};
            const vec3 p1 = mesh.positions[t[1]] - mesh.positions[t[0]];
            const vec3 p2 = mesh.positions[t[2]] - mesh.positions[t[0]];
            const vec2 uv1 = mesh.attributes[t[1]].uv0 - mesh.attributes[t[0]].uv0;
            const vec2 uv2 = mesh.attributes[t[2]].uv0 - mesh.attributes[t[0]].uv0;
            const float area = uv1.x * uv2.y - uv2.x * uv1.y;
            const vec3 alongU = (p1 * uv2.y - p2 * uv1.y) / area;
            const vec3 alongV = (p2 * uv1.x - p1 * uv2.x) / area;
            for (const uint32_t index : t) {
                const VertexAttributes& a = mesh.attributes[index];
                const vec3 bitangent = a.tangent.w * glm::cross(a.normal, vec3(a.tangent));
                wrong += glm::dot(vec3(a.tangent), alongU) > 0.0F && glm::dot(bitangent, alongV) < 0.0F ? 0 : 1;
            }
        }
        EXPECT_LE(wrong, mesh.indices.size() / 100) << mesh.name;
    }
}

TEST_P(EveryBuiltinScene, BoundsContainAllPositionsTightly) {
    for (const Mesh& mesh : scene.meshes) {
        Aabb exact;
        for (const vec3& p : mesh.positions) {
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)) << mesh.name;
            exact.add(p);
        }
        EXPECT_EQ(mesh.bounds.min, exact.min) << mesh.name;
        EXPECT_EQ(mesh.bounds.max, exact.max) << mesh.name;
    }
}

TEST_P(EveryBuiltinScene, IsSmallEnoughForOneShadowMapAndAFastFrame) {
    const vec3 size = scene.bounds().size();
    if (scene.name == "street") {
        GTEST_SKIP() << "it is large: see BuiltinStreet";
    }
    EXPECT_LT(glm::length(size), scene.name == "quay" ? 500.0F : 30.0F);  // the quay is there for cascades
    EXPECT_LE(worldTriangles(scene).size(), 60000U);
}

TEST_P(EveryBuiltinScene, HasASunOfUnitDirectionAndColoursThatReflectNoMoreThanTheyReceive) {
    const Sun sun = sunOf(scene);
    EXPECT_GT(sun.irradiance.g, 0.0F);
    EXPECT_NEAR(glm::length(sun.direction), 1.0F, 1e-5F);
    EXPECT_LT(sun.direction.y, 0.0F);
    for (const Lamp& lamp : scene.lamps) {
        EXPECT_NEAR(glm::length(lamp.direction), 1.0F, 1e-5F) << lamp.name;
    }
    for (const Material& m : scene.materials) {
        EXPECT_TRUE(glm::all(glm::lessThanEqual(m.baseColor, vec4(1.0F)))) << m.name;
        EXPECT_TRUE(m.roughness >= 0.0F && m.roughness <= 1.0F && m.metallic >= 0.0F && m.metallic <= 1.0F) << m.name;
    }
}

TEST_P(EveryBuiltinScene, CamerasStandInTheOpenAndLookAtTheScene) {
    ASSERT_FALSE(scene.cameras.empty());
    const auto triangles = worldTriangles(scene);
    for (const Camera& camera : scene.cameras) {
        const vec3 ahead = glm::normalize(camera.target - camera.position);
        EXPECT_GT(glm::dot(ahead, scene.bounds().center() - camera.position), 0.0F) << camera.name;
        for (const vec3& direction : directions(80)) {
            const Hit hit = castRay(triangles, camera.position, direction);
            if (hit.triangle == nullptr) {
                continue;
            }
            EXPECT_GT(hit.distance, 2.0F * camera.near) << camera.name;
            // If it hit a back face first, the camera would be inside a solid or below the ground.
            EXPECT_TRUE(hit.triangle->doubleSided || glm::dot(faceNormal(*hit.triangle), direction) < 0.0F)
                << camera.name;
        }
    }
}

TEST_P(EveryBuiltinScene, ShowsSunlitAndShadedPlaces) {
    if (scene.name == "street" && std::getenv("REFLET_ALL_SCENES") == nullptr) {  // NOLINT(concurrency-mt-unsafe)
        GTEST_SKIP() << "hundreds of millions of intersections: only in full runs";
    }
    const auto points = visiblePoints(scene, worldTriangles(scene));
    ASSERT_GT(points.size(), 100U);
    size_t lit = 0;
    size_t shadowed = 0;
    for (const VisiblePoint& p : points) {
        lit += p.sunlit ? 1 : 0;
        shadowed += p.facesSun && !p.sunlit ? 1 : 0;
    }
    EXPECT_GT(lit * 50, points.size());
    EXPECT_GT(shadowed * 100, points.size());
}

TEST(BuiltinCave, LightLeavesOnlyThroughTheShaft) {
    const Scene scene = findBuiltinScene("cave")->make();
    const auto triangles = worldTriangles(scene);
    const Aabb bounds = scene.bounds();
    // Bounds of where the sun's rays to all visible sunlit points enter: the opening.
    Aabb opening;
    for (const VisiblePoint& p : visiblePoints(scene, triangles)) {
        if (p.sunlit) {
            opening.add(leaves(bounds, p.position, -scene.sun->direction));
        }
    }
    ASSERT_FALSE(opening.empty());
    EXPECT_LT(glm::length(opening.size()), 8.0F);
    int escaped = 0;
    const std::array<vec3, 3> places{scene.cameras.front().position, vec3(0.3F, 1.2F, -2.0F), vec3(0.2F, 1.6F, 1.0F)};
    for (const vec3& place : places) {
        for (const vec3& direction : directions(400)) {
            if (castRay(triangles, place, direction).triangle != nullptr) {
                continue;
            }
            ++escaped;
            const vec3 out = leaves(bounds, place, direction);
            EXPECT_TRUE(glm::all(glm::greaterThan(out, opening.min - 1.2F))) << out.x << ' ' << out.y << ' ' << out.z;
            EXPECT_TRUE(glm::all(glm::lessThan(out, opening.max + 1.2F))) << out.x << ' ' << out.y << ' ' << out.z;
        }
    }
    EXPECT_GT(escaped, 0);
    EXPECT_LT(escaped, 120);
}

TEST(BuiltinCornell, IsClosedOnAllSidesButTheFront) {
    const Scene scene = findBuiltinScene("cornell")->make();
    const auto triangles = worldTriangles(scene);
    const vec3 middle(0.0F, 3.2F, 0.0F);
    for (const vec3& direction : directions(1000)) {
        if (castRay(triangles, middle, direction).triangle == nullptr) {
            const vec3 out = leaves(scene.bounds(), middle, direction);
            EXPECT_FLOAT_EQ(out.z, scene.bounds().max.z);
        }
    }
}

TEST(BuiltinMirrorHall, IsClosedOnAllSidesButTheRoof) {
    const Scene scene = findBuiltinScene("mirror-hall")->make();
    const auto triangles = worldTriangles(scene);
    for (const vec3& direction : directions(1000)) {
        if (castRay(triangles, scene.cameras.front().position, direction).triangle == nullptr) {
            EXPECT_GT(direction.y, 0.0F);
        }
    }
}

}  // namespace
}  // namespace builtin_test
}  // namespace reflet
