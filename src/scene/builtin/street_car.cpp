// The car of the built-in scene "street": a body of ellipsoids that melt into one another, meshed as an isosurface,
// with clear-coated paint, dark glass, chrome, tyres and lights. x to the right, z ahead, the ground at y = 0.
#include "scene/builtin/assemble.h"
#include "scene/builtin/street.h"
#include "scene/builtin/surface_nets.h"

#include <array>
#include <cmath>

namespace reflet::builtin::street {
namespace {

constexpr float wheelRadius = 0.33F;
constexpr float axle = 1.22F;   // z
constexpr float track = 0.66F;  // x

// Union with a fillet of about the size k (I. Quilez, smooth minimum, polynomial).
float melt(float a, float b, float k) {
    const float h = std::max(k - std::abs(a - b), 0.0F) / k;
    return std::min(a, b) - 0.25F * h * h * k;
}

// About the distance to |x/a|^n + |y/b|^n + |z/c|^n = 1.
float superellipsoid(const vec3& p, const vec3& size, float n) {
    const vec3 q = glm::abs(p) / size;
    const float r = std::pow(std::pow(q.x, n) + std::pow(q.y, n) + std::pow(q.z, n), 1.0F / n);
    return (r - 1.0F) * std::min({size.x, size.y, size.z});
}

float cabin(const vec3& p) {
    const float narrow = 1.0F - 0.16F * std::max(p.y - 0.85F, 0.0F);
    return superellipsoid((p - vec3(0, 0.74F, -0.28F)) / vec3(narrow, 1, 1), {0.7F, 0.72F, 1.22F}, 2.7F);
}

float hull(const vec3& p) {
    const vec3 m(std::abs(p.x), p.y, p.z);
    float d = superellipsoid(p - vec3(0, 0.5F, 0), {0.68F, 0.34F, 1.95F}, 3.2F);
    d = melt(d, superellipsoid(p - vec3(0, 0.58F, 1.0F), {0.52F, 0.37F, 0.98F}, 2.4F), 0.16F);
    d = melt(d, superellipsoid(p - vec3(0, 0.62F, -1.15F), {0.58F, 0.36F, 0.92F}, 2.4F), 0.16F);
    d = melt(d, cabin(p), 0.12F);
    for (const float z : {axle, -axle}) {
        d = melt(d, superellipsoid(m - vec3(0.62F, 0.44F, z), {0.25F, 0.36F, 0.62F}, 2.3F), 0.1F);
    }
    d = melt(d, superellipsoid(m - vec3(0.72F, 0.29F, 0), {0.12F, 0.05F, 1.0F}, 3.0F), 0.06F);
    d = std::max(d, 0.17F - p.y);
    const float round = glm::length(vec2(p.y - wheelRadius, std::abs(p.z) - axle)) - (wheelRadius + 0.05F);
    const float arch = std::max(round, 0.48F - m.x);
    return std::max(d, -arch);
}

// Negative where the body has windows.
float windows(const vec3& p) {
    const auto area = [](const vec2& q, const vec2& half, float corner) {
        const vec2 d = glm::abs(q) - half + corner;
        return glm::length(glm::max(d, vec2(0))) + std::min(std::max(d.x, d.y), 0.0F) - corner;
    };
    constexpr float middle = 1.13F;  // height
    const float lean = 0.45F * (p.y - middle);
    const float sides = std::min(area({p.z + 0.02F + lean, p.y - middle}, {0.46F, 0.165F}, 0.09F),
                                 area({p.z + 0.93F - 0.6F * lean, p.y - middle}, {0.27F, 0.15F}, 0.09F));
    const float front = std::max(area({p.x, p.y - middle - 0.01F}, {0.53F, 0.17F}, 0.1F), 0.3F - p.z);
    const float back = std::max(area({p.x, p.y - middle - 0.02F}, {0.44F, 0.14F}, 0.1F), p.z + 1.0F);
    return std::min({std::max(sides, 0.25F - std::abs(p.x)), front, back});
}

using Field = std::function<float(const vec3&)>;

// Moves the vertices onto the surface, so that reflections are smooth.
Mesh smoothNets(const Lattice& lattice, const Field& field) {
    Mesh mesh = surfaceNets(lattice, field);
    constexpr float h = 2e-3F;
    for (size_t i = 0; i < mesh.positions.size(); ++i) {
        vec3& p = mesh.positions[i];
        vec3 slope(0.0F);
        for (int step = 0; step < 2; ++step) {
            for (int axis = 0; axis < 3; ++axis) {
                vec3 e(0.0F);
                e[axis] = h;
                slope[axis] = (field(p + e) - field(p - e)) / (2.0F * h);
            }
            const float squared = std::max(glm::dot(slope, slope), 0.05F);
            const vec3 move = field(p) * slope / squared;
            p -= move * std::min(1.0F, 0.4F * lattice.cell / std::max(glm::length(move), 1e-6F));
        }
        if (glm::length(slope) > 1e-3F) {
            mesh.attributes[i].normal = glm::normalize(slope);
        }
    }
    return boxMapped(mesh, 1.0F);
}

void addBody(Scene& scene, const mat4& toWorld) {
    const Lattice lattice{{-1.0F, 0.1F, -2.2F}, 0.03F, {67, 48, 147}};
    Material paint = plain("car paint", {0xB01216, 0.42F, 0.25F});
    paint.clearcoat = {.factor = 1.0F, .roughness = 0.03F};
    paint.doubleSided = true;
    const Field body = [](const vec3& p) { return std::max(hull(p), -windows(p)); };
    place(scene, "car body", addMaterial(scene, paint), smoothNets(lattice, body), toWorld);
    const Lattice upper{{-0.85F, 0.8F, -1.7F}, 0.035F, {49, 22, 86}};
    const Field glass = [](const vec3& p) { return std::max(cabin(p) + 0.018F, 0.86F - p.y); };
    place(scene, "car glass", addMaterial(scene, plain("car glass", {0x050708, 0.03F})), smoothNets(upper, glass),
          toWorld);
}

void addWheels(Scene& scene, const mat4& toWorld) {
    static constexpr std::array<vec2, 9> tyre{
        vec2(0.2F, -0.09F),        vec2(0.27F, -0.1F),       vec2(wheelRadius - 0.02F, -0.085F),
        vec2(wheelRadius, -0.05F), vec2(wheelRadius, 0.05F), vec2(wheelRadius - 0.02F, 0.085F),
        vec2(0.27F, 0.1F),         vec2(0.2F, 0.09F),        vec2(0.18F, 0.05F)};
    static constexpr std::array<vec2, 7> cap{vec2(0.205F, 0.02F), vec2(0.2F, 0.07F), vec2(0.17F, 0.05F),
                                             vec2(0.13F, 0.07F),  vec2(0.11F, 0.1F), vec2(0.06F, 0.125F),
                                             vec2(0, 0.13F)};
    const uint32_t rubber =
        addMesh(scene, "tyre", addMaterial(scene, plain("tyre", {0x121214, 0.55F})), lathe(tyre, 48));
    const uint32_t chrome =
        addMesh(scene, "hub cap", addMaterial(scene, plain("hub cap", {0xD8DADC, 0.12F, 1.0F})), lathe(cap, 40));
    for (const float x : {-track, track}) {
        for (const float z : {-axle, axle}) {
            const mat4 wheel = toWorld * at({x, wheelRadius - 0.01F, z}) * turned(x > 0.0F ? -90.0F : 90.0F, {0, 0, 1});
            place(scene, "tyre", rubber, wheel);
            place(scene, "hub cap", chrome, wheel);
        }
    }
}

// A bumper of a bent tube; ahead: +1, at the back: -1.
std::vector<vec3> bumperLine(float end) {
    std::vector<vec3> line;
    for (int i = 0; i <= 16; ++i) {
        const float x = -0.86F + 1.72F * static_cast<float>(i) / 16.0F;
        const float curve = std::pow(std::abs(x) / 0.86F, 3.0F);
        line.emplace_back(x, 0.4F, end * (2.07F - 0.42F * curve));
    }
    return line;
}

void addChrome(Scene& scene, const mat4& toWorld) {
    Mesh mesh;
    for (const float end : {-1.0F, 1.0F}) {
        append(mesh, tube(bumperLine(end), 0.045F, 12), mat4(1.0F));
        for (const float x : {-0.4F, 0.4F}) {
            append(mesh, roundedBox({0.035F, 0.11F, 0.05F}, 0.03F, 3), at({x, 0.42F, end * 2.04F}));
        }
    }
    for (const float s : {-1.0F, 1.0F}) {
        append(mesh, sphere(0.012F, 8), at({s * 0.8F, 0.8F, 0.2F}));
        append(mesh, roundedBox({0.018F, 0.02F, 0.075F}, 0.012F, 2), at({s * 0.72F, 0.86F, -0.3F}));  // handles
        append(mesh, sphere(0.075F, 20), at({s * 0.82F, 1.0F, 0.52F}));                               // mirrors
        append(mesh, cylinder(0.012F, 0.2F, 8), between({s * 0.66F, 0.92F, 0.5F}, {s * 0.82F, 1.0F, 0.52F}));
        append(mesh, cylinder(0.035F, 0.2F, 14), at({s * 0.3F, 0.27F, -1.9F}) * turned(-90, {1, 0, 0}));  // exhausts
    }
    place(scene, "car chrome", addMaterial(scene, plain("chrome", {0xE0E2E4, 0.08F, 1.0F})), mesh, toWorld);
}

void addCarLights(Scene& scene, const mat4& toWorld) {
    static constexpr std::array<vec2, 5> lens{vec2(0.11F, 0), vec2(0.105F, 0.03F), vec2(0.08F, 0.055F),
                                              vec2(0.04F, 0.068F), vec2(0, 0.07F)};
    static constexpr std::array<vec2, 4> rim{vec2(0.12F, -0.04F), vec2(0.128F, 0.0F), vec2(0.12F, 0.02F),
                                             vec2(0.108F, 0.01F)};
    const uint32_t tail =
        addMesh(scene, "tail light", addGlow(scene, "tail light", {5.5F, 0.12F, 0.06F}), lathe(lens, 24));
    const uint32_t head =
        addMesh(scene, "head light", addGlow(scene, "head light", {3.0F, 2.5F, 1.8F}), lathe(lens, 24));
    const uint32_t ring =
        addMesh(scene, "light rim", addMaterial(scene, plain("light rim", {0xE0E2E4, 0.1F, 1.0F})), lathe(rim, 24));
    for (const float s : {-1.0F, 1.0F}) {
        const mat4 back =
            toWorld * at({s * 0.64F, 0.6F, -1.79F}) * turned(-78, {1, 0, 0}) * turned(s * -8.0F, {0, 0, 1});
        const mat4 front = toWorld * at({s * 0.64F, 0.62F, 1.78F}) * turned(74, {1, 0, 0});
        place(scene, "tail light", tail, back * glm::scale(mat4(1.0F), vec3(0.9F)));
        place(scene, "light rim", ring, back * glm::scale(mat4(1.0F), vec3(0.9F)));
        place(scene, "head light", head, front);
        place(scene, "light rim", ring, front);
    }
    Canvas plate("number plate", 96, 24, 0xE8E4D8);
    plate.text("F1ACE55", {48, 12}, 1, 0x1A1A1A);
    place(scene, "number plate", addMaterial(scene, textured("number plate", addTexture(scene, plate.finish()), 0.4F)),
          box({0.24F, 0.055F, 0.01F}), toWorld * at({0, 0.57F, -2.03F}) * turned(180));
}

}  // namespace

void addCar(Scene& scene, const mat4& carToWorld) {
    addBody(scene, carToWorld);
    addWheels(scene, carToWorld);
    addChrome(scene, carToWorld);
    addCarLights(scene, carToWorld);
}

}  // namespace reflet::builtin::street
