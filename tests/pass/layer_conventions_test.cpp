// The contract of layers behind glass and in mirrors (docs/datasets.md): what depth, albedo, motion and hit distance
// belong to, in the renderer and in the reference.
#include "pass/harness.h"
#include "reference/motion.h"
#include "reference/reference.h"

namespace reflet::test::layer_conventions_test {
namespace {

using builtin::at;

constexpr uvec2 size(64, 48);
constexpr float moved = 0.1F;     // metres to the right, of the camera
constexpr float toGlass = 5.0F;   // metres before the camera: a pane at the left
constexpr float toMirror = 6.0F;  // a mirror at the right
constexpr float toWall = 9.0F;    // all over
constexpr float behind = 3.0F;    // metres behind the camera: what the mirror shows

const uvec2 atGlass(16, 24);
const uvec2 atMirror(48, 24);
const vec3 wallColor(0.6F, 0.3F, 0.1F);
const vec3 mirrorColor(0.9F, 0.8F, 0.7F);

void add(Scene& scene, const std::string& name, const Material& material, const vec2& halfSize, const mat4& place) {
    builtin::place(scene, name, builtin::addMaterial(scene, material),
                   builtin::patch({.right = {halfSize.x, 0, 0}, .up = {0, halfSize.y, 0}}), place);
}

Scene makeScene() {
    Scene scene;
    add(scene, "wall", lambertMaterial(wallColor), {20, 20}, at({0, 0, -toWall}));
    Material pane = lambertMaterial(vec3(1.0F));
    pane.roughness = 0.0F;
    pane.doubleSided = true;
    pane.transmission.factor = 1.0F;
    add(scene, "pane", pane, {2, 2}, at({-2.5F, 0, -toGlass}));
    Material mirror = lambertMaterial(mirrorColor);
    mirror.metallic = 1.0F;
    mirror.roughness = 0.0F;
    add(scene, "mirror", mirror, {2, 2}, at({2.5F, 0, -toMirror}));
    Material board = lambertMaterial(vec3(0.5F));
    board.doubleSided = true;
    add(scene, "board", board, {30, 30}, at({0, 0, behind}));
    return scene;
}

View viewFrom(float x) {
    View view;
    view.camera.position = {x, 0, 0};
    view.camera.target = {x, 0, -1};
    view.camera.fovY = glm::radians(50.0F);
    view.sun.irradiance = vec3(0.0F);
    view.environment.radiance = vec3(1.0F);
    return view;
}

// Of a point at that distance, as the camera moves.
float motionAt(float distance) {
    return -moved / (2.0F * distance * std::tan(glm::radians(25.0F)) * static_cast<float>(size.x) / size.y);
}

vec3 texel(const FloatImage& image, const uvec2& pixel) {
    const size_t channels = image.channels.size();
    vec3 out(0.0F);
    for (size_t i = 0; i < std::min(channels, size_t(3)); ++i) {
        out[static_cast<int>(i)] = image.data.at((size_t(pixel.y) * image.width + pixel.x) * channels + i);
    }
    return out;
}

TEST(LayerConventions, OfTheRendererBehindGlassAndInMirrors) {
    const Scene scene = makeScene();
    const Pictures p =
        renderMoved(scene, viewFrom(0.0F), viewFrom(moved), size,
                    settingsOf({"trace_scene.enabled=true", "trace_screen.count_hits=true", "specular.rays=1"}),
                    {"depth", "albedo", "motion", "specular_hit_distance", "specular_confidence"});
    EXPECT_NEAR(p.value("depth", atGlass.x, atGlass.y), toWall, 0.01F) << "of the opaque surface behind the glass";
    EXPECT_LT(glm::distance(p.color("albedo", atGlass.x, atGlass.y), wallColor), 0.01F);
    EXPECT_NEAR(p.value("motion", atGlass.x, atGlass.y), motionAt(toWall), 1e-4F);
    EXPECT_NEAR(p.value("depth", atMirror.x, atMirror.y), toMirror, 0.01F) << "of the mirror, not of its image";
    EXPECT_LT(glm::distance(p.color("albedo", atMirror.x, atMirror.y), mirrorColor), 0.01F) << "its reflectance";
    EXPECT_NEAR(p.value("motion", atMirror.x, atMirror.y), motionAt(toMirror), 1e-4F);
    const vec3 seen = pixelDirection(viewFrom(moved).camera, size, atMirror.x, atMirror.y);
    EXPECT_NEAR(p.value("specular_hit_distance", atMirror.x, atMirror.y), (toMirror + behind) / -seen.z, 0.05F)
        << "of the first bounce, from the mirror";
    EXPECT_NEAR(p.value("specular_confidence", atMirror.x, atMirror.y), 1.0F, 0.01F);
}

TEST(LayerConventions, OfTheReferenceBehindGlassAndInMirrors) {
    const Scene scene = makeScene();
    ReferenceOptions options;
    options.samples = 4;
    const ReferencePicture picture = traceReference(scene, viewFrom(moved), size, options);
    const RayScene rays(scene);
    const MotionImages motion = traceMotion(rays, viewFrom(moved), rays, viewFrom(0.0F), size);
    EXPECT_NEAR(texel(picture.depth, atGlass).x, toGlass, 0.01F) << "of the glass";
    EXPECT_LT(glm::distance(texel(picture.albedo, atGlass), vec3(1.0F)), 0.01F);
    EXPECT_NEAR(texel(motion.motion, atGlass).x, motionAt(toGlass), 1e-4F);
    EXPECT_NEAR(texel(motion.previousDepth, atGlass).x, toGlass, 0.01F);
    EXPECT_NEAR(texel(picture.depth, atMirror).x, toMirror, 0.01F) << "of the mirror, not of its image";
    EXPECT_LT(glm::distance(texel(picture.albedo, atMirror), mirrorColor), 0.01F) << "its reflectance";
    EXPECT_NEAR(texel(motion.motion, atMirror).x, motionAt(toMirror), 1e-4F);
}

}  // namespace
}  // namespace reflet::test::layer_conventions_test
