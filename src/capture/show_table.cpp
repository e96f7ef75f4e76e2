// The table of shows: where their values come from, and how they become pictures.
#include "capture/show.h"

#include "base/color.h"
#include "effects/shadow/shadow.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace reflet {

namespace {

using enum ShowProperty;

using Texels = std::span<const vec4>;
using Images = std::vector<gpu::Image>;

// From texels to values.
void first(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].x;
}
// Negative where no blocker was found: the magnitude is the upper bound of the width.
void penumbraWidth(Texels t, const ShownPixel&, float* out) {
    out[0] = std::max(t[0].x, 0.0F);
}
void cascade(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].x * static_cast<float>(maxCascades - 1);
}
// The G-buffer has no motion where there is no surface: there it is that of a direction, which turns with the camera.
// An orthographic camera sees one direction everywhere.
void motion(Texels t, const ShownPixel& at, float* out) {
    vec2 moved(t[0]);
    if (!(t[1].x > 0.0F) && at.rendered.eye.w != 0.0F) {
        const vec4 ahead = at.rendered.clipToWorld * vec4(2.0F * at.uv - 1.0F, 0.0F, 1.0F);
        // By both matrices, so that a camera at rest gives exactly 0.
        const vec4 now = at.rendered.worldToClip * vec4(vec3(ahead), 0.0F);
        const vec4 before = at.rendered.previousWorldToClip * vec4(vec3(ahead), 0.0F);
        moved = before.w > 0.0F ? 0.5F * (vec2(now) / now.w - vec2(before) / before.w) : vec2(0.0F);
    }
    std::memcpy(out, &moved, sizeof(moved));
}
void color(Texels t, const ShownPixel&, float* out) {
    std::memcpy(out, t.data(), 3 * sizeof(float));
}
// As unpackBaseColor in gbuffer.glsl: stored as a square root.
void squaredColor(Texels t, const ShownPixel&, float* out) {
    const vec3 c = vec3(t[0]) * vec3(t[0]);
    std::memcpy(out, &c, sizeof(c));
}
void green(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].y;
}
void blue(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].z;
}
void alpha(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].w;
}
void bothAlphas(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].w;
    out[1] = t[1].w;
}
void bothFirsts(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].x;
    out[1] = t[1].x;
}
void firstTwo(Texels t, const ShownPixel&, float* out) {
    out[0] = t[0].x;
    out[1] = t[0].y;
}
// Of each image: the sum over rays that hit, and their share. Shares have 8 bits.
void hitDistances(Texels t, const ShownPixel&, float* out) {
    constexpr float leastShare = 1.0F / 512.0F;
    for (size_t i = 0; i < t.size(); ++i) {
        out[i] = t[i].y > leastShare ? t[i].x / t[i].y : 0.0F;
    }
}
void meanColor(Texels t, const ShownPixel&, float* out) {
    const vec3 mean = 0.5F * vec3(t[0] + t[1]);
    std::memcpy(out, &mean, sizeof(mean));
}
void viewDistance(Texels t, const ShownPixel& at, float* out) {
    const vec4& d = at.view.depthToDistance;
    out[0] = t[0].x > 0.0F ? (d.x + d.y * t[0].x) / (d.z + d.w * t[0].x) : 0.0F;
}
// Where there is no surface (depth 0), a cleared normal would decode to +Z.
void normal(Texels t, const ShownPixel&, float* out) {
    const vec3 n = t[1].x > 0.0F ? vec3(t[0]) : vec3(0.0F);
    std::memcpy(out, &n, sizeof(n));
}

// From values to display RGB.
vec3 encoded(const float* v) {
    return {encodeSrgb(v[0]), encodeSrgb(v[1]), encodeSrgb(v[2])};
}
vec3 grey(const float* v) {
    return vec3(std::clamp(v[0], 0.0F, 1.0F));
}
vec3 redGreen(const float* v) {
    return {std::clamp(v[0], 0.0F, 1.0F), std::clamp(v[1], 0.0F, 1.0F), 0.0F};
}
vec3 asIs(const float* v) {
    return glm::clamp(vec3(v[0], v[1], v[2]), 0.0F, 1.0F);
}
vec3 direction(const float* v) {
    return 0.5F + 0.5F * vec3(v[0], v[1], v[2]);
}
vec3 offsets(const float* v) {
    return glm::clamp(vec3(0.5F + 10.0F * v[0], 0.5F + 10.0F * v[1], 0.5F), 0.0F, 1.0F);
}
float nearness(float metres) {
    return metres > 0.0F ? 4.0F / (4.0F + metres) : 0.0F;
}
vec3 near(const float* v) {
    return vec3(nearness(v[0]));
}
vec3 nearRedGreen(const float* v) {
    return {nearness(v[0]), nearness(v[1]), 0.0F};
}
vec3 farAndNear(const float* v) {
    const float radius = v[0] / 16.0F;
    return glm::clamp(vec3(radius, 0.0F, -radius), 0.0F, 1.0F);
}
vec3 streakColor(const float* v) {
    return glm::clamp(vec3(0.5F + v[0] / 64.0F, 0.5F + v[1] / 64.0F, 0.5F), 0.0F, 1.0F);
}
constexpr float manySteps = 128.0F;
vec3 count(const float* v) {
    return vec3(std::clamp(v[0] / manySteps, 0.0F, 1.0F));
}
vec3 countRedGreen(const float* v) {
    return {count(v).x, count(v + 1).x, 0.0F};
}
vec3 lampsCounted(const float* v) {
    return vec3(std::clamp(v[0] / 32.0F, 0.0F, 1.0F));
}
constexpr float manyRays = 8.0F;
vec3 raysCounted(const float* v) {
    return vec3(std::clamp(v[0] / manyRays, 0.0F, 1.0F));
}
vec3 raysCountedRedGreen(const float* v) {
    return {raysCounted(v).x, raysCounted(v + 1).x, 0.0F};
}
vec3 classColor(const float* v) {
    constexpr vec3 colors[] = {{0.25F, 0.45F, 0.9F}, {0.6F, 0.6F, 0.6F}, {0.9F, 0.6F, 0.2F}, {0.2F, 0.8F, 0.85F}};
    return colors[std::clamp(static_cast<int>(v[0]), 0, 3)];
}
vec3 framesCounted(const float* v) {
    return vec3(std::clamp(v[0] / 32.0F, 0.0F, 1.0F));
}
vec3 cascadeColor(const float* v) {
    constexpr vec3 colors[maxCascades] = {
        {0.9F, 0.3F, 0.25F}, {0.3F, 0.75F, 0.35F}, {0.3F, 0.45F, 0.9F}, {0.9F, 0.8F, 0.3F}};
    const float at = std::clamp(v[0], 0.0F, static_cast<float>(maxCascades - 1));
    const auto first = static_cast<uint>(at);
    return glm::mix(colors[first], colors[std::min(first + 1, maxCascades - 1)], at - std::floor(at));
}
vec3 mapDepth(const float* v) {
    return vec3(v[0]);
}

const std::vector<std::string> rgb{"R", "G", "B"};
const std::vector<std::string> xyz{"X", "Y", "Z"};
const std::vector<std::string> xy{"X", "Y"};
const std::vector<std::string> rg{"R", "G"};
const std::vector<std::string> y{"Y"};

// A line each.
const std::vector<Show>& table() {
    static const std::vector<Show> all{
        {"final", "the final image: radiance; PNG tone mapped",
         [](const FrameImages& i) { return Images{i.light.lit}; }, color, rgb, nullptr, radiance},
        {"unfiltered", "final before temporal antialiasing (TAA): radiance",
         [](const FrameImages& i) { return Images{i.unfiltered}; }, color, rgb, encoded, radiance},
        {"temporal_frames",
         "number of frames accumulated in the pixel's history; PNG 1 is 32 frames; only with temporal.enabled",
         [](const FrameImages& i) { return Images{i.temporal}; }, alpha, y, framesCounted},
        {"circle_of_confusion",
         "signed radius of the circle of confusion in pixels, negative in front of the plane of focus; PNG red far, "
         "blue "
         "near, 1 is 16 pixels; only with a camera that has an aperture",
         [](const FrameImages& i) { return Images{i.circleOfConfusion}; }, first, y, farAndNear},
        {"velocity_tiles",
         "longest half streak of motion blur in each tile and those around it, in pixels; one texel per tile; PNG 0.5 "
         "is 0, 1 is 32 pixels; only with motion_blur.enabled",
         [](const FrameImages& i) { return Images{i.velocityTiles}; }, firstTwo, xy, streakColor, ownSize},
        {"direct", "direct light of sun and lamps, emission and background: radiance",
         [](const FrameImages& i) { return Images{i.direct}; }, color, rgb, encoded, radiance},
        {"indirect_diffuse", "indirect diffuse light: radiance",
         [](const FrameImages& i) { return Images{i.light.indirectDiffuse}; }, color, rgb, encoded, radiance},
        {"indirect_specular", "indirect specular light (reflections): radiance",
         [](const FrameImages& i) { return Images{i.light.indirectSpecular}; }, color, rgb, encoded, radiance},
        {"diffuse_radiance", "mean incoming radiance of the diffuse rays, without the surface's colour",
         [](const FrameImages& i) { return Images{i.diffuse.radiance}; }, color, rgb, encoded, radiance},
        {"specular_radiance", "mean incoming radiance of the reflection rays, without the surface's colour",
         [](const FrameImages& i) { return Images{i.specular.radiance}; }, color, rgb, encoded, radiance},
        {"ambient_occlusion",
         "share of directions in which nothing is near (ao.radius), cosine-weighted: 1 open, 0 covered",
         [](const FrameImages& i) { return Images{i.ambientOcclusion}; }, alpha, y, grey},
        {"bent_normal", "mean direction in which nothing is near (ao.radius), world space; PNG as normal",
         [](const FrameImages& i) { return Images{i.ambientOcclusion}; }, color, xyz, direction},
        {"sun_visibility", "visibility of the sun: 0 in shadow, 1 lit",
         [](const FrameImages& i) { return Images{i.sunVisibility}; }, first, y, grey},
        {"sun_visibility_raw", "sun_visibility before denoising",
         [](const FrameImages& i) { return Images{i.rawSunVisibility}; }, first, y, grey},
        {"penumbra_width",
         "full width of the sun's penumbra in metres, perpendicular to its direction; PNG 1 is a metre; only with "
         "shadow.filter pcf or pcss",
         [](const FrameImages& i) { return Images{i.shadowPenumbra}; }, penumbraWidth, y, grey},
        {"blocker_distance",
         "mean distance to the sun's blockers in metres, along the direction to the sun; 0: none found, or no search "
         "needed; PNG bright is near; only with shadow.filter=pcss",
         [](const FrameImages& i) { return Images{i.shadowPenumbra}; }, green, y, near},
        {"cascade_index",
         "shadow map cascade of the surface, 0 the nearest, fractional where two blend; the sky has the last; PNG red, "
         "green, blue, yellow; only with shadow.cascades above 1",
         [](const FrameImages& i) { return Images{i.cascadeIndex}; }, cascade, y, cascadeColor},
        {"shadow_map",
         "depth in the sun's shadow map, 1 nearest to the sun, 0 empty; in the map's size, cascades in rows of two",
         [](const FrameImages& i) { return i.shadowMap ? Images{i.shadowMap} : Images{i.sunVisibility}; }, first, y,
         mapDepth, ownSize},
        {"lamp_visibility",
         "visibility of lamps: 0 in shadow or out of range, 1 lit: R, G, B the three strongest lamps that cast "
         "shadows; only where lamps cast shadows",
         [](const FrameImages& i) { return Images{i.lampVisibility}; }, color, rgb, asIs},
        {"lamp_count",
         "number of lamps that may light a tile of 16x16 pixels; one texel per tile; PNG 1 is 32 lamps; only with "
         "lamps",
         [](const FrameImages& i) { return Images{i.lampTiles.count}; }, first, y, lampsCounted, ownSize},
        {"depth", "view-space depth in metres, 0 without a surface; PNG bright is near",
         [](const FrameImages& i) { return Images{i.g.depth}; }, viewDistance, y, near},
        {"back_depth",
         "view-space depth in metres of the nearest back face behind the surface, 0 none; PNG bright is near; only "
         "with trace_screen.thickness_mode=second_layer",
         [](const FrameImages& i) { return Images{i.backDepth}; }, viewDistance, y, near},
        {"normal", "world-space shading normal, 0 without a surface; PNG 0.5 + 0.5 n",
         [](const FrameImages& i) {
             return Images{i.g.normal, i.g.depth};
         },
         normal, xyz, direction},
        {"geometric_normal", "world-space normal of the triangle, facing the camera; PNG 0.5 + 0.5 n",
         [](const FrameImages& i) {
             return Images{i.g.geometricNormal, i.g.depth};
         },
         normal, xyz, direction},
        {"albedo", "base colour, linear", [](const FrameImages& i) { return Images{i.g.baseColor}; }, squaredColor, rgb,
         encoded},
        {"roughness", "perceptual roughness, 0 mirror to 1", [](const FrameImages& i) { return Images{i.g.material}; },
         first, y, grey},
        {"metallic", "0 dielectric to 1 metal", [](const FrameImages& i) { return Images{i.g.material}; }, green, y,
         grey},
        {"occlusion", "the materials' occlusion maps, 1 open",
         [](const FrameImages& i) { return Images{i.g.material}; }, blue, y, grey},
        {"emissive", "emitted radiance", [](const FrameImages& i) { return Images{i.g.emissive}; }, color, rgb, encoded,
         radiance},
        {"motion",
         "motion vector: uv minus uv in the previous frame, of the sky as the camera turns; PNG 0.5 + 10 motion",
         [](const FrameImages& i) {
             return Images{i.g.motion, i.g.depth};
         },
         motion, xy, offsets},
        {"confidence", "fraction of the ray weight not left to the environment: R diffuse, G specular",
         [](const FrameImages& i) {
             return Images{i.diffuse.source, i.specular.source};
         },
         bothAlphas, rg, redGreen},
        {"diffuse_confidence", "confidence of the diffuse rays only",
         [](const FrameImages& i) { return Images{i.diffuse.source}; }, alpha, y, grey},
        {"specular_confidence", "confidence of the reflection rays only",
         [](const FrameImages& i) { return Images{i.specular.source}; }, alpha, y, grey},
        {"hit_distance",
         "mean distance in metres over the rays that hit something, of which `confidence` is the share; 0 where none "
         "does: R diffuse, G specular; PNG bright is near; only with trace_screen.count_hits=true, which render sets "
         "by itself",
         [](const FrameImages& i) {
             return Images{i.diffuse.hits, i.specular.hits};
         },
         hitDistances, rg, nearRedGreen, countsHits},
        {"diffuse_hit_distance", "hit_distance of the diffuse rays only",
         [](const FrameImages& i) { return Images{i.diffuse.hits}; }, hitDistances, y, near, countsHits},
        {"specular_hit_distance", "hit_distance of the reflection rays only",
         [](const FrameImages& i) { return Images{i.specular.hits}; }, hitDistances, y, near, countsHits},
        {"steps",
         "mean ray march steps (depth samples) per ray: R diffuse, G specular; PNG 1 is 128 samples; only with "
         "trace_screen.count_steps=true, which render sets by itself",
         [](const FrameImages& i) {
             return Images{i.diffuse.steps, i.specular.steps};
         },
         bothFirsts, rg, countRedGreen, countsSteps},
        {"diffuse_steps", "steps of the diffuse rays only",
         [](const FrameImages& i) { return Images{i.diffuse.steps}; }, first, y, count, countsSteps},
        {"specular_steps", "steps of the reflection rays only",
         [](const FrameImages& i) { return Images{i.specular.steps}; }, first, y, count, countsSteps},
        {"rays",
         "rays per traced pixel in each tile of 8x8 traced pixels: R diffuse, G specular; one texel per tile; PNG 1 is "
         "8 rays",
         [](const FrameImages& i) {
             return Images{i.diffuse.tiles.tiles, i.specular.tiles.tiles};
         },
         bothFirsts, rg, raysCountedRedGreen, ownSize},
        {"diffuse_rays", "rays of the diffuse lobe only",
         [](const FrameImages& i) { return Images{i.diffuse.tiles.tiles}; }, first, y, raysCounted, ownSize},
        {"specular_rays", "rays of the specular lobe only",
         [](const FrameImages& i) { return Images{i.specular.tiles.tiles}; }, first, y, raysCounted, ownSize},
        {"tile_class",
         "surfaces of these tiles: 0 none (sky), 1 diffuse only, 2 some glossy, 3 mirrors but none glossy; one texel "
         "per tile; PNG blue, grey, orange, cyan",
         [](const FrameImages& i) {
             return Images{i.diffuse.tiles.tiles ? i.diffuse.tiles.tiles : i.specular.tiles.tiles};
         },
         green, y, classColor, ownSize},
        {"probe_atlas",
         "radiance captured by the probes: a row per probe with its cube map faces +X -X +Y -Y +Z -Z; black is the "
         "sky; in the atlas's size; only with probes.enabled",
         [](const FrameImages& i) { return Images{i.probeAtlas}; }, color, rgb, encoded, ownSize | radiance},
        {"source",
         "source of each ray's radiance, both lobes: cyan planar reflections, green screen, yellow ray tracing, "
         "magenta probes, blue environment",
         [](const FrameImages& i) {
             return Images{i.diffuse.source, i.specular.source};
         },
         meanColor, rgb, asIs},
        {"diffuse_source", "source of the diffuse rays only",
         [](const FrameImages& i) { return Images{i.diffuse.source}; }, color, rgb, asIs},
        {"specular_source", "source of the reflection rays only",
         [](const FrameImages& i) { return Images{i.specular.source}; }, color, rgb, asIs},
    };
    return all;
}

}  // namespace

std::span<const Show> shows() {
    return table();
}

}  // namespace reflet
