// Scene bounds, the default view, and a camera's view and projection matrices.
#include "scene/scene.h"

#include "base/error.h"
#include "scene/framing.h"
#include "scene/gltf/normals.h"
#include "scene/pose.h"

#include <algorithm>
#include <cmath>

namespace reflet {
namespace {

constexpr vec3 worldUp{0, 1, 0};

/// `up`, or an axis that is not parallel to `forward` if `up` is.
vec3 usableUp(const vec3& forward, const vec3& up) {
    const float sine = glm::length(glm::cross(forward, up));
    if (sine > 1e-4F * glm::length(up)) {
        return up;
    }
    return std::abs(forward.y) < 0.9F ? worldUp : vec3(0, 0, -1);
}

vec3 viewDirection(const Camera& camera) {
    const vec3 toTarget = camera.target - camera.position;
    const float distance = glm::length(toTarget);
    return distance > 0.0F ? toTarget / distance : vec3(0, 0, -1);
}

}  // namespace

// From behind the camera's left shoulder, 53° above the horizon: shadows fall to the right and stay in the image.
Sun defaultSun(const Camera& camera) {
    const vec3 forward = viewDirection(camera);
    vec3 ahead{forward.x, 0.0F, forward.z};
    if (glm::length(ahead) < 1e-3F) {  // looks straight up or down: use the image's up direction
        const vec3 up = usableUp(forward, camera.up);
        ahead = {up.x, 0.0F, up.z};
    }
    ahead = glm::normalize(ahead);
    const vec3 right = glm::cross(ahead, worldUp);
    Sun sun;
    sun.direction = glm::normalize(0.6F * ahead + 0.45F * right - worldUp);
    sun.irradiance = vec3(glm::pi<float>());
    return sun;
}

namespace {

bool isLit(const Scene& scene) {
    // Emissive surfaces do not count: a glowing lamp on a robot does not light the robot.
    const Environment& environment = scene.environment;
    return scene.sun || !scene.lamps.empty() || environment.image || environment.radiance != vec3(0.0F);
}

}  // namespace

void Mesh::addSkin(std::span<const JointWeight> joints) {
    const auto first = static_cast<uint32_t>(jointWeights.size());
    for (const JointWeight& moved : joints) {
        if (moved.weight > 0.0F) {
            jointWeights.push_back(moved);
        }
    }
    skin.push_back({first, static_cast<uint32_t>(jointWeights.size()) - first});
}

Aabb Scene::bounds() const {
    const ScenePose pose = scenePose(*this, 0.0);
    Aabb result;
    for (size_t i = 0; i < instances.size(); ++i) {
        const int32_t skin = instances[i].skin;
        const size_t joints = skin < 0 ? 0 : skins[static_cast<size_t>(skin)].joints.size();
        result.add(instanceBounds(*this, pose, i, jointBounds(meshes.at(instances[i].mesh), joints)));
    }
    return result;
}

std::array<vec3, 2> uvTransformOf(const vec2& offset, double rotation, const vec2& scale) {
    const double cosine = std::cos(rotation);
    const double sine = std::sin(rotation);
    return {vec3(cosine * scale.x, sine * scale.y, offset.x), vec3(-sine * scale.x, cosine * scale.y, offset.y)};
}

void setTransform(Camera& camera, const mat4& toWorld) {
    camera.position = vec3(toWorld[3]);
    const vec3 forward = unitOr(-vec3(toWorld[2]), vec3(0, 0, -1));
    const vec3 up = vec3(toWorld[1]) - forward * glm::dot(vec3(toWorld[1]), forward);
    camera.up = unitOr(up, perpendicular(forward));
    // Far enough ahead that target and position differ in float precision.
    const float farthest =
        std::max({1.0F, std::abs(camera.position.x), std::abs(camera.position.y), std::abs(camera.position.z)});
    camera.target = camera.position + forward * (farthest < 1000.0F ? 1.0F : farthest / 1000.0F);
}

void setTransform(Lamp& lamp, const mat4& toWorld) {
    lamp.position = vec3(toWorld[3]);
    lamp.direction = unitOr(-vec3(toWorld[2]), vec3(0, 0, -1));
}

float lampClearance(float radius) {
    return std::max(radius, 1e-3F);
}

bool isUnlit(const Scene& scene) {
    return !scene.instances.empty() && std::ranges::all_of(scene.instances, [&](const Instance& instance) {
        const size_t material = scene.meshes.at(instance.mesh).material;
        return material < scene.materials.size() && scene.materials[material].unlit;
    });
}

View defaultView(const Scene& scene, float aspect) {
    View view;
    view.origin = scene.origin;
    view.camera = scene.cameras.empty() ? framingCamera(scene, aspect) : scene.cameras.front();
    view.hasDefaultSun = !isLit(scene) && !isUnlit(scene);
    view.sun = view.hasDefaultSun ? defaultSun(view.camera) : scene.sun.value_or(Sun{});
    view.environment = scene.environment;
    return view;
}

View defaultView(const Scene& scene) {
    return defaultView(scene, 16.0F / 9.0F);
}

mat4 worldToView(const Camera& camera) {
    const vec3 back = -viewDirection(camera);
    const vec3 right = glm::normalize(glm::cross(usableUp(-back, camera.up), back));
    const vec3 up = glm::cross(back, right);
    const mat3 worldToViewRotation = glm::transpose(mat3(right, up, back));
    mat4 result(worldToViewRotation);
    result[3] = vec4(worldToViewRotation * -camera.position, 1.0F);
    return result;
}

mat4 viewToClip(const Camera& camera, float aspect) {
    REFLET_CHECK(aspect > 0.0F, "aspect {}", aspect);
    mat4 result(0.0F);  // result[column][row]
    if (camera.orthographicHeight > 0.0F) {
        REFLET_CHECK(camera.far > camera.near, "near {}, far {}", camera.near, camera.far);
        const float scale = 2.0F / camera.orthographicHeight;
        const float depthScale = 1.0F / (camera.far - camera.near);
        result[0][0] = scale / aspect;
        result[1][1] = -scale;  // clip y points down
        result[2][2] = depthScale;
        result[3][2] = camera.far * depthScale;
        result[3][3] = 1.0F;
        return result;
    }
    REFLET_CHECK(camera.near > 0.0F && camera.fovY > 0.0F, "near {}, fovY {}", camera.near, camera.fovY);
    const float scale = 1.0F / std::tan(0.5F * camera.fovY);
    result[0][0] = scale / aspect;
    result[1][1] = -scale;       // clip y points down
    result[3][2] = camera.near;  // clip.z = near
    result[2][3] = -1.0F;        // clip.w = -z_view, the distance along the view: depth = near / distance
    return result;
}

}  // namespace reflet
