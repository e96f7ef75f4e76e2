// Lights of the built-in scene "quay": all are small, and those of the posts and of the crane are lamps, too.
#include "scene/builtin/animate.h"
#include "scene/builtin/assemble.h"
#include "scene/builtin/quay.h"

#include <array>
#include <span>
#include <string>

namespace reflet::builtin {
namespace {

constexpr float postHeight = 3.4F;
constexpr int nearPosts = 7;  // with the lantern as many lamps as have shadows by default
constexpr float bulbRadius = 0.06F;
constexpr float pearlRadius = 0.025F;  // of a bulb on a string
constexpr vec3 warm{1.0F, 0.62F, 0.28F};

Material glowing(const std::string& name, const vec3& radiance) {
    Material m = plain(name, {0x000000, 0.9F});
    m.emissive = radiance;
    return m;
}

void addPosts(Scene& scene, const Along& edge) {
    const uint32_t iron = addMaterial(scene, plain("iron", {0x23282B, 0.45F, 0.0F}));
    Mesh post;
    append(post, cylinder(0.13F, 0.35F, 12), mat4(1.0F));
    append(post, cylinder(0.05F, postHeight, 12), mat4(1.0F));
    append(post, cylinder(0.025F, 0.7F, 8), between({0, postHeight - 0.1F, 0}, {1, postHeight - 0.05F, 0}));
    static constexpr std::array<vec2, 4> shade{vec2(0.17F, 0.05F), vec2(0.06F, 0.16F), vec2(0.03F, 0.24F),
                                               vec2(0.0F, 0.24F)};
    append(post, lathe(shade, 16), at({0.68F, postHeight - 0.3F, 0}));
    finish(post);
    const uint32_t postMesh = addMesh(scene, "post", iron, post);
    const uint32_t bulb =
        addMesh(scene, "bulb", addMaterial(scene, glowing("bulb", 60.0F * warm)), sphere(bulbRadius, 12));
    static constexpr std::array<vec2, 6> bollardOutline{vec2(0, 0),         vec2(0.2F, 0),    vec2(0.13F, 0.1F),
                                                        vec2(0.12F, 0.32F), vec2(0.2F, 0.4F), vec2(0, 0.48F)};
    const uint32_t bollard = addMesh(scene, "bollard", iron, lathe(bollardOutline, 16));
    const float x = edge.x + 0.9F;
    int number = 0;
    for (float z = edge.from - 15.5F; z > edge.to; z -= 13.0F, ++number) {
        const std::string name = std::to_string(number);
        place(scene, "post " + name, postMesh, at({x, 0, z}));
        place(scene, "bollard " + name, bollard, at({x - 0.45F, 0, z - 6.5F}));
        const vec3 light(x + 0.68F, postHeight - 0.28F, z);
        place(scene, "bulb " + name, bulb, at(light));
        if (number >= nearPosts) {
            continue;  // its bulb is a few pixels, and its light on the ground fewer
        }
        Lamp lamp;
        lamp.name = "post " + name;
        lamp.position = light;
        lamp.intensity = 9.0F * warm;
        lamp.range = 9.0F;
        lamp.radius = bulbRadius;
        scene.lamps.push_back(lamp);
    }
}

// From posts at the edge to posts before the houses, sagging.
void addStrings(Scene& scene, const Along& edge) {
    static constexpr std::array<vec3, 4> colors{vec3(1.0F, 0.55F, 0.2F), vec3(1.0F, 0.2F, 0.12F),
                                                vec3(0.25F, 0.9F, 0.5F), vec3(0.3F, 0.5F, 1.0F)};
    std::array<uint32_t, colors.size()> pearls{};
    for (size_t i = 0; i < colors.size(); ++i) {
        const std::string name = "pearl " + std::to_string(i);
        pearls[i] = addMesh(scene, name, addMaterial(scene, glowing(name, 60.0F * colors[i])), sphere(pearlRadius, 8));
    }
    const uint32_t cord = addMaterial(scene, plain("cord", {0x1B1A19, 0.9F}));
    constexpr int links = 22;
    for (int s = 0; s < 5; ++s) {
        const float z = edge.from - 15.5F - 13.0F * static_cast<float>(s);
        const vec3 from(edge.x + 0.9F, postHeight, z);
        const vec3 to(edge.x + 17.3F, 4.2F, z - 4.0F);
        Mesh line;
        vec3 last = from;
        for (int i = 1; i <= links; ++i) {
            const float t = static_cast<float>(i) / links;
            const vec3 next = glm::mix(from, to, t) - vec3(0, 3.2F * t * (1.0F - t), 0);
            append(line, cylinder(0.008F, glm::distance(last, next), 4), between(last, next));
            if (i < links) {
                place(scene, "pearl", pearls.at(size_t(i + s) % pearls.size()), at(next - vec3(0, 0.04F, 0)));
            }
            last = next;
        }
        finish(line);
        place(scene, "string " + std::to_string(s), cord, line);
    }
}

// Swings about the tip of the crane's arm, with a lamp.
void addCrane(Scene& scene) {
    constexpr vec3 foot(-3.3F, 0, 1.5F);
    constexpr vec3 tip(0.1F, 4.6F, 0.9F);
    constexpr float rope = 2.4F;
    const uint32_t wood = addMaterial(scene, plain("crane", {0x5B4636, 0.8F}));
    Mesh crane;
    append(crane, box({0.14F, 2.4F, 0.14F}), at(foot + vec3(0, 2.4F, 0)));
    append(crane, box({0.5F, 0.12F, 0.5F}), at(foot + vec3(0, 0.12F, 0)));
    append(crane, cylinder(0.09F, glm::distance(foot + vec3(0, 3.2F, 0), tip), 8),
           between(foot + vec3(0, 3.2F, 0), tip));
    append(crane, cylinder(0.02F, glm::distance(foot + vec3(0, 4.8F, 0), tip), 6),
           between(foot + vec3(0, 4.8F, 0), tip));
    finish(crane);
    place(scene, "crane", wood, crane);

    const int32_t pivot = addNode(scene, tip);
    Channel channel{.target = Channel::Target::rotation,
                    .interpolation = Interpolation::cubicSpline,
                    .times = {0.0F, 1.0F, 2.0F, 3.0F, 4.0F},
                    .values = {}};
    constexpr std::array<double, 5> angles{0.0, 26.0, 0.0, -26.0, 0.0};
    constexpr std::array<float, 5> speeds{0.35F, 0.0F, -0.35F, 0.0F, 0.35F};
    for (size_t i = 0; i < angles.size(); ++i) {
        const vec4 speed(0, 0, speeds.at(i), 0);
        channel.values.insert(channel.values.end(), {speed, rotation(angles.at(i), {0, 0, 1}), speed});
    }
    animate(scene, pivot, std::move(channel));
    const int32_t lantern = addNode(scene, {0, -rope, 0}, pivot);

    const uint32_t iron = addMaterial(scene, plain("lantern", {0x2A2A2A, 0.5F}));
    Mesh frame;
    append(frame, cylinder(0.012F, rope - 0.2F, 6), at({0, 0.2F, 0}));
    append(frame, box({0.16F, 0.02F, 0.16F}), at({0, 0.2F, 0}));
    append(frame, box({0.16F, 0.02F, 0.16F}), at({0, -0.2F, 0}));
    for (int i = 0; i < 4; ++i) {
        append(frame, box({0.012F, 0.2F, 0.012F}), at({i % 2 == 0 ? -0.14F : 0.14F, 0, i < 2 ? -0.14F : 0.14F}));
    }
    finish(frame);
    const mat4 rest = at(tip - vec3(0, rope, 0));
    place(scene, "lantern", iron, frame, rest);
    scene.instances.back().node = lantern;
    place(scene, "flame", addMaterial(scene, glowing("flame", 90.0F * warm)), sphere(0.07F, 16), rest);
    scene.instances.back().node = lantern;
    Lamp lamp;
    lamp.name = "lantern";
    lamp.position = vec3(rest[3]);
    lamp.intensity = 20.0F * warm;
    lamp.range = 14.0F;
    lamp.radius = 0.07F;
    lamp.node = lantern;
    scene.lamps.push_back(lamp);
}

// On a pier in the water.
void addBeacon(Scene& scene) {
    static constexpr std::array<vec2, 6> pier{vec2(9, -3),      vec2(7, 0.4F),  vec2(0, 0.4F),
                                              vec2(2.2F, 0.4F), vec2(1.4F, 13), vec2(0, 13)};
    const uint32_t rock = addMaterial(scene, plain("pier", {0x5E5B55, 0.9F}));
    const uint32_t white = addMaterial(scene, plain("tower", {0xD8D2C6, 0.7F}));
    const uint32_t red = addMaterial(scene, plain("tower roof", {0x8C2A20, 0.6F}));
    const vec3 foot(-58, 0, -150);
    place(scene, "pier", rock, lathe(std::span(pier).first(3), 24), at(foot));
    place(scene, "tower", white, lathe(std::span(pier).last(3), 24), at(foot));
    static constexpr std::array<vec2, 4> gallery{vec2(0, 12.9F), vec2(1.8F, 12.9F), vec2(1.8F, 13.15F),
                                                 vec2(0, 13.15F)};
    static constexpr std::array<vec2, 3> roof{vec2(0, 14.5F), vec2(1.5F, 14.5F), vec2(0, 15.9F)};
    place(scene, "gallery", red, lathe(gallery, 24), at(foot));
    place(scene, "tower roof", red, lathe(roof, 24), at(foot));
    place(scene, "beacon", addMaterial(scene, glowing("beacon", vec3(14.0F, 11.0F, 7.0F))), cylinder(0.9F, 1.35F, 16),
          at(foot + vec3(0, 13.15F, 0)));
}

}  // namespace

void addQuayLights(Scene& scene, const Along& edge) {
    addPosts(scene, edge);
    addStrings(scene, edge);
    addCrane(scene);
    addBeacon(scene);
}

}  // namespace reflet::builtin
