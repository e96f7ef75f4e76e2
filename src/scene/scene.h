// The scene description: meshes, materials, images, lamps, cameras, a sun, an environment. Plain values, filled by the
// loader or by a built-in scene, and read by both the GPU renderer and the reference path tracer.
// World: right-handed, Y up, metres. A view looks along its own -Z. Angles in radians. Its origin may be elsewhere than
// the file's (Scene::origin).
#pragma once

#include "base/image_file.h"
#include "base/math.h"
#include "scene/animation.h"
#include "scene/camera.h"

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace reflet {

/// 8-bit RGBA image, rows from the top. The texture slot that uses it decides whether it is sRGB.
struct TextureImage {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;  ///< width · height · 4 bytes
};

/// Material::alphaCutoff of blended materials.
constexpr float blendCutoff = 0.5F;

enum class Wrap : uint8_t { repeat, mirror, clamp };

/// Texture filtering and addressing. Mips are always generated; `mips` says whether they are used.
struct Sampler {
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    bool magLinear = true;
    bool minLinear = true;
    bool mips = true;
    bool mipLinear = true;

    bool operator==(const Sampler&) const = default;
};

/// A texture as a material refers to it. image < 0: no texture, only the factor applies.
struct TextureSlot {
    int32_t image = -1;    ///< index into Scene::images
    int32_t sampler = -1;  ///< index into Scene::samplers; < 0: Sampler{}
    uint32_t uvSet = 0;    ///< 0 or 1
    /// KHR_texture_transform as two rows: u' = dot(row[0], (u, v, 1)), v' = dot(row[1], (u, v, 1)).
    std::array<vec3, 2> uvTransform{vec3(1, 0, 0), vec3(0, 1, 0)};
};

/// KHR_texture_transform. The sine in u' is positive, as in the extension's example, its wording ("counter-clockwise",
/// with v down) and the common viewers; the matrix in early versions has it negative.
std::array<vec3, 2> uvTransformOf(const vec2& offset, double rotation, const vec2& scale);

/// KHR_materials_transmission and KHR_materials_volume. With a thickness the surface bounds a volume of the material, a
/// closed mesh whose front faces look outwards; without, it is a sheet that is thinner than a pixel.
struct Transmission {
    float factor = 0.0F;       ///< share of the light in the dielectric's base that passes the surface, 0..1
    float thickness = 0.0F;    ///< of the volume beneath the surface [m in object space]; 0: none
    vec3 attenuationColor{1};  ///< that white light has after `attenuationDistance` in the volume
    float attenuationDistance = std::numeric_limits<float>::infinity();  ///< metres in the world, > 0
    float dispersion = 0.0F;       ///< KHR_materials_dispersion: 20 over the Abbe number, >= 0; 0: none. Volumes only
    TextureSlot texture;           ///< red
    TextureSlot thicknessTexture;  ///< green
};

/// KHR_materials_clearcoat: a second layer of reflectance 0.04 over everything else.
struct Clearcoat {
    float factor = 0.0F;     ///< 0..1
    float roughness = 0.0F;  ///< perceptual, 0..1
    float normalScale = 1.0F;
    TextureSlot texture;           ///< red
    TextureSlot roughnessTexture;  ///< green
    TextureSlot normalTexture;     ///< none: the normal of the vertices
};

/// KHR_materials_sheen: fibres over the base and beneath the clear coat, whose light is seen at grazing angles.
struct Sheen {
    vec3 color{0.0F};              ///< factor, 0..1; 0: none
    float roughness = 0.0F;        ///< perceptual, factor, 0..1
    TextureSlot colorTexture;      ///< sRGB
    TextureSlot roughnessTexture;  ///< alpha
};

/// KHR_materials_anisotropy: the reflection is stretched along a direction of the surface.
struct Anisotropy {
    float strength = 0.0F;  ///< factor, 0..1; 0: none
    float rotation = 0.0F;  ///< of the direction from the tangent to the bitangent [rad]
    TextureSlot texture;    ///< red, green: direction, as -1..1 along tangent and bitangent; blue: strength
};

/// KHR_materials_iridescence: a thin film over the surface, whose interference colours the reflection.
struct Iridescence {
    float factor = 0.0F;           ///< share of the surface that it covers, 0..1; 0: none
    float ior = 1.3F;              ///< of the film, >= 1
    float thinnest = 100.0F;       ///< thickness where the texture is 0 [nm]
    float thickest = 400.0F;       ///< where it is 1, or without one [nm]
    TextureSlot texture;           ///< red
    TextureSlot thicknessTexture;  ///< green
};

/// KHR_materials_diffuse_transmission: the share of the base's diffuse light that leaves on the other side.
struct DiffuseTransmission {
    float factor = 0.0F;       ///< 0..1; 0: none
    vec3 color{1.0F};          ///< of that light, factor, 0..1
    TextureSlot texture;       ///< alpha
    TextureSlot colorTexture;  ///< sRGB
};

/// glTF metallic-roughness. Colours are linear.
struct Material {
    std::string name;
    vec4 baseColor{1.0F};    ///< factor, alpha in w
    float metallic = 1.0F;   ///< factor, 0..1
    float roughness = 1.0F;  ///< perceptual (alpha = roughness²), factor, 0..1
    vec3 emissive{0.0F};     ///< factor times strength: emitted radiance [W/(m² sr)]
    float normalScale = 1.0F;
    float occlusionStrength = 1.0F;
    float alphaCutoff = 0.0F;  ///< fragments with alpha < cutoff are discarded; 0: opaque
    /// alphaMode BLEND: alpha is coverage, the surface is composited over what is behind it. Its alphaCutoff,
    /// blendCutoff, is used where surfaces are there or not: in shadow maps, probes, live pictures.
    bool blended = false;
    bool doubleSided = false;
    bool unlit = false;            ///< KHR_materials_unlit: emits its base colour, reflects nothing
    float ior = 1.5F;              ///< KHR_materials_ior: index of refraction of the dielectric; 0: reflects all light
    float specular = 1.0F;         ///< KHR_materials_specular: strength of the dielectric's reflection, factor, 0..1
    vec3 specularColor{1.0F};      ///< its tint at normal incidence, factor, not negative
    std::string camera;            ///< name of the camera whose image the surface emits (alone); empty: none
    TextureSlot baseColorTexture;  ///< sRGB
    TextureSlot metallicRoughnessTexture;
    TextureSlot normalTexture;
    TextureSlot occlusionTexture;
    TextureSlot emissiveTexture;       ///< sRGB
    TextureSlot specularTexture;       ///< alpha
    TextureSlot specularColorTexture;  ///< sRGB
    Transmission transmission;
    Clearcoat clearcoat;
    Sheen sheen;
    Anisotropy anisotropy;
    Iridescence iridescence;
    DiffuseTransmission diffuseTransmission;
};

/// All textures of a Material or a const Material.
template <class M>
auto materialTextures(M& m) {
    return std::array{&m.baseColorTexture,
                      &m.metallicRoughnessTexture,
                      &m.normalTexture,
                      &m.occlusionTexture,
                      &m.emissiveTexture,
                      &m.specularTexture,
                      &m.specularColorTexture,
                      &m.transmission.texture,
                      &m.transmission.thicknessTexture,
                      &m.clearcoat.texture,
                      &m.clearcoat.roughnessTexture,
                      &m.clearcoat.normalTexture,
                      &m.sheen.colorTexture,
                      &m.sheen.roughnessTexture,
                      &m.anisotropy.texture,
                      &m.iridescence.texture,
                      &m.iridescence.thicknessTexture,
                      &m.diffuseTransmission.texture,
                      &m.diffuseTransmission.colorTexture};
}

/// Vertex attributes besides the position. Unit normal; unit tangent, w = ±1 (bitangent = w · cross(n, t)).
struct VertexAttributes {
    vec3 normal{0, 1, 0};
    vec4 tangent{1, 0, 0, 1};
    vec2 uv0{0.0F};
    vec2 uv1{0.0F};
    glm::u16vec4 color{65535};  ///< linear, unorm, multiplies the base colour
};

/// Triangles of one material, in object space. Three indices per triangle, front faces counter-clockwise.
struct Mesh {
    std::string name;
    std::vector<vec3> positions;
    std::vector<VertexAttributes> attributes;  ///< one per position
    std::vector<VertexSkin> skin;              ///< one per position, or empty
    std::vector<JointWeight> jointWeights;     ///< that `skin` refers to
    Morph morph;
    std::vector<uint32_t> indices;
    uint32_t material = 0;  ///< index into Scene::materials
    Aabb bounds;
    /// Of points and lines (thin_meshes.h): per position the unit vector from the point or line that it is beside; else
    /// empty. Positions are `width` along it, until they have been made a pixel wide.
    std::vector<vec3> outward;
    float width = 0.0F;

    /// The joints that move a vertex. Needs a skin.
    [[nodiscard]] std::span<const JointWeight> jointsOf(size_t vertex) const {
        return std::span(jointWeights).subspan(skin[vertex].first, skin[vertex].count);
    }
    /// Gives the next vertex its joints, whose weights sum to 1.
    void addSkin(std::span<const JointWeight> joints);
};

/// A mesh placed in the world. Instances may share a mesh.
struct Instance {
    std::string name;  ///< of the glTF node, may be empty
    uint32_t mesh = 0;
    mat4 objectToWorld{1.0F};  ///< unless its node is animated or it has a skin
    int32_t node = -1;         ///< index into Scene::nodes; < 0: none
    int32_t skin = -1;         ///< index into Scene::skins, whose joints place the mesh; < 0: none
    /// Of an animated morph, which needs a node: one for each morph target, where the node has no channel for them.
    /// Empty: the mesh keeps its shape.
    std::vector<float> weights;
    mat4 objectToNode{1.0F};  ///< an animated node places the mesh by its transform times this
};

/// Directional light. `irradiance` is what a surface that faces it receives [W/m²].
struct Sun {
    vec3 direction{0, -1, 0};  ///< the way the light travels, unit length
    vec3 irradiance{0.0F};
    float angularDiameter = glm::radians(0.53F);
    int32_t node = -1;  ///< index into Scene::nodes that it turns with; < 0: none

    bool operator==(const Sun&) const = default;
};

/// KHR_lights_punctual. Point and spot: intensity [W/sr]; directional: irradiance [W/m²].
struct Lamp {
    enum class Type : uint8_t { point, spot, directional };

    std::string name;
    Type type = Type::point;
    vec3 position{0.0F};
    vec3 direction{0, -1, 0};  ///< the way the light travels, unit length (spot, directional)
    vec3 intensity{1.0F};
    float range = 0.0F;                           ///< metres; 0: unlimited
    float innerAngle = 0.0F;                      ///< spot: from the axis, full strength inside
    float outerAngle = glm::quarter_pi<float>();  ///< spot: from the axis, dark outside
    /// Radius in metres of a disk that faces each receiver; 0: a point. It softens the lamp's shadows only: shading is
    /// that of a punctual light, as in KHR_lights_punctual. Directional: the tangent of half the angular diameter.
    float radius = 0.0F;
    int32_t node = -1;  ///< index into Scene::nodes that it moves with; < 0: none
};

/// Places a camera or a lamp at a node's transform; both point along its -Z.
void setTransform(Camera& camera, const mat4& toWorld);
void setTransform(Lamp& lamp, const mat4& toWorld);

/// Occluders nearer to a lamp than this cast no shadow: its own geometry, and rounding errors at a point light [m].
float lampClearance(float radius);

/// Light for rays that hit nothing. The mapping of directions to the image is in scene/environment.h. Two are equal
/// only if they share their image.
struct Environment {
    vec3 radiance{0.0F};  ///< constant over all directions [W/(m² sr)]; not used where there is an image
    /// Equirectangular, "R" "G" "B", linear, finite, not negative [W/(m² sr)], rows from the top (+Y). May be null.
    std::shared_ptr<const FloatImage> image;
    /// Absolute path that the image was read from; "sky" or "studio" (scene/default_light.h); empty: none of these.
    std::string imageFile;
    float intensity = 1.0F;  ///< scale of the image, not negative
    float rotation = 0.0F;   ///< of the image about +Y; 0: its centre is at -Z; 90 degrees: at -X

    bool operator==(const Environment&) const = default;
};

/// An animation of a file.
struct AnimationClip {
    std::string name;
    float seconds = 0.0F;  ///< until its last key
    size_t channels = 0;
    bool plays = false;  ///< it is in Scene::animations
};

struct Scene {
    std::string name;
    /// Of world space, in the coordinates of the file. Floats have few digits far from their origin, so it is near what
    /// the file has [m].
    glm::dvec3 origin{0.0};
    bool fromFile = false;  ///< its lights may have any unit; those of other scenes suit an exposure of 0
    std::vector<TextureImage> images;
    std::vector<Sampler> samplers;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Lamp> lamps;  ///< without the sun
    std::vector<Camera> cameras;
    std::optional<Sun> sun;  ///< the first directional light
    Environment environment;
    std::vector<Node> nodes;            ///< parents first; empty if there are neither animations nor skins
    std::vector<Animation> animations;  ///< that play, at once
    /// Parts of animated values that no animation changes, such as the strength of an animated colour; one key each.
    std::vector<PropertyChannel> resting;
    std::vector<Skin> skins;
    std::vector<std::string> extensions;  ///< that the file says it uses
    std::vector<std::string> variants;    ///< names of the file's material variants, whether chosen or not
    std::vector<AnimationClip> clips;     ///< the file's animations, whether chosen or not

    /// World-space bounds of all instances at time 0; empty if there are none.
    [[nodiscard]] Aabb bounds() const;
};

/// A reflection probe: where its cube map is captured, and the box for parallax correction.
struct Probe {
    vec3 position{0.0F};  ///< inside the box
    Aabb box;             ///< world space, not empty

    bool operator==(const Probe&) const = default;
};

/// What the camera sees where there is no surface. It lights nothing and is in no reflection.
struct Background {
    enum class Mode : uint8_t {
        environment,
        blur,  ///< the environment, blurred
        color,
        transparent  ///< alpha 0 in PNG and EXR
    };

    Mode mode = Mode::environment;
    vec3 color{0.0F};  ///< display value (sRGB-encoded, not exposed nor tone mapped), 0 to 1; used by Mode::color

    /// Whether images need the share of each pixel that surfaces cover.
    [[nodiscard]] bool needsCoverage() const { return mode == Mode::color || mode == Mode::transparent; }
    bool operator==(const Background&) const = default;
};

/// Camera, lighting and time of a render: everything that a view file can change.
struct View {
    static constexpr uint32_t maxProbes = 16;

    static constexpr double largestTime = 1e6;  // seconds; double precision there is 0.1 ns

    Camera camera;
    Sun sun;
    Environment environment;
    Background background;
    double time = 0.0;                         ///< of the scene's animations [s], 0 to largestTime
    std::optional<float> lampRadius;           ///< overrides the radius of all point and spot lamps [m]
    std::vector<uint32_t> lampsOff;            ///< indices into Scene::lamps that are off, ascending
    std::optional<std::vector<Probe>> probes;  ///< at most maxProbes; nullopt: placed automatically
    std::vector<std::string> mirrors;          ///< instances with planar reflections; empty: detected automatically
    bool hasDefaultSun = false;                ///< the scene has no light, and the sun is a default
    glm::dvec3 origin{0.0};                    ///< Scene::origin; positions in view files are relative to the file's

    bool operator==(const View&) const = default;
};

/// The scene's first camera, its sun and its environment. Without a camera: one that frames the whole scene from
/// slightly above; without any light, unless it is unlit: a sun from over the camera's shoulder.
View defaultView(const Scene& scene);

/// From behind the camera's left shoulder, 53 degrees above the horizon, white, pi W/m².
Sun defaultSun(const Camera& camera);

/// Whether nothing in the scene receives light, because all materials are unlit: such a scene, often with baked light,
/// needs no default light. False for an empty scene.
bool isUnlit(const Scene& scene);

/// World-to-view matrix; view space looks along -Z.
mat4 worldToView(const Camera& camera);

/// Reversed depth: 1 at the near plane, 0 at infinity (perspective) or at the far plane (orthographic). Vulkan's
/// clip space, Y down: uv = 0.5 + 0.5 · ndc.xy with (0,0) at the top left.
mat4 viewToClip(const Camera& camera, float aspect);

}  // namespace reflet
