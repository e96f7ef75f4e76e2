// What a picture is made of: meshes, materials, images, lamps, a camera, a sun, an environment. Plain values;
// every loader and every built-in scene ends here, and the GPU renderer and the reference both start here.
// World: right-handed, Y up, metres. A view looks along its own -Z. Angles in radians.
#pragma once

#include "base/image_file.h"
#include "base/math.h"
#include "scene/animation.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace reflet {

/// 8-bit image, four channels, rows from the top. Whether its colours are sRGB is said by the slot that uses it.
struct Image {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgba;  ///< width · height · 4 bytes
};

enum class Wrap : uint8_t { repeat, mirror, clamp };

/// How an image is read. Mips are always generated; `mips` says whether they are used.
struct Sampler {
    Wrap wrapU = Wrap::repeat;
    Wrap wrapV = Wrap::repeat;
    bool magLinear = true;
    bool minLinear = true;
    bool mips = true;
    bool mipLinear = true;

    bool operator==(const Sampler&) const = default;
};

/// A texture as one material slot sees it. image < 0: none, the slot's factor stands alone.
struct TextureSlot {
    int32_t image = -1;    ///< index into Scene::images
    int32_t sampler = -1;  ///< index into Scene::samplers; < 0: Sampler{}
    uint32_t uvSet = 0;    ///< 0 or 1
    /// KHR_texture_transform as two rows: u' = dot(row[0], (u, v, 1)), v' = dot(row[1], (u, v, 1)).
    std::array<vec3, 2> uvTransform{vec3(1, 0, 0), vec3(0, 1, 0)};
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
    float alphaCutoff = 0.0F;  ///< a fragment with alpha < cutoff is not there; 0: opaque
    bool doubleSided = false;
    std::string camera;            ///< the surface shows what that camera sees, and emits nothing else; empty: none
    TextureSlot baseColorTexture;  ///< sRGB
    TextureSlot metallicRoughnessTexture;
    TextureSlot normalTexture;
    TextureSlot occlusionTexture;
    TextureSlot emissiveTexture;  ///< sRGB
};

/// What a vertex has besides its position. Unit normal; unit tangent, w = ±1 (bitangent = w · cross(n, t)).
struct VertexAttributes {
    vec3 normal{0, 1, 0};
    vec4 tangent{1, 0, 0, 1};
    vec2 uv0{0.0F};
    vec2 uv1{0.0F};
    glm::u16vec4 color{65535};  ///< linear, unorm, multiplies the base colour
};

/// Triangles of one material, in object space. Three indices a triangle, front faces counter-clockwise.
struct Mesh {
    std::string name;
    std::vector<vec3> positions;
    std::vector<VertexAttributes> attributes;  ///< as many as positions
    std::vector<VertexSkin> skin;              ///< as many as positions, or none
    std::vector<uint32_t> indices;
    uint32_t material = 0;  ///< index into Scene::materials
    Aabb bounds;
};

/// A mesh at a place. Several may share a mesh.
struct Instance {
    std::string name;  ///< of the glTF node, may be empty
    uint32_t mesh = 0;
    mat4 objectToWorld{1.0F};  ///< where it is, unless its node moves or it has a skin
    int32_t node = -1;         ///< index into Scene::nodes; < 0: none
    int32_t skin = -1;         ///< index into Scene::skins, whose joints place the mesh; < 0: none
};

/// Perspective where orthographicHeight is 0, with reversed depth and an infinite far plane.
struct Camera {
    std::string name;
    vec3 position{0, 0, 5};
    vec3 target{0.0F};  ///< any point straight ahead, not the position itself
    vec3 up{0, 1, 0};   ///< not parallel to the view
    float fovY = glm::radians(60.0F);
    float near = 0.05F;               ///< metres, > 0
    float orthographicHeight = 0.0F;  ///< metres from the lower to the upper edge; > 0: orthographic
    float far = 1000.0F;              ///< metres; of an orthographic camera only
    bool aims = true;                 ///< at its target; false: that only says which way it looks
    int32_t node = -1;                ///< index into Scene::nodes: moves with it; < 0: does not move

    bool operator==(const Camera&) const = default;
};

/// Directional light. `irradiance` is what a surface that faces it receives [W/m²].
struct Sun {
    vec3 direction{0, -1, 0};  ///< the way the light travels, unit length
    vec3 irradiance{0.0F};
    float angularDiameter = glm::radians(0.53F);
    int32_t node = -1;  ///< index into Scene::nodes: turns with it; < 0: does not move

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
    float range = 0.0F;                           ///< metres; 0: without end
    float innerAngle = 0.0F;                      ///< spot: from the axis, full strength inside
    float outerAngle = glm::quarter_pi<float>();  ///< spot: from the axis, dark outside
    /// Metres; of a disk that faces whoever looks at it. It softens the lamp's shadow, and nothing else: the light is
    /// that of a point, as KHR_lights_punctual has it. 0: a point. Directional lamps have none.
    float radius = 0.0F;
    int32_t node = -1;  ///< index into Scene::nodes: moves with it; < 0: does not move
};

/// Puts a camera or a lamp where a node is: they look, and shine, along its -Z.
void putAt(Camera& camera, const mat4& toWorld);
void putAt(Lamp& lamp, const mat4& toWorld);

/// Metres round a lamp in which nothing casts its shadow: its own glass, or what rounding makes of the lamp's place.
float lampClearance(float radius);

/// What rays meet that meet nothing else. scene/environment.h says which direction is where in the image. Two are the
/// same only if they share their image.
struct Environment {
    vec3 radiance{0.0F};  ///< constant over all directions [W/(m² sr)]; not used where there is an image
    /// Equirectangular, "R" "G" "B", linear, finite, not negative [W/(m² sr)], rows from the top (+Y). May be null.
    std::shared_ptr<const FloatImage> image;
    std::string imageFile;   ///< absolute, where it was read from; empty: from no file
    float intensity = 1.0F;  ///< factor on the image, not negative
    float rotation = 0.0F;   ///< of the image about +Y; 0: its centre is seen along -Z; 90 degrees: along -X

    bool operator==(const Environment&) const = default;
};

struct Scene {
    std::string name;
    std::vector<Image> images;
    std::vector<Sampler> samplers;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Lamp> lamps;  ///< without the sun
    std::vector<Camera> cameras;
    std::optional<Sun> sun;  ///< the first directional light
    Environment environment;
    std::vector<Node> nodes;            ///< parents first; none where there are neither animations nor skins
    std::vector<Animation> animations;  ///< all play at once
    std::vector<Skin> skins;

    /// World-space box around all instances (at time 0); empty if there are none.
    [[nodiscard]] Aabb bounds() const;
};

/// A place from which reflections see the scene, and the box whose walls stand in for what is seen from there.
struct Probe {
    vec3 position{0.0F};  ///< inside the box
    Aabb box;             ///< world space, not empty

    bool operator==(const Probe&) const = default;
};

/// From where, and in which light, a scene is seen: what a view file can change.
struct View {
    static constexpr uint32_t maxProbes = 16;

    static constexpr double largestTime = 1e6;  // seconds; doubles count them to a ten-millionth of a millisecond

    Camera camera;
    Sun sun;
    Environment environment;
    double time = 0.0;                         ///< of the scene's animations [s], 0 to largestTime
    std::optional<float> lampRadius;           ///< of all lamps [m], in the place of their own
    std::vector<uint32_t> lampsOff;            ///< indices into Scene::lamps that do not shine, in rising order
    std::optional<std::vector<Probe>> probes;  ///< at most maxProbes; not given: the renderer places them itself
    std::vector<std::string> mirrors;          ///< names of instances that planar views are for; empty: they are found
    bool sunStandsIn = false;                  ///< the scene has no light; the sun is there so that something is seen

    bool operator==(const View&) const = default;
};

/// The scene's first camera, its sun and its environment; where it has none, a camera that frames the whole scene
/// from a little above, and (without any light at all) a sun from over the camera's shoulder.
View defaultView(const Scene& scene);

/// Camera-to-view matrix; view space looks along -Z.
mat4 worldToView(const Camera& camera);

/// Reversed depth: 1 at the near plane, 0 at infinity (perspective) or at the far plane (orthographic). Vulkan's
/// clip space, Y down: uv = 0.5 + 0.5 · ndc.xy with (0,0) at the top left.
mat4 viewToClip(const Camera& camera, float aspect);

}  // namespace reflet
